"""The packages that CMake finds, also through others."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.api import ViewError
from scaffold.api.catalog import is_released, released_dependencies

if TYPE_CHECKING:
    from scaffold.api import Package

_LIBRARIES = frozenset({"fmt", "glog", "gflags", "pybind11", "spdlog", "tinyxml2", "yaml_cpp"})
"""Libraries with names like those of packages of ROS."""
_GENERATORS = "rosidl_"
"""The start of the names of packages that only find their tools when they generate code."""


def packages_found(package: Package, before: int | None = None) -> set[str] | None:
    """Return the packages that ``find_package`` calls find, with what those need.

    Args:
        package: The package.
        before: The index of a command; only calls before it count.

    Returns:
        More than what is found, as not every dependency is exported to CMake; ``None`` if the
        dependencies of a package are unknown.
    """
    pending = [
        found.name
        for found in package.cmake.found_packages
        if before is None or found.command.index < before
    ]
    result: set[str] = set()
    for name in pending:  # extended during the loop
        if name in result:
            continue
        result.add(name)
        neighbor = package.workspace.get(name)
        if neighbor is not None:
            try:
                pending += [item.name for item in neighbor.manifest.dependencies]
            except ViewError:
                return None
        elif is_released(name):
            pending += () if name.startswith(_GENERATORS) else released_dependencies(name)
        elif name.islower() and "-" not in name and name not in _LIBRARIES:
            return None  # perhaps a package of ROS
    return result
