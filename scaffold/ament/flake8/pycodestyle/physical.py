"""E101, E501, W191, W29x, W391: checks of physical lines."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.ament.finding import Finding
from scaffold.ament.python_text.text import PythonText

MAX_LENGTH = 99
"""The maximum line length of ament."""


def check(text: PythonText, max_length: int = MAX_LENGTH) -> Iterator[Finding]:
    """Yield the findings in single lines.

    Args:
        text: The file.
        max_length: The maximum line length.
    """
    if not text.lines:
        return
    if "\t" in text.text:
        yield from _tabs(text)
    if re.search(r"[ \t\v]\f*$", text.text, re.MULTILINE):
        yield from _trailing(text)
    yield from _end(text)
    yield from _too_long(text, max_length)


def _tabs(text: PythonText) -> Iterator[Finding]:
    for number, line in enumerate(text.lines, 1):
        indent = line[: len(line) - len(line.lstrip(" \t"))]
        if "\t" in indent:
            at = indent.index("\t") + 1
            yield Finding("W191", number, at, "the indentation contains tabs")
        other = next((at for at, item in enumerate(indent, 1) if item != text.indent_char), 0)
        if other:
            yield Finding("E101", number, other, "the indentation mixes tabs and spaces")


def _trailing(text: PythonText) -> Iterator[Finding]:
    for number, line in enumerate(text.lines, 1):
        shown = line.rstrip("\n").rstrip("\r").rstrip("\f")
        rest = shown.rstrip(" \t\v")
        if shown == rest:
            continue
        start, end = len(rest) + 1, len(shown) + 1
        code, message = (
            ("W291", "trailing whitespace") if rest else ("W293", "whitespace on a blank line")
        )
        inside_string = _is_inside_string(text, number)
        fix = () if inside_string else ((number, start, number, end, ""),)
        yield Finding(code, number, start, message, number, end, fix, "remove the whitespace")


def _is_inside_string(text: PythonText, line: int) -> bool:
    return text.is_without_tokens or line in text.multiline_rows


def _end(text: PythonText) -> Iterator[Finding]:
    last = text.lines[-1]
    number = len(text.lines)
    if last == "\n":
        first = number
        while first > 1 and not text.lines[first - 2].strip():
            first -= 1
        yield Finding(
            "W391",
            number,
            1,
            "blank line at the end of the file",
            fix=((first, 1, number + 1, 1, ""),),
            fix_title="Remove the blank lines",
        )
    elif not last.endswith("\n"):
        at = len(last) + 1
        fix = ((number, at, number, at, "\n"),)
        yield Finding(
            "W292",
            number,
            at,
            "no newline at the end of the file",
            number,
            at,
            fix,
            "add a newline",
        )


def _too_long(text: PythonText, most: int) -> Iterator[Finding]:
    for number, line in enumerate(text.lines, 1):
        if len(line) <= most:
            continue
        shown = line.rstrip()
        length = len(shown)
        if length <= most or (number == 1 and shown.startswith("#!")):
            continue
        if not _is_excused(text, number, shown, most):
            message = f"the line has {length} characters, {most} are allowed"
            yield Finding("E501", number, most + 1, message, number, length + 1)


def _is_excused(text: PythonText, number: int, line: str, most: int) -> bool:
    """Return whether the line is one long word, such as a URL, in a comment or a string."""
    words = line.split()
    if len(line) - len(words[-1]) >= most - 7:
        return False
    if words[:-1] == ["#"]:
        return True
    return len(words) == 1 and number in text.multiline_rows
