"""E111 to E117: the indentation of statements and comments."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.ament.finding import Finding
from scaffold.ament.flake8.options import AMENT, Options
from scaffold.ament.python_text.logical import LogicalLine
from scaffold.ament.python_text.text import PythonText

FOUR = 4
"""The indentation of a block that is always allowed."""
TAB = 8


def check(text: PythonText, options: Options = AMENT) -> Iterator[Finding]:
    """Yield the logical lines with wrong indentation."""
    before: LogicalLine | None = None
    step = options.indent_size
    for logical in text.logical_lines:
        is_on_level = before is not None and logical.indent == before.indent
        if is_on_level and not logical.is_comment and not logical.indent % step:
            before = logical
            continue
        for code in _judge(logical, before, text.indent_char, step):
            row, column = logical.position(0)
            yield Finding(code, row, column + 1)
        if not logical.is_comment:
            before = logical


def _judge(
    logical: LogicalLine, before: LogicalLine | None, indent_char: str, step: int
) -> Iterator[str]:
    indent = logical.indent
    above = before.indent if before else 0
    if indent % step:
        yield "E114" if logical.is_comment else "E111"
    if indent == above and not logical.is_comment:
        return
    opens = before is not None and before.last == ":"
    if opens and indent <= above:
        yield "E115" if logical.is_comment else "E112"
    elif not opens and indent > above:
        yield "E116" if logical.is_comment else "E113"
    if opens and indent > above + (TAB if indent_char == "\t" else FOUR):
        yield "E117"
