"""PF011: the plugins of Nav2 exist, those in a list are configured, and none is loaded twice."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import suppress

from scaffold.api import (
    Diagnostic,
    Edit,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
    closest_name,
)
from scaffold.api.distributions import target
from scaffold.api.formats import Scalar
from scaffold.api.formats import Sequence as YamlSequence
from scaffold.api.manifest import declared
from scaffold.api.parameters import Entry, Section, parameter_files

from ._started_programs import is_server_started
from ._tree_nodes import repeated_tree_nodes

_OF_NAV2 = re.compile(r"(nav2_\w+)(?:/|::)(\w+)")
"""Matches names of plugins in packages of Nav2."""
_CLASSES: Mapping[str, tuple[str, ...]] = {
    "nav2_behaviors": ("AssistedTeleop", "BackUp", "DriveOnHeading", "Spin", "Wait"),
    "nav2_bt_navigator": ("NavigateThroughPosesNavigator", "NavigateToPoseNavigator"),
    "nav2_constrained_smoother": ("ConstrainedSmoother",),
    "nav2_controller": (
        *("PoseProgressChecker", "SimpleGoalChecker", "SimpleProgressChecker"),
        "StoppedGoalChecker",
    ),
    "nav2_costmap_2d": (
        *("BinaryFilter", "DenoiseLayer", "InflationLayer", "KeepoutFilter", "ObstacleLayer"),
        *("RangeSensorLayer", "SpeedFilter", "StaticLayer", "VoxelLayer"),
    ),
    "nav2_graceful_controller": ("GracefulController",),
    "nav2_mppi_controller": ("MPPIController",),
    "nav2_navfn_planner": ("NavfnPlanner",),
    "nav2_regulated_pure_pursuit_controller": ("RegulatedPurePursuitController",),
    "nav2_rotation_shim_controller": ("RotationShimController",),
    "nav2_smac_planner": ("SmacPlanner2D", "SmacPlannerHybrid", "SmacPlannerLattice"),
    "nav2_smoother": ("SavitzkyGolaySmoother", "SimpleSmoother"),
    "nav2_theta_star_planner": ("ThetaStarPlanner",),
    "nav2_waypoint_follower": ("InputAtWaypoint", "PhotoAtWaypoint", "WaitAtWaypoint"),
}
"""The classes of Nav2's plugins, by package."""
_PACKAGES = frozenset({*_CLASSES, "nav2_recoveries"})
"""The packages of Nav2 that have or had plugins."""
_PLUGINS: Mapping[str, str] = {
    **{name: f"{package}::{name}" for package, names in _CLASSES.items() for name in names},
    "NonPersistentVoxelLayer": "nav2_costmap_2d/NonPersistentVoxelLayer",
    "SpatioTemporalVoxelLayer": "spatio_temporal_voxel_layer/SpatioTemporalVoxelLayer",
}
"""The names of plugins of released packages by class; other packages also use '/'."""
_OWNERS: Mapping[str, str] = {
    _PLUGINS["NonPersistentVoxelLayer"]: "nonpersistent_voxel_layer",
    _PLUGINS["SpatioTemporalVoxelLayer"]: "spatio_temporal_voxel_layer",
}
"""The packages of plugins that Nav2 does not depend on."""
_SERVERS = frozenset(
    {"behavior_server", "controller_server", "global_costmap", "local_costmap", "planner_server"}
    | {"smoother_server", "waypoint_follower"}
)
"""The nodes of Nav2 that load plugins."""
_COSTMAPS = frozenset({"global_costmap", "local_costmap"})
_DEFAULTS = frozenset(
    {"FollowPath", "GridBased", "SmoothPath", "assisted_teleop", "backup", "drive_on_heading"}
    | {"goal_checker", "inflation_layer", "obstacle_layer", "progress_checker", "simple_smoother"}
    | {"spin", "static_layer", "wait", "wait_at_waypoint"}
)
"""The plugins that servers load by default, which need no section."""
_COSTMAP = (
    "local_costmap:\n  local_costmap:\n    ros__parameters:\n"
    '      plugins: ["obstacles", "inflation"]\n'
    '      obstacles:\n        plugin: "nav2_costmap_2d::ObstacleLayer"\n'
    "        observation_sources: {}\n        scan:\n          topic: /scan\n"
    '      {}:\n        plugin: "{}"\n'
)
_INFLATION = "nav2_costmap_2d::InflationLayer"
_PLANNER = (
    "planner_server:\n  ros__parameters:\n    planner_plugins: [GridBased]\n"
    "    GridBased:\n      plugin: {}\n"
)
_NAVIGATOR = "bt_navigator:\n  ros__parameters:\n    plugin_lib_names: [{}]\n"
_NAVFN = "nav2_navfn_planner{}NavfnPlanner"


