"""Dependencies that the environment lacks, reported before the build."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import suppress

from scaffold import distributions
from scaffold.model.catalog import ROS_PACKAGES
from scaffold.model.package import Package, imports
from scaffold.record import NamedTuple
from scaffold.smoke.environment import Environment
from scaffold.source import ViewError

_NOT_RUN = ("launch", "test")
"""Directories of Python files that no executable imports."""


class Lack(NamedTuple):
    """A missing ROS package."""

    message: str
    """A line with its dependents and how to install it."""
    users: frozenset[str]
    """The names of the packages that need it."""


def unavailable(environment: Environment, packages: Sequence[Package]) -> Iterator[Lack]:
    """Yield the missing ROS packages.

    Args:
        environment: The environment to build and run with.
        packages: The packages to build, which provide themselves.
    """
    available = {package.name for package in packages}
    for prefix in environment.variables.get("AMENT_PREFIX_PATH", "").split(os.pathsep):
        index = os.path.join(prefix, "share/ament_index/resource_index/packages")
        available.update(os.listdir(index) if os.path.isdir(index) else ())
    needed: dict[str, list[str]] = {}
    for package in packages:
        for name in _needed(package) & ROS_PACKAGES - available:
            needed.setdefault(name, []).append(package.name)
    distribution = environment.distribution or distributions.DEFAULT
    for name, users in sorted(needed.items()):
        apt = f"sudo apt install ros-{distribution}-{name.replace('_', '-')}"
        way = f"run: {apt}"
        if environment.kind == "wheels":
            way = f"there is no wheel; install it with {apt}, and use --ros {distribution}"
        yield Lack(
            f"{', '.join(sorted(users))} needs {name}, which {environment.prefix} lacks; {way}",
            frozenset(users),
        )


def _needed(package: Package) -> set[str]:
    """Return the dependencies to build a package and to start its executables."""
    with suppress(ViewError):
        manifest = package.manifest
        needed = manifest.build_names if package.has("CMakeLists.txt") else set[str]()
        for path in package.python_files:
            if not path.startswith(_NOT_RUN):
                with suppress(ViewError):
                    needed = needed | (imports(package, path) & manifest.declared_names)
        return needed
    return set()
