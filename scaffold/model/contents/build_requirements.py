"""What is installed where a package is built from source."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

from scaffold.model.catalog import keys_brought
from scaffold.model.released import transitive_dependencies
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package


_OF_TOOLS = frozenset(
    {"python3-catkin-pkg", "python3-catkin-pkg-modules", "python3-dateutil", "python3-distlib"}
    | {"python3-distro", "python3-docutils", "python3-empy", "python3-packaging"}
    | {"python3-pyparsing", "python3-pytest", "python3-rosdistro-modules"}
    | {"python3-rospkg", "python3-rospkg-modules", "python3-setuptools", "python3-yaml"}
)
"""The libraries that colcon and rosdep themselves depend on."""


def is_installed_to_build(package: Package, keys: Collection[str]) -> bool:
    """Return whether building a package and what it uses from source installs one of some keys.

    rosdep installs the dependencies of all kinds, and colcon builds the used packages of the
    workspace on the same machine; their test dependencies do not count. Both bring libraries of
    their own.
    """
    return not package.remember("installed to build", lambda: _to_build(package)).isdisjoint(keys)


def _to_build(package: Package) -> frozenset[str]:
    result: set[str] = {*_OF_TOOLS}
    pending = [package.name]
    kinds = ["build", "build_export", "run", "test"]
    while pending:
        name = pending.pop()
        neighbor = package if name == package.name else package.workspace.get(name)
        try:
            names = set() if neighbor is None else neighbor.manifest.names_for(*kinds)
        except ViewError:
            continue
        kinds = ["build", "build_export", "run"]
        pending += names - result
        result |= names
    result |= transitive_dependencies(result)
    return frozenset(result | keys_brought(result))
