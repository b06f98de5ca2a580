"""What the condition of a loop is computed of."""

from __future__ import annotations

import ast
from collections.abc import Sequence

from scaffold.api.rclpy import RclpyFile

_PURE = frozenset({"abs", "len", "min", "max", "round", "float", "int", "any", "all", "bool"})
_PURE_MODULES = ("math.", "numpy.")
_UNCLEAR = ast.Lambda | ast.NamedExpr | ast.Await | ast.Yield | ast.comprehension


def attributes_asked(file: RclpyFile, loop: ast.While) -> set[str]:
    """Return the attributes of ``self`` that can end a loop, if nothing else can.

    Empty if its condition has unknown calls, or names that the loop changes.
    """
    names = file.module.below(loop, ast.Name)
    changed = {name.id for name in names if isinstance(name.ctx, ast.Store)}
    result: set[str] = set()
    todo: list[ast.AST] = [loop.test]
    while todo:
        node = todo.pop()
        if isinstance(node, ast.Call):
            parts = _parts_of_call(file, node)
            if parts is None:
                return set()
            todo.extend(parts)
        elif isinstance(node, ast.Attribute) and file.evaluator.self_class(node.value):
            result.add(node.attr)
        elif isinstance(node, _UNCLEAR) or (isinstance(node, ast.Name) and node.id in changed):
            return set()
        else:
            todo.extend(ast.iter_child_nodes(node))
    return result


def _parts_of_call(file: RclpyFile, call: ast.Call) -> Sequence[ast.expr] | None:
    """Return the operands of the result of a call; ``None`` if unknown."""
    match call.func:
        case ast.Attribute(value=owner, attr=name) if class_ := file.evaluator.self_class(owner):
            result = _result_of(class_, name)
            return None if result is None else [*call.args, result]
        case ast.Name(id=name) if name in _PURE:
            return call.args
    name = file.module.qualified_name(call.func) or ""
    return call.args if name == "rclpy.ok" or name.startswith(_PURE_MODULES) else None


def _result_of(class_: ast.ClassDef, name: str) -> ast.expr | None:
    """Return the expression of a method that only returns a value."""
    for method in class_.body:
        if isinstance(method, ast.FunctionDef) and method.name == name:
            match method.body:
                case [ast.Return(value=value)] | [ast.Expr(), ast.Return(value=value)]:
                    return value
    return None
