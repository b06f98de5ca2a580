"""BR003: a bridge and the nodes of its package agree on the type and direction of a topic."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from contextlib import suppress

from scaffold.api import (
    Diagnostic,
    Example,
    Location,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
    fact,
)
from scaffold.api.launch import is_named_elsewhere, launch_paths
from scaffold.api.messages import message_paths
from scaffold.api.parameters import keeps_default_name
from scaffold.api.programs import is_remapped, topics_of

from ._bridges import bridge_entries

_ENTRY = (
    "- ros_topic_name: {}\n  gz_topic_name: /cmd_vel\n  ros_type_name: geometry_msgs/msg/{}\n"
    "  gz_type_name: gz.msgs.Twist\n  direction: {}\n"
)
_NODE = (
    "from geometry_msgs.msg import TwistStamped\nfrom rclpy.node import Node\n\n\n"
    "class Driver(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('driver')\n"
    "        self.pub = self.create_publisher(TwistStamped, 'cmd_vel', 10)\n"
)
_ENTRY_DIRECTION = (
    "- ros_topic_name: {0}\n  gz_topic_name: /{0}\n  ros_type_name: {1}\n"
    "  gz_type_name: gz.msgs.{2}\n  direction: {3}\n"
)
_NODE_DIRECTION = (
    "from geometry_msgs.msg import Twist\nfrom rclpy.node import Node\n\n\n"
    "class Driver(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('driver')\n"
    "        self.pub = self.create_publisher(Twist, 'cmd_vel', 10)\n"
)
_FROM_GAZEBO = re.compile(r"(/?\w[\w/]*)@\w+/msg/\w+\[(?:gz|ignition)\.msgs\.\w+")
"""Matches an argument of a bridge from Gazebo to ROS."""
_CLOCK = re.compile(r"\bclock\b")
_SIM_TIME = re.compile(
    r"use_sim_time['\"]?[\s:,]{0,20}(?:(?:default_value|default|value)=)?['\"]?[Tt]rue"
)
"""Matches how launch files and parameter files switch to the time of the simulation."""
_TIMED = (
    "<launch>\n  <arg name='use_sim_time' default='true'/>\n"
    "  <node pkg='ros_gz_bridge' exec='parameter_bridge'>\n"
    "    <param name='use_sim_time' value='$(var use_sim_time)'/>\n  </node>\n</launch>\n"
)
_OF_SENSORS = frozenset(
    {"rosgraph_msgs/msg/Clock", "sensor_msgs/msg/LaserScan", "sensor_msgs/msg/Image"}
    | {"sensor_msgs/msg/CameraInfo", "sensor_msgs/msg/Imu", "sensor_msgs/msg/PointCloud2"}
    | {"sensor_msgs/msg/NavSatFix", "sensor_msgs/msg/MagneticField"}
)
"""Data of Gazebo sensors, which Gazebo plugins never read from ROS."""
_OF_PLUGINS = ("gz-sim", "gz-plugin", "gz_sim", "gz_plugin", "ignition-gazebo", "ignition-plugin")
"""The prefixes of the CMake packages for building Gazebo plugins."""


class BridgeDiffersFromNodes(Rule):
    """A bridge has a different type or direction for a topic than the nodes of its package.

    **Why.** The two never connect, or nothing publishes on the side that the bridge subscribes to:
    the simulated robot does not move, or no data arrives, without an error.

    **Fix.** Use the same type on both sides; ``Twist`` and ``TwistStamped`` both correspond to
    ``gz.msgs.Twist``. Write ``ROS_TO_GZ`` for topics that nodes publish, ``GZ_TO_ROS`` for sensors
    and the clock.

    **Source.** ROS 2 documentation, "Topics": a topic has one type; ros_gz_bridge, README.
    """

    code = "BR003"
    name = "bridge-differs-from-nodes"
    other_severities = {
        Severity.WARNING: "it carries the data in the other direction, or a parameter of the node "
        "names the topic"
    }
    examples = (
        Example(
            "the time of the simulation, without its clock",
            {
                "launch/a.launch.xml": _TIMED,
                "config/bridge.yaml": _ENTRY.format("cmd_vel", "Twist", "ROS_TO_GZ"),
            },
            Report(
                "config/bridge.yaml:1:19",
                "launch/a.launch.xml:2 sets use_sim_time, but nothing bridges /clock: "
                "the time of the nodes stays zero and no timer runs; add an entry for "
                "/clock",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "the time of the simulation, and its clock",
            {
                "launch/a.launch.xml": _TIMED,
                "config/bridge.yaml": _ENTRY.format("cmd_vel", "Twist", "ROS_TO_GZ"),
                "config/clock.yaml": _ENTRY.format("/clock", "Twist", "GZ_TO_ROS")
                .replace("geometry_msgs/msg/Twist", "rosgraph_msgs/msg/Clock")
                .replace("gz.msgs.Twist", "gz.msgs.Clock"),
            },
        ),
        Example(
            "the same type; the other direction; another topic",
            {
                "driver.py": _NODE,
                "a.yaml": _ENTRY.format("/cmd_vel", "TwistStamped", "ROS_TO_GZ")
                + _ENTRY.format("cmd_vel", "Twist", "GZ_TO_ROS")
                + _ENTRY.format("cmd_vel_nav", "Twist", "ROS_TO_GZ"),
            },
            Report(
                "a.yaml:10:14",
                "'cmd_vel' comes from Gazebo, but driver.py:8 publishes it: nothing arrives in "
                "Gazebo; write ROS_TO_GZ",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "another type",
            {"driver.py": _NODE, "a.yaml": _ENTRY.format("/cmd_vel", "Twist", "ROS_TO_GZ")},
            "a.yaml:3:18: '/cmd_vel' has the type geometry_msgs/msg/Twist here, but "
            "geometry_msgs/msg/TwistStamped in driver.py:8: they never connect",
        ),
        Example(
            "another type, on a topic that a parameter names",
            {
                "driver.py": _NODE.replace(
                    "'cmd_vel'", "self.declare_parameter('output', 'cmd_vel').value"
                ),
                "a.yaml": _ENTRY.format("/cmd_vel", "Twist", "ROS_TO_GZ"),
            },
            Report(
                "a.yaml:3:18",
                "'/cmd_vel' has the type geometry_msgs/msg/Twist here, but "
                "geometry_msgs/msg/TwistStamped in driver.py:8: they never connect",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "the directions of arguments",
            {
                "driver.py": _NODE_DIRECTION,
                "launch/sim.launch.py": "from launch import LaunchDescription\n"
                "from launch_ros.actions import Node\n\n\n"
                "def generate_launch_description():\n"
                "    return LaunchDescription([\n"
                "        Node(package='ros_gz_bridge', executable='parameter_bridge', arguments=[\n"
                "            '/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock',\n"
                "            '/cmd_vel@geometry_msgs/msg/Twist[gz.msgs.Twist'])])\n",
            },
            Report(
                "launch/sim.launch.py:9:13",
                "'/cmd_vel' comes from Gazebo, but driver.py:8 publishes it: nothing "
                "arrives in Gazebo; write ] instead of [",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "both directions",
            {
                "driver.py": _NODE_DIRECTION,
                "a.yaml": _ENTRY_DIRECTION.format(
                    "cmd_vel", "geometry_msgs/msg/Twist", "Twist", "ROS_TO_GZ"
                )
                + _ENTRY_DIRECTION.format("clock", "rosgraph_msgs/msg/Clock", "Clock", "GZ_TO_ROS"),
            },
        ),
        Example(
            "an image that a plugin of the package shows",
            {
                "CMakeLists.txt": "find_package(gz-plugin2 REQUIRED)\n",
                "a.yaml": _ENTRY_DIRECTION.format(
                    "lights", "sensor_msgs/msg/Image", "Image", "ROS_TO_GZ"
                ),
            },
        ),
        Example(
            "the opposite direction",
            {
                "driver.py": _NODE_DIRECTION,
                "a.yaml": _ENTRY_DIRECTION.format(
                    "cmd_vel", "geometry_msgs/msg/Twist", "Twist", "GZ_TO_ROS"
                )
                + _ENTRY_DIRECTION.format("clock", "rosgraph_msgs/msg/Clock", "Clock", "ROS_TO_GZ"),
            },
            Report(
                "a.yaml:5:14",
                "'cmd_vel' comes from Gazebo, but driver.py:8 publishes it: nothing arrives in "
                "Gazebo; write ROS_TO_GZ",
                severity=Severity.WARNING,
            ),
            Report(
                "a.yaml:10:14",
                "'clock' goes to Gazebo, but Gazebo publishes it: nothing arrives in ROS; write "
                "GZ_TO_ROS",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_type(package)
        yield from self._check_direction(package)
        yield from self._check_arguments(package)
        yield from self._check_clock(package)

    def _check_clock(self, package: Package) -> Iterator[Diagnostic]:
        entries = [*bridge_entries(package)]
        is_timed = entries and not is_named_elsewhere(package, "", "clock")
        if not is_timed or _line_with(package, _CLOCK) or _has_plugin(package):
            return
        place = _line_with(package, _SIM_TIME)
        topic = entries[0].values.get("ros_topic_name") or entries[0].values.get("topic_name")
        if place and topic is not None:
            message = (
                f"{place} sets use_sim_time, but nothing bridges /clock: the time of the nodes "
                "stays zero and no timer runs; add an entry for /clock"
            )
            yield self.report(topic, message, severity=Severity.WARNING)

    def _check_type(self, package: Package) -> Iterator[Diagnostic]:
        entries = [*bridge_entries(package)]
        if not entries or not message_paths(package):
            return
        topics = topics_of(package)
        for entry in entries:
            topic = topics.get(entry.ros_topic.removeprefix("/"))
            if topic is None or not topic.is_plain_by_default:
                continue
            sides = {
                "ROS_TO_GZ": topic.publishers,
                "GZ_TO_ROS": topic.subscriptions,
                "BIDIRECTIONAL": [*topic.publishers, *topic.subscriptions],
            }
            type_ = entry.values.get("ros_type_name")
            for endpoint in sides.get(entry.direction, ()):
                if type_ is None or endpoint.interface in {type_.text, None}:
                    continue
                if not keeps_default_name(package, endpoint) or is_remapped(package, endpoint):
                    continue
                at = endpoint.location
                message = (
                    f"{entry.ros_topic!r} has the type {type_.text} here, but "
                    f"{endpoint.interface} in "
                    f"{at.path}:{at.line}: they never connect"
                )
                is_set = endpoint.from_parameter is not None  # set at the start
                yield self.report(type_, message, severity=Severity.WARNING if is_set else None)

    def _check_arguments(self, package: Package) -> Iterator[Diagnostic]:
        """Check the directions in the arguments of bridges in launch files."""
        for path in launch_paths(package) if message_paths(package) else ():
            with suppress(ViewError):
                for name, at in _bridged_from_gazebo(package, path):
                    topic = topics_of(package).get(name.removeprefix("/"))
                    if topic is not None and topic.publishers and not topic.subscriptions:
                        source = topic.publishers[0].location
                        message = (
                            f"{name!r} comes from Gazebo, but {source.path}:{source.line} "
                            f"publishes it: nothing arrives in Gazebo; write ] instead of ["
                        )
                        yield self.report(at, message, severity=Severity.WARNING)

    def _check_direction(self, package: Package) -> Iterator[Diagnostic]:
        for entry in bridge_entries(package):
            direction = entry.values.get("direction")
            if direction is None:
                continue
            is_of_sensor = entry.text("ros_type_name") in _OF_SENSORS
            if entry.direction == "ROS_TO_GZ" and is_of_sensor and not _has_plugin(package):
                message = (
                    f"{entry.ros_topic!r} goes to Gazebo, but Gazebo publishes it: nothing "
                    f"arrives in ROS; write GZ_TO_ROS"
                )
                yield self.report(direction, message, severity=Severity.WARNING)
            elif entry.direction == "GZ_TO_ROS" and message_paths(package):
                topic = topics_of(package).get(entry.ros_topic.removeprefix("/"))
                if topic is not None and topic.publishers and not topic.subscriptions:
                    at = topic.publishers[0].location
                    message = (
                        f"{entry.ros_topic!r} comes from Gazebo, but {at.path}:{at.line} "
                        f"publishes it: nothing arrives in Gazebo; write ROS_TO_GZ"
                    )
                    yield self.report(direction, message, severity=Severity.WARNING)


@fact
def _bridged_from_gazebo(package: Package, path: str) -> tuple[tuple[str, Location], ...]:
    """Return the topics that the arguments of a bridge carry from Gazebo to ROS only."""
    module = package.module(path)
    return tuple(
        (match[1], module.location(node))
        for node in module.walk(ast.Constant)
        if isinstance(node.value, str) and (match := _FROM_GAZEBO.fullmatch(node.value))
    )


def _line_with(package: Package, pattern: re.Pattern[str]) -> str:
    """Return the first place in a launch file or a YAML file that matches; empty if none does."""
    for path in package.files:
        is_python = path.endswith(".py") and "launch" in path
        if is_python or path.endswith((".launch.xml", ".yaml", ".yml")):
            with suppress(ViewError):
                text = package.source(path).text
                found = pattern.search(text)
                if found is not None:
                    return f"{path}:{text.count(chr(10), 0, found.start()) + 1}"
    return ""


def _has_plugin(package: Package) -> bool:
    """Return whether a package builds a Gazebo plugin, which may read anything from ROS."""
    text = package.source("CMakeLists.txt").text if package.has("CMakeLists.txt") else ""
    return any(name in text for name in _OF_PLUGINS)
