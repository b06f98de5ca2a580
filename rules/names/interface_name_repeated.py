"""NM023: fields and constants of an interface have names of their own."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.interfaces import ProblemKind, problems

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} srv/Add.srv)\n"


class InterfaceNameRepeated(Rule):
    """Two fields, or two constants, of an interface have the same name.

    **Why.** The build stops in rosidl_adapter: ``the fields iterable contains duplicate names``.

    **Fix.** Rename one, or remove it.

    **Source.** ``rosidl_adapter/parser.py``, ``MessageSpecification``.
    """

    code = "NM023"
    name = "interface-name-repeated"
    examples = (
        Example(
            "the same name in request and response",
            {"CMakeLists.txt": _LISTS, "srv/Add.srv": "int32 a\n---\nint32 a\n"},
        ),
        Example(
            "twice in the request",
            {
                "CMakeLists.txt": _LISTS,
                "srv/Add.srv": "int32 a\nfloat64 a\n---\nint32 A=1\nint32 A=2\n",
            },
            Report("srv/Add.srv:2:9", "the field 'a' exists already, in line 1"),
            Report("srv/Add.srv:5:7", "the constant 'A' exists already, in line 4"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for problem in problems(package, ProblemKind.DUPLICATE):
            yield self.report(problem, problem.message)
