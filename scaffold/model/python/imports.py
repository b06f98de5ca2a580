"""The imports of a file, and the conditions under which each runs or may fail."""

from __future__ import annotations

import ast
from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from scaffold.model.python.conditions.distribution_conditions import holds
from scaffold.model.python.conditions.handlers import (
    IMPORT_ERRORS,
    catches_import_errors,
    expected_errors,
)
from scaffold.record import NamedTuple
from scaffold.source import Location

if TYPE_CHECKING:
    from scaffold.model.python.syntax_tree import SyntaxTree

FIND_SPEC = "importlib.util.find_spec"
_PLATFORM_NAMES = (
    *("sys.", "os.name", "os.environ", "os.getenv", "os.uname", "platform."),
    *(FIND_SPEC, "pkgutil.find_loader"),
)
IMPORT_OR_SKIP = "pytest.importorskip"
"""The function of pytest that skips the tests of a file without a module."""


class ImportedName(NamedTuple):
    """One name of a ``from`` import; ``*`` for all."""

    name: str
    asname: str | None
    location: Location


class Import(NamedTuple):
    """One imported module; ``import a, b`` makes two."""

    module: str
    """The dotted name as written; empty for ``from . import x``."""
    level: int
    """Leading dots."""
    names: tuple[ImportedName, ...]
    """What a ``from`` import takes; empty for ``import module``."""
    asname: str | None
    location: Location
    """The statement, or for ``import a, b`` the one name."""
    top_level: bool
    """Whether it is at the top level of the module, under no condition."""
    in_function: bool
    guarded: bool
    """May fail or be skipped: ``try`` with ImportError, TYPE_CHECKING, platform, version, and
    ``find_spec`` or ``importorskip``."""
    type_checking: bool
    """For type checkers alone; not run."""
    conditional: bool
    """Under any other ``if``."""
    in_tests: bool
    """The file is a test."""

    @property
    def root(self) -> str:
        """The top-level package; empty for a relative import."""
        return "" if self.level else self.module.partition(".")[0]


def read_imports(module: SyntaxTree, *, in_tests: bool) -> Sequence[Import]:
    """Return all imports of a file, in the order of the text.

    Args:
        module: The file.
        in_tests: Whether it is a test.
    """
    guards = _Guards(module)
    result: list[Import] = []
    nodes: list[ast.Import | ast.ImportFrom] = [
        *module.walk(ast.Import),
        *module.walk(ast.ImportFrom),
    ]
    for node in sorted(nodes, key=lambda node: (node.lineno, node.col_offset)):
        context = (*guards.context(node), in_tests)
        if isinstance(node, ast.ImportFrom):
            names = tuple(
                ImportedName(alias.name, alias.asname, module.location(alias))
                for alias in node.names
            )
            at = module.location(node)
            result.append(Import(node.module or "", node.level, names, None, at, *context))
            continue
        for alias in node.names:
            at = module.location(node if len(node.names) == 1 else alias)
            result.append(Import(alias.name, 0, (), alias.asname, at, *context))
    return result


class _Guards:
    """The statements around the imports of a file."""

    def __init__(self, module: SyntaxTree) -> None:
        self._module = module

    def context(self, node: ast.AST) -> tuple[bool, bool, bool, bool, bool]:
        """Return top_level, in_function, guarded, type_checking, conditional."""
        in_function = type_checking = conditional = False
        guarded = self._is_asked_for(node)
        child: ast.AST = node
        for parent in self._module.parents(node):
            match parent:
                case ast.FunctionDef() | ast.AsyncFunctionDef():
                    in_function = True
                case ast.Try() if catches_import_errors(parent):
                    guarded = guarded or self._module.index.place(child)[0] != "finalbody"
                case ast.With(items=items):
                    guarded = guarded or any(IMPORT_ERRORS & expected_errors(i) for i in items)
                case ast.If() if not is_main_test(parent.test):
                    if "TYPE_CHECKING" in self._module.text(parent.test):
                        guarded = True
                        in_body = self._module.index.place(child)[0] == "body"
                        type_checking = type_checking or in_body
                    elif self._asks_platform(parent.test) or self._is_never_run(parent, child):
                        guarded = True
                    else:
                        conditional = True
            child = parent
        top_level = self._module.parent(node) is self._module.tree
        return top_level, in_function, guarded, type_checking, conditional

    def _is_asked_for(self, node: ast.AST) -> bool:
        """Return whether the file looks for an imported module before, or skips its tests."""
        match node:
            case ast.Import(names=[ast.alias(name=module)]) | ast.ImportFrom(module=str(module)):
                return module.partition(".")[0] in self._asked_for
        return False

    @cached_property
    def _asked_for(self) -> frozenset[str]:
        """The packages of ``pytest.importorskip`` and ``find_spec`` calls."""
        if not self._module.mentions("importorskip", "find_spec"):
            return frozenset()
        return frozenset(
            str(call.args[0].value).partition(".")[0]
            for call in self._module.walk(ast.Call)
            if call.args and isinstance(call.args[0], ast.Constant)
            if self._module.qualified_name(call.func) in {IMPORT_OR_SKIP, FIND_SPEC}
        )

    def _is_never_run(self, node: ast.If, child: ast.AST) -> bool:
        """Return whether a branch is disabled by a constant of the file, or is for ROS 1."""
        is_body = child in node.body
        return _is_switched(self._module, node.test, not is_body) or (
            holds(self._module, node.test) is (not is_body)
        )

    def _asks_platform(self, test: ast.expr) -> bool:
        for node in ast.walk(test):
            if isinstance(node, ast.Name | ast.Attribute):
                name = self._module.qualified_name(node)
                if name and name.startswith(_PLATFORM_NAMES):
                    return True
        return False


def _is_switched(module: SyntaxTree, test: ast.expr, wanted: bool) -> bool:  # noqa: FBT001
    """Return whether a condition is a constant, or the name of one, that is true or false."""
    match test:
        case ast.Constant():
            return bool(test.value) is wanted
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            return _is_switched(module, operand, not wanted)
        case ast.Name(id=name):
            scope, bindings = module.index.lookup(name, test) or (None, ())
            value = bindings[0].value if len(bindings) == 1 and scope is module.tree else None
            return isinstance(value, ast.Constant) and bool(value.value) is wanted
    return False


def is_main_test(test: ast.expr) -> bool:
    """Return whether a condition is ``__name__ == '__main__'``."""
    match test:
        case ast.Compare(
            left=ast.Name(id="__name__"), ops=[ast.Eq()], comparators=[ast.Constant("__main__")]
        ):
            return True
        case ast.Compare(
            left=ast.Constant("__main__"), ops=[ast.Eq()], comparators=[ast.Name(id="__name__")]
        ):
            return True
        case ast.BoolOp(op=ast.And(), values=values):
            return any(is_main_test(value) for value in values)
        case _:
            return False
