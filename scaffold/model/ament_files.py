"""The files of a package that ament's linters look at."""

from __future__ import annotations

from collections.abc import Iterable

from scaffold.model.package import Package

IGNORE_MARKER = "AMENT_IGNORE"


def lintable(package: Package) -> tuple[str, ...]:
    """Return the files that every ament linter that walks directories itself would visit.

    They leave out directories that begin with ``_`` or ``.``, and directories with a file or a
    directory named AMENT_IGNORE and all that is below.
    """
    return package.remember("ament_files", lambda: tuple(_visited(package, package.files)))


def broken_links(package: Package) -> list[str]:
    """Return the links to nothing that the linters stop at: they see a name, and no file."""
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
