"""NM021: fields of interfaces have names that rosidl takes."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.interfaces import ProblemKind, problems

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n"


class InterfaceFieldName(Rule):
    """A field of an interface has a name that rosidl refuses.

    **Why.** The build stops in rosidl_adapter: ``'maxSpeed' is an invalid field name``.

    **Fix.** Write lower-case words with single underscores between them. No automatic fix: whoever
    uses the field must follow.

    **Source.** ``rosidl_adapter/parser.py``, ``VALID_FIELD_NAME_PATTERN``.
    """

    code = "NM021"
    name = "interface-field-name"
    examples = (
        Example("lower case", {"CMakeLists.txt": _LISTS, "msg/Beat.msg": "float64 max_speed_2\n"}),
        Example(
            "camel case, a trailing underscore",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "int32 count\nfloat64 maxSpeed\nint32 next_\n",
            },
            Report(
                "msg/Beat.msg:2:9",
                "'maxSpeed' is no field name: rosidl wants lower-case letters, "
                "digits and single underscores, a letter first, as in 'max_speed'",
            ),
            Report(
                "msg/Beat.msg:3:7",
                "'next_' is no field name: rosidl wants lower-case letters, digits "
                "and single underscores, a letter first, as in 'next'",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for problem in problems(package, ProblemKind.FIELD_NAME):
            yield self.report(problem, problem.message)
