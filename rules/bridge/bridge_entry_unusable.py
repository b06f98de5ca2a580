"""BR001: ros_gz_bridge can read the entries of a bridge, and convert between their types."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Example,
    Location,
    Package,
    ParseError,
    Report,
    Rule,
    Severity,
    ViewError,
    closest_name,
    fact,
)
from scaffold.api.formats import Mapping
from scaffold.api.launch import launch_paths, markup_files

from ._bridges import BRIDGED_TYPES, BridgeEntry, bridge_entries, bridge_roots

_ENTRY = (
    "- ros_topic_name: scan\n  gz_topic_name: /scan\n  ros_type_name: sensor_msgs/msg/LaserScan\n"
    "  gz_type_name: gz.msgs.LaserScan\n  direction: GZ_TO_ROS\n"
)
_KEYS = (
    *("topic_name", "ros_topic_name", "gz_topic_name", "ros_type_name", "gz_type_name"),
    *("direction", "publisher_queue", "subscriber_queue", "lazy", "service_name"),
    *("gz_req_type_name", "gz_rep_type_name", "qos_profile", "frame_id"),
)
_OLD = {"ign_topic_name": "gz_topic_name", "ign_type_name": "gz_type_name"}
_DIRECTIONS = ("GZ_TO_ROS", "ROS_TO_GZ", "BIDIRECTIONAL")
_TOPICS = ("ros_topic_name", "gz_topic_name", "topic_name")
_ENTRY_TYPES = (
    "- ros_topic_name: scan\n  gz_topic_name: /scan\n  ros_type_name: {}\n"
    "  gz_type_name: {}\n  direction: GZ_TO_ROS\n"
)
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='ros_gz_bridge', executable='parameter_bridge',\n"
    "             arguments=['{}']),\n    ])\n"
)
_OF_ROS = r"[A-Za-z]\w*(?:/\w+)+"
_OF_GAZEBO = r"(?:gz|ignition)\.msgs\.\w+"
_ARGUMENT = re.compile(  # linear: it starts with a single character
    rf"(?<=[\w/~{{}}-])@(?:({_OF_ROS})[@\[\]]({_OF_GAZEBO})|({_OF_GAZEBO})[@\[\]]({_OF_ROS}))"
)
_OLD_TYPES = "ignition.msgs."
_NEW = "gz.msgs."


class BridgeEntryUnusable(Rule):
    """A bridge entry has a key, a direction or types that ros_gz_bridge does not support.

    **Why.** ``Could not parse entry``, or ``Failed to create a bridge for topic [scan]``: the
    bridge drops the entry, and nothing arrives. Unknown keys are silently ignored.

    **Fix.** Use the keys ``ros_topic_name``, ``gz_topic_name``, ``ros_type_name`` and
    ``gz_type_name``, one of the directions ``GZ_TO_ROS``, ``ROS_TO_GZ`` and ``BIDIRECTIONAL``, and
    a supported pair of types such as ``sensor_msgs/msg/LaserScan`` and ``gz.msgs.LaserScan``.

    **Source.** ros_gz_bridge, ``bridge_config.cpp``, ``mappings.py`` and ``get_factory``; the names
    ``ignition.msgs`` are those of Gazebo Fortress.
    """

    code = "BR001"
    name = "bridge-entry-unusable"
    other_severities = {Severity.WARNING: "the type has its old name, which still works"}
    examples = (
        Example("a bridge", {"bridge.yaml": _ENTRY}),
        Example(
            "other directions",
            {
                "a.yaml": _ENTRY.replace("GZ_TO_ROS", "ROS_TO_IGN"),
                "b.yaml": _ENTRY.replace("GZ_TO_ROS", "both"),
            },
            "a.yaml:5:14: invalid direction 'ROS_TO_IGN': the bridge drops the entry; did you "
            "mean ROS_TO_GZ?",
            "b.yaml:5:14: invalid direction 'both': the bridge drops the entry; known: GZ_TO_ROS, "
            "ROS_TO_GZ, BIDIRECTIONAL",
        ),
        Example(
            "keys without their suffix",
            {"bridge.yaml": _ENTRY.replace("_name", "")},
            "1:3: unknown key 'ros_topic': the bridge ignores it; write 'ros_topic_name'",
            "2:3: unknown key 'gz_topic': the bridge ignores it; write 'gz_topic_name'",
            "3:3: unknown key 'ros_type': the bridge ignores it; write 'ros_type_name'",
            "4:3: unknown key 'gz_type': the bridge ignores it; write 'gz_type_name'",
        ),
        Example(
            "unknown keys; keys of Fortress",
            {
                "a.yaml": _ENTRY.replace("ros_type_name", "ros_type"),
                "b.yaml": _ENTRY.replace("gz_topic_name", "ign_topic_name"),
            },
            "a.yaml:3:3: unknown key 'ros_type': the bridge ignores it; write 'ros_type_name'",
            "b.yaml:2:3: unknown key 'ign_topic_name': the bridge ignores it; write "
            "'gz_topic_name'",
        ),
        Example(
            "a missing type; a missing topic; two topics",
            {
                "a.yaml": _ENTRY.replace("  gz_type_name: gz.msgs.LaserScan\n", ""),
                "b.yaml": "- ros_type_name: std_msgs/msg/Bool\n  gz_type_name: gz.msgs.Boolean\n",
                "c.yaml": _ENTRY.replace("gz_topic_name", "topic_name"),
            },
            "a.yaml:1:3: no 'gz_type_name': the bridge drops the entry with 'Could not parse "
            "entry'",
            "b.yaml:1:3: no topic: the bridge drops the entry; write 'ros_topic_name' and "
            "'gz_topic_name'",
            "c.yaml:2:3: 'topic_name' and 'ros_topic_name' are mutually exclusive: the bridge "
            "drops the entry",
        ),
        Example(
            "not YAML",
            {"a.yaml": _ENTRY.replace("  gz_topic", "\tgz_topic")},
            "2:1: line is indented with a tab; YAML allows only spaces: the bridge bridges no "
            "topics",
        ),
        Example(
            "not a list",
            {"a.yaml": _ENTRY.replace("- ", "", 1).replace("\n  ", "\n")},
            "1:1: expected a list of entries; write '- ' before the first key",
        ),
        Example(
            "a pair of types",
            {"bridge.yaml": _ENTRY_TYPES.format("sensor_msgs/msg/LaserScan", "gz.msgs.LaserScan")},
        ),
        Example(
            "types of a later release",
            {"bridge.yaml": _ENTRY_TYPES.format("my_msgs/msg/Sonar", "gz.msgs.Sonar")},
        ),
        Example(
            "the Fortress name of a type",
            {"bridge.yaml": _ENTRY_TYPES.format("rosgraph_msgs/msg/Clock", "ignition.msgs.Clock")},
            Report(
                "4:17",
                "'ignition.msgs.Clock' is the name in Gazebo Fortress; use 'gz.msgs.Clock' instead",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "two types without a conversion; an unknown Gazebo type",
            {
                "a.yaml": _ENTRY_TYPES.format("sensor_msgs/msg/Image", "gz.msgs.LaserScan"),
                "b.yaml": _ENTRY_TYPES.format("sensor_msgs/msg/LaserScan", "gz.msgs.LidarScan"),
            },
            "a.yaml:4:17: no conversion between 'sensor_msgs/msg/Image' and 'gz.msgs.LaserScan': "
            "nothing is bridged; 'sensor_msgs/msg/Image' is converted to gz.msgs.Image",
            "b.yaml:4:17: no conversion between 'sensor_msgs/msg/LaserScan' and "
            "'gz.msgs.LidarScan': nothing is bridged; 'sensor_msgs/msg/LaserScan' is converted to "
            "gz.msgs.LaserScan",
        ),
        Example(
            "an unknown ROS type; one without msg",
            {
                "a.yaml": _ENTRY_TYPES.format("sensor_msgs/msg/LaserScans", "gz.msgs.LaserScan"),
                "b.yaml": _ENTRY_TYPES.format("sensor_msgs/LaserScan", "gz.msgs.LaserScan"),
            },
            "a.yaml:3:18: unknown type 'sensor_msgs/msg/LaserScans': nothing is bridged; did you "
            "mean 'sensor_msgs/msg/LaserScan'?",
            "b.yaml:3:18: unknown type 'sensor_msgs/LaserScan': nothing is bridged; did you mean "
            "'sensor_msgs/msg/LaserScan'?",
        ),
        Example(
            "types in a launch file",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "/scan@sensor_msgs/msg/LaserScan[gz.msgs.Image"
                ),
                "launch/c.launch.py": _LAUNCH.format(
                    "/scan@gz.msgs.LaserScan[sensor_msgs/msg/LaserScan"
                ),
                "launch/b.launch.xml": '<launch>\n  <node pkg="ros_gz_bridge" '
                'exec="parameter_bridge" args="/a@std_msgs/msg/Bool@gz.msgs.Image"/>\n</launch>\n',
            },
            "launch/a.launch.py:8:25: no conversion between 'sensor_msgs/msg/LaserScan' and "
            "'gz.msgs.Image': nothing is bridged; 'sensor_msgs/msg/LaserScan' is converted to "
            "gz.msgs.LaserScan",
            "launch/b.launch.xml:2:59: no conversion between 'std_msgs/msg/Bool' and "
            "'gz.msgs.Image': nothing is bridged; 'std_msgs/msg/Bool' is converted to "
            "gz.msgs.Boolean",
            "launch/c.launch.py:8:25: the ROS type comes first: nothing is bridged; write "
            "@gz.msgs.LaserScan, then sensor_msgs/msg/LaserScan",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_keys(package)
        yield from self._check_types(package)

    def _check_keys(self, package: Package) -> Iterator[Diagnostic]:
        for path, root in bridge_roots(package):
            if isinstance(root, ParseError):
                yield self.report(root, f"{root.message}: the bridge bridges no topics")
            elif isinstance(root, Mapping) and any(key.text in _KEYS for key, _ in root.pairs):
                message = "expected a list of entries; write '- ' before the first key"
                yield self.report(package.start_of(path), message)
        for entry in bridge_entries(package):
            yield from self._check(package, entry)

    def _check(self, package: Package, entry: BridgeEntry) -> Iterator[Diagnostic]:
        misspelt = [key for key in entry.keys if key not in _KEYS]
        for key in misspelt:
            whole = f"{key}_name" if f"{key}_name" in _KEYS else None
            closest = _OLD.get(key) or whole or closest_name(package, key, _KEYS, 0.75)
            if closest and closest not in entry.keys:
                message = f"unknown key {key!r}: the bridge ignores it; write {closest!r}"
                yield self.report(entry.keys[key], message)
        direction = entry.values.get("direction")
        if direction is not None and direction.text not in _DIRECTIONS:
            closest = closest_name(package, direction.text.upper(), _DIRECTIONS, 0.6)
            hint = f"did you mean {closest}?" if closest else f"known: {', '.join(_DIRECTIONS)}"
            message = f"invalid direction {direction.text!r}: the bridge drops the entry; {hint}"
            yield self.report(direction, message)
        if "service_name" in entry.keys:
            return
        if not misspelt:
            for key in ("ros_type_name", "gz_type_name"):
                if key not in entry.keys:
                    message = f"no {key!r}: the bridge drops the entry with 'Could not parse entry'"
                    yield self.report(entry, message)
            if not any(key in entry.keys for key in _TOPICS):
                yield self.report(
                    entry,
                    "no topic: the bridge drops the entry; write "
                    "'ros_topic_name' and 'gz_topic_name'",
                )
        both = [key for key in _TOPICS[:2] if key in entry.keys]
        if "topic_name" in entry.keys and both:
            message = (
                f"'topic_name' and {both[0]!r} are mutually exclusive: the bridge drops the entry"
            )
            yield self.report(entry.keys["topic_name"], message)

    def _check_types(self, package: Package) -> Iterator[Diagnostic]:
        for entry in bridge_entries(package):
            ros, gz = entry.values.get("ros_type_name"), entry.values.get("gz_type_name")
            if ros is None or gz is None or "$" in ros.text + gz.text:
                continue
            yield from self._check_pair(package, ros.text, gz.text, ros.location, gz.location)
        for path in launch_paths(package):
            try:
                arguments = _arguments(package, path)
            except ViewError:
                continue
            for ros_type, gz_type, at in arguments:
                yield from self._check_pair(package, ros_type, gz_type, at, at)
        for file in markup_files(package):
            for attribute in file.attributes:
                for match in _ARGUMENT.finditer(attribute.value):
                    at = attribute.location
                    yield from self._check_pair(package, *_types(match), at, at)

    def _check_pair(
        self, package: Package, ros: str, gz: str, ros_at: Location, gz_at: Location
    ) -> Iterator[Diagnostic]:
        if ros.startswith((_NEW, _OLD_TYPES)):
            message = f"the ROS type comes first: nothing is bridged; write @{ros}, then {gz}"
            yield self.report(ros_at, message)
            return
        new = gz.replace(_OLD_TYPES, _NEW, 1)
        of_ros = sorted(item for name, item in BRIDGED_TYPES if name == ros)
        of_gz = sorted(name for name, item in BRIDGED_TYPES if item == new)
        if (ros, new) in BRIDGED_TYPES:
            if gz != new:
                message = f"{gz!r} is the name in Gazebo Fortress; use {new!r} instead"
                yield self.report(gz_at, message, severity=Severity.WARNING)
        elif of_ros:
            message = f"no conversion between {ros!r} and {gz!r}: nothing is bridged"
            yield self.report(gz_at, f"{message}; {ros!r} is converted to {' or '.join(of_ros)}")
        elif of_gz and package.workspace.interfaces.find(ros) is None:
            closest = closest_name(package, ros, {name for name, _ in BRIDGED_TYPES}, 0.7)
            hint = f"; did you mean {closest!r}?" if closest else ""
            message = f"unknown type {ros!r}: nothing is bridged{hint}"
            yield self.report(ros_at, message)


def _types(match: re.Match[str]) -> tuple[str, str]:
    """Return the two types of an argument, in order."""
    return match[1] or match[3], match[2] or match[4]


@fact
def _arguments(package: Package, path: str) -> tuple[tuple[str, str, Location], ...]:
    """Return the pairs of types in the arguments of a bridge, each with its place."""
    module = package.module(path)
    return tuple(
        (*_types(match), module.location(node))
        for node in module.walk(ast.Constant)
        if isinstance(node.value, str) and "@" in node.value
        for match in _ARGUMENT.finditer(node.value)
    )
