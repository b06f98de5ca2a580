"""Keeps templates, and what is rendered from them, in their directories."""

from __future__ import annotations

import os
from collections.abc import Iterable

from scaffold.errors import ContentError


def refuse_outside(path: str, places: Iterable[str]) -> None:
    """Raise if a file is not in one of some directories, links followed.

    Raises:
        ContentError: it is elsewhere.
    """
    real = os.path.realpath(path)
    if not any(real.startswith(os.path.realpath(place) + os.sep) for place in places):
        raise ContentError(f"{path}: a link to {real}, which is not in the directory of templates")


def refuse_leaving(path: str, where: str) -> None:
    """Raise if the path of a rendered file leaves the package.

    Raises:
        ContentError: it does, or is none.
    """
    parts = path.split("/")
    if "\0" in path or not all(parts) or {".", ".."} & set(parts):
        raise ContentError(f"{where}: {path!r} is not a path in the package")
