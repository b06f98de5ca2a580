"""The other packages of the workspace."""

from __future__ import annotations

from scaffold.model.discovery.colcon import is_ignored
from scaffold.model.discovery.gitignore import is_of_submodule, is_untracked

__all__ = [
    "is_ignored",
    "is_of_submodule",
    "is_untracked",
]
