"""CM013: installed scripts say what runs them."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.cmake import is_only_imported, programs, runs_with_python

SHEBANG = "#!/usr/bin/env python3"
ENV_WORDS = 2
"""``/usr/bin/env python3``."""
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
            "a module that other scripts import",
            {"CMakeLists.txt": _LISTS, "talker/node.py": "def rate():\n    return 2.0\n"},
        ),
        Example(
            "a generator that CMake gives to Python",
            {
                "CMakeLists.txt": _LISTS,
                "cmake/talker-extras.cmake": "execute_process(\n"
                "  COMMAND ${Python3_EXECUTABLE} ${talker_DIR}/node.py)\n",
                "talker/node.py": "import rclpy\n",
            },
        ),
        Example(
            "without",
            {"CMakeLists.txt": _LISTS, "talker/node.py": "import rclpy\n"},
            Report(
                "talker/node.py:1:1",
                "installed as a program, but does not begin with #!/usr/bin/env python3",
                fix="begin with #!/usr/bin/env python3",
            ),
            fixed={"talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
        ),
        Example(
            "the Python of long ago",
            {"CMakeLists.txt": _LISTS, "talker/node.py": "#!/usr/bin/env python\nimport rclpy\n"},
            Report(
                "talker/node.py:1:1",
                "'#!/usr/bin/env python' names a Python that ROS 2 does not have",
                fix="begin with #!/usr/bin/env python3",
            ),
            fixed={"talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
        ),
        Example(
            "after a byte order mark",
            {"CMakeLists.txt": _LISTS, "talker/node.py": f"\ufeff{SHEBANG}\nimport rclpy\n"},
            Report(
                "talker/node.py:1:1",
                "a byte order mark comes before the shebang: the kernel does not recognize it",
                fix="begin with #!/usr/bin/env python3",
            ),
            fixed={"talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
        ),
        Example(
            "line ends of Windows",
            {"CMakeLists.txt": _LISTS, "talker/node.py": f"{SHEBANG}\r\nimport rclpy\r\n"},
            Report(
                "talker/node.py:1:1",
                "CRLF: the kernel looks for 'python3\\r'; save it with LF line ends",
            ),
        ),
        Example(
            "the Python of one machine",
            {"CMakeLists.txt": _LISTS, "talker/node.py": "#!/opt/bin/python3\nimport rclpy\n"},
            Report(
                "talker/node.py:1:1",
                "'#!/opt/bin/python3' does not exist on other machines; write "
                "#!/usr/bin/env python3",
                fix="begin with #!/usr/bin/env python3",
            ),
            fixed={"talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in sorted({program.path for program in programs(package)}):
            if not path.endswith(".py") or path.endswith("__init__.py") or not package.has(path):
                continue
            if is_only_imported(package, path) or runs_with_python(package, path):
                continue
            source = package.editable(path)
            line = source.lines[0]
            end = len(line)
            if line.startswith("\ufeff"):
                end = 1
                what = (
                    "a byte order mark comes before the shebang: the kernel does not recognize it"
                )
            elif not line.startswith("#!"):
                end = 0
                what = f"installed as a program, but does not begin with {SHEBANG}"
            elif line.rstrip().endswith(("/python", "/python2", "env python", "env python2")):
                what = f"{line.strip()!r} names a Python that ROS 2 does not have"
            elif source.text.partition("\n")[0].endswith("\r"):
                end = 0
                what = "CRLF: the kernel looks for 'python3\\r'; save it with LF line ends"
            elif not _starts_python(line.strip()):
                what = f"{line.strip()!r} does not exist on other machines; write {SHEBANG}"
            else:
                continue
            text = "" if end == 1 else SHEBANG if end else SHEBANG + source.newline
            fix = Fix(f"begin with {SHEBANG}", (Edit(path, 0, end, text),))
            is_crlf = what.startswith("CRLF")
            yield self.report(package.start_of(path), what, None if is_crlf else fix)


def _starts_python(line: str) -> bool:
    """Tell whether a shebang starts Python 3 wherever ROS 2 is installed."""
    words = line.removeprefix("#!").split()
    if words[:1] == ["/usr/bin/env"] and len(words) > 1:
        if words[1] == "-S":
            return len(words) > ENV_WORDS and words[2].startswith("python3")
        # The kernel passes everything after the first space as one argument.
        return words[1] in {"python3", "python3.12"} and len(words) == ENV_WORDS
    if words[:1] == ["/bin/env"]:
        return words[1:] == ["python3"]
    return words[:1] in (["/usr/bin/python3"], ["/usr/bin/python3.12"], ["/bin/python3"])
