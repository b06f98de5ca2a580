"""Which files there are, and which git does not track."""

from __future__ import annotations

from scaffold.files.tree import CMAKE_LISTS

__all__ = [
    "CMAKE_LISTS",
]
