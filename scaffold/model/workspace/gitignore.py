"""Files that git does not track: they are ignored, or in a submodule."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.package import Package

_FILE = ".gitignore"
_MOST_BYTES = 200_000
"""Of such a file; people write some lines."""
_SUBMODULES = ".gitmodules"


def is_untracked(package: Package, path: str) -> bool:
    """Tell whether a ``.gitignore`` names a file of a package.

    Patterns for directories and for paths are not supported.
    """
    from fnmatch import fnmatchcase  # few packages name a file that is not there

    if _is_of_submodule(package, path):
        return True
    name = path.rpartition("/")[2]
    for _, text in _texts(package, _FILE):
        for line in text.splitlines():
            pattern = line.strip()
            if pattern and pattern[0] not in "#!" and fnmatchcase(name, pattern):
                return True
    return False


def _is_of_submodule(package: Package, path: str) -> bool:
    """Tell whether a path lies in a directory of the package that git fetches from elsewhere."""
    for prefix, text in _texts(package, _SUBMODULES):
        for line in text.splitlines():
            key, _, directory = line.partition("=")
            if key.strip() == "path" and f"{prefix}{path}/".startswith(f"{directory.strip()}/"):
                return True
    return False


def _texts(package: Package, name: str) -> Iterator[tuple[str, str]]:
    """Yield what the files of a name say, from the package up to the root of the checkout.

    In front of each, the way from its directory to the package: ``src/talker/``.
    """
    with contextlib.suppress(OSError):
        yield "", package.bytes_of(name, _MOST_BYTES).decode(errors="replace")
    disk = package.outside
    for directory in _parents(package):
        with contextlib.suppress(OSError):
            text = disk.read(os.path.join(directory, name), _MOST_BYTES).decode(errors="replace")
            way = os.path.relpath(disk.real(package.root or ""), directory)
            yield f"{way.replace(os.sep, '/')}/", text


def _parents(package: Package) -> list[str]:
    """Return the directories above a package that belong to its checkout."""
    if package.root is None:
        return []
    disk = package.outside
    directory = disk.real(package.root)
    result: list[str] = []
    while not disk.exists(os.path.join(directory, ".git")):
        parent = os.path.dirname(directory)
        if parent == directory:
            return []  # no checkout
        result.append(parent)
        directory = parent
    return result
