"""F codes: ruff's findings at the lines and in the cases that pyflakes reports."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold.style.finding import Finding
from scaffold.style.ruff import Said
from scaffold.style.text import PythonText


def translate(text: PythonText, said: Sequence[Said]) -> Iterator[Finding]:
    """Yield what pyflakes would say, given what ruff says."""
    has_star_use = any(one.code == "F405" for one in said)
    for one in said:
        line, column = one.line, one.column
        if one.code == "F401":
            line, column = _statement(text, line, column)
        yield plain(one)._replace(line=line, column=column)
        if one.code == "F403" and not has_star_use:
            yield Finding("F401", line, column, "nothing of the star import is used")


def plain(said: Said) -> Finding:
    """Return a finding of ruff as it stands."""
    return Finding(
        said.code,
        said.line,
        said.column,
        worded(said.message),
        said.end_line,
        said.end_column,
        said.fix,
        said.fix_title,
    )


def worded(message: str) -> str:
    """Return a message of ruff in the form of ours: lower case start, no full stop."""
    message = message.rstrip(".")
    return message[:1].lower() + message[1:] if message[1:2].islower() else message


def _statement(text: PythonText, line: int, column: int) -> tuple[int, int]:
    """Return the start of the import statement that covers a line."""
    if text.tree is None:
        return line, column
    for node in ast.walk(text.tree):
        if isinstance(node, (ast.Import, ast.ImportFrom)):
            end = node.end_lineno or node.lineno
            if node.lineno <= line <= end:
                return node.lineno, text.column(node.lineno, node.col_offset)
    return line, column
