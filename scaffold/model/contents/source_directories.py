"""The directories ``src`` of workspaces, in which colcon looks for packages."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package


def is_in_no_workspace(package: Package) -> bool:
    """Return whether all packages of ROS 2 are in a directory ``src`` that does not contain one."""
    workspace = package.workspace
    packages = (*workspace, *workspace.namesakes(package))
    others = [other for other in packages if not _is_for_catkin(other)]
    return bool(others) and all(_is_below_another_source(other, package) for other in others)


def _is_below_another_source(other: Package, package: Package) -> bool:
    place = f"{package.directory}/"
    return not all(place.startswith(f"{parent}/") for parent in _source_directories(other))


def _source_directories(package: Package) -> Iterator[str]:
    parts = package.directory.split("/")
    return ("/".join(parts[: at + 1]) for at, name in enumerate(parts[:-1]) if name == "src")


def _is_for_catkin(package: Package) -> bool:
    try:
        return package.manifest.catkin is not None
    except ViewError:
        return True
