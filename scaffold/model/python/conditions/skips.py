"""Conditions under which tests are skipped or expected to fail."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.model.python.evaluation.given_arguments import argument_of
from scaffold.model.python.module import PythonModule
from scaffold.model.python.scopes import FunctionNode
from scaffold.record import NamedTuple

_NEEDED = {
    "pytest.mark.skipif": False,
    "pytest.mark.xfail": False,
    "unittest.skipIf": False,
    "unittest.skipUnless": True,
    "unittest.case.skipIf": False,
    "unittest.case.skipUnless": True,
}
"""The required value of the condition of a mark, for the test to run and pass."""
_OF_BLOCK = "pytestmark"
"""The name of the marks of all tests in a module or a class."""
_MAX_DEPTH = 5


class SkipCondition(NamedTuple):
    """A condition of a mark."""

    test: ast.expr
    needed: bool
    """The value required for the test to run."""


def skip_conditions(module: PythonModule, function: FunctionNode) -> Iterator[SkipCondition]:
    """Yield the conditions for a test to run: its own, and those of its class and file.

    Args:
        module: The file.
        function: The test, or a method of its class.
    """
    if not module.mentions("skipif", "skipIf", "skipUnless", "xfail"):
        return
    marks: list[ast.expr] = [*function.decorator_list]
    for parent in module.parents(function):
        if isinstance(parent, ast.ClassDef):
            marks += parent.decorator_list
        if isinstance(parent, ast.ClassDef | ast.Module):
            bindings = module.index.bindings(parent).get(_OF_BLOCK, ())
            marks += (binding.value for binding in bindings if binding.value is not None)
    for mark in marks:
        yield from _conditions(module, mark, 0)


def _conditions(module: PythonModule, mark: ast.expr, depth: int) -> Iterator[SkipCondition]:
    match mark:
        case ast.List(elts=parts) | ast.Tuple(elts=parts):
            for part in parts:
                yield from _conditions(module, part, depth + 1)
        case ast.Name(id=name) if depth < _MAX_DEPTH:
            lookup = module.index.lookup(name, mark)
            for binding in lookup[1] if lookup and len(lookup[1]) == 1 else ():
                if binding.kind == "assignment" and binding.value is not None:
                    yield from _conditions(module, binding.value, depth + 1)
        case ast.Call(func=func):
            needed = _NEEDED.get(module.qualified_name(func) or "")
            given = argument_of(mark, "condition", 0)
            if needed is not None and given is not None:
                yield SkipCondition(given, needed)
