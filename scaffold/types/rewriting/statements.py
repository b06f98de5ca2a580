"""Finds statements, definitions and names in source text without parsing it.

Most searches use ``str.find``, which is many times faster than a regular expression tried at each
position.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import lru_cache

from scaffold import lazy_re

_FIRST = lazy_re.compile(r"[ \t]*([^\W\d]\w*)")
_BLOCKS = frozenset({"if", "for", "with"})
_INSIDE = frozenset(
    {"elif", "else", "except", "finally", "case", "while", "and", "or", "in", "is", "not"}
    | {"def", "class", "async", "lambda", "import", "from"}
)
"""Keywords at the start of a line before which no line can be inserted."""
_SOMETIMES = lazy_re.compile(r"\b(?:lambda|for|if|else|and|or)\b|:=")
"""Matches code that makes a call conditional or deferred."""
_GOES_ON = lazy_re.compile(r"(?:[,(\[{\\=+\-*/%|&<>.]|\b(?:and|or|not|in|is|if|else|lambda|for))$")
_HEAD = lazy_re.compile(
    r"[ \t]*(?:(?:if|elif|else|for|while|with|try|except|finally|def|class|async|match|case)\b"
    r"|[)\]])"
)
_IN_F_STRING = lazy_re.compile(r"""\bf(['"])[^'"\n{}]*\{$""")
"""Matches the text before a call in an f-string."""
_LINES_BACK = 6
_MOST_LINES = 20
"""The maximum number of lines of a statement before a call in it."""
_MOST_AFTER = 2_000
"""The maximum length of a statement after a call in it."""
_BRACKET = lazy_re.compile(r"[()\[\]{}]")
_STRING = lazy_re.compile(r"(?<![\w'\"])[rRbBuU]?(?:'[^'\\\n{}]*'|\"[^\"\\\n{}]*\")(?!['\"])")
"""Matches a string on one line, without braces: in an f-string, these contain code."""
_TRIPLE = ('"""', "'''")


def statement_around(text: str, start: int, end: int) -> int:
    """Return the start of the statement around a call; -1 if the call may not be executed."""
    line = text.rfind("\n", 0, start) + 1
    if not _ends_statement(text, line):
        return _wrapped_statement_around(text, start, end)
    stop = text.find("\n", end)
    after = text[end : stop if stop >= 0 else len(text)]
    first = _FIRST.match(text, line)
    if first is None or first[1] in _INSIDE:
        return -1
    if first[1] in _BLOCKS and not after.rstrip().endswith(":"):
        return -1
    before = _IN_F_STRING.sub("", text[first.end() : start])
    if _SOMETIMES.search(before) or _SOMETIMES.search(after):
        return -1
    if before.count("'") % 2 or before.count('"') % 2 or not _is_closed(before, after):
        return -1
    return -1 if _is_in_docstring(text, start) else line


def _wrapped_statement_around(text: str, start: int, end: int) -> int:
    """Return the start of a statement of several lines around a call; -1 if that is uncertain."""
    line = text.rfind("\n", 0, start) + 1
    for _ in range(_MOST_LINES):
        line = text.rfind("\n", 0, line - 1) + 1
        if not line or _ends_statement(text, line):
            break
    first = _FIRST.match(text, line)
    if first is None or first[1] in _INSIDE | _BLOCKS or _is_in_docstring(text, start):
        return -1
    before = _STRING.sub("", text[first.end() : start])
    stop = text.find("\n\n", end, end + _MOST_AFTER)
    after = _STRING.sub("", text[end : stop if stop >= 0 else end + _MOST_AFTER])
    depth = sum(map(before.count, "([{")) - sum(map(before.count, ")]}"))
    if depth <= 0 or any(mark in before for mark in "#'\""):
        return -1
    for sign in _BRACKET.finditer(after):
        depth += 1 if sign[0] in "([{" else -1
        if not depth:
            inside = before + after[: after.find("\n", sign.end())]
            return -1 if "#" in inside or _SOMETIMES.search(inside) else line
    return -1


def _is_in_docstring(text: str, at: int) -> bool:
    """Return whether a position is in a string of several lines, such as a usage example."""
    return any(start < at < end for start, end in _docstrings(text))


@lru_cache(maxsize=1)
def _docstrings(text: str) -> Sequence[tuple[int, int]]:
    """Return the ranges of the strings in triple quotes."""
    ranges: list[tuple[int, int]] = []
    end = 0
    while True:
        starts = [start for quotes in _TRIPLE if (start := text.find(quotes, end)) >= 0]
        if not starts:
            return ranges
        start = min(starts)
        end = text.find(text[start : start + 3], start + 3)
        end = len(text) if end < 0 else end + 3
        ranges.append((start, end))


def definitions(pattern: re.Pattern[str], text: str) -> Iterator[re.Match[str]]:
    """Yield the matches of an expression at the start of lines with a ``def``."""
    end = 0
    at = text.find("def ")
    while at >= 0:
        line = text.rfind("\n", 0, at) + 1
        match = pattern.match(text, line) if line >= end else None
        if match is not None:
            yield match
            end = match.end()
        at = text.find("def ", max(at + 1, end))


def lines_like(
    pattern: re.Pattern[str], part: re.Pattern[str], text: str
) -> Iterator[re.Match[str]]:
    """Yield the matches of an expression at the start of lines.

    Args:
        pattern: The expression.
        part: What its matches contain in their first line, starting with a fixed character.
        text: The text.
    """
    last = -1
    for found in part.finditer(text):
        line = text.rfind("\n", 0, found.start()) + 1
        match = pattern.match(text, line) if line != last else None
        last = line
        if match is not None:
            yield match


def class_starts(text: str) -> Iterator[int]:
    """Yield the positions of the classes of a module."""
    if text.startswith("class "):
        yield 0
    at = text.find("\nclass ")
    while at >= 0:
        yield at + 1
        at = text.find("\nclass ", at + 1)


def mentions(text: str, name: str, start: int = 0, end: int | None = None) -> Iterator[int]:
    """Yield the positions of a name, not as a part or an attribute of others."""
    at = text.find(name, start, end)
    while at >= 0:
        before, after = text[at - 1 : at] if at else "", text[at + len(name) : at + len(name) + 1]
        if not (before.isalnum() or before in {"_", "."} or after.isalnum() or after == "_"):
            yield at
        at = text.find(name, at + 1, end)


def _is_closed(before: str, after: str) -> bool:
    """Return whether the brackets that are open before a call are closed on its line."""
    opened = sum(map(before.count, "([{")) - sum(map(before.count, ")]}"))
    return opened <= 0 or opened <= sum(map(after.count, ")]}"))


def _ends_statement(text: str, line: int) -> bool:
    """Return whether the statement before a line does not continue on it."""
    for _ in range(_LINES_BACK):
        if not line:
            return True
        previous = text.rfind("\n", 0, line - 1) + 1
        code, comment, _ = text[previous : line - 1].partition("#")
        code = code.rstrip()
        if code:
            if comment and ("'" in code or '"' in code):
                return False
            if code.endswith(":"):
                return _HEAD.match(code) is not None
            return _GOES_ON.search(code) is None
        line = previous
    return False
