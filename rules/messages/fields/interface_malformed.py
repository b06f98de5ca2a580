"""MS008: rosidl can read interface files, and generate code for their names."""

from __future__ import annotations

import errno
import warnings
from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Effect, Example, Package, Rule
from scaffold.api.interfaces import ProblemKind, interface_files, problems, reserved

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg srv/Add.srv)\n"
_LISTS_NAMES = {
    "CMakeLists.txt": "project(my_msgs)\nrosidl_generate_interfaces(\n"
    "  ${PROJECT_NAME} msg/Beat.msg msg/my_beat.msg srv/Add.srv)\n"
}
_KINDS = (
    ProblemKind.TYPE_NAME,
    ProblemKind.FIELD_NAME,
    ProblemKind.CONSTANT_NAME,
    ProblemKind.DUPLICATE,
)
_LISTS_KEYWORDS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n"
_LISTS_ESCAPES = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n"
_C_MACROS = frozenset(
    {"BUFSIZ", "CLOCKS_PER_SEC", "EOF", "EXIT_FAILURE", "EXIT_SUCCESS", "NULL", "RAND_MAX"}
    | {"SEEK_CUR", "SEEK_END", "SEEK_SET", "SIZE_MAX"}
    | {f"{kind}{bits}_MAX" for kind in ("INT", "UINT") for bits in (8, 16, 32, 64)}
    | {f"INT{bits}_MIN" for bits in (8, 16, 32, 64)}
)
"""Macros of the headers that generated C++ code includes."""


