"""Programs that pip installs with this tool: ruff and the type checker."""

from __future__ import annotations

import os
import sys

from scaffold.programs import search


def find(name: str) -> str | None:
    """Return the program of the running Python, else that on the PATH.

    Args:
        name: The program, which is also the name of its Python package.
    """
    beside = os.path.join(os.path.dirname(sys.executable), name)
    own = os.path.join(sys.prefix, "bin", name)
    for candidate in (beside, own):
        if os.path.isabs(candidate) and os.access(candidate, os.X_OK):
            return candidate
    from importlib import import_module

    try:
        return str(getattr(import_module(name), f"find_{name}_bin")())
    except (ImportError, AttributeError, FileNotFoundError):
        return search.find(name)