class PluginUnfit(Rule):
    """A parameter file of Nav2 lists an unconfigured, built-in or old plugin, or a sensor.

    **Why.** The server does not start: ``Can not get 'plugin' param value for inflation``, or
    ``According to the loaded plugin descriptions the class nav2_navfn_planner/NavfnPlanner with
    base class type nav2_core::GlobalPlanner does not exist``. A costmap ignores a sensor that is
    not in ``observation_sources``. Since Jazzy, ``bt_navigator`` loads all nodes of Nav2 itself,
    and fails when ``plugin_lib_names`` repeats one: ``ID [ComputePathToPose] already registered``.

    **Fix.** Use the same name in the list and for the section. Since Jazzy, the names of plugins
    have ``::`` instead of ``/``, and ``plugin_lib_names`` lists only nodes that are not of Nav2.

    **Source.** Nav2 documentation, migration guide "Iron to Jazzy", and "Configuration guide";
    https://github.com/ros-navigation/navigation2/issues/2653.
    """

    code = "PF011"
    name = "plugin-unfit"
    other_severities = {
        Severity.WARNING: "the launch files of the workspace only start the localization of Nav2"
    }
    examples = (
        Example(
            "configured plugins",
            {
                "config/nav2.yaml": _COSTMAP.format("scan", "inflation", _INFLATION),
                "config/planner.yaml": _PLANNER.format(_NAVFN.format("::")),
            },
        ),
        Example(
            "a layer and a sensor that are listed under other names",
            {"config/nav2.yaml": _COSTMAP.format("laser", "inflation_layer", _INFLATION)},
            "4:30: no inflation.plugin here: the server fails; did you mean 'inflation_layer'?",
            "7:30: no section 'laser' here: the sensor is ignored",
        ),
        Example(
            "a plugin with its name in Iron",
            {"config/planner.yaml": _PLANNER.format(_NAVFN.format("/"))},
            Report(
                "5:15",
                "Jazzy has no plugin 'nav2_navfn_planner/NavfnPlanner': the server "
                "fails; write 'nav2_navfn_planner::NavfnPlanner'",
                fix="Replace '/' with '::'",
            ),
            fixed={"config/planner.yaml": _PLANNER.format(_NAVFN.format("::"))},
        ),
        Example(
            "a plugin with an old name, and a launch file that does not start the server",
            {
                "config/planner.yaml": _PLANNER.format("nav2_recoveries/Spin"),
                "launch/map.launch.xml": '<include file="$(find-pkg-share nav2_bringup)/launch/'
                'localization_launch.py"/>\n',
            },
            Report(
                "config/planner.yaml:5:15",
                "Jazzy has no plugin 'nav2_recoveries/Spin': the server fails; write "
                "'nav2_behaviors::Spin'",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "plugins of other packages, with names of their own",
            {
                "config/planner.yaml": _PLANNER.format("nav2_costmap_2d/NonPersistentVoxelLayer"),
                "config/other.yaml": _PLANNER.format("nav2_straightline_planner/StraightLine"),
            },
        ),
        Example(
            "plugins of packages that are declared and not declared",
            {
                "package.xml": "<package><name>bringup</name>"
                "<exec_depend>nonpersistent_voxel_layer</exec_depend></package>\n",
                "config/planner.yaml": _PLANNER.format("nav2_costmap_2d/NonPersistentVoxelLayer"),
                "config/other.yaml": _PLANNER.format(
                    "spatio_temporal_voxel_layer/SpatioTemporalVoxelLayer"
                ),
            },
            "config/other.yaml:5:15: no package.xml declares 'spatio_temporal_voxel_layer', which "
            "has this plugin: the server fails; add "
            "<exec_depend>spatio_temporal_voxel_layer</exec_depend>",
        ),
        Example(
            "a plugin of another package with the wrong package",
            {"config/planner.yaml": _PLANNER.format("nav2_costmap_2d/SpatioTemporalVoxelLayer")},
            "5:15: Jazzy has no plugin 'nav2_costmap_2d/SpatioTemporalVoxelLayer': the server "
            "fails; write 'spatio_temporal_voxel_layer/SpatioTemporalVoxelLayer'",
        ),
        Example(
            "a plugin that a package of the workspace has under this name",
            {
                "package.xml": "<package><name>bringup</name></package>\n",
                "config/planner.yaml": _PLANNER.format(_NAVFN.format("/")),
            },
            neighbors={
                "planner": {
                    "package.xml": "<package><name>planner</name></package>\n",
                    "plugins.xml": '<library path="planner">\n'
                    f'  <class name="{_NAVFN.format("/")}" type="{_NAVFN.format("::")}"\n'
                    '    base_class_type="nav2_core::GlobalPlanner"/>\n</library>\n',
                }
            },
        ),
        Example(
            "behavior tree nodes of its own",
            {"config/nav2.yaml": _NAVIGATOR.format("my_bt_node, other_bt_node")},
        ),
        Example(
            "behavior tree nodes of Nav2",
            {
                "config/nav2.yaml": _NAVIGATOR.format(
                    "nav2_spin_action_bt_node, nav2_wait_cancel_bt_node, my_bt_node"
                ),
                "config/other.yaml": _NAVIGATOR.format("my_bt_node, nav2_single_trigger_bt_node"),
            },
            "config/nav2.yaml:3:24: 'nav2_spin_action_bt_node' and 1 more are always loaded: "
            "registering it again makes bt_navigator fail; list only nodes that are not of Nav2",
            "config/other.yaml:3:36: 'nav2_single_trigger_bt_node' is always loaded: registering "
            "it again makes bt_navigator fail; list only nodes that are not of Nav2",
        ),
        Example(
            "behavior tree nodes of Nav2, which Humble needs",
            {"config/nav2.yaml": _NAVIGATOR.format("nav2_spin_action_bt_node")},
            distro="humble",
        ),
        Example(
            "a file for another distribution",
            {"config/nav2_humble.yaml": _NAVIGATOR.format("nav2_spin_action_bt_node")},
        ),
        Example(
            "a section with the name of a costmap once",
            {"config/nav2.yaml": "local_costmap:\n  ros__parameters:\n    width: 3\n"},
            "1:1: this section is ignored: the node is /local_costmap/local_costmap; write "
            "'local_costmap': twice",
        ),
        Example(
            "the same lists in other nodes",
            {
                "config/nav2.yaml": "arm:\n  ros__parameters:\n"
                "    plugins: [a]\n    b: {plugin: c}\n"
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        sections = [section for file in parameter_files(package) for section in file.sections]
        for section in sections:
            if section.name in _COSTMAPS and not _is_costmap(section):
                name = section.name
                message = (
                    f"this section is ignored: the node is /{name}/{name}; write {name!r}: twice"
                )
                yield self.report(section.key, message)
            elif section.name in _SERVERS:
                is_only_one = [other.name for other in sections].count(section.name) == 1
                findings = [
                    *self._check_names(package, section),
                    *(self._check_lists(package, section) if is_only_one else ()),
                ]
                is_started = not findings or is_server_started(package, section.name)
                severity = None if is_started else Severity.WARNING
                yield from (item._replace(severity=severity or item.severity) for item in findings)
            elif section.name == "bt_navigator":
                yield from self._check_tree_nodes(package, section)

    def _check_tree_nodes(self, package: Package, section: Section) -> Iterator[Diagnostic]:
        for item, count in repeated_tree_nodes(package, section):
            what = f"{item.text!r} is" if count == 1 else f"{item.text!r} and {count - 1} more are"
            message = (
                f"{what} always loaded: registering it again makes bt_navigator fail; list only "
                f"nodes that are not of Nav2"
            )
            severity = None if is_server_started(package, section.name) else Severity.WARNING
            yield self.report(item, message, severity=severity)

    def _check_names(self, package: Package, section: Section) -> Iterator[Diagnostic]:
        if not target().fact("nav2.has_colons_in_plugins"):
            return
        lists = [entry for entry in section.entries if entry.name.endswith("plugins")]
        listed = {name for entry in lists for name, _ in _listed(entry)}
        for entry in section.entries:
            value = entry.value
            is_plugin = isinstance(value, Scalar) and entry.name.endswith(".plugin")
            if not isinstance(value, Scalar) or not is_plugin:
                continue
            old = _OF_NAV2.fullmatch(value.text)
            is_known = old is not None and old[1] in _PACKAGES
            new = _PLUGINS.get(old[2], value.text) if old and is_known else value.text
            holder = _OWNERS.get(value.text, "")
            is_loaded = entry.name.removesuffix(".plugin") in listed
            if holder and is_loaded and not _is_brought(package, holder):
                message = f"no package.xml declares {holder!r}, which has this plugin"
                message += f": the server fails; add <exec_depend>{holder}</exec_depend>"
                yield self.report(value, message, cause=f"dependency {holder}")
            if new == value.text or _is_declared(package, value.text):
                continue
            message = f"{target().title} has no plugin {value.text!r}: the server fails"
            fix = _fix(value) if new == value.text.replace("/", "::") else None
            yield self.report(value, f"{message}; write {new!r}", fix)

    def _check_lists(self, package: Package, section: Section) -> Iterator[Diagnostic]:
        names = {entry.name for entry in section.entries}
        for entry in section.entries:
            above, _, last = entry.name.rpartition(".")
            prefix = f"{above}." if above else ""
            is_sources = last == "observation_sources"
            if not is_sources and (above or not last.endswith("plugins")):
                continue
            listed = [*_listed(entry)]
            if not is_sources and _DEFAULTS.issuperset(name for name, _ in listed):
                continue
            for name, item in listed:
                needed = f"{prefix}{name}."
                is_there = any(
                    other.startswith(needed) if is_sources else other == f"{needed}plugin"
                    for other in names
                )
                others = {
                    other.removeprefix(prefix).partition(".")[0]
                    for other in names
                    if other.startswith(prefix) and "." in other.removeprefix(prefix)
                }
                if not is_there and others:
                    closest = closest_name(package, name, others, 0.5)
                    hint = f"; did you mean {closest!r}?" if closest else ""
                    what = "sensor is ignored" if is_sources else "server fails"
                    missing = f"no section {name!r}" if is_sources else f"no {name}.plugin"
                    yield self.report(item.location, f"{missing} here: the {what}{hint}")


def _fix(value: Scalar) -> Fix:
    at = value.end - int(not value.is_plain) - len(value.text.rpartition("/")[2]) - 1
    return Fix("Replace '/' with '::'", (Edit(value.location.path, at, at + 1, "::"),))


def _is_costmap(section: Section) -> bool:
    """Return whether a section is for the node of a costmap, whose namespace is its name."""
    *_, above, _ = ["", *section.node.split("/")]
    return above == section.name or "*" in section.node


def _is_brought(package: Package, name: str) -> bool:
    """Return whether a package is in the workspace, declared in it, or may come along."""
    if package.workspace.get(name) is not None or not package.has("package.xml"):
        return True
    for other in package.workspace:
        with suppress(ViewError):
            dependencies = declared(other, for_tests=True)
            if name in other.manifest.declared_names | dependencies.along:
                return True
            if dependencies.may_use(other, name):
                return True
    return False


def _is_declared(package: Package, plugin: str) -> bool:
    """Return whether a package of the workspace declares a plugin under a name."""
    names = (f"'{plugin}'".encode(), f'"{plugin}"'.encode())
    for other in package.workspace:
        for path in other.files:
            if path.endswith(".xml"):
                with suppress(ViewError):
                    data = other.data(path)
                    if b"base_class_type" in data and any(name in data for name in names):
                        return True
    return False


def _listed(entry: Entry) -> Iterator[tuple[str, Scalar]]:
    """Yield the names in a list, or in a text with spaces between them."""
    value = entry.value
    items = value.items if isinstance(value, YamlSequence) else [value]
    for item in items:
        if isinstance(item, Scalar) and "$" not in item.text:
            yield from ((name, item) for name in item.text.split())
