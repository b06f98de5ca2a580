"""MS008: interface files can be read by rosidl."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.interfaces import ProblemKind, problems

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg srv/Add.srv)\n"


class InterfaceMalformed(Rule):
    """rosidl cannot read a line of a .msg, .srv or .action file.

    **Why.** The build stops in rosidl_adapter, with the line but not its number: a type that is
    none, a size that is no number, a default that does not fit its type, a missing ``---``.

    **Fix.** Write the line as the message says.

    **Source.** ``rosidl_adapter/parser.py``; ROS 2 documentation, "Interfaces".
    """

    code = "MS008"
    name = "interface-malformed"
    examples = (
        Example(
            "types, sizes, bounds and defaults",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "std_msgs/Header header\nuint8[<=3] levels [1, 2]\n"
                "string<=9 name 'beat'\n",
                "srv/Add.srv": "int32 a\n---\nint32 b\n",
            },
        ),
        Example(
            "a file that rosidl does not read",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "int32 count\n",
                "msg/Old.msg": "time stamp\n",
                "srv/Add.srv": "---\n",
            },
        ),
        Example(
            "a type of C, a default out of range, an indented line, no separator",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "int count\nuint8 level 256\n  bool on\nint32[0] none\n"
                "std_msgs/msg/String text\n",
                "srv/Add.srv": "int32 a\n",
            },
            reports=(
                Report(
                    "msg/Beat.msg:1:1",
                    "'int' is no type: neither a primitive one nor the name of an "
                    "interface, which starts with a capital and has only letters and "
                    "digits",
                ),
                Report("msg/Beat.msg:2:13", "'256' is outside of 'uint8', which holds 0 to 255"),
                Report(
                    "msg/Beat.msg:3:3",
                    "the line is indented: rosidl wants the type in the first column",
                ),
                Report(
                    "msg/Beat.msg:4:1",
                    "the size of the array 'int32[0]' is no whole number above 0, as in "
                    "'[3]', or '[<=3]' for at most three elements",
                ),
                Report(
                    "msg/Beat.msg:5:1",
                    "in a definition the type 'std_msgs/msg/String' is written 'std_msgs/String'",
                ),
                Report(
                    "srv/Add.srv:1:1",
                    "a .srv file has 1 line '---' between request, response; this one has 0",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for problem in problems(
            package, ProblemKind.SYNTAX, ProblemKind.TYPE, ProblemKind.VALUE, ProblemKind.SEPARATOR
        ):
            yield self.report(problem, problem.message)
