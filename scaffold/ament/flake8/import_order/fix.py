"""Sorts blocks of plain import statements: the fix of I100, I101 and I201."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence

from scaffold.ament.finding import Finding
from scaffold.ament.flake8.import_order.statement import MIXED, Statement, describe, fold
from scaffold.ament.flake8.pycodestyle.physical import MAX_LENGTH
from scaffold.ament.python_text.text import PythonText
from scaffold.record import NamedTuple

CODES = ("I100", "I101", "I201")
_OF_PLACE = r"(?i)isort|noqa(?!:)|noqa:[\w ,]{0,80}\bI\d|\b(?:before|after|first|last|order)\b"
"""Matches comments that depend on the place of an import."""


class _Import(NamedTuple):
    """An import statement and its new lines."""

    statement: Statement
    lines: str


def attach(text: PythonText, tree: ast.Module, findings: Sequence[Finding]) -> list[Finding]:
    """Attach the fix that sorts a block to the findings in it."""
    fixed = list(findings)
    for block in _blocks(text, tree):
        first, last = block[0].statement.line, block[-1].statement.end_line
        sorted_block = _sorted(block)
        if sorted_block == "".join(text.lines[first - 1 : last]).rstrip("\n"):
            continue
        end = len(text.lines[last - 1].rstrip("\n")) + 1
        fix = ((first, 1, last, end, sorted_block),)
        for at, finding in enumerate(fixed):
            # The code before the block is not moved, so a finding on its first line may remain.
            gains = finding.line > first or finding.code == "I101"
            if finding.code in CODES and gains and first <= finding.line <= last:
                fixed[at] = finding._replace(fix=fix, fix_title="Sort the imports")
    return fixed


def _blocks(text: PythonText, tree: ast.Module) -> Iterator[list[_Import]]:
    """Yield blocks of imports with only blank lines between them."""
    block: list[_Import] = []
    for node in tree.body:
        plain = (
            _fixable_import(text, node) if isinstance(node, (ast.Import, ast.ImportFrom)) else None
        )
        follows = block and _only_blank(text, block[-1].statement, plain)
        if block and not follows:
            yield block
            block = []
        if plain is not None:
            block.append(plain)
    if block:
        yield block


def _only_blank(text: PythonText, before: Statement, item: _Import | None) -> bool:
    if item is None:
        return False
    between = text.lines[before.end_line : item.statement.line - 1]
    return not any(line.strip() for line in between)


def _fixable_import(text: PythonText, node: ast.Import | ast.ImportFrom) -> _Import | None:
    """Return a statement alone on its lines; ``None`` if it must not be changed.

    Comments on its lines move with it, but keep the order of its names.
    """
    statement = describe(node)
    lines = "".join(text.lines[statement.line - 1 : statement.end_line]).rstrip("\n")
    if node.col_offset or statement.group == MIXED or any(item in lines for item in ";\\\f"):
        return None
    has_comment = "#" in lines
    if has_comment and re.search(_OF_PLACE, lines.partition("#")[2]):
        return None
    if list(statement.names) == sorted(statement.names):
        return _Import(statement, lines)
    if has_comment or not isinstance(node, ast.ImportFrom):
        return None
    ordered = statement._replace(names=tuple(sorted(statement.names)))
    if statement.line != statement.end_line:
        sorted_lines = _in_place(text, node)
        return _Import(ordered, sorted_lines) if sorted_lines else None
    head, keyword, rest = lines.partition(" import ")
    aliases = sorted(node.names, key=lambda alias: fold(alias.name))
    names = ", ".join(
        f"{aliase.name} as {aliase.asname}" if aliase.asname else aliase.name for aliase in aliases
    )
    listed = f"({names})" if rest.strip().startswith("(") else names
    return _Import(ordered, f"{head}{keyword}{listed}")


def _in_place(text: PythonText, node: ast.ImportFrom) -> str:
    """Return a multiline statement with sorted names; empty if a line gets too long."""
    first, last = node.lineno, node.end_lineno or node.lineno
    starts = text.line_starts
    spans = [
        (
            starts[name.lineno - 1] + text.column(name.lineno, name.col_offset) - 1,
            starts[(name.end_lineno or 0) - 1]
            + text.column(name.end_lineno or 0, name.end_col_offset or 0)
            - 1,
        )
        for name in node.names
    ]
    order = sorted(range(len(spans)), key=lambda at: fold(node.names[at].name))
    parts: list[str] = []
    at = starts[first - 1]
    for (start, end), other in zip(spans, order, strict=True):
        parts += text.text[at:start], text.text[slice(*spans[other])]
        at = end
    lines = "".join([*parts, text.text[at : starts[last]]]).rstrip("\n")
    return "" if any(len(line) > MAX_LENGTH for line in lines.split("\n")) else lines


def _sorted(block: Sequence[_Import]) -> str:
    parts: list[str] = []
    group = -1
    for item in sorted(block, key=lambda item: item.statement.key):
        if parts and item.statement.group != group:
            parts.append("")
        parts.append(item.lines)
        group = item.statement.group
    return "\n".join(parts)
