"""BR001: the entries of a bridge have the keys that ros_gz_bridge reads."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, ParseError, Report, Rule, closest_name
from scaffold.api.formats import Mapping
from scaffold.api.robot import BridgeEntry, bridge_entries, bridge_roots

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


class BridgeEntryUnusable(Rule):
    """An entry of a bridge has a key or a direction that ros_gz_bridge does not know.

    **Why.** ``Could not parse entry``: the bridge goes on without it, and nothing arrives. A key
    that it does not know is ignored without a word.

    **Fix.** ``ros_topic_name``, ``gz_topic_name``, ``ros_type_name``, ``gz_type_name``, and as
    direction ``GZ_TO_ROS``, ``ROS_TO_GZ`` or ``BIDIRECTIONAL``.

    **Source.** ros_gz_bridge, ``bridge_config.cpp``.
    """

    code = "BR001"
    name = "bridge-entry-unusable"
    examples = (
        Example("a bridge", {"bridge.yaml": _ENTRY}),
        Example(
            "other directions",
            {
                "a.yaml": _ENTRY.replace("GZ_TO_ROS", "ROS_TO_IGN"),
                "b.yaml": _ENTRY.replace("GZ_TO_ROS", "both"),
            },
            Report(
                "a.yaml:5:14",
                "invalid direction 'ROS_TO_IGN': the bridge drops the entry; closest: ROS_TO_GZ",
            ),
            Report(
                "b.yaml:5:14",
                "invalid direction 'both': the bridge drops the entry; known: "
                "GZ_TO_ROS, ROS_TO_GZ, BIDIRECTIONAL",
            ),
        ),
        Example(
            "other keys; those of Fortress",
            {
                "a.yaml": _ENTRY.replace("ros_type_name", "ros_type"),
                "b.yaml": _ENTRY.replace("gz_topic_name", "ign_topic_name"),
            },
            Report("a.yaml:3:3", "the bridge ignores the key 'ros_type': write 'ros_type_name'"),
            Report(
                "b.yaml:2:3", "the bridge ignores the key 'ign_topic_name': write 'gz_topic_name'"
            ),
        ),
        Example(
            "no type; no topic; two topics",
            {
                "a.yaml": _ENTRY.replace("  gz_type_name: gz.msgs.LaserScan\n", ""),
                "b.yaml": "- ros_type_name: std_msgs/msg/Bool\n  gz_type_name: gz.msgs.Boolean\n",
                "c.yaml": _ENTRY.replace("gz_topic_name", "topic_name"),
            },
            Report("a.yaml:1:3", "no 'gz_type_name': 'Could not parse entry', nothing is bridged"),
            Report("b.yaml:1:3", "no topic: write 'ros_topic_name' and 'gz_topic_name'"),
            Report(
                "c.yaml:2:3",
                "'topic_name' and 'ros_topic_name' exclude each other: the bridge drops the entry",
            ),
        ),
        Example(
            "not YAML",
            {"a.yaml": _ENTRY.replace("  gz_topic", "\tgz_topic")},
            Report(
                "2:1",
                "line is indented with a tab; YAML allows only spaces: the bridge connects nothing",
            ),
        ),
        Example(
            "not a list",
            {"a.yaml": _ENTRY.replace("- ", "", 1).replace("\n  ", "\n")},
            Report("1:1", "the bridge reads a list of entries: write '- ' before the first key"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path, root in bridge_roots(package):
            if isinstance(root, ParseError):
                yield self.report(root, f"{root.message}: the bridge connects nothing")
            elif isinstance(root, Mapping) and any(key.text in _KEYS for key, _ in root.pairs):
                message = "the bridge reads a list of entries: write '- ' before the first key"
                yield self.report(package.start_of(path), message)
        for entry in bridge_entries(package):
            yield from self._check(package, entry)

    def _check(self, package: Package, entry: BridgeEntry) -> Iterator[Diagnostic]:
        misspelt = [key for key in entry.keys if key not in _KEYS]
        for key in misspelt:
            closest = _OLD.get(key) or closest_name(package, key, _KEYS, 0.75)
            if closest and closest not in entry.keys:
                message = f"the bridge ignores the key {key!r}: write {closest!r}"
                yield self.report(entry.keys[key], message)
        direction = entry.values.get("direction")
        if direction is not None and direction.text not in _DIRECTIONS:
            closest = closest_name(package, direction.text.upper(), _DIRECTIONS, 0.6)
            hint = f"closest: {closest}" if closest else f"known: {', '.join(_DIRECTIONS)}"
            message = f"invalid direction {direction.text!r}: the bridge drops the entry; {hint}"
            yield self.report(direction, message)
        if "service_name" in entry.keys:
            return
        if not misspelt:
            for key in ("ros_type_name", "gz_type_name"):
                if key not in entry.keys:
                    message = f"no {key!r}: 'Could not parse entry', nothing is bridged"
                    yield self.report(entry, message)
            if not any(key in entry.keys for key in _TOPICS):
                yield self.report(entry, "no topic: write 'ros_topic_name' and 'gz_topic_name'")
        both = [key for key in _TOPICS[:2] if key in entry.keys]
        if "topic_name" in entry.keys and both:
            message = f"'topic_name' and {both[0]!r} exclude each other: the bridge drops the entry"
            yield self.report(entry.keys["topic_name"], message)
