"""MS008: rosidl can read interface files."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.interfaces import ProblemKind, problems

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg srv/Add.srv)\n"


class InterfaceMalformed(Rule):
    """rosidl cannot parse a line of a .msg, .srv or .action file.

    **Why.** The build stops in rosidl_adapter, with the line but not its number: an invalid
    type or array size, a default that does not fit its type, a missing ``---``.

    **Fix.** Correct the line as the message shows.

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
            "a file that is not generated",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "int32 count\n",
                "msg/Old.msg": "time stamp\n",
                "srv/Add.srv": "---\n",
            },
        ),
        Example(
            "a C type, a default out of range, an indented line, no separator",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "int count\nuint8 level 256\n  bool on\nint32[0] none\n"
                "std_msgs/msg/String text\n",
                "srv/Add.srv": "int32 a\n",
            },
            Report(
                "msg/Beat.msg:1:1",
                "'int' is neither a primitive type nor an interface name (a capital "
                "letter, then letters and digits)",
            ),
            Report("msg/Beat.msg:2:13", "'256' is out of range for 'uint8': 0 to 255"),
            Report("msg/Beat.msg:3:3", "indented line: rosidl needs the type in the first column"),
            Report(
                "msg/Beat.msg:4:1",
                "invalid array size in 'int32[0]'; write a positive integer, as in "
                "'[3]', or '[<=3]' for at most three elements",
            ),
            Report(
                "msg/Beat.msg:5:1",
                "definitions name this type without 'msg'; write 'std_msgs/String'",
            ),
            Report(
                "srv/Add.srv:1:1",
                "a .srv file needs 1 line '---' between request, response, but this file has 0",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for problem in problems(
            package, ProblemKind.SYNTAX, ProblemKind.TYPE, ProblemKind.VALUE, ProblemKind.SEPARATOR
        ):
            yield self.report(problem, problem.message)
