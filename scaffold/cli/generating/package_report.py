"""Common output of ``new`` and ``add``: conflicts, edits left to the user, next commands."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scaffold.errors import ConflictError
    from scaffold.generate.edit.addition import ByHand


def conflict(paths: Sequence[str], where: str, hint: str) -> ConflictError:
    """Return the error about existing files that differ."""
    from scaffold.errors import ConflictError

    state = "exist and differ" if len(paths) > 1 else "exists and differs"
    return ConflictError(f"{', '.join(paths)} in {where} already {state}; {hint}")


def by_hand(directory: str, edits: Sequence[ByHand]) -> list[str]:
    """Return the lines that the user has to add, with place and reason."""
    lines = ["Add by hand:"] if edits else []
    for edit in edits:
        path = os.path.normpath(os.path.join(directory, edit.path))
        lines += [f"    {path}: {edit.line}", f"        because {edit.reason}"]
    return lines


def next_commands(directory: str, name: str, top: str) -> list[str]:
    """Return the commands that check and build a package.

    Args:
        directory: The package.
        name: Its name.
        top: The directory in which colcon is started; empty for the current one.
    """
    from shlex import quote

    build = f"colcon build --packages-select {name}"
    if top and os.path.realpath(top) != os.path.realpath("."):
        build = f"cd {quote(top)} && {build}"
    return [
        "Next:",
        f"    ros2-scaffold check {quote(directory)}",
        f"    {build}",
        "    source install/setup.bash",
    ]


def shortest(path: str) -> str:
    """Return a path relative to the current directory, or the absolute one if that is shorter."""
    return min(os.path.relpath(path), os.path.realpath(path), key=len)
