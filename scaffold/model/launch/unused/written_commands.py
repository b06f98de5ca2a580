"""Command lines with ``ros2 launch`` in scripts, containers and texts of a repository."""

from __future__ import annotations

import contextlib
import os
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.discovery.colcon import repository_around
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_DIRECTORIES = ("", "docker", "scripts", ".devcontainer")
"""Directories of a repository whose files are read."""
_STARTING = lazy_re.compile(r"(?i)docker|compose|\.(?:sh|bash|md|rst|ya?ml)$")
"""Matches the names of files that start programs or document how to."""
_MAX_BYTES = 200_000


def gives_argument(package: Package, launch_file: str, name: str) -> bool:
    """Return whether a command line starts a launch file with an argument.

    Args:
        package: The package of the launch file.
        launch_file: The name of the file.
        name: The name of the argument.
    """
    command = re.compile(rf"{re.escape(launch_file)}[^\n]{{0,500}}\b{re.escape(name)}:=")
    texts = (*_texts_of_package(package), *_texts_of_repository(package))
    return any(command.search(text.replace("\\\n", " ")) for text in texts)


def _texts_of_package(package: Package) -> Iterator[str]:
    for path in package.files:
        if _STARTING.search(path.rpartition("/")[2]):
            with contextlib.suppress(ViewError):
                yield package.data(path).decode(errors="replace")


def _texts_of_repository(package: Package) -> Iterator[str]:
    if not package.directory:
        return
    disk = package.outside
    top = repository_around(disk, disk.real(package.directory))
    for directory in _DIRECTORIES if top is not None else ():
        place = os.path.join(str(top), directory)
        for name in disk.entries(place):
            if _STARTING.search(name):
                with contextlib.suppress(OSError):
                    yield disk.read(os.path.join(place, name), _MAX_BYTES).decode(errors="replace")
