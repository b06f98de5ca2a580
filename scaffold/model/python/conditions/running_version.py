"""The Python version that code runs on, as far as the distribution determines it."""

from __future__ import annotations

import ast

_ABOVE = (ast.Gt, ast.GtE, ast.NotEq)
_BELOW = (ast.Lt, ast.LtE, ast.NotEq)
SWAPPED: dict[type[ast.cmpop], type[ast.cmpop]] = {
    ast.Lt: ast.Gt,
    ast.LtE: ast.GtE,
    ast.Gt: ast.Lt,
    ast.GtE: ast.LtE,
    ast.Eq: ast.Eq,
    ast.NotEq: ast.NotEq,
}
"""The operators for exchanged operands."""


class RunningVersion(tuple[int, ...]):
    """``sys.version_info``, or ``sys.hexversion``: the first components of a longer version."""

    __slots__ = ()

    def compare(self, operator: type[ast.cmpop], other: object) -> bool | None:
        """Return the result of a comparison; ``None`` if it depends on unknown numbers.

        Args:
            operator: The type of the operator.
            other: The right side: a tuple, or a number such as ``0x030c0000``.
        """
        if operator not in SWAPPED:
            return None
        if isinstance(other, int):
            other = (other >> 24, other >> 16 & 255, other & 65535)
        if not isinstance(other, tuple) or not all(isinstance(item, int) for item in other):
            return None
        shared = len(self)
        if other[:shared] != self[: len(other)]:
            return operator in (_BELOW if self < other else _ABOVE)
        if len(other) <= shared:
            return operator in _ABOVE  # it is longer
        if not any(other[shared:]) and operator in (ast.GtE, ast.Lt):
            return operator is ast.GtE
        return None
