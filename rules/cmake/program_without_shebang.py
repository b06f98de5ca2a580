"""CM013: installed scripts say what runs them."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Rule
from scaffold.model.cmake_facts import programs

SHEBANG = "#!/usr/bin/env python3"
_LISTS = "project(talker)\ninstall(PROGRAMS talker/node.py DESTINATION lib/${PROJECT_NAME})\n"


class ProgramWithoutShebang(Rule):
    """An installed Python script does not begin with ``#!/usr/bin/env python3``.

    **Why.** Without a first line the shell tries to run Python as shell script: ``Exec format
    error``. ``python`` without the 3 does not exist on Ubuntu, and a byte order mark or a blank
    line in front hides the line.

    **Fix.** Write the line first.

    **Source.** PEP 394; ``execve(2)``; ``ros2run`` starts the file itself.
    """

    code = "CM013"
    name = "program-without-shebang"
    examples = (
        Example("with", {"CMakeLists.txt": _LISTS, "talker/node.py": f"{SHEBANG}\nimport rclpy\n"}),
        Example(
            "without",
            {"CMakeLists.txt": _LISTS, "talker/node.py": "import rclpy\n"},
            at=("talker/node.py:1",),
            fixed={"talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
        ),
        Example(
            "the Python of long ago",
            {"CMakeLists.txt": _LISTS, "talker/node.py": "#!/usr/bin/env python\nimport rclpy\n"},
            at=("talker/node.py:1",),
            fixed={"talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
        ),
        Example(
            "behind a byte order mark",
            {"CMakeLists.txt": _LISTS, "talker/node.py": f"\ufeff{SHEBANG}\nimport rclpy\n"},
            at=("talker/node.py:1",),
            fixed={"talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in sorted({program.path for program in programs(package)}):
            if not path.endswith(".py") or path.endswith("__init__.py") or not package.has(path):
                continue
            source = package.editable(path)
            line = source.lines[0]
            end = len(line)
            if line.startswith("\ufeff"):
                end = 1
                what = "a byte order mark stands in front: the kernel does not see the shebang"
            elif not line.startswith("#!"):
                end = 0
                what = f"installed as a program, but does not begin with {SHEBANG}"
            elif line.rstrip().endswith(("/python", "/python2", "env python", "env python2")):
                what = f"{line.strip()!r} names a Python that ROS 2 does not have"
            else:
                continue
            text = "" if end == 1 else SHEBANG if end else SHEBANG + source.newline
            fix = Fix(f"begin with {SHEBANG}", (Edit(path, 0, end, text),))
            yield self.report(package.start_of(path), what, fix)
