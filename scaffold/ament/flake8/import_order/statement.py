"""An import statement as flake8-import-order sees it: its group and its sort key."""

from __future__ import annotations

import ast

from scaffold import distributions
from scaffold.ament import linters, standard_library
from scaffold.ament.flake8.import_order.stdlib import STDLIB
from scaffold.ament.flake8.options import AMENT, Options
from scaffold.record import NamedTuple

NAME = "flake8-import-order"
MIXED, FUTURE, STANDARD, THIRD_PARTY, OF_COMPANY, OWN, RELATIVE = range(7)
SHOWN = 60
"""The maximum length of a statement in a message."""

Folded = tuple[str, str]


class Statement(NamedTuple):
    """An import statement and its sort key."""

    line: int
    column: int
    end_line: int
    group: int
    level: int
    modules: tuple[Folded, ...]
    names: tuple[Folded, ...]
    shown: str
    is_from: bool
    is_for_types: bool = False
    """Whether it is in a block for type checkers, which matters from 0.19 on."""

    @property
    def key(self) -> tuple[int, int, tuple[Folded, ...], tuple[Folded, ...]]:
        """The sort key of statements in the style of Google."""
        return self.group, self.level, self.modules, self.names

    @property
    def root(self) -> str:
        """The top-level package of the first module."""
        return self.modules[0][1].partition(".")[0]


def describe(node: ast.Import | ast.ImportFrom, options: Options = AMENT) -> Statement:
    """Return the properties of an import statement used by the checks."""
    names = [alias.name for alias in node.names]
    is_from = isinstance(node, ast.ImportFrom)
    if isinstance(node, ast.Import):
        groups = {_group(name, options) for name in names}
        group = groups.pop() if len(groups) == 1 else MIXED
        modules, imported, level = names, [], 0
        shown = f"import {', '.join(names)}"
    else:
        level = node.level
        module = node.module or ""
        group = RELATIVE if level else _group(module, options)
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
        is_from,
    )


def _group(module: str, options: Options) -> int:
    while True:
        if module == "__future__":
            return FUTURE
        if module in options.application_import_names:
            return OWN
        if module in _company_names(options):
            return OF_COMPANY
        if module in _standard_library():
            return STANDARD
        module, is_deeper, _ = module.rpartition(".")
        if not is_deeper:
            return THIRD_PARTY


def _standard_library() -> frozenset[str]:
    """Return the standard library of the oldest distribution of the package.

    The linters of a later one may require another order; no order satisfies both.
    """
    oldest = min((distributions.target(), *distributions.kept()), key=lambda item: item.place)
    has_own_list = not linters.of(oldest).since(NAME, 0, 19)
    return STDLIB if has_own_list else standard_library.modules(oldest)


def _company_names(options: Options) -> tuple[str, ...]:
    has_them = options.import_order_style in {"appnexus", "edited"}
    return options.application_package_names if has_them else ()


def fold(name: str) -> Folded:
    """Return the sort key of names: letters, then case."""
    return name.lower(), name
