"""Operands of which no table can say something wrong; for TY006."""

from __future__ import annotations

import ast
import builtins
import sys

from scaffold.api.messages import MessageTypes
from scaffold.api.rclpy import RclpyFile, rclpy_file
from scaffold.api.types import TypeFinding

_LIBRARIES = frozenset({"ament_index_python", "numpy"})
_MAX_DEPTH = 4
"""The maximum number of names to trace a value through."""


def are_sure(finding: TypeFinding) -> bool:
    """Return whether the types of both operands do not depend on tables or user functions.

    Elements of a dictionary or list are often added elsewhere, with other types.
    """
    node = finding.node(ast.BinOp, ast.Compare, ast.AugAssign)
    match node:
        case ast.BinOp(left=left, right=right) | ast.AugAssign(target=left, value=right):
            operands = (left, right)
        case ast.Compare(left=left, comparators=[right]):
            operands = (left, right)
        case _:
            return False
    file = rclpy_file(finding.package, finding.path)
    read = (part for item in operands for part in ast.walk(item) if isinstance(part, ast.Attribute))
    return all(_is_sure(file, operand, _MAX_DEPTH) for operand in operands) and not any(
        _is_given_to_object(finding, attribute) for attribute in read
    )


def _is_sure(file: RclpyFile, node: ast.expr, depth: int) -> bool:
    match node:
        case ast.Constant() | ast.JoinedStr() | ast.List() | ast.Tuple() | ast.Dict():
            return True
        case ast.Attribute(value=owner, attr=name):
            stored = [store.value for store in file.evaluator.stores(name)]
            return not any(isinstance(part, ast.Subscript) for part in (*ast.walk(owner), *stored))
        case ast.Name():
            value = file.evaluator.single_value(node)
            return depth > 0 and value is not node and _is_sure(file, value, depth - 1)
        case ast.BinOp(left=left, right=right):
            return _is_sure(file, left, depth) and _is_sure(file, right, depth)
        case ast.Call(func=func):
            root = (file.module.qualified_name(func) or "").partition(".")[0]
            return root in _LIBRARIES or root in sys.stdlib_module_names or hasattr(builtins, root)
    return False


def _is_given_to_object(finding: TypeFinding, node: ast.Attribute) -> bool:
    """Return whether the type is that of a value stored on an object of a class that is unknown.

    The class may have a property of that name, which returns something else.
    """
    module = finding.module
    owner = module.text(node.value)
    if owner in {"self", "cls"}:
        return False
    if MessageTypes.of(finding.package, finding.path).field_type_of(node) is not None:
        return False
    stored = (use for use in module.index.attributes(node.attr) if isinstance(use.ctx, ast.Store))
    return any(module.text(use.value) == owner and use is not node for use in stored)
