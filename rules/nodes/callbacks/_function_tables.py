"""Tables of functions, which code calls by key."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api.rclpy import RclpyFile


def calls_of_tables(file: RclpyFile) -> Iterator[tuple[ast.Dict, list[ast.Call]]]:
    """Yield the dictionaries of functions in a file, each with the calls of their values.

    ``self.handlers[name](message)``, or ``handler = self.handlers.get(name)`` and
    ``handler(message)``.
    """
    calls: dict[ast.Dict, list[ast.Call]] = {}
    for call in file.module.walk(ast.Call):
        table = _table_of(file, call.func)
        if table is not None:
            calls.setdefault(table, []).append(call)
    yield from calls.items()


def _table_of(file: RclpyFile, called: ast.expr) -> ast.Dict | None:
    """Return the dictionary that a called object is from."""
    match file.evaluator.single_value(called):
        case ast.Subscript(value=holder):
            pass
        case ast.Call(func=ast.Attribute(attr="get", value=holder)):
            pass
        case _:
            return None
    table = file.evaluator.single_value(holder)
    return table if isinstance(table, ast.Dict) and table.keys and all(table.keys) else None
