"""Files that git does not track: they are ignored, or in a submodule."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.package import Package

_FILE = ".gitignore"
_MAX_BYTES = 200_000
"""The size limit of ``.gitignore`` files."""
_SUBMODULES = ".gitmodules"


def is_untracked(package: Package, path: str) -> bool:
    """Return whether a ``.gitignore`` matches a file or directory of a package, or one around it.

    Negated patterns are not supported.
    """
    if is_of_submodule(package, path):
        return True
    return any(
        _is_named(pattern, below, full_path)
        for below, full_path, text in _ignore_files(package, path)
        for line in text.splitlines()
        if (pattern := line.strip()) and pattern[0] not in "#!"
    )


def _ignore_files(package: Package, path: str) -> Iterator[tuple[str, str, str]]:
    """Yield the path relative to each ``.gitignore``, with the patterns of that file."""
    for prefix, text in _texts(package, _FILE):
        yield path, f"{prefix}{path}", text
    directory, *rest = path.split("/")
    while rest and directory and ".." not in directory.split("/"):
        with contextlib.suppress(OSError):
            text = package.bytes_of(f"{directory}/{_FILE}", _MAX_BYTES).decode(errors="replace")
            yield "/".join(rest), "/".join(rest), text
        directory = f"{directory}/{rest.pop(0)}"


def _is_named(pattern: str, path: str, full_path: str) -> bool:
    """Return whether a pattern matches a path, or a directory above it in the package.

    Args:
        pattern: A line of the file.
        path: The path in the package, below the directory of the file.
        full_path: The path from the directory of the file.
    """
    from fnmatch import fnmatchcase  # few packages refer to a missing file

    pattern = pattern.rstrip("/")
    if "/" not in pattern:
        return any(fnmatchcase(part, pattern) for part in path.split("/"))
    parts = full_path.split("/")
    above = ["/".join(parts[:depth]) for depth in range(1, len(parts) + 1)]
    return any(fnmatchcase(item, pattern.removeprefix("/")) for item in above)


def is_of_submodule(package: Package, path: str) -> bool:
    """Return whether a path is in a git submodule."""
    for prefix, text in _texts(package, _SUBMODULES):
        for line in text.splitlines():
            key, _, directory = line.partition("=")
            if key.strip() == "path" and f"{prefix}{path}/".startswith(f"{directory.strip()}/"):
                return True
    return False


def _texts(package: Package, name: str) -> Iterator[tuple[str, str]]:
    """Yield the texts of files with a name, from the package up to the root of the checkout.

    Each with the relative path from its directory to the package: ``src/talker/``.
    """
    with contextlib.suppress(OSError):
        yield "", package.bytes_of(name, _MAX_BYTES).decode(errors="replace")
    disk = package.outside
    for directory in directories_above(package):
        with contextlib.suppress(OSError):
            text = disk.read(os.path.join(directory, name), _MAX_BYTES).decode(errors="replace")
            way = os.path.relpath(disk.real(package.root or ""), directory)
            yield f"{way.replace(os.sep, '/')}/", text


def directories_above(package: Package) -> list[str]:
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
