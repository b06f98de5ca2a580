"""The exceptions that handlers and ``with`` statements catch, by name."""

from __future__ import annotations

import ast

IMPORT_ERRORS = frozenset({"ImportError", "ModuleNotFoundError", "Exception", "BaseException"})
"""The exceptions that catch a missing import."""
_EXPECT = frozenset({"suppress", "raises", "assertRaises", "assertRaisesRegex"})
"""Functions that expect an exception: ``with pytest.raises(ImportError):``."""


def catches_import_errors(node: ast.Try) -> bool:
    """Tell whether a ``try`` has a handler for a failed import."""
    return any(
        handler.type is None or not IMPORT_ERRORS.isdisjoint(last_names(handler.type))
        for handler in node.handlers
    )


def expected_errors(item: ast.withitem) -> set[str]:
    """Return the last parts of the names of exceptions in ``suppress``, ``raises`` and the like."""
    match item.context_expr:
        case ast.Call(func=func, args=args) if not _EXPECT.isdisjoint(last_names(func)):
            return set().union(*map(last_names, args))
    return set()


def last_names(node: ast.expr) -> set[str]:
    """Return the last parts of the names in an expression: ``{'error'}`` for ``socket.error``."""
    result: set[str] = set()
    for part in ast.walk(node):
        if isinstance(part, ast.Name):
            result.add(part.id)
        elif isinstance(part, ast.Attribute):
            result.add(part.attr)
    return result
