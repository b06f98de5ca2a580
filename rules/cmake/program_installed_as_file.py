"""CM090: programs are installed with their executable bit."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Safety
from scaffold.api.cmake import Install
from scaffold.api.install import paths_imported_by

_NODE = "#!/usr/bin/env python3\nimport rclpy\n\nif __name__ == '__main__':\n    rclpy.init()\n"
_LISTS = (
    "project(talker)\ninstall({} talker/node.py DESTINATION lib/${{PROJECT_NAME}})\n"
    "ament_package()\n"
)


class ProgramInstalledAsFile(Rule):
    """A script is installed to ``lib/<package>`` with ``FILES`` or ``DIRECTORY``.

    **Why.** Only ``PROGRAMS`` keeps the executable bit, and ``ros2 run`` lists nothing without it:
    ``No executable found``.

    **Fix.** Write ``PROGRAMS``.

    **Source.** CMake documentation, ``install``; ``ros2pkg/api/__init__.py``,
    ``get_executable_paths``.
    """

    code = "CM090"
    name = "program-installed-as-file"
    examples = (
        Example(
            "as a program",
            {"CMakeLists.txt": _LISTS.format("PROGRAMS"), "talker/node.py": _NODE},
            executable=("talker/node.py",),
        ),
        Example(
            "run by CMake itself",
            {
                "CMakeLists.txt": _LISTS.format("FILES"),
                "cmake/generate.cmake": "set(SCRIPT ${talker_DIR}/../../../lib/talker/node.py)\n",
                "talker/node.py": _NODE,
            },
            executable=("talker/node.py",),
        ),
        Example(
            "a module with a demo, next to the program that imports it",
            {
                "CMakeLists.txt": _LISTS.format("FILES").replace(
                    "ament_p", "install(PROGRAMS talker/run.py DESTINATION lib/talker)\nament_p"
                ),
                "talker/node.py": _NODE,
                "talker/run.py": "#!/usr/bin/env python3\nfrom node import Node\n\nNode()\n",
            },
            executable=("talker/node.py", "talker/run.py"),
        ),
        Example(
            "as a file",
            {"CMakeLists.txt": _LISTS.format("FILES"), "talker/node.py": _NODE},
            Report(
                "CMakeLists.txt:2:15",
                "install(FILES) drops the executable bit of talker/node.py: `ros2 "
                "run` finds no executable; install it with PROGRAMS",
                fix="write PROGRAMS",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("PROGRAMS")},
            executable=("talker/node.py",),
        ),
        Example(
            "its directory",
            {
                "CMakeLists.txt": _LISTS.format("DIRECTORY").replace("/node.py", ""),
                "talker/node.py": _NODE,
            },
            Report(
                "CMakeLists.txt:2:19",
                "install(DIRECTORY) drops the executable bit of talker/node.py: "
                "`ros2 run` finds no executable; install it with PROGRAMS",
            ),
            executable=("talker/node.py",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        programs = {
            item.path
            for install in package.cmake.installs
            if install.kind == "PROGRAMS"
            for item in install.items
            if item.path
        }
        imported = tuple(f"/{path}" for path in paths_imported_by(package, programs))
        for install in package.cmake.installs:
            if not self._loses_bits(package, install):
                continue
            for item in install.items:
                path = self._script(package, item.path or "", install.kind)
                is_module = path in programs or f"/{path}".endswith(imported)
                if path and not is_module and not _is_run_by_cmake(package, path):
                    message = (
                        f"install({install.kind}) drops the executable bit of {path}: `ros2 run` "
                        "finds no executable; install it with PROGRAMS"
                    )
                    yield self.report(item, message, self._fix(install))

    def _loses_bits(self, package: Package, install: Install) -> bool:
        target = (install.destination or "").rstrip("/")
        keeps = {"PERMISSIONS", "FILE_PERMISSIONS", "USE_SOURCE_PERMISSIONS"}
        return (
            install.kind in {"FILES", "DIRECTORY"}
            and target == f"lib/{package.cmake.project_name}"
            and not keeps & set(install.command.values)
        )

    def _script(self, package: Package, path: str, kind: str) -> str:
        """Return the node that a path is, or the first in a directory."""
        paths = [path]
        if kind == "DIRECTORY":
            paths = [file for file in package.files if file.startswith(f"{path}/")]
        for item in paths:
            if item in package.python_files and not item.endswith("__init__.py"):
                module = package.module(item)
                if module.is_script and module.has_main_guard:
                    return item
        return ""

    def _fix(self, install: Install) -> Fix | None:
        if install.kind != "FILES" or len(install.items) != 1:
            return None
        for argument in install.command.arguments:
            if argument.raw == "FILES":
                edit = Edit("CMakeLists.txt", argument.start, argument.end, "PROGRAMS")
                return Fix("write PROGRAMS", (edit,), Safety.SAFE)
        return None


def _is_run_by_cmake(package: Package, path: str) -> bool:
    """Tell whether a file of CMake names a script where it is installed, to run it itself."""
    place = f"/{package.cmake.project_name}/{path.rpartition('/')[2]}"
    return any(
        place in package.source(file).text
        for file in package.files
        if file.endswith((".cmake", ".cmake.in"))
    )
