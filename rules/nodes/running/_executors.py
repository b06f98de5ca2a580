"""The use of executors in programs, and what runs after rclpy.shutdown()."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.api.rclpy import RclpyCall, RclpyFile

_FAR = 200
"""The maximum number of statements between, which are not checked."""


class Shutdowns:
    """The shutdown statements of a file, by block."""

    def __init__(self, file: RclpyFile) -> None:
        self._module = file.module
        self._blocks: dict[tuple[ast.AST, str], dict[int, RclpyCall]] = {}
        for call in file.shutdown_calls:
            place = self._place(call.call)
            if place is not None:
                holder, block, number = place
                self._blocks.setdefault((holder, block), {})[number] = call

    def before(self, call: ast.Call) -> RclpyCall | None:
        """Return the last shutdown before a call in its block, unless rclpy may be restarted."""
        place = self._place(call)
        if place is None:
            return None
        holder, block, number = place
        calls = self._blocks.get((holder, block), {})
        for at in range(number - 1, max(number - _FAR, 0) - 1, -1) if calls else ():
            if at in calls:
                return calls[at]
            if "init" in ast.unparse(getattr(holder, block)[at]):
                return None
        return None

    def _place(self, call: ast.Call) -> tuple[ast.AST, str, int] | None:
        """Return the parent, block and index of a call statement."""
        statement = self._module.parent(call)
        holder = self._module.parent(statement) if isinstance(statement, ast.Expr) else None
        if statement is None or holder is None:
            return None
        return holder, *self._module.index.place(statement)


def used_of_executor(file: RclpyFile, call: ast.Call) -> dict[str, ast.AST] | None:
    """Return the used attributes of an executor that stays in a local variable."""
    parent = file.module.parent(call)
    if not isinstance(parent, ast.Assign):
        return None
    name = file.module.qualified_name(call.func) or ""
    if not name.startswith("rclpy.executors.") or not name.endswith("Executor"):
        return None
    if not isinstance(parent.targets[0], ast.Name):
        return None
    variable = parent.targets[0]
    uses = file.module.index.uses_of(variable)
    around = [file.module.parent(use) for use in uses if use is not variable]
    attributes = [node for node in around if isinstance(node, ast.Attribute)]
    is_alone = len(uses) == len(file.module.index.names(variable.id))
    if not is_alone or len(attributes) < len(around):
        return None
    return {node.attr: node for node in attributes}
