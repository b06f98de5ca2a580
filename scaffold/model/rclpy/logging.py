"""Calls of rclpy loggers."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.rclpy.file import RclpyFile

LOG_METHODS = frozenset({"debug", "info", "warn", "warning", "error", "fatal"})
_METHOD = "get_logger"


def log_calls(file: RclpyFile) -> Iterator[ast.Call]:
    """Yield the calls such as ``node.get_logger().info(...)``."""
    for logger, attribute in file.module.method_calls(_METHOD):
        method = file.module.parent(logger)
        is_log = isinstance(method, ast.Attribute) and method.attr in LOG_METHODS
        call = file.module.call_with(method) if method is not None and is_log else None
        if call is not None and is_of_rclpy(file, attribute):
            yield call


def is_of_rclpy(file: RclpyFile, method: ast.expr) -> bool:
    """Return whether ``get_logger`` is that of rclpy, not one defined by a class of the file.

    Args:
        file: The file.
        method: The ``get_logger`` that is called.
    """
    makers = {
        file.module.parent(function)
        for function in file.module.walk(ast.FunctionDef)
        if function.name == _METHOD
    }
    class_ = file.evaluator.self_class(method.value) if isinstance(method, ast.Attribute) else None
    if class_ is None:
        return not any(isinstance(maker, ast.ClassDef) for maker in makers)
    return makers.isdisjoint(file.related_classes(class_))
