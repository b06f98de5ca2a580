"""NM020: types, fields and constants of interfaces have names that rosidl accepts."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.interfaces import ProblemKind, problems

_LISTS = {
    "CMakeLists.txt": "project(my_msgs)\nrosidl_generate_interfaces(\n"
    "  ${PROJECT_NAME} msg/Beat.msg msg/my_beat.msg srv/Add.srv)\n"
}
_KINDS = (
    ProblemKind.TYPE_NAME,
    ProblemKind.FIELD_NAME,
    ProblemKind.CONSTANT_NAME,
    ProblemKind.DUPLICATE,
)


class InterfaceNameInvalid(Rule):
    """A type, field or constant of an interface has an invalid name, or the name of another one.

    **Why.** The build stops in rosidl_adapter: ``'my_type' is an invalid message name``,
    ``'maxSpeed' is an invalid field name``, ``'max' is an invalid constant name``, ``the fields
    iterable contains duplicate names``. An ``=`` makes a line a constant, also where a default
    was intended.

    **Fix.** Types are files in CamelCase; fields are lower-case words with single underscores
    between them; constants are written in capitals; a default comes after the name of a field
    without ``=``. No automatic fix: anyone who uses the name must follow.

    **Source.** ``rosidl_adapter/parser.py``, ``VALID_MESSAGE_NAME_PATTERN``,
    ``VALID_FIELD_NAME_PATTERN``, ``VALID_CONSTANT_NAME_PATTERN``, ``MessageSpecification``.
    """

    code = "NM020"
    name = "interface-name-invalid"
    examples = (
        Example("a type: capital first", {**_LISTS, "msg/Beat.msg": "int32 count\n"}),
        Example(
            "a type: small letters and an underscore",
            {**_LISTS, "msg/my_beat.msg": "int32 count\n"},
            Report(
                "msg/my_beat.msg:1:1",
                "the file name 'my_beat' is not a valid type name: rosidl requires letters and "
                "digits only, a capital first, as in 'MyBeat.msg'",
            ),
        ),
        Example("a field: lower case", {**_LISTS, "msg/Beat.msg": "float64 max_speed_2\n"}),
        Example(
            "fields: camel case, a trailing underscore",
            {**_LISTS, "msg/Beat.msg": "int32 count\nfloat64 maxSpeed\nint32 next_\n"},
            Report(
                "msg/Beat.msg:2:9",
                "'maxSpeed' is not a valid field name: rosidl requires lower-case letters, "
                "digits and single underscores, a letter first, as in 'max_speed'",
            ),
            Report(
                "msg/Beat.msg:3:7",
                "'next_' is not a valid field name: rosidl requires lower-case letters, digits "
                "and single underscores, a letter first, as in 'next'",
            ),
        ),
        Example(
            "constants: capitals; a default",
            {**_LISTS, "msg/Beat.msg": "int32 MAX_COUNT=5\nint32 count 1\n"},
        ),
        Example(
            "constants: small letters, a default with an equals sign, a bound with spaces",
            {**_LISTS, "msg/Beat.msg": "int32 max=5\nint32 count = 1\nstring <= 5 name\n"},
            Report(
                "msg/Beat.msg:1:7",
                "the '=' makes this line a constant, and 'max' is not a valid name "
                "for one: rosidl requires capitals, digits and single underscores, "
                "a letter first, as in 'MAX'",
            ),
            Report(
                "msg/Beat.msg:2:7",
                "the '=' makes this line a constant, and 'count' is not a valid "
                "name for one: rosidl requires capitals, digits and single "
                "underscores, a letter first, as in 'COUNT'",
            ),
            Report("msg/Beat.msg:3:8", "a bound is written without spaces, as in 'string<=10'"),
        ),
        Example(
            "the same name in request and response",
            {**_LISTS, "srv/Add.srv": "int32 a\n---\nint32 a\n"},
        ),
        Example(
            "twice in the request",
            {**_LISTS, "srv/Add.srv": "int32 a\nfloat64 a\n---\nint32 A=1\nint32 A=2\n"},
            Report("srv/Add.srv:2:9", "the field 'a' exists already, in line 1"),
            Report("srv/Add.srv:5:7", "the constant 'A' exists already, in line 4"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for problem in problems(package, *_KINDS):
            yield self.report(problem, problem.message)
