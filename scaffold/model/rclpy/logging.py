"""Which loggers in the code of a package are those of rclpy."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.rclpy.file import RclpyFile

_METHOD = "get_logger"


def is_of_rclpy(facts: RclpyFile, method: ast.expr) -> bool:
    """Tell whether ``get_logger`` of some object is rclpy's, not one that a class here defines.

    Args:
        facts: The file.
        method: The ``get_logger`` that is called.
    """
    makers = {
        facts.module.parent(function)
        for function in facts.module.walk(ast.FunctionDef)
        if function.name == _METHOD
    }
    class_ = facts.evaluator.self_class(method.value) if isinstance(method, ast.Attribute) else None
    if class_ is None:
        return not any(isinstance(one, ast.ClassDef) for one in makers)
    return makers.isdisjoint(facts.related_classes(class_))
