"""NM020: interface files are named like types."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.interfaces import ProblemKind, problems

_LISTS = (
    "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg msg/my_beat.msg)\n"
)


class InterfaceTypeName(Rule):
    """A .msg, .srv or .action file has a name that is not a type name.

    **Why.** The build stops in rosidl_adapter: ``'my_type' is an invalid message name``.

    **Fix.** Rename the file: letters and digits only, a capital first. No automatic fix: whoever
    uses the type must follow.

    **Source.** ``rosidl_adapter/parser.py``, ``VALID_MESSAGE_NAME_PATTERN``.
    """

    code = "NM020"
    name = "interface-type-name"
    examples = (
        Example("capital first", {"CMakeLists.txt": _LISTS, "msg/Beat.msg": "int32 count\n"}),
        Example(
            "small letters and an underscore",
            {"CMakeLists.txt": _LISTS, "msg/my_beat.msg": "int32 count\n"},
            Report(
                "msg/my_beat.msg:1:1",
                "the file name 'my_beat' is no type name: rosidl wants letters and "
                "digits only, a capital first, as in 'MyBeat.msg'",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for problem in problems(package, ProblemKind.TYPE_NAME):
            yield self.report(problem, problem.message)
