"""Python style and docstrings: the verdict of ament_flake8 and ament_pep257 at ruff's speed."""

from __future__ import annotations

from scaffold.ament.backend import StyleCheck

__all__ = ["StyleCheck"]
