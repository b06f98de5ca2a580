"""E241, E242, W503 to W505: codes only enabled by a package's own configuration."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold import lazy_re
from scaffold.ament.finding import Finding
from scaffold.ament.flake8.options import Options
from scaffold.ament.python_text.logical import LogicalLine
from scaffold.ament.python_text.text import PythonText
from scaffold.ament.python_text.tokens import COMMENT, ERRORTOKEN, LAYOUT, OP, SILENT, STRING, Token

_AFTER_PUNCTUATION = lazy_re.compile(r"[,;:]\s*(?:  |\t)")
_NO_OPERATORS = frozenset("()[]{},:.;@=%~") | {"..."}
_DOCUMENTED = 72
"""The column at which a single long word may start."""


def check(text: PythonText, options: Options) -> Iterator[Finding]:
    """Yield the findings in statements and comments."""
    has_spaces = options.reports_any(("E241", "E242"))
    has_breaks = options.reports_any(("W503", "W504"))
    most = options.max_doc_length if options.reports("W505") else None
    if not has_spaces and not has_breaks and most is None:
        return
    for logical in text.logical_lines:
        if has_spaces:
            yield from _spaces(logical)
        if has_breaks and logical.tokens[0].start[0] != logical.end_row:
            yield from _operator_line_breaks(logical)
        if most is not None:
            yield from _long_text(logical, most)


def _spaces(logical: LogicalLine) -> Iterator[Finding]:
    for item in _AFTER_PUNCTUATION.finditer(logical.text):
        row, column = logical.position(item.start() + 1)
        position = f"after '{item[0][0]}'"
        if "\t" in item[0]:
            yield Finding("E242", row, column + 1, f"a tab {position}")
        else:
            yield Finding("E241", row, column + 1, f"several spaces {position}")


def _operator_line_breaks(logical: LogicalLine) -> Iterator[Finding]:
    """Yield the line breaks before and after binary operators."""
    is_broken, is_unary = False, True
    before: Token | None = None
    for token in logical.tokens:
        if token.type == COMMENT:
            continue
        if token.type != STRING and ("\n" in token.string or "\r" in token.string):
            is_broken = True
            continue
        follows = _is_binary(before)
        if is_broken and not is_unary:
            if _is_binary(token) and not follows:
                row, column = token.start
                yield Finding("W503", row, column + 1, "line break before a binary operator")
            elif before is not None and follows and not _is_binary(token):
                row, column = before.start
                yield Finding("W504", row, column + 1, "line break after a binary operator")
        is_unary = token.string in "([{,;"
        is_broken = False
        before = token


def _is_binary(token: Token | None) -> bool:
    if token is None:
        return False
    is_operator = token.type == OP or token.string in {"and", "or"}
    return is_operator and token.string not in _NO_OPERATORS


def _long_text(logical: LogicalLine, most: int) -> Iterator[Finding]:
    """Yield the long lines of docstrings and of separate comments."""
    has_code = any(item.type not in (*SILENT, ERRORTOKEN, STRING) for item in logical.tokens)
    before: Token | None = None
    for token in logical.tokens:
        if token.type == STRING and has_code:
            continue  # and the following token is treated as if it was not there
        is_alone = before is None or before.type in LAYOUT
        before = token
        is_text = token.type in {COMMENT, STRING}
        if not is_text or not is_alone:
            continue
        rows = range(token.start[0], token.end[0] + 1)
        lines = [logical.lines[row - 1].rstrip("\r\n") for row in rows]
        if rows[0] == 1 and lines[0].startswith("#!"):
            return
        for at, line in enumerate(lines):
            if len(line) > most and not _is_one_word(line, token, is_last=at + 1 == len(lines)):
                message = f"the line of text has {len(line)} characters, {most} are allowed"
                yield Finding("W505", rows[at], most + 1, message, rows[at], len(line) + 1)


def _is_one_word(line: str, token: Token, *, is_last: bool) -> bool:
    words = line.split()
    is_early = bool(words) and len(line) - len(words[-1]) < _DOCUMENTED
    if token.type == COMMENT and len(words) == 2:  # noqa: PLR2004  the mark and a word
        return is_early
    return len(words) == 1 and not is_last and is_early
