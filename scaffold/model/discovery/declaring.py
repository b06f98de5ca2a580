"""How to declare a dependency without closing a dependency cycle."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.edits import Fix
from scaffold.model.released import is_released
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.manifest.manifest import Manifest
    from scaffold.model.package import Package

_FIRST_WITH_CONDITIONS = 3
"""The first format of package.xml with conditions."""
_OF_ROS2 = "$ROS_VERSION == 2"
_ROS1 = {"ROS_VERSION": "1", "ROS_DISTRO": "noetic", "ROS_PYTHON_VERSION": "3"}


class Declaring(NamedTuple):
    """How to declare a missing dependency."""

    advice: str
    """The advice at the end of a message."""
    fix: Fix | None
    """The fix; ``None`` if it would cause a dependency cycle."""


def declaring(package: Package, tag: str, name: str) -> Declaring:
    """Return how a package declares a dependency.

    Args:
        package: The package, which does not declare it.
        tag: The element to add, such as ``exec_depend``.
        name: The other package, or the rosdep key.
    """
    way = [] if tag == "test_depend" else way_back(package, name)
    if way:
        cycle = " needs ".join([package.name, *way])
        advice = f"declaring it would close a cycle, {cycle}: move what both need into a third"
        return Declaring(f"{advice} package", None)
    manifest = package.manifest
    is_for_ros2 = is_released(name) and _is_also_for_ros1(manifest)
    attributes = {"condition": _OF_ROS2} if is_for_ros2 else {}
    fix = Fix(f"Declare {name}", (manifest.insert(tag, name, attributes),))
    opening = f'{tag} condition="{_OF_ROS2}"' if is_for_ros2 else tag
    return Declaring(f"add <{opening}>{name}</{tag}>{manifest.note_on_export(name)}", fix)


def _is_also_for_ros1(manifest: Manifest) -> bool:
    """Return whether some dependencies are for ROS 1 alone, by their conditions."""
    from scaffold.model.manifest import conditions  # few manifests have one

    for item in manifest.dependencies if manifest.format >= _FIRST_WITH_CONDITIONS else ():
        if item.condition is not None and not item.may_be_active:
            try:
                if conditions.holds(item.condition, _ROS1):
                    return True
            except conditions.ConditionError:
                continue
    return False


def way_back(package: Package, start: str) -> list[str]:
    """Return the dependency path from another package back to a package, if there is one.

    Source: ``colcon_core/topological_order.py``, which takes dependencies for building and running.
    """
    ways = {start: [start]}
    pending = [start]
    while pending:
        name = pending.pop(0)
        neighbor = package.workspace.get(name)
        if neighbor is None or neighbor is package:
            continue
        try:
            manifest = neighbor.manifest
        except ViewError:
            continue
        for needed in sorted(manifest.build_names | manifest.run_names):
            if needed == package.name:
                return [*ways[name], needed]
            if needed not in ways:
                ways[needed] = [*ways[name], needed]
                pending.append(needed)
    return []
