"""Keeps the checked repository off Python's search path.

``python -m`` and an empty entry of ``PYTHONPATH`` put the current directory on it, in front of the
standard library: a ``json.py`` of a stranger would run.
"""

from __future__ import annotations

import os
import sys

_OWN = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def leave_out_current_directory() -> None:
    """Import nothing more from the current directory, unless this tool itself is there."""
    try:
        here = os.getcwd()
    except OSError:  # it was removed
        here = ""
    if here != _OWN:
        sys.path[:] = [entry for entry in sys.path if entry not in {"", os.curdir, here}]
