"""Which Python files each of the two linters looks at."""

from __future__ import annotations

from collections.abc import Iterable

from scaffold.style.finding import FLAKE8, PEP257

IGNORE_MARKER = "AMENT_IGNORE"


def select(files: Iterable[str]) -> dict[str, int]:
    """Return the linters (FLAKE8, PEP257, both) of each file that one of them checks.

    Both take ``*.py``. ament_flake8 leaves out directories with an AMENT_IGNORE file and all
    directories whose name starts with a dot or an underscore; ament_pep257 knows only the second.
    """
    listed = list(files)
    ignored = tuple(
        path[: -len(IGNORE_MARKER)] for path in listed if path.rpartition("/")[2] == IGNORE_MARKER
    )
    found: dict[str, int] = {}
    for path in listed:
        if not path.endswith(".py"):
            continue
        parents = path.split("/")[:-1]
        if any(parent.startswith((".", "_")) for parent in parents):
            continue
        linters = PEP257
        if not any(path.startswith(directory) for directory in ignored):
            linters |= FLAKE8
        found[path] = linters
    return found
