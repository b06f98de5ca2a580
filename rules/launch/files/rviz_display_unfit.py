"""LF087: configurations of RViz fit the topics and frames of the package."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Location, Package, Rule, Severity, ViewError
from scaffold.api.formats import Mapping as YamlMapping
from scaffold.api.formats import Scalar, yaml_tree
from scaffold.api.launch import started_nodes
from scaffold.api.parameters import keeps_default_name
from scaffold.api.programs import is_remapped, topics_of
from scaffold.api.robot import robots

_PREFIX = "rviz_default_plugins/"
_TYPES: Mapping[str, str] = {
    "AccelStamped": "geometry_msgs/msg/AccelStamped",
    "Camera": "sensor_msgs/msg/Image",
    "FluidPressure": "sensor_msgs/msg/FluidPressure",
    "GridCells": "nav_msgs/msg/GridCells",
    "Illuminance": "sensor_msgs/msg/Illuminance",
    "Image": "sensor_msgs/msg/Image",
    "LaserScan": "sensor_msgs/msg/LaserScan",
    "Map": "nav_msgs/msg/OccupancyGrid",
    "Marker": "visualization_msgs/msg/Marker",
    "MarkerArray": "visualization_msgs/msg/MarkerArray",
    "Odometry": "nav_msgs/msg/Odometry",
    "Path": "nav_msgs/msg/Path",
    "PointCloud": "sensor_msgs/msg/PointCloud",
    "PointCloud2": "sensor_msgs/msg/PointCloud2",
    "PointStamped": "geometry_msgs/msg/PointStamped",
    "Polygon": "geometry_msgs/msg/PolygonStamped",
    "Pose": "geometry_msgs/msg/PoseStamped",
    "PoseArray": "geometry_msgs/msg/PoseArray",
    "PoseWithCovariance": "geometry_msgs/msg/PoseWithCovarianceStamped",
    "Range": "sensor_msgs/msg/Range",
    "RelativeHumidity": "sensor_msgs/msg/RelativeHumidity",
    "Temperature": "sensor_msgs/msg/Temperature",
    "TwistStamped": "geometry_msgs/msg/TwistStamped",
    "Wrench": "geometry_msgs/msg/WrenchStamped",
}
"""The displays of one topic, with its type."""
_OTHERS = frozenset(
    {"Axes", "DepthCloud", "Effort", "Grid", "InteractiveMarkers", "RobotModel", "TF"}
    | {"FocusCamera", "Interact", "Measure", "MoveCamera", "PublishPoint", "Select", "SetGoal"}
    | {"SetInitialPose", "FPS", "FrameAligned", "Orbit", "ThirdPersonFollower", "TopDownOrtho"}
    | {"XYOrbit", "Marker", "WrenchStamped"}
)
"""Other displays, tools and views."""
_FRAMES = frozenset({"map", "odom", "base_link", "base_footprint", "world"})
_SHORTEST = 4
"""Letters; shorter names are alike by chance."""
_NODE = (
    "from rclpy.node import Node\nfrom rclpy.qos import qos_profile_sensor_data\n"
    "from sensor_msgs.msg import LaserScan\n\n\n"
    "class Laser(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('laser')\n"
    "        self.pub = self.create_publisher(LaserScan, 'front_scan', qos_profile_sensor_data)\n"
)
_RVIZ = (
    "Visualization Manager:\n  Displays:\n    - Class: rviz_default_plugins/{}\n"
    "      Name: Scan\n      Topic:\n        Reliability Policy: {}\n        Value: {}\n"
    "  Global Options:\n    Fixed Frame: {}\n"
)


class RvizDisplayUnfit(Rule):
    """A configuration of RViz has a display, a topic, a policy or a frame that does not fit.

    **Why.** RViz starts, and shows nothing: ``The class required for this display could not be
    loaded``, ``Frame [odomm] does not exist``, or no message ever arrives.

    **Fix.** Write what the nodes of the package publish: its type, name and reliability.

    **Source.** ``rviz_default_plugins/plugins_description.xml``; ROS 2 documentation, "Quality of
    Service settings".
    """

    code = "LF087"
    name = "rviz-display-unfit"
    severity = Severity.WARNING
    examples = (
        Example(
            "fitting",
            {
                "laser.py": _NODE,
                "a.rviz": _RVIZ.format("LaserScan", "Best Effort", "/front_scan", "map"),
            },
        ),
        Example(
            "a topic, a frame and a display of others",
            {
                "laser.py": _NODE,
                "a.rviz": _RVIZ.format("LaserScan", "Reliable", "/rear_laser", "mast").replace(
                    "rviz_default_plugins", "my_plugins"
                ),
            },
        ),
        Example(
            "a misspelled display, another reliability, a misspelled topic and frame",
            {
                "laser.py": _NODE,
                "a.rviz": _RVIZ.format("Laserscan", "Best Effort", "/front_scan", "odomm"),
                "b.rviz": _RVIZ.format("LaserScan", "Reliable", "/front_scan", "map"),
                "c.rviz": _RVIZ.format("LaserScan", "Best Effort", "/frontscan", "map"),
                "d.rviz": _RVIZ.format("PointCloud2", "Best Effort", "/front_scan", "map"),
                "e.rviz": _RVIZ.format("LaserScan", "Best Effort", "/front_scan", "map").replace(
                    "rviz_default_plugins", "rviz"
                ),
            },
            "a.rviz:3:14: RViz has no rviz_default_plugins/Laserscan; did you mean "
            "rviz_default_plugins/LaserScan?",
            "a.rviz:9:18: nothing has a frame 'odomm'; did you mean 'odom'?",
            "b.rviz:6:29: laser.py:9 publishes BEST_EFFORT: RViz gets nothing; write Best Effort",
            "c.rviz:7:16: no node has a topic '/frontscan'; did you mean '/front_scan'?",
            "d.rviz:7:16: this display shows sensor_msgs/msg/PointCloud2, but laser.py:9 "
            "publishes sensor_msgs/msg/LaserScan",
            "e.rviz:3:14: rviz/LaserScan belongs to ROS 1; ROS 2 has "
            "rviz_default_plugins/LaserScan",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in package.files:
            if not path.endswith(".rviz"):
                continue
            try:
                roots = yaml_tree.parse(package.source(path))
            except ViewError:
                continue
            for _, mapping in yaml_tree.mappings(roots):
                values = {key.text: value for key, value in mapping.pairs}
                for at, problem in (*_of_display(package, values), *_of_frame(package, values)):
                    cause = f"RViz of ROS 1: {path}" if _OF_ROS1 in problem else ""
                    yield self.report(at, problem, cause=cause)


_OF_ROS1 = "belongs to ROS 1"
_Values = Mapping[str, object]
"""The values of a mapping, by key."""


def _of_display(package: Package, values: _Values) -> Iterator[tuple[Location, str]]:
    """Yield the problems with the class of a display, and with its topic."""
    class_, topic = values.get("Class"), values.get("Topic")
    if not isinstance(class_, Scalar):
        return
    area, _, name = class_.text.rpartition("/")
    known = {*_TYPES, *_OTHERS}
    if area == "rviz" and name in known:
        yield class_.location, f"{class_.text} {_OF_ROS1}; ROS 2 has {_PREFIX}{name}"
    elif f"{area}/" == _PREFIX and name not in known:
        closest = get_close_matches(name, sorted(known), 1, 0.75)
        if closest:
            yield class_.location, f"RViz has no {class_.text}; did you mean {_PREFIX}{closest[0]}?"
    elif isinstance(topic, YamlMapping):
        type_ = _TYPES.get(name, "") if f"{area}/" == _PREFIX else ""
        yield from _of_topic(package, type_, {key.text: item for key, item in topic.pairs})


def _of_topic(package: Package, type_: str, values: _Values) -> Iterator[tuple[Location, str]]:
    """Yield the problem with the name, the type or the reliability of a topic."""
    given, reliability = values.get("Value"), values.get("Reliability Policy")
    if not isinstance(given, Scalar):
        return
    topics = topics_of(package)
    name = given.text.strip("/")
    topic = topics.get(name)
    if topic is None:
        others = {other.strip("/") for other in topics} | _targets(package)
        meant = _slip(name, others)
        if meant and not _is_in_texts(package, name):
            yield given.location, f"no node has a topic {given.text!r}; did you mean '/{meant}'?"
        return
    for publisher in topic.publishers if topic.is_plain_by_default else ():
        if not keeps_default_name(package, publisher) or is_remapped(package, publisher):
            continue
        at = f"{publisher.location.path}:{publisher.location.line}"
        if type_ and publisher.interface not in {type_, None}:
            yield (
                given.location,
                f"this display shows {type_}, but {at} publishes {publisher.interface}",
            )
        is_lossy = publisher.qos is not None and publisher.qos.reliability == "BEST_EFFORT"
        if is_lossy and isinstance(reliability, Scalar) and reliability.text == "Reliable":
            problem = f"{at} publishes BEST_EFFORT: RViz gets nothing; write Best Effort"
            yield reliability.location, problem
        return


def _of_frame(package: Package, values: _Values) -> Iterator[tuple[Location, str]]:
    """Yield the problem with the name of the fixed frame."""
    given = values.get("Fixed Frame")
    if isinstance(given, Scalar) and given.text not in _FRAMES:
        links = {
            part.attributes.get("name", "")
            for robot in robots(package).whole
            for part in robot.root.children
            if part.tag == "link"
        }
        meant = _slip(given.text, links | _FRAMES)
        if meant and given.text not in links and not _is_in_texts(package, given.text):
            yield given.location, f"nothing has a frame {given.text!r}; did you mean {meant!r}?"


def _targets(package: Package) -> set[str]:
    """Return the names that launch files remap to."""
    return {
        target.strip("/")
        for node in started_nodes(package)
        for _, target, _ in node.remappings
        if target
    }


def _slip(name: str, others: Collection[str]) -> str:
    """Return the name that another one differs from by a letter or a separator; else ``""``."""
    for other in sorted(others):
        if re.sub(r"[/_]", "", name) == re.sub(r"[/_]", "", other):
            return other
        short, long = sorted((name, other), key=len)
        is_short = len(short) < _SHORTEST or len(long) - len(short) > 1
        if is_short or any(map(str.isdigit, name + other)):
            continue
        same = next((i for i, letter in enumerate(short) if letter != long[i]), len(short))
        rest = same if len(long) > len(short) else same + 1
        if short[rest:] == long[same + 1 :]:
            return other
    return ""


def _is_in_texts(package: Package, word: str) -> bool:
    """Return whether a file with code, parameters or a robot has a word."""
    whole = re.compile(rf"(?<!\w){re.escape(word)}(?!\w)")
    for path in package.files:
        if path.endswith((".py", ".yaml", ".yml", ".xml", ".urdf", ".xacro", ".cpp", ".hpp")):
            try:
                if whole.search(package.source(path).text):
                    return True
            except ViewError:
                continue
    return False
