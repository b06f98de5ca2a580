"""What is installed where a package is built from source."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from typing import TYPE_CHECKING

from scaffold.closure import closure
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
    own = _names_for(package, "build", "build_export", "run", "test")

    def required(name: str) -> Iterable[str]:
        neighbor = package.workspace.get(name)
        return _names_for(neighbor, "build", "build_export", "run") if neighbor is not None else ()

    result = {*_OF_TOOLS, *own, *closure(own, required)}
    result |= transitive_dependencies(result)
    return frozenset(result | keys_brought(result))


def _names_for(package: Package, *kinds: str) -> Iterable[str]:
    try:
        return package.manifest.names_for(*kinds)
    except ViewError:
        return ()
