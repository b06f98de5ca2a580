"""The packages around one."""

from __future__ import annotations

from scaffold.model.workspace.gitignore import is_left_out

__all__ = [
    "is_left_out",
]
