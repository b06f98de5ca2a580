"""The files that the linters of ament check."""

from __future__ import annotations

from collections.abc import Collection, Iterable

from scaffold.ament.finding import FLAKE8, PEP257
from scaffold.model.package import Package

IGNORE_MARKER = "AMENT_IGNORE"


def lintable(package: Package) -> tuple[str, ...]:
    """Return the files that the linters of ament visit when they walk the package.

    They skip directories that begin with ``_`` or ``.``, and directories with a file or a
    directory named AMENT_IGNORE and all that is below.
    """
    return package.remember("ament_files", lambda: tuple(_visited(package, package.files)))


def broken_links(package: Package) -> list[str]:
    """Return the broken symbolic links that make the linters fail."""
    return _visited(package, getattr(package.tree, "broken_links", ()))


def _visited(package: Package, paths: Iterable[str]) -> list[str]:
    marked = [
        path[: -len(IGNORE_MARKER)]
        for path in (*package.files, *package.tree.directories)
        if path.rpartition("/")[2] == IGNORE_MARKER
    ]
    if "" in marked:
        return []
    ignored = tuple(marked)
    return [
        path
        for path in paths
        if not path.startswith(ignored) and "/_" not in f"/{path.rpartition('/')[0]}"
    ]


def select(files: Iterable[str], named: Collection[str] = ()) -> dict[str, int]:
    """Return the linters (FLAKE8, PEP257, both) of each file that one of them checks.

    Args:
        files: All files.
        named: Files passed to ament_flake8 by name.

    Both take ``*.py``. ament_flake8 skips directories with an AMENT_IGNORE file and all
    directories whose name starts with a dot or an underscore; ament_pep257 knows only the second.
    """
    listed = list(files)
    ignored = tuple(
        path[: -len(IGNORE_MARKER)] for path in listed if path.rpartition("/")[2] == IGNORE_MARKER
    )
    result: dict[str, int] = {}
    for path in listed:
        if not path.endswith(".py"):
            if path in named:
                result[path] = FLAKE8
            continue
        parents = path.split("/")[:-1]
        if any(parent.startswith((".", "_")) for parent in parents):
            continue
        linters = PEP257
        if not any(path.startswith(directory) for directory in ignored):
            linters |= FLAKE8
        result[path] = linters
    return result
