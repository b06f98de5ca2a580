"""I100, I101, I201, I666: the order of imports, in the style called ``google``.

Only statements that start in the first column count. Each is compared with the one before it:
first by group (``__future__``, standard library, third party, relative), then by the modules and
at last by the imported names, both without regard to case.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.ament.finding import Finding
from scaffold.ament.flake8.import_order.stdlib import STDLIB
from scaffold.ament.python_text.text import PythonText
from scaffold.record import NamedTuple

MIXED, FUTURE, STANDARD, THIRD_PARTY, RELATIVE = range(5)
GROUPS = ("mixed", "__future__", "standard library", "third-party", "relative")

SHOWN = 60
"""Characters of a statement in a message."""

Folded = tuple[str, str]


class Statement(NamedTuple):
    """An import statement and what it is sorted by."""

    line: int
    column: int
    end_line: int
    group: int
    level: int
    modules: tuple[Folded, ...]
    names: tuple[Folded, ...]
    shown: str

    @property
    def key(self) -> tuple[int, int, tuple[Folded, ...], tuple[Folded, ...]]:
        """What statements are ordered by."""
        return self.group, self.level, self.modules, self.names


def check(text: PythonText) -> Iterator[Finding]:
    """Yield the import statements that are in the wrong place."""
    found: list[Finding] = []
    before: Statement | None = None
    for node in _nodes(text.tree):
        statement = describe(node)
        found.extend(_judge(statement))
        if before is not None:
            found.extend(_compare(before, statement, text.lines))
        before = statement
    if found and text.tree is not None:
        from scaffold.ament.flake8.import_order.fix import attach

        found = attach(text, text.tree, found)
    yield from found


def _nodes(tree: ast.Module | None) -> Iterator[ast.Import | ast.ImportFrom]:
    for node in tree.body if tree else ():
        if isinstance(node, (ast.Import, ast.ImportFrom)) and node.col_offset == 0:
            yield node


def describe(node: ast.Import | ast.ImportFrom) -> Statement:
    """Return what an import statement is judged by."""
    names = [alias.name for alias in node.names]
    if isinstance(node, ast.Import):
        groups = {_group(name) for name in names}
        group = groups.pop() if len(groups) == 1 else MIXED
        modules, imported, level = names, [], 0
        shown = f"import {', '.join(names)}"
    else:
        level = node.level
        module = node.module or ""
        group = RELATIVE if level else _group(module)
        modules, imported = [module], names
        shown = f"from {'.' * level}{module} import {', '.join(names)}"
    return Statement(
        node.lineno,
        node.col_offset + 1,
        node.end_lineno or node.lineno,
        group,
        level,
        tuple(map(fold, modules)),
        tuple(map(fold, imported)),
        shown if len(shown) <= SHOWN else f"{shown[: SHOWN - 3]}...",
    )


def _group(module: str) -> int:
    root = module.partition(".")[0]
    if root == "__future__":
        return FUTURE
    return STANDARD if root in STDLIB else THIRD_PARTY


def fold(name: str) -> Folded:
    """Return what names are ordered by: their letters, then their case."""
    return name.lower(), name


def _judge(statement: Statement) -> Iterator[Finding]:
    at = (statement.line, statement.column)
    names = statement.names
    if list(names) != sorted(names):
        wanted = ", ".join(name for _, name in sorted(names))
        yield Finding("I101", *at, f"imported names are not sorted; wanted: {wanted}")
    if statement.group == MIXED:
        yield Finding("I666", *at, "one import statement for modules of different groups")


def _compare(before: Statement, statement: Statement, lines: list[str]) -> Iterator[Finding]:
    at = (statement.line, statement.column)
    if statement.key < before.key:
        said = f"'{statement.shown}' belongs before '{before.shown}' of line {before.line}"
        if statement.group != before.group:
            said += f": {GROUPS[statement.group]} before {GROUPS[before.group]}"
        yield Finding("I100", *at, said)
    if statement.group != before.group:
        between = lines[before.line - 1 : statement.line - 1]
        if not any(not line.strip() for line in between):
            said = (
                f"no blank line between {GROUPS[before.group]} and {GROUPS[statement.group]} "
                "imports"
            )
            yield Finding("I201", *at, said)
