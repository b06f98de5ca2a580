"""Paths relative to the current directory or to the repository root."""

from __future__ import annotations

import os
from collections.abc import Callable

from scaffold.diagnostic import Diagnostic
from scaffold.model.package import Package
from scaffold.model.remembered import remembered
from scaffold.printable import printable


@remembered
def shown(package: Package, path: str) -> str:
    """Return the path of a file of a package relative to the current directory.

    A file outside the current directory keeps the form in which its package was given.
    """
    joined = os.path.normpath(os.path.join(package.directory, path))
    if not os.path.isabs(joined):
        return joined
    relative = os.path.relpath(joined)
    return joined if relative.startswith(os.pardir) else relative


def printable_path(package: Package, path: str) -> str:
    """Return the path of a file of a package with control characters escaped."""
    return printable(shown(package, path))


def place(
    package: Package,
    diagnostic: Diagnostic,
    name: Callable[[Package, str], str] = printable_path,
) -> str:
    """Return ``path:line:column``, a form that terminals and editors link."""
    at = diagnostic.location
    return f"{name(package, at.path)}:{at.line}:{at.column}"


@remembered
def in_repository(package: Package, path: str) -> str:
    """Return the real path of a file of a package relative to the top of its repository.

    The repository is the one around the current directory if the file is in it, else the one around
    the file. A file in no repository is relative to the current directory, like `shown`.
    """
    real = os.path.realpath(os.path.join(package.directory, path))
    current = os.path.realpath(os.curdir)
    for start in (current, os.path.dirname(real)):
        top = _repository_around(package, start)
        if top is not None and real.startswith(os.path.join(top, "")):
            return os.path.relpath(real, top).replace(os.sep, "/")
    return shown(package, path)


def _repository_around(package: Package, directory: str) -> str | None:
    disk = package.outside  # a cached report is valid while the disk gives these answers
    while not disk.exists(os.path.join(directory, ".git")):
        parent = os.path.dirname(directory)
        if parent == directory:
            return None
        directory = parent
    return directory
