"""Size limits for Python files, far above what people write."""

from __future__ import annotations

import ast

from scaffold.model.python.scopes import ScopeIndex

MAX_NODES = 60_000
"""The size limit of syntax trees; the largest file of 22 public repositories has 18 000 nodes."""
MAX_STATEMENTS = 4_000
"""The limit of statements in a block; the longest block of these repositories has 250."""
_BLOCKS = ("body", "orelse", "finalbody")
_WITH_BLOCKS = tuple(
    kind
    for kind in vars(ast).values()
    if isinstance(kind, type) and issubclass(kind, ast.AST) and "body" in kind._fields
)


def why_unchecked(index: ScopeIndex) -> str:
    """Return why a file is not checked; empty if it is.

    Rules follow names from statement to statement, and fixes cascade: their time depends
    on the size of the syntax tree, not on bytes or words.
    """
    size = len(index.nodes)
    if size > MAX_NODES:
        return _limit_message(f"a syntax tree of {size} nodes", MAX_NODES)
    longest = _longest_block(index) if size > MAX_STATEMENTS else 0
    if longest > MAX_STATEMENTS:
        return _limit_message(f"{longest} statements in one block", MAX_STATEMENTS)
    return ""


def _limit_message(much: str, most: int) -> str:
    return f"{much}; the limit is {most}: the file is not checked"


def _longest_block(index: ScopeIndex) -> int:
    nodes = index.of_types(*_WITH_BLOCKS)
    blocks = (getattr(node, field, None) for node in nodes for field in _BLOCKS)
    return max(len(block) for block in blocks if isinstance(block, list))
