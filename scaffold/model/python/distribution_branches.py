"""Branches of a Python file that are for other distributions: they ask for ROS_DISTRO."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.distributions import VARIABLE, target
from scaffold.model.python.module import PythonModule

_GETTERS = frozenset({"os.environ.get", "os.getenv"})
_FORMS = frozenset({"lower", "strip"})
"""Methods that do not change the name of a distribution."""

Lines = tuple[int, int]


def lines_not_run(module: PythonModule) -> Iterator[Lines]:
    """Yield the first and last lines of what does not run on the target distribution."""
    for node in module.walk(ast.If):
        decided = holds(module, node.test)
        dead = () if decided is None else node.orelse if decided else node.body
        if dead:
            yield dead[0].lineno, dead[-1].end_lineno or dead[-1].lineno


def holds(module: PythonModule, test: ast.expr) -> bool | None:
    """Return whether a condition is true on the target; ``None`` if that is not known."""
    match test:
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            inner = holds(module, operand)
            return None if inner is None else not inner
        case ast.BoolOp(op=op, values=values):
            deciding = isinstance(op, ast.Or)
            parts = {holds(module, value) for value in values}
            if deciding in parts:
                return deciding
            return None if None in parts else not deciding
        case ast.Compare(left=left, ops=[op], comparators=[right]):
            return _compared(module, left, op, right)
    return None


def _compared(module: PythonModule, left: ast.expr, op: ast.cmpop, right: ast.expr) -> bool | None:
    name = target().name
    match left, op, right:
        case ast.Constant(value=str(word)), ast.Eq() | ast.NotEq(), _ if _is_name(module, right):
            return (word == name) == isinstance(op, ast.Eq)
        case _, ast.Eq() | ast.NotEq(), ast.Constant(value=str(word)) if _is_name(module, left):
            return (word == name) == isinstance(op, ast.Eq)
        case _, ast.In() | ast.NotIn(), ast.Tuple() | ast.List() | ast.Set() if _is_name(
            module, left
        ):
            words = [item.value for item in right.elts if isinstance(item, ast.Constant)]
            if len(words) == len(right.elts):
                return (name in words) == isinstance(op, ast.In)
        case ast.Constant(value=str(word)), ast.In() | ast.NotIn(), _ if word == VARIABLE:
            if module.qualified_name(right) == "os.environ":
                return isinstance(op, ast.In)
    return None


def _is_name(module: PythonModule, node: ast.expr) -> bool:
    """Tell whether an expression is the value of ROS_DISTRO."""
    match node:
        case ast.Subscript(value=value, slice=ast.Constant(value=key)):
            return key == VARIABLE and module.qualified_name(value) == "os.environ"
        case ast.Call(func=ast.Attribute(attr=attr, value=value), args=[]) if attr in _FORMS:
            return _is_name(module, value)
        case ast.Call(func=func, args=[ast.Constant(value=key), *_]):
            return key == VARIABLE and module.qualified_name(func) in _GETTERS
        case ast.Name(id=name):
            found = module.index.lookup(name, node)
            bindings = found[1] if found else ()
            return len(bindings) == 1 and any(
                item.value is not None
                and not isinstance(item.value, ast.Name)
                and _is_name(module, item.value)
                for item in bindings
            )
    return False
