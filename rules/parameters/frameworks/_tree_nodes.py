"""The libraries of behavior tree nodes that the bt_navigator of Nav2 always loads itself."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Package
from scaffold.api.distributions import ENDED, NAMES, target
from scaffold.api.formats import Scalar
from scaffold.api.formats import Sequence as YamlSequence
from scaffold.api.parameters import Section

_ACTIONS = (
    *("assisted_teleop", "back_up", "compute_path_through_poses", "compute_path_to_pose"),
    *("follow_path", "navigate_through_poses", "navigate_to_pose", "remove_passed_goals"),
    *("smooth_path", "spin", "truncate_path", "truncate_path_local", "wait"),
)
_CONDITIONS = (
    *("are_error_codes_active", "distance_traveled", "globally_updated_goal", "goal_reached"),
    *("goal_updated", "initial_pose_received", "is_battery_charging", "is_battery_low"),
    *("is_stuck", "time_expired", "transform_available"),
    *(f"would_a_{server}_recovery_help" for server in ("controller", "planner", "smoother")),
)
_CANCELED = ("assisted_teleop", "back_up", "controller", "drive_on_heading", "spin", "wait")
_SELECTED = ("controller", "goal_checker", "planner", "progress_checker", "smoother")
_OTHERS = (
    *("clear_costmap_service", "distance_controller", "drive_on_heading"),
    *("goal_updated_controller", "goal_updater_node", "path_longer_on_approach"),
    *("pipeline_sequence", "rate_controller", "recovery_node"),
    *("reinitialize_global_localization_service", "round_robin_node", "single_trigger"),
    "speed_controller",
)
_BUILT_IN = frozenset(
    f"nav2_{name}_bt_node"
    for name in (
        *(f"{name}_action" for name in _ACTIONS),
        *(f"{name}_condition" for name in _CONDITIONS),
        *(f"{name}_cancel" for name in _CANCELED),
        *(f"{name}_selector" for name in _SELECTED),
        *_OTHERS,
    )
)
"""Those of ``nav2_behavior_tree/CMakeLists.txt`` in all releases since 1.3.0, that of Jazzy."""
_DISTRIBUTIONS = frozenset(NAMES) | ENDED
_WORD = re.compile(r"[^\W_]+")


def repeated_tree_nodes(package: Package, section: Section) -> Iterator[tuple[Scalar, int]]:
    """Yield the first library of a list that is loaded anyway, and the number of all of them."""
    if not target().fact("nav2.has_builtin_tree_nodes") or _is_other(package, section):
        return
    for entry in section.entries:
        if entry.name == "plugin_lib_names" and isinstance(entry.value, YamlSequence):
            repeated = [
                item
                for item in entry.value.items
                if isinstance(item, Scalar) and item.text in _BUILT_IN
            ]
            if repeated:
                yield repeated[0], len(repeated)


def _is_other(package: Package, section: Section) -> bool:
    """Return whether a section may be for another version of Nav2."""
    words = set(_WORD.findall(section.key.location.path.lower()))
    is_of_other_distribution = bool(words & (_DISTRIBUTIONS - {target().name}))
    return is_of_other_distribution or package.workspace.get("nav2_bt_navigator") is not None
