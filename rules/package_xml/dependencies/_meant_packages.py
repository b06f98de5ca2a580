"""The existing packages that unknown dependencies refer to."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.api.catalog import ROS_PACKAGES, has_rosdep_rule, is_near, is_released
from scaffold.api.manifest import is_included

if TYPE_CHECKING:
    from scaffold.api import Package


def package_of_key(name: str) -> str:
    """Return the released package for a name like a key: py_trees for python3-py-trees, or ""."""
    package = name.removeprefix("python3-").replace("-", "_")
    is_key = package != name and is_released(package) and has_rosdep_rule(package)
    return package if is_key else ""


def is_in_rosdep_cache(package: Package, name: str) -> bool:
    """Return whether rosdep's cache, if it exists, has a rule for a name."""
    rosdep = package.workspace.rosdep
    return rosdep is not None and rosdep.resolves(name) is not False


def similar_neighbor(package: Package, name: str) -> str | None:
    """Return the only workspace package that an unknown name can refer to, if any."""
    if is_released(name) or name in ROS_PACKAGES or is_in_rosdep_cache(package, name):
        return None
    similar = [other.name for other in package.workspace if is_near(name, other.name)]
    if len(similar) != 1 or similar[0] == package.name:
        return None
    is_imported = any(name in module.imports_by_root for module in package.modules())
    return None if is_imported or is_included(package, name) else similar[0]
