"""Finds the distribution named in the README, containers and workflows of a repository.

It does not select the target, because findings should not depend on an outdated README. If the
report is for another distribution, a note says so.
"""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING

from scaffold import distributions, lazy_re
from scaffold.cli.distro import FLAG
from scaffold.model.discovery.colcon import repository_around

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from scaffold.distributions import Distribution
    from scaffold.files.disk import Disk

_PLACES = (
    ("", ("README", "DOCKERFILE", "DOCKER-COMPOSE", ".GITLAB-CI")),
    ("docker", ("DOCKERFILE",)),
    (".devcontainer", ("DOCKERFILE", "DOCKER-COMPOSE")),
    (os.path.join(".github", "workflows"), ()),
)
"""Directories of a repository, and patterns of the files read there."""
_MAX_BYTES = 200_000
"""The number of bytes read; a README names its distribution at the top."""
_KNOWN = (*distributions.NAMES, *sorted(distributions.ENDED_ROS2))
_NAMED = lazy_re.compile(
    r"(?<![a-z])ros[ _-]?2?[ _-]?(?:distro(?:s|butions?)?)?[\W_]{1,4}"
    rf"({'|'.join(_KNOWN)})(?![a-z])"
    r"(?P<later>\+|\s+(?:onwards?|(?:or|and)\s+(?:above|higher|later|newer|up))\b)?",
    re.IGNORECASE,
)
"""Matches ``ROS 2 Humble``, ``ros:humble``, ``ros-humble-desktop``, ``ROS_DISTRO=humble``."""


def note(directory: str, targets: Sequence[Distribution], disk: Disk) -> tuple[str, ...]:
    """Return a note if the repository names other distributions than the targets.

    Args:
        directory: The checked directory, or the common one.
        targets: The targets of the check.
        disk: Records what was accessed.
    """
    real = disk.real(directory)
    top = repository_around(disk, real) or real
    by_name: dict[str, list[str]] = {}
    for path in _files(disk, top):
        for match in _NAMED.finditer(_text(disk, path)):
            if match["later"]:
                return ()
            by_name.setdefault(match[1].lower(), []).append(path)
    if not by_name or by_name.keys() & {target.name for target in targets}:
        return ()
    usable = [name for name in distributions.NAMES if name in by_name]
    ended = [name for name in by_name if name in distributions.ENDED]
    path = os.path.relpath(by_name[(usable or ended)[0]][0], disk.real(os.curdir))
    checked = f"checked for {distributions.titles(targets)}, although {path} is for"
    if not usable:
        return (f"{checked} {_titles(ended)}, which {distributions.ending(ended[0])}",)
    return (f"{checked} {_titles(usable)}; use {FLAG} {','.join(usable)} to check for that",)


def _titles(names: Sequence[str]) -> str:
    return distributions.enumerated(name.capitalize() for name in names)


def _files(disk: Disk, top: str) -> Iterator[str]:
    for directory, starts in _PLACES:
        place = os.path.join(top, directory) if directory else top
        for name in disk.entries(place, *starts):
            yield os.path.join(place, name)


def _text(disk: Disk, path: str) -> str:
    """Return the text of a file; empty if it is binary or too large."""
    try:
        return disk.read(path, _MAX_BYTES).decode(errors="replace")
    except OSError:
        return ""
