"""Which files of a package are launch files, and which others belong beside them at run time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.errors import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

ENDINGS = ("launch.py", "launch.xml", "launch.yaml", "launch.yml")
DIRECTORIES = ("launch/", "launches/")
DATA_DIRECTORIES = ("config", "params", "param", "rviz", "urdf", "maps", "worlds", "meshes")
"""Directories whose files are read at run time from ``share/<package>``."""


def launch_files(package: Package) -> list[str]:
    """Return the launch files: by their ending, or by ``generate_launch_description``."""
    return [path for path in package.files if _is_launch_file(package, path)]


def data_files(package: Package, directory: str) -> list[str]:
    """Return the files of a data directory that a node or a launch file may read."""
    return [
        path
        for path in package.files
        if path.startswith(f"{directory}/") and not path.endswith((".py", ".md", ".in", ".txt"))
    ]


def _is_launch_file(package: Package, path: str) -> bool:
    directory, _, name = path.rpartition("/")
    if not f"{directory}/".startswith(DIRECTORIES):
        return False
    if name.endswith(ENDINGS):
        return True
    if not name.endswith(".py"):
        return False
    try:
        return package.module(path).defines("generate_launch_description") is True
    except ViewError:
        return False
