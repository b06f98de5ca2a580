"""BR002: ros_gz_bridge can convert between the two types of an entry."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Example,
    Location,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
    closest_name,
    fact,
)
from scaffold.api.launch import launch_paths, markup_files
from scaffold.api.robot import BRIDGED_TYPES, bridge_entries

_ENTRY = (
    "- ros_topic_name: scan\n  gz_topic_name: /scan\n  ros_type_name: {}\n"
    "  gz_type_name: {}\n  direction: GZ_TO_ROS\n"
)
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='ros_gz_bridge', executable='parameter_bridge',\n"
    "             arguments=['{}']),\n    ])\n"
)
_ARGUMENT = re.compile(r"(?<=[\w/~{}-])@([A-Za-z]\w*(?:/\w+)+)[@\[\]]((?:gz|ignition)\.msgs\.\w+)")
_OLD = "ignition.msgs."
_NEW = "gz.msgs."


class BridgeTypesUnfit(Rule):
    """ros_gz_bridge has no conversion between the types of an entry.

    **Why.** ``Failed to create a bridge for topic [scan]``: the bridge goes on without it, and
    nothing arrives.

    **Fix.** Use one of the pairs of ros_gz_bridge, such as ``sensor_msgs/msg/LaserScan`` and
    ``gz.msgs.LaserScan``.

    **Source.** ros_gz_bridge, ``mappings.py`` and ``get_factory``; the names ``ignition.msgs`` are
    those of Gazebo Fortress.
    """

    code = "BR002"
    name = "bridge-types-unfit"
    other_severities = {Severity.WARNING: "the name is an old one that is still converted"}
    examples = (
        Example(
            "a pair",
            {"bridge.yaml": _ENTRY.format("sensor_msgs/msg/LaserScan", "gz.msgs.LaserScan")},
        ),
        Example(
            "types of a later release",
            {"bridge.yaml": _ENTRY.format("my_msgs/msg/Sonar", "gz.msgs.Sonar")},
        ),
        Example(
            "the name of Fortress",
            {"bridge.yaml": _ENTRY.format("rosgraph_msgs/msg/Clock", "ignition.msgs.Clock")},
            Report(
                "4:17",
                "'ignition.msgs.Clock' is the name of Gazebo Fortress, which "
                "Harmonic replaces: 'gz.msgs.Clock'",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "two types that do not belong together; a name that Gazebo does not have",
            {
                "a.yaml": _ENTRY.format("sensor_msgs/msg/Image", "gz.msgs.LaserScan"),
                "b.yaml": _ENTRY.format("sensor_msgs/msg/LaserScan", "gz.msgs.LidarScan"),
            },
            Report(
                "a.yaml:4:17",
                "no conversion between 'sensor_msgs/msg/Image' and "
                "'gz.msgs.LaserScan': nothing is bridged; 'sensor_msgs/msg/Image' "
                "goes with gz.msgs.Image",
            ),
            Report(
                "b.yaml:4:17",
                "no conversion between 'sensor_msgs/msg/LaserScan' and "
                "'gz.msgs.LidarScan': nothing is bridged; "
                "'sensor_msgs/msg/LaserScan' goes with gz.msgs.LaserScan",
            ),
        ),
        Example(
            "an unknown type of ROS; one without msg",
            {
                "a.yaml": _ENTRY.format("sensor_msgs/msg/LaserScans", "gz.msgs.LaserScan"),
                "b.yaml": _ENTRY.format("sensor_msgs/LaserScan", "gz.msgs.LaserScan"),
            },
            Report(
                "a.yaml:3:18",
                "the bridge does not know the type 'sensor_msgs/msg/LaserScans': "
                "nothing is bridged; closest: 'sensor_msgs/msg/LaserScan'",
            ),
            Report(
                "b.yaml:3:18",
                "the bridge does not know the type 'sensor_msgs/LaserScan': nothing "
                "is bridged; closest: 'sensor_msgs/msg/LaserScan'",
            ),
        ),
        Example(
            "in a launch file",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "/scan@sensor_msgs/msg/LaserScan[gz.msgs.Image"
                ),
                "launch/b.launch.xml": '<launch>\n  <node pkg="ros_gz_bridge" '
                'exec="parameter_bridge" args="/a@std_msgs/msg/Bool@gz.msgs.Image"/>\n</launch>\n',
            },
            Report(
                "launch/a.launch.py:8:25",
                "no conversion between 'sensor_msgs/msg/LaserScan' and "
                "'gz.msgs.Image': nothing is bridged; 'sensor_msgs/msg/LaserScan' "
                "goes with gz.msgs.LaserScan",
            ),
            Report(
                "launch/b.launch.xml:2:59",
                "no conversion between 'std_msgs/msg/Bool' and 'gz.msgs.Image': "
                "nothing is bridged; 'std_msgs/msg/Bool' goes with gz.msgs.Boolean",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for entry in bridge_entries(package):
            ros, gz = entry.values.get("ros_type_name"), entry.values.get("gz_type_name")
            if ros is None or gz is None or "$" in ros.text + gz.text:
                continue
            yield from self._check(package, ros.text, gz.text, ros.location, gz.location)
        for path in launch_paths(package):
            try:
                arguments = _arguments(package, path)
            except ViewError:
                continue
            for ros_type, gz_type, at in arguments:
                yield from self._check(package, ros_type, gz_type, at, at)
        for file in markup_files(package):
            for attribute in file.attributes:
                for match in _ARGUMENT.finditer(attribute.value):
                    at = attribute.location
                    yield from self._check(package, match[1], match[2], at, at)

    def _check(
        self, package: Package, ros: str, gz: str, ros_at: Location, gz_at: Location
    ) -> Iterator[Diagnostic]:
        new = gz.replace(_OLD, _NEW, 1)
        of_ros = sorted(item for name, item in BRIDGED_TYPES if name == ros)
        of_gz = sorted(name for name, item in BRIDGED_TYPES if item == new)
        if (ros, new) in BRIDGED_TYPES:
            if gz != new:
                message = f"{gz!r} is the name of Gazebo Fortress, which Harmonic replaces: {new!r}"
                yield self.report(gz_at, message, severity=Severity.WARNING)
        elif of_ros:
            message = f"no conversion between {ros!r} and {gz!r}: nothing is bridged"
            yield self.report(gz_at, f"{message}; {ros!r} goes with {' or '.join(of_ros)}")
        elif of_gz and package.workspace.interfaces.find(ros) is None:
            closest = closest_name(package, ros, {name for name, _ in BRIDGED_TYPES}, 0.7)
            hint = f"; closest: {closest!r}" if closest else ""
            message = f"the bridge does not know the type {ros!r}: nothing is bridged{hint}"
            yield self.report(ros_at, message)


@fact
def _arguments(package: Package, path: str) -> tuple[tuple[str, str, Location], ...]:
    """Return the pairs of types in the arguments of a bridge, each with its place."""
    module = package.module(path)
    return tuple(
        (match[1], match[2], module.location(node))
        for node in module.walk(ast.Constant)
        if isinstance(node.value, str) and "@" in node.value
        for match in _ARGUMENT.finditer(node.value)
    )
