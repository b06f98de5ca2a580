"""The lists in which tests collect messages."""

from __future__ import annotations

import ast
from collections.abc import Iterator


def appended_lists(call: ast.Call) -> Iterator[str]:
    """Yield the lists that a subscription appends to."""
    if isinstance(call.func, ast.Attribute) and call.func.attr == "create_subscription":
        for node in (*call.args, *(word.value for word in call.keywords)):
            match node:
                case ast.Attribute(value=ast.Name(id=name), attr="append"):
                    yield name
                case ast.Lambda(body=body):
                    yield from (item.id for item in ast.walk(body) if isinstance(item, ast.Name))
