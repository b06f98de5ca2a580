"""Writes the stubs directory for editors and type checkers."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from scaffold.errors import ConflictError, InputError

if TYPE_CHECKING:
    from scaffold.writing.plan import WritePlan

MARK = "# Made by `ros2-scaffold stubs`, which overwrites changes.\n"
"""The first line of each stub: it belongs to this tool."""
_LENIENT = "# pyright: basic\n"
"""The second one: what pyright asks of strict projects is not the users' business here."""
_SHOWN = 3


def plan(directory: str, stubs: Mapping[str, str], *, force: bool = False) -> WritePlan:
    """Compare stubs with a directory; nothing is written.

    A stub that an earlier run has written and that is not made any more is removed.

    Args:
        directory: Where they go; it need not exist.
        stubs: The stubs by path relative to the directory.
        force: Overwrite files that are not from an earlier run.

    Raises:
        ConflictError: a file that is not from an earlier run would be overwritten, and ``force``
            was not given.
        InputError: something cannot be read.
    """
    from scaffold.writing.plan import WritePlan
    from scaffold.writing.planned_file import State

    files = {path: MARK + _LENIENT + text for path, text in stubs.items()}
    stale = [path for path in _earlier(directory) if path not in files]
    result = WritePlan.of(directory, files, remove=stale)
    foreign = [
        file.path
        for file in result.changes
        if file.state is State.DIFFERING and not (file.before or b"").startswith(MARK.encode())
    ]
    if foreign and not force:
        more = f" and {len(foreign) - _SHOWN} more" if len(foreign) > _SHOWN else ""
        raise ConflictError(
            f"would overwrite {', '.join(foreign[:_SHOWN])}{more} in {directory}, not written by "
            "`ros2-scaffold stubs`; nothing was written: choose another --output, or use --force"
        )
    return result


def _earlier(directory: str) -> Iterator[str]:
    """Yield the relative paths of the stubs that an earlier run has written."""

    def refuse(error: OSError) -> None:
        if not isinstance(error, FileNotFoundError):
            raise InputError(f"{error.filename}: {error.strerror}") from error

    for parent, directories, names in os.walk(directory, onerror=refuse):
        directories.sort()
        for name in sorted(names):
            path = os.path.join(parent, name)
            if name.endswith(".pyi") and not os.path.islink(path) and _is_marked(path):
                yield os.path.relpath(path, directory).replace(os.sep, "/")


def _is_marked(path: str) -> bool:
    try:
        with open(path, "rb") as file:
            return file.read(len(MARK)) == MARK.encode()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from error
