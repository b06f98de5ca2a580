"""NM025: backslashes in interface files are escapes that rosidl can read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.interfaces import escape_problem, interface_files

_LISTS = "project(my_msgs)\nrosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n"


class InterfaceTextEscape(Rule):
    r"""A comment or text of an interface holds a backslash that is not a valid escape.

    **Why.** The build stops in rosidl_adapter: ``UnicodeDecodeError processing template
    'struct.idl.em': 'unicodeescape' codec can't decode``, without the line. A backslash at the end
    of a comment does that, and so do ``\users`` and ``\x`` in the path of a file; ``\n`` stops the
    parser of the .idl file.

    **Fix.** Write a slash, or two backslashes.

    **Source.** ``rosidl_adapter/msg/__init__.py``, ``string_to_idl_string_literal``.
    """

    code = "NM025"
    name = "interface-text-escape"
    examples = (
        Example(
            "slashes, escapes, the end of the file, which rosidl leaves out",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "# in C:/users\nint32 count  # or \\d+\\\\\n# the end\\\n",
            },
        ),
        Example(
            "at the end, in a path",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": "# C:\\users\nint32 count  # of C:\\data\\\n# all \\\nint8 code\n",
            },
            Report("msg/Beat.msg:1:1", "rosidl cannot read the comment: truncated \\uXXXX escape"),
            Report("msg/Beat.msg:2:14", "rosidl cannot read the comment: \\ at end of string"),
            Report("msg/Beat.msg:3:1", "rosidl cannot read the comment: \\ at end of string"),
        ),
        Example(
            "a line end, a constant",
            {
                "CMakeLists.txt": _LISTS,
                "msg/Beat.msg": 'int8 code  # ends with \\n\nstring HOME="C:\\users"\n',
            },
            Report(
                "msg/Beat.msg:1:12",
                "rosidl cannot read the comment: its \\n ends the line in the middle of a text",
            ),
            Report("msg/Beat.msg:2:1", "rosidl cannot read the value: truncated \\uXXXX escape"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for file in interface_files(package):
            source = package.source(file.path)
            start = 0
            lines = source.text.splitlines(keepends=True)
            declared = _last_declaration(lines)
            for number, line in enumerate(lines):
                text, mark, comment = line.rstrip().partition("#")
                problem = escape_problem(comment.lstrip("#")) if mark else ""
                if problem and number <= declared:
                    at = source.location(start + len(text), start + len(line.rstrip()))
                    yield self.report(at, f"rosidl cannot read the comment: {problem}")
                problem = escape_problem(text)
                if problem:
                    at = source.location(start, start + len(text))
                    yield self.report(at, f"rosidl cannot read the value: {problem}")
                start += len(line)


def _last_declaration(lines: Sequence[str]) -> int:
    """Return the index of the last line that declares something: comments after it are dropped."""
    stated = [n for n, line in enumerate(lines) if line.partition("#")[0].strip(" \t\r\n-")]
    return stated[-1] if stated else -1
