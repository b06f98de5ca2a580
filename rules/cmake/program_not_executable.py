"""CM014: installed scripts are executable in the source tree, too."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, MakeExecutable, Package, Report, Rule
from scaffold.api.cmake import is_only_imported, programs

_LISTS = "project(talker)\ninstall(PROGRAMS talker/node.py DESTINATION lib/${PROJECT_NAME})\n"
_NODE = "#!/usr/bin/env python3\n"

_COPIED = ("RENAME", "PERMISSIONS", "CONFIGURATIONS", "COMPONENT")
"""With one of these CMake itself installs the file, and sets the bit."""


class ProgramNotExecutable(Rule):
    """An installed script has no executable bit.

    **Why.** ``colcon build --symlink-install`` links to the file as it is: ``No executable
    found``, or ``Permission denied``.

    **Fix.** ``chmod +x``.

    **Source.** ``ros2pkg.api.get_executable_paths`` asks for the bit; pyrobosim issue 182.
    """

    code = "CM014"
    name = "program-not-executable"
    examples = (
        Example(
            "executable",
            {"CMakeLists.txt": _LISTS, "talker/node.py": _NODE},
            executable=("talker/node.py",),
        ),
        Example(
            "a module that other scripts import",
            {"CMakeLists.txt": _LISTS, "talker/node.py": "def rate():\n    return 2.0\n"},
        ),
        Example(
            "a module that gives a class its methods in a loop",
            {
                "CMakeLists.txt": _LISTS,
                "talker/node.py": f"{_NODE}\n\nclass Talker:\n    pass\n\n\n"
                "for name in ('start', 'stop'):\n    setattr(Talker, name, print)\n",
            },
        ),
        Example(
            "installed by CMake itself under another name, which sets the bit",
            {
                "CMakeLists.txt": _LISTS.replace("DESTINATION", "RENAME node DESTINATION"),
                "talker/node.py": _NODE,
            },
        ),
        Example(
            "not executable",
            {"CMakeLists.txt": _LISTS, "talker/node.py": _NODE},
            Report(
                "talker/node.py:1:1",
                "CMakeLists.txt installs it as a program, but it has no executable "
                "bit: `colcon build --symlink-install` makes an executable that "
                "does not start",
                fix="make talker/node.py executable",
            ),
            fixed={"talker/node.py": _NODE},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        wanted = f"lib/{cmake.project_name}"
        reported: set[str] = set()
        for program in programs(package):
            path = program.path
            if path in reported or program.destination != wanted or not package.has(path):
                continue
            if any(program.command.has(keyword) for keyword in _COPIED):
                continue
            reported.add(path)
            if (
                package.is_executable(path)
                or not path.endswith(".py")
                or path.endswith("__init__.py")
                or is_only_imported(package, path)
            ):
                continue
            message = (
                "CMakeLists.txt installs it as a program, but it has no executable bit: "
                "`colcon build --symlink-install` makes an executable that does not start"
            )
            fix = Fix(f"make {path} executable", (MakeExecutable(path),))
            yield self.report(package.start_of(path), message, fix, cause="not executable")
