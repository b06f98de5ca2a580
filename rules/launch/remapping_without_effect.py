"""LF065: remappings name what the node has."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, closest_name, listed_names
from scaffold.api.launch import has_name, names_of, remappings_of, started_nodes

_FILES = {
    "package.xml": "<package><name>demo</name>"
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(name='demo', packages=['demo'],\n"
    "      entry_points={'console_scripts': ['talk = demo.talker:main']})\n",
    "demo/__init__.py": "",
    "demo/talker.py": "import rclpy\nfrom rclpy.node import Node\n"
    "from std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        topic = self.declare_parameter('topic', 'chatter').value\n"
    "        self.create_publisher(String, topic, 10)\n"
    "        self.create_subscription(String, '~/input', print, 10)\n\n\n"
    "def main():\n    rclpy.init()\n    rclpy.spin(Talker())\n",
}
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='demo', executable='talk',{}\n"
    "             remappings=[('{}', 'other')]),\n    ])\n"
)


class RemappingWithoutEffect(Rule):
    """A launch file remaps a name that the node does not have.

    Reported where the code of the node is Python of the workspace, and all its topics, services
    and actions are known.

    **Why.** Nothing is remapped, without a word: the node publishes and listens where it did
    before, and what should reach it does not.

    **Fix.** Remap a name that the node has. A topic that a parameter names is set with that
    parameter.

    **Source.** ROS 2 design, "Topic and Service name mapping": remapping rules match full names.
    """

    code = "LF065"
    name = "remapping-without-effect"
    examples = (
        Example("a topic", {**_FILES, "launch/a.launch.py": _LAUNCH.format("", "/chatter")}),
        Example(
            "a private topic", {**_FILES, "launch/a.launch.py": _LAUNCH.format("", "talker/input")}
        ),
        Example(
            "no such topic",
            {**_FILES, "launch/a.launch.py": _LAUNCH.format("", "chat_in")},
            Report(
                "launch/a.launch.py:8:27",
                "'talk' has no topic, service or action 'chat_in': nothing is "
                "remapped; it has chatter, ~/input",
            ),
        ),
        Example(
            "a slip",
            {**_FILES, "launch/a.launch.py": _LAUNCH.format("", "chater")},
            Report(
                "launch/a.launch.py:8:27",
                "'talk' has no topic, service or action 'chater': nothing is "
                "remapped; did you mean 'chatter'?",
            ),
        ),
        Example(
            "the name of a parameter that is set",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format(" parameters=[{'topic': 'a'}],", "chat_in"),
            },
        ),
        Example("what tf2 has", {**_FILES, "launch/a.launch.py": _LAUNCH.format("", "/tf_static")}),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for started in started_nodes(package):
            remappings = list(remappings_of(started))
            names = names_of(started, package) if remappings else None
            if names is None:
                continue
            for remapping in remappings:
                if has_name(names, remapping.source, started.name):
                    continue
                message = (
                    f"{started.executable!r} has no topic, service or action {remapping.source!r}: "
                    f"nothing is remapped; {_hint(package, remapping.source, names)}"
                )
                at = started.launch.location(remapping.node)
                yield self.report(at, message, cause=f"names of {started.executable}")


def _hint(package: Package, source: str, names: set[str]) -> str:
    near = closest_name(package, source, names, 0.6)
    if near:
        return f"did you mean {near!r}?"
    return f"it has {listed_names(names, source)}"