class InterfaceMalformed(Rule):
    """A line of a .msg, .srv or .action file has an invalid form, name, keyword or escape.

    **Why.** The build fails in rosidl_adapter, which prints the line without its number, for
    example ``'maxSpeed' is an invalid field name``. An invalid escape, such as a backslash at the
    end of a comment or before ``x`` or ``users``, raises a ``UnicodeDecodeError`` that does not
    show the line. If a field name is a C or C++ keyword, the generated code does not compile; if
    it is a Python keyword, ``message.from`` is a ``SyntaxError``.

    **Fix.** Correct the line as the message shows. File names are in CamelCase, field names in
    snake_case, constants in upper case. A default follows the field name without ``=``. No
    automatic fix: all code that uses a renamed field or constant must change, too.

    **Source.** ``rosidl_adapter/parser.py``; ``rosidl_adapter/msg/__init__.py``,
    ``string_to_idl_string_literal``; ``rosidl_generator_py/generate_py_impl.py``; the keywords of
    C17 and C++17; ROS 2 documentation, "Interfaces".
    """

    code = "MS008"
    name = "interface-malformed"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "valid types, array sizes, bounds and defaults",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "std_msgs/Header header\nuint8[<=3] levels [1, 2]\n"
                "string<=9 name 'beat'\n",
                "srv/Add.srv": "int32 a\n---\nint32 b\n",
            },
        ),
        Example(
            "invalid file that CMakeLists.txt does not list",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "int32 count\n",
                "msg/Old.msg": "time stamp\n",
                "srv/Add.srv": "---\n",
            },
        ),
        Example(
            "C type, default out of range, indented line, missing separator",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "int count\nuint8 level 256\n  bool on\nint32[0] none\n"
                "std_msgs/msg/String text\n",
                "srv/Add.srv": "int32 a\n",
            },
            "msg/Beat.msg:1:1: 'int' is neither a primitive type nor an interface name (a capital "
            "letter, then letters and digits)",
            "msg/Beat.msg:2:13: '256' is out of range for 'uint8': 0 to 255",
            "msg/Beat.msg:3:3: indented line: rosidl needs the type in the first column",
            "msg/Beat.msg:4:1: invalid array size in 'int32[0]'; write a positive integer, as in "
            "'[3]', or '[<=3]' for at most three elements",
            "msg/Beat.msg:5:1: definitions name this type without 'msg'; write 'std_msgs/String'",
            "srv/Add.srv:1:1: a .srv file needs 1 line '---' between request, response, but this "
            "file has 0",
        ),
        Example(
            "lower-case file name with an underscore",
            {**_LISTS_NAMES, "msg/my_beat.msg": "int32 count\n"},
            "msg/my_beat.msg:1:1: the file name 'my_beat' is not a valid type name: rosidl "
            "requires letters and digits only, a capital first, as in 'MyBeat.msg'",
        ),
        Example(
            "field names in camel case and with a trailing underscore",
            {**_LISTS_NAMES, "msg/Beat.msg": "int32 count\nfloat64 maxSpeed\nint32 next_\n"},
            "msg/Beat.msg:2:9: 'maxSpeed' is not a valid field name: rosidl requires lower-case "
            "letters, digits and single underscores, a letter first, as in 'max_speed'",
            "msg/Beat.msg:3:7: 'next_' is not a valid field name: rosidl requires lower-case "
            "letters, digits and single underscores, a letter first, as in 'next'",
        ),
        Example(
            "constant in capitals, field with a default",
            {**_LISTS_NAMES, "msg/Beat.msg": "int32 MAX_COUNT=5\nint32 count 1\n"},
        ),
        Example(
            "lower-case constant, default with an equals sign, bound with spaces",
            {**_LISTS_NAMES, "msg/Beat.msg": "int32 max=5\nint32 count = 1\nstring <= 5 name\n"},
            "msg/Beat.msg:1:7: the '=' makes this line a constant, and 'max' is not a valid name "
            "for one: rosidl requires capitals, digits and single underscores, a letter first, as "
            "in 'MAX'",
            "msg/Beat.msg:2:7: the '=' makes this line a constant, and 'count' is not a valid "
            "name for one: rosidl requires capitals, digits and single underscores, a letter "
            "first, as in 'COUNT'",
            "msg/Beat.msg:3:8: a bound is written without spaces, as in 'string<=10'",
        ),
        Example(
            "same field name in request and response",
            {**_LISTS_NAMES, "srv/Add.srv": "int32 a\n---\nint32 a\n"},
        ),
        Example(
            "duplicate field in the request, duplicate constant in the response",
            {**_LISTS_NAMES, "srv/Add.srv": "int32 a\nfloat64 a\n---\nint32 A=1\nint32 A=2\n"},
            "srv/Add.srv:2:9: the field 'a' exists already, in line 1",
            "srv/Add.srv:5:7: the constant 'A' exists already, in line 4",
        ),
        Example(
            "C++ and Python keywords as field names",
            {
                "CMakeLists.txt": _LISTS_KEYWORDS,
                "msg/Beat.msg": "string class\nint32 from\nbool ok\n",
            },
            "msg/Beat.msg:1:8: 'class' is a keyword of C or C++: the generated code does not "
            "compile",
            "msg/Beat.msg:2:7: 'from' is a keyword of Python: 'message.from' is a SyntaxError",
        ),
        Example(
            "C macros as constant names",
            {
                "CMakeLists.txt": _LISTS_KEYWORDS,
                "msg/Beat.msg": "int8 NULL=0\nint8 EIO=1\nint8 OK=2\n",
            },
            "msg/Beat.msg:1:6: 'NULL' is a macro of C: the generated C++ code does not compile",
            "msg/Beat.msg:2:6: 'EIO' is a macro of C: the generated C++ code does not compile",
        ),
        Example(
            "message named like a Python keyword",
            {
                "CMakeLists.txt": _LISTS_KEYWORDS.replace("Beat", "None"),
                "msg/None.msg": "int8 count\n",
            },
            "msg/None.msg:1:1: 'None' is a keyword of Python: the generated module is a "
            "SyntaxError",
        ),
        Example(
            "slashes and escaped backslashes in comments",
            {
                "CMakeLists.txt": _LISTS_ESCAPES,
                "msg/Beat.msg": "# in C:/users\nint32 count  # or \\d+\\\\\n# the end\\\n",
            },
        ),
        Example(
            "backslashes at the end of comments and in Windows paths",
            {
                "CMakeLists.txt": _LISTS_ESCAPES,
                "msg/Beat.msg": "# C:\\users\nint32 count  # of C:\\data\\\n# all \\\nint8 code\n",
            },
            "msg/Beat.msg:1:1: rosidl cannot read the comment: truncated \\uXXXX escape",
            "msg/Beat.msg:2:14: rosidl cannot read the comment: \\ at end of string",
            "msg/Beat.msg:3:1: rosidl cannot read the comment: \\ at end of string",
        ),
        Example(
            "backslash-n in a comment, Windows path in a constant",
            {
                "CMakeLists.txt": _LISTS_ESCAPES,
                "msg/Beat.msg": 'int8 code  # ends with \\n\nstring HOME="C:\\users"\n',
            },
            "msg/Beat.msg:1:12: rosidl cannot read the comment: its \\n ends the line in the "
            "middle of a text",
            "msg/Beat.msg:2:1: rosidl cannot read the value: truncated \\uXXXX escape",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_lines(package)
        yield from self._check_names(package)
        yield from self._check_keywords(package)
        yield from self._check_escapes(package)

    def _check_lines(self, package: Package) -> Iterator[Diagnostic]:
        for problem in problems(
            package, ProblemKind.SYNTAX, ProblemKind.TYPE, ProblemKind.VALUE, ProblemKind.SEPARATOR
        ):
            yield self.report(problem, problem.message)

    def _check_names(self, package: Package) -> Iterator[Diagnostic]:
        for problem in problems(package, *_KINDS):
            yield self.report(problem, problem.message)

    def _check_keywords(self, package: Package) -> Iterator[Diagnostic]:
        for file in interface_files(package):
            message = _reserved_type(file.name)
            if message:
                yield self.report(package.start_of(file.path), message)
            for section in file.definition.sections:
                for field in section.fields:
                    message = reserved(field.name)
                    if message:
                        yield self.report(field, message)
                for constant in section.constants:
                    message = _reserved_constant(constant.name)
                    if message:
                        yield self.report(constant, message)

    def _check_escapes(self, package: Package) -> Iterator[Diagnostic]:
        for file in interface_files(package):
            source = package.source(file.path)
            start = 0
            lines = source.text.splitlines(keepends=True)
            declared = _last_declaration(lines)
            for number, line in enumerate(lines):
                text, mark, comment = line.rstrip().partition("#")
                problem = _escape_problem(comment.lstrip("#")) if mark else ""
                if problem and number <= declared:
                    at = source.location(start + len(text), start + len(line.rstrip()))
                    yield self.report(at, f"rosidl cannot read the comment: {problem}")
                problem = _escape_problem(text)
                if problem:
                    at = source.location(start, start + len(text))
                    yield self.report(at, f"rosidl cannot read the value: {problem}")
                start += len(line)


def _last_declaration(lines: Sequence[str]) -> int:
    """Return the index of the last declaration: comments after it are dropped."""
    stated = [n for n, line in enumerate(lines) if line.partition("#")[0].strip(" \t\r\n-")]
    return stated[-1] if stated else -1


def _escape_problem(text: str) -> str:
    """Return the problem with the backslashes of a text, which rosidl reads as escapes."""
    if "\\" not in text:
        return ""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of \d, which is kept
        try:
            read = text.encode().decode("unicode_escape")
        except UnicodeDecodeError as error:
            return error.reason
    return "its \\n ends the line in the middle of a text" if "\n" in read else ""


def _reserved_constant(name: str) -> str:
    """Return why a constant cannot have a name; empty if it can."""
    is_macro = name in _C_MACROS or name in errno.errorcode.values()
    return _named_like_a_macro(name) if is_macro else ""


def _reserved_type(name: str) -> str:
    """Return why an interface cannot have a name; empty if it can."""
    if name in {"None", "True", "False"}:
        return f"{name!r} is a keyword of Python: the generated module is a SyntaxError"
    return _named_like_a_macro(name) if name in _C_MACROS else ""


def _named_like_a_macro(name: str) -> str:
    return f"{name!r} is a macro of C: the generated C++ code does not compile"
