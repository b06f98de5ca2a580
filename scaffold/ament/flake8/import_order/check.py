"""I100, I101, I201, I202, I300, I666: the order of imports, in the configured style.

The style of ament is ``google``. Only statements in the first column count. Each is compared with
the previous one: first by group (``__future__``, standard library, third party, own, relative),
then by module, and last by imported names. The styles differ in the criteria between these and in
case sensitivity.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator
from typing import TYPE_CHECKING

from scaffold.ament import linters
from scaffold.ament.finding import Finding
from scaffold.ament.flake8.import_order.fix import attach
from scaffold.ament.flake8.import_order.statement import (
    MIXED,
    NAME,
    OWN,
    RELATIVE,
    THIRD_PARTY,
    Statement,
    describe,
    fold,
)
from scaffold.ament.flake8.options import AMENT, Options
from scaffold.ament.python_text.text import PythonText

if TYPE_CHECKING:
    from typing import Any

GROUPS = (
    "mixed",
    "__future__",
    "standard library",
    "third-party",
    "application package",
    "application",
    "relative",
)

_Import = ast.Import | ast.ImportFrom
_TO_FIRST_FOR_TYPES = 3


class _Style:
    """The criteria of a style of flake8-import-order."""

    def __init__(self, name: str) -> None:
        self.name = name

    def key(self, statement: Statement) -> tuple[Any, ...]:
        """Return the sort key of statements."""
        group, is_from, level = statement.group, statement.is_from, statement.level
        modules = [name for _, name in statement.modules]
        names = [name for _, name in statement.names]
        match self.name:
            case "pep8":
                return (group,)
            case "smarkets" | "edited":
                return group, is_from, level, statement.modules, statement.names
            case "pycharm":
                return group, is_from, level, modules, names
            case "cryptography":
                package = statement.root if group in {THIRD_PARTY, OWN} else ""
                return group, package, is_from, level, modules, names
            case _:
                return statement.key

    def sorted_names(self, statement: Statement) -> list[str]:
        """Return the imported names in their order."""
        names = [name for _, name in statement.names]
        if self.name == "pep8":
            return names
        return sorted(names, key=None if self.name in {"pycharm", "cryptography"} else fold)

    def is_same_section(self, before: Statement, statement: Statement) -> bool:
        """Return whether two statements belong together without a blank line."""
        groups = {before.group, statement.group}
        if self.name == "cryptography" and statement.group in {THIRD_PARTY, OWN}:
            return before.root == statement.root
        if self.name in {"edited", "cryptography"}:
            return len(groups) == 1
        return len(groups) == 1 or groups == {OWN, RELATIVE}

    def may_be_split(self, before: Statement, statement: Statement) -> bool:
        """Return whether a blank line is allowed within a section."""
        return self.name == "edited" and statement.is_from and not before.is_from


def check(text: PythonText, options: Options = AMENT) -> Iterator[Finding]:
    """Yield the misplaced import statements."""
    style = _Style(options.import_order_style)
    findings: list[Finding] = []
    before: Statement | None = None
    for_types = _for_types(text) if linters.of_target().since(NAME, 0, 19) else ()
    for node in _nodes(text.tree, for_types):
        statement = describe(node, options)._replace(is_for_types=node in for_types)
        findings.extend(_judge(statement, style))
        if before is not None and statement.is_for_types and not before.is_for_types:
            findings.extend(_first_for_types(before, statement))
        elif before is not None:
            findings.extend(_compare(before, statement, text.lines, style))
        before = statement
    is_known = style.name == AMENT.import_order_style and not options.application_import_names
    if findings and text.tree is not None and is_known:
        findings = attach(text, text.tree, findings)
    yield from findings


def _nodes(tree: ast.Module | None, for_types: Collection[ast.stmt]) -> list[_Import]:
    own = [
        node
        for node in (tree.body if tree else ())
        if isinstance(node, (ast.Import, ast.ImportFrom)) and node.col_offset == 0
    ]
    more = [node for node in for_types if isinstance(node, (ast.Import, ast.ImportFrom))]
    return sorted([*own, *more], key=lambda node: (node.lineno, node.col_offset))


def _for_types(text: PythonText) -> set[ast.stmt]:
    """Return the statements of ``if TYPE_CHECKING:`` and of its ``else``."""
    if "TYPE_CHECKING" not in text.text:
        return set()
    aliases = {
        alias.asname or alias.name
        for node in text.nodes(ast.Import)
        for alias in node.names
        if alias.name == "typing"
    }
    written = {"TYPE_CHECKING", *(f"{name}.TYPE_CHECKING" for name in ("typing", *aliases))}
    return {
        statement
        for node in text.nodes(ast.If)
        if ast.unparse(node.test) in written
        for statement in (*node.body, *node.orelse)
    }


def _first_for_types(before: Statement, statement: Statement) -> Iterator[Finding]:
    """Yield I300: the imports before and in ``if TYPE_CHECKING:`` must be three lines apart."""
    if statement.line - before.end_line != _TO_FIRST_FOR_TYPES:
        message = "no single blank line between the imports and the if TYPE_CHECKING block"
        yield Finding("I300", statement.line, 1, message)


def _judge(statement: Statement, style: _Style) -> Iterator[Finding]:
    at = (statement.line, statement.column)
    wanted = style.sorted_names(statement)
    if [name for _, name in statement.names] != wanted:
        yield Finding("I101", *at, f"imported names are not sorted; wanted: {', '.join(wanted)}")
    if statement.group == MIXED:
        yield Finding("I666", *at, "one import statement for modules of different groups")


def _compare(
    before: Statement, statement: Statement, lines: list[str], style: _Style
) -> Iterator[Finding]:
    at = (statement.line, statement.column)
    is_same = style.is_same_section(before, statement)
    if style.key(statement) < style.key(before):
        message = f"'{statement.shown}' belongs before '{before.shown}' in line {before.line}"
        if statement.group != before.group:
            message += f": {GROUPS[statement.group]} before {GROUPS[before.group]}"
        yield Finding("I100", *at, message)
    between = lines[before.line - 1 : statement.line - 1]
    is_split = any(not line.strip() for line in between)
    if not is_same and not is_split:
        groups = f"{GROUPS[before.group]} and {GROUPS[statement.group]} imports"
        if statement.group == before.group:
            groups = f"imports of '{before.root}' and '{statement.root}'"
        yield Finding("I201", *at, f"no blank line between {groups}")
    elif is_same and is_split and not style.may_be_split(before, statement):
        message = f"a blank line within the {GROUPS[statement.group]} imports"
        yield Finding("I202", *at, message)
