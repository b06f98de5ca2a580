"""NM022: constants of interfaces have names that rosidl takes."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.interfaces import ProblemKind, problems

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n"


class InterfaceConstantName(Rule):
    """A constant of an interface has a name that rosidl refuses.

    **Why.** The build stops in rosidl_adapter: ``'max' is an invalid constant name``. An ``=``
    makes a line a constant, also where a default was meant.

    **Fix.** Write capitals; a default comes after the name of a field without ``=``.

    **Source.** ``rosidl_adapter/parser.py``, ``VALID_CONSTANT_NAME_PATTERN``.
    """

    code = "NM022"
    name = "interface-constant-name"
    examples = (
        Example(
            "capitals, a default",
            {"CMakeLists.txt": _LISTS, "msg/Beat.msg": "int32 MAX_COUNT=5\nint32 count 1\n"},
        ),
        Example(
            "small letters, a default with an equals sign, a bound with spaces",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "int32 max=5\nint32 count = 1\nstring <= 5 name\n",
            },
            Report(
                "msg/Beat.msg:1:7",
                "the '=' makes this line a constant, and 'max' is no name of one: "
                "rosidl wants capitals, digits and single underscores, a letter "
                "first, as in 'MAX'",
            ),
            Report(
                "msg/Beat.msg:2:7",
                "the '=' makes this line a constant, and 'count' is no name of one: "
                "rosidl wants capitals, digits and single underscores, a letter "
                "first, as in 'COUNT'",
            ),
            Report("msg/Beat.msg:3:8", "a bound is written without blanks, as in 'string<=10'"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for problem in problems(package, ProblemKind.CONSTANT_NAME):
            yield self.report(problem, problem.message)
