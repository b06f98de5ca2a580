"""LF065: remapped names exist in the node."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Effect,
    Example,
    Package,
    Rule,
    closest_name,
    listed_names,
)
from scaffold.api.launch import (
    Remapped,
    has_name,
    is_reversed,
    misses_namespace,
    misses_privacy,
    names_of,
    remapped_nodes,
)

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

    Only Python nodes in the workspace are checked, if all of their topics, services and actions are
    known.

    **Why.** The remapping is ignored without an error: the node keeps its old names, and messages
    do not reach it.

    **Fix.** Remap a name that the node has. If a parameter holds the topic name, set the parameter.

    **Source.** ROS 2 design, "Topic and Service name mapping": remapping rules match full names.
    """

    code = "LF065"
    name = "remapping-without-effect"
    effect = Effect.IGNORED
    examples = (
        Example(
            "a name remapped to itself",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("", "chat_in").replace(
                    "'other'", "'/chat_in'"
                ),
            },
        ),
        Example("a topic", {**_FILES, "launch/a.launch.py": _LAUNCH.format("", "/chatter")}),
        Example(
            "a private topic", {**_FILES, "launch/a.launch.py": _LAUNCH.format("", "talker/input")}
        ),
        Example(
            "a private topic without ~/",
            {**_FILES, "launch/a.launch.py": _LAUNCH.format("", "input")},
            "launch/a.launch.py:8:27: 'talk' uses the private name '~/input': nothing is "
            "remapped; write '~/input'",
        ),
        Example(
            "an unknown topic",
            {**_FILES, "launch/a.launch.py": _LAUNCH.format("", "chat_in")},
            "launch/a.launch.py:8:27: 'talk' has no topic, service or action 'chat_in': nothing "
            "is remapped; it has chatter, ~/input",
        ),
        Example(
            "a misspelled topic",
            {**_FILES, "launch/a.launch.py": _LAUNCH.format("", "chater")},
            "launch/a.launch.py:8:27: 'talk' has no topic, service or action 'chater': nothing is "
            "remapped; did you mean 'chatter'?",
        ),
        Example(
            "the wrong order",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("", "robot/chatter").replace(
                    "'other'", "'chatter'"
                ),
            },
            "launch/a.launch.py:8:27: 'talk' uses 'chatter', not 'robot/chatter': nothing is "
            "remapped; the name in the code comes first",
        ),
        Example(
            "a full name, in a namespace",
            {**_FILES, "launch/a.launch.py": _LAUNCH.format(" namespace='bot',", "/chatter")},
            "launch/a.launch.py:8:27: 'talk' uses '/bot/chatter' in its namespace: nothing is "
            "remapped; write 'chatter'",
        ),
        Example(
            "in XML and in YAML",
            {
                **_FILES,
                "launch/a.launch.xml": '<launch><node pkg="demo" exec="talk">'
                '<remap from="chatter" to="a"/><remap from="chat_in" to="b"/></node></launch>\n',
                "launch/b.launch.yaml": "launch:\n- node:\n    pkg: demo\n    exec: talk\n"
                "    remap:\n    - from: chat_in\n      to: b\n",
                "launch/c.launch.xml": '<launch><node pkg="demo" exec="talk">'
                '<param from="a.yaml"/><remap from="chat_in" to="b"/></node></launch>\n',
            },
            "launch/a.launch.xml:1:81: 'talk' has no topic, service or action 'chat_in': nothing "
            "is remapped; it has chatter, ~/input",
            "launch/b.launch.yaml:6:13: 'talk' has no topic, service or action 'chat_in': nothing "
            "is remapped; it has chatter, ~/input",
        ),
        Example(
            "a topic from a parameter that is set",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format(" parameters=[{'topic': 'a'}],", "chat_in"),
            },
        ),
        Example(
            "parameters from a file",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format(" parameters=['a.yaml'],", "chat_in"),
            },
        ),
        Example(
            "parameters in the arguments",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format(
                    " arguments=['--ros-args', '-p', 'topic:=a'],", "chat_in"
                ),
            },
        ),
        Example(
            "topics of tf2", {**_FILES, "launch/a.launch.py": _LAUNCH.format("", "/tf_static")}
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for node in remapped_nodes(package):
            names = names_of(node, package)
            for source, target, location in node.remappings if names is not None else ():
                problem = _problem(package, node, names or set(), (source, target))
                if problem:
                    yield self.report(location, problem, cause=f"names of {node.program}")


def _problem(
    package: Package, node: Remapped, names: set[str], remapping: tuple[str, str | None]
) -> str:
    """Return why a remapping has no effect; empty if it may have one."""
    source, target = remapping
    full_name = misses_namespace(names, source, node.namespace)
    if full_name:
        return (
            f"{node.program!r} uses {full_name!r} in its namespace: nothing is remapped; write "
            f"{source.removeprefix('/')!r}"
        )
    private = misses_privacy(names, source)
    if private:
        return (
            f"{node.program!r} uses the private name {private!r}: nothing is remapped; write "
            f"{private!r}"
        )
    if is_reversed(names, source, target, node.name):
        return (
            f"{node.program!r} uses {target!r}, not {source!r}: nothing is remapped; the name in "
            f"the code comes first"
        )
    if has_name(names, source, node.name):
        return ""
    return (
        f"{node.program!r} has no topic, service or action {source!r}: "
        f"nothing is remapped; {_hint(package, source, names)}"
    )


def _hint(package: Package, source: str, names: set[str]) -> str:
    closest = closest_name(package, source, names, 0.6)
    if closest:
        return f"did you mean {closest!r}?"
    return f"it has {listed_names(names, source)}"
