"""The packages that a manifest declares, and those that may come with them."""

from __future__ import annotations

import sys
from functools import partial
from typing import TYPE_CHECKING

from scaffold.closure import closure
from scaffold.model.catalog import (
    LIBRARY_KEYS,
    OTHER_NAMES,
    ROS1_PACKAGES,
    ROS_PACKAGES,
    keys_brought,
    keys_of_module,
    module_of_key,
    similar_key,
    similar_package,
)
from scaffold.model.released import dependencies, is_released, transitive_dependencies
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_OF_MESSAGES = ("_msgs", "_interfaces", "_msg")
"""The last parts of names of interface packages, which often use those of ROS."""
_INTERFACES = frozenset(
    {"action", "interface", "interfaces", "messages", "msg", "msgs", "srv", "srvs"}
)
"""Words in names of packages that only contain interfaces."""
_TOOLS = ("ament_", "launch", "rclcpp", "rclpy", "rosbag2", "rosidl_")
"""The first parts of names of client libraries, and of tools for builds and tests."""
_STARTING = frozenset(
    {"bringup", "config", "demo", "demos", "description", "launch", "robot", "robots", "sim"}
    | {"simulation", "simulator"}
)
"""Words in names of packages with launch files, which start nodes of other packages."""
_DIGITS = "0123456789"
_COMMON_WORDS = frozenset({"ament", "my", "python", "python3", "ros", "ros2"})
"""First parts of names that do not make packages related."""


class Declared(NamedTuple):
    """The packages that the manifest declares, directly and through dependencies."""

    direct: set[str]
    along: set[str]
    unknown: frozenset[str]
    """Packages that are neither released nor in the workspace; what they bring is not known."""

    def may_bring(self, package: Package, name: str) -> bool:
        """Return whether an unknown dependency may bring a package from outside of the workspace.

        Their names are related: ``arm_bringup`` may bring ``arm_msgs``, and ``arm_msgs`` may bring
        ``sensor_msgs``.
        """
        return package.workspace.get(name) is None and any(
            _are_related(dependency, name) for dependency in self.unknown
        )

    def may_use(self, package: Package, name: str) -> bool:
        """Return whether an unknown dependency may bring a library or node that it uses itself.

        ``arm_driver`` may use messages, which ``arm_msgs`` does not, and ``arm_bringup`` any node.
        Several unknown ones are part of a larger system that is installed in another way.
        """
        if self.may_bring(package, name):
            return True
        if package.workspace.get(name) is not None or name.startswith(_TOOLS):
            return False
        using = [*filter(_may_use_others, self.unknown)]
        return (
            len(using) > 1
            or (bool(using) and _has_messages(name))
            or any(not _STARTING.isdisjoint(dependency.split("_")) for dependency in using)
        )


@remembered
def declared(package: Package, *, for_tests: bool) -> Declared:
    """Return the packages available to the package, or to its tests."""
    manifest = package.manifest
    direct = set(manifest.run_names)
    # Code generators are build dependencies with modules as well.
    direct |= {
        dependency.name
        for dependency in manifest.dependencies
        if dependency.kind.startswith("buildtool")
    }
    direct |= {dependency.name for dependency in manifest.dependencies if dependency.is_optional}
    direct |= {*package.workspace.policy.implicit}
    if for_tests:
        direct |= manifest.test_names | manifest.build_names
    along = transitive_dependencies(direct) | closure(direct, partial(brought_by, package))
    along |= transitive_dependencies(along)
    unknown = frozenset(name for name in direct | along if _is_unknown(package, name))
    return Declared(direct, along | keys_brought(direct | along), unknown)


def _is_unknown(package: Package, name: str) -> bool:
    """Return whether a dependency is a package that is neither released nor in the workspace."""
    if name in LIBRARY_KEYS or name in OTHER_NAMES:
        return False
    is_known = is_released(name) or name in ROS_PACKAGES or name in ROS1_PACKAGES
    is_module = name in sys.stdlib_module_names or keys_of_module(name) or module_of_key(name)
    return not (is_known or is_module) and package.workspace.get(name) is None


def _are_related(dependency: str, name: str) -> bool:
    """Return whether two packages are of one family, or both contain interfaces."""
    first, rest = dependency.partition("_")[::2]
    if first == name.partition("_")[0] and first not in _COMMON_WORDS:
        return bool(rest) or not is_released(name)  # no distribution has ``nav2``
    return dependency.endswith(_OF_MESSAGES) and _has_messages(name)


def _may_use_others(dependency: str) -> bool:
    """Return whether an unknown package may use libraries and nodes: its name is of no other kind.

    Programs themselves declare their client library, and the tools of builds and tests.
    """
    if similar_package(dependency) or similar_key(dependency) or not dependency.islower():
        return False
    words = [word.rstrip(_DIGITS) for word in dependency.split("_")]
    is_name = len(words) > 1 and not dependency.startswith(_TOOLS)
    return is_name and _INTERFACES.isdisjoint(words)


def _has_messages(name: str) -> bool:
    """Return whether a package has only interfaces; ``tf2_geometry_msgs`` converts those of ROS."""
    needed = dependencies(name)
    is_generated = not needed or any(item.startswith("rosidl_") for item in needed)
    return name.endswith(_OF_MESSAGES) and is_generated


def brought_by(package: Package, name: str) -> set[str]:
    """Return the run dependencies of another package of the workspace; empty if unknown."""
    neighbor = package.workspace.get(name)
    try:
        return neighbor.manifest.run_names if neighbor not in {None, package} else set()
    except ViewError:
        return set()
