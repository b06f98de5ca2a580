"""Licenses: directories ``_licenses/<SPDX id>/`` with a header for sources and the full text."""

from __future__ import annotations

import os
from collections.abc import Sequence

DIRECTORY = "_licenses"
HEADER = "header.jinja"
TEXT = "LICENSE.jinja"
CONTRIBUTING = "CONTRIBUTING.md.jinja"
NOTE = "note.jinja"
"""A file with a note about a license; most have none."""


def names(roots: Sequence[str]) -> tuple[str, ...]:
    """Return the identifiers of the licenses in content directories."""
    result: set[str] = set()
    for root in roots:
        directory = os.path.join(root, DIRECTORY)
        if os.path.isdir(directory):
            result.update(
                name
                for name in os.listdir(directory)
                if os.path.isfile(os.path.join(directory, name, TEXT))
            )
    return tuple(sorted(result))
