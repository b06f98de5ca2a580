"""Removes the current directory from Python's module search path.

``python -m`` and an empty entry in ``PYTHONPATH`` put the current directory before the standard
library: a ``json.py`` in the checked repository would be executed.
"""

from __future__ import annotations

import os
import sys

_OWN = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def leave_out_current_directory() -> None:
    """Remove the current directory from the path, unless this tool itself is there."""
    try:
        current = os.getcwd()
    except OSError:  # it was removed
        current = ""
    if current != _OWN:
        sys.path[:] = [entry for entry in sys.path if entry not in {"", os.curdir, current}]
