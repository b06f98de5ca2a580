"""Parameter files and descriptions of robots that no launch file and no text names."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_NAMING = (
    *(".py", ".xml", ".yaml", ".yml", ".launch", ".sh", ".md", ".rst", ".cpp", ".hpp"),
    *(".urdf", ".xacro", ".sdf", ".world", ".txt", ".cmake"),
)
"""The endings of files that start nodes, build a robot, or tell people how to."""
_MARKUP = (".py", ".xml", ".yaml", ".yml")
_PUT_TOGETHER = rb"[\"'})](?:\.urdf)?%b"
"""Matches where a name ends that is only known when a launch file runs."""


def is_left_alone(package: Package, path: str) -> bool:
    """Return whether launch files are about a package, and nothing in the workspace names a file.

    A launch file that puts the name together may name any with that ending.
    """
    return package.remember(("left alone", path), lambda: _is_left_alone(package, path))


def _is_left_alone(package: Package, path: str) -> bool:
    name = path.rpartition("/")[2]
    ending = re.escape(f".{name.rpartition('.')[2]}".encode())
    whole = re.escape(name.encode("utf-8", "surrogateescape"))
    naming = re.compile(rb"(?<![\w.-])%b|%b" % (whole, _PUT_TOGETHER % ending))
    is_launched = False
    for file, data, is_own in _texts(package):
        if is_own and file == path:
            continue
        if naming.search(data):
            return False
        is_about = is_own or package.name.encode() in data
        is_launched = is_launched or (is_about and _is_launch_file(file))
    return is_launched


def _texts(package: Package) -> Iterator[tuple[str, bytes, bool]]:
    """Yield the files of the workspace that may name others, and whether they are of a package."""
    for other in package.workspace:
        for path in other.files:
            if path.endswith(_NAMING) and not path.endswith("setup.py"):
                with contextlib.suppress(ViewError):
                    yield path, other.data(path), other.name == package.name


def _is_launch_file(path: str) -> bool:
    return "launch" in path.rpartition("/")[2] and path.endswith(_MARKUP)
