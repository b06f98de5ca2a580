"""The velocity commands of diff_drive_controller, which has lost its topic without stamps."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from scaffold.api import Location, Package
from scaffold.api.distributions import target
from scaffold.api.formats import Scalar
from scaffold.api.launch import started_nodes
from scaffold.api.parameters import Section, parameter_files

from ._started_programs import is_used_by_nodes

_DRIVE = "diff_drive_controller/DiffDriveController"
_TOPIC = "cmd_vel_unstamped"
_MANAGER = "controller_manager"


def ignored_settings(section: Section) -> Iterator[Location]:
    """Yield the setting of a diff_drive_controller that asks for commands without stamps."""
    if target().fact("ros2_controllers.has_unstamped_commands"):
        return
    for entry in section.entries:
        value = entry.value
        if not isinstance(value, Scalar) or entry.name != "use_stamped_vel":
            continue
        if value.text.lower() == "false":
            yield value.location


def lost_topics(package: Package) -> Iterator[tuple[Location, str]]:
    """Yield remapped names that no diff_drive_controller of the workspace has, with the names."""
    if target().fact("ros2_controllers.has_unstamped_commands"):
        return
    remapped = [
        (node, source, goal or "", location)
        for node in started_nodes(package)
        for source, goal, location in node.remappings
        if _TOPIC in f"{source} {goal}"
    ]
    if not remapped or is_used_by_nodes(package, _TOPIC):
        return
    drives = _drives(package)
    topics = {f"{name}/{_TOPIC}" for name in drives}
    uses = Counter(goal.lstrip("/") for _, _, goal, _ in remapped)
    for node, source, goal, location in remapped:
        is_manager = node.executable == "ros2_control_node"
        if is_manager and drives and source.rpartition("/")[2] == _TOPIC:
            yield location, source
        elif goal.lstrip("/") in topics and uses[goal.lstrip("/")] == 1:
            yield location, goal


def _drives(package: Package) -> frozenset[str]:
    """Return the names of the diff_drive_controllers of a workspace."""
    return frozenset(
        entry.name.removesuffix(".type")
        for other in (package, *package.workspace)
        for file in parameter_files(other)
        for section in file.sections
        if section.name == _MANAGER
        for entry in section.entries
        if isinstance(entry.value, Scalar) and entry.value.text == _DRIVE
    )
