"""Paths as a user would type them."""

from __future__ import annotations

import os

from scaffold.model.package import Package


def shown(package: Package, path: str) -> str:
    """Return the path of a file of a package relative to the current directory.

    A file outside the current directory keeps the form in which its package was given.
    """
    return package.remember(("shown", path), lambda: _shown(package, path))


def _shown(package: Package, path: str) -> str:
    joined = os.path.normpath(os.path.join(package.directory, path))
    if not os.path.isabs(joined):
        return joined
    relative = os.path.relpath(joined)
    return joined if relative.startswith(os.pardir) else relative
