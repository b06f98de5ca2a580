"""LF065: remapped names exist in the node."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Effect,
    Example,
    Package,
    Report,
    Rule,
    Severity,
    closest_name,
    listed_names,
)
from scaffold.api.launch import Remapped, code_of, is_known, markup_files, names_of, started_nodes

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
_ALWAYS = frozenset({"clock", "parameter_events", "rosout", "tf", "tf_static"})
"""Topics of any node, also through tf2."""


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
    effect = Effect.WRONG_BEHAVIOR
    other_severities = {
        Severity.WARNING: "no name of the node is similar, as if the remapping was left over; or "
        "the node already has the new name, as a full name in its code"
    }
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
            Report(
                "launch/a.launch.py:8:27",
                "'talk' has no topic, service or action 'chat_in': nothing is "
                "remapped; it has chatter, ~/input",
                severity=Severity.WARNING,
            ),
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
            "a name that the node has anyway",
            {
                **_FILES,
                "demo/talker.py": _FILES["demo/talker.py"].replace("~/input", "/robot/input"),
                "launch/a.launch.xml": '<launch><node pkg="demo" exec="talk">'
                '<remap from="in" to="robot/input"/></node></launch>\n',
            },
            Report(
                "launch/a.launch.xml:1:51",
                "'talk' has no topic, service or action 'in': nothing is remapped; it "
                "has /robot/input, chatter",
                severity=Severity.WARNING,
            ),
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
            Report(
                "launch/a.launch.xml:1:81",
                "'talk' has no topic, service or action 'chat_in': nothing is "
                "remapped; it has chatter, ~/input",
                severity=Severity.WARNING,
            ),
            Report(
                "launch/b.launch.yaml:6:13",
                "'talk' has no topic, service or action 'chat_in': nothing is "
                "remapped; it has chatter, ~/input",
                severity=Severity.WARNING,
            ),
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
        for node in _remapped_nodes(package):
            names = names_of(node, package)
            for source, target, location in node.remappings if names is not None else ():
                problem, is_unlike_all = _problem(package, node, names or set(), (source, target))
                if problem:
                    is_kept = _is_absolute_in(names or set(), target)
                    severity = Severity.WARNING if is_kept or is_unlike_all else None
                    cause = f"names of {node.program}"
                    yield self.report(location, problem, severity=severity, cause=cause)


def _problem(
    package: Package, node: Remapped, names: set[str], remapping: tuple[str, str | None]
) -> tuple[str, bool]:
    """Return why a remapping has no effect, if so, and whether its source is like no name."""
    source, target = remapping
    mistake = _mistake(node, names, source, target)
    if mistake:
        return f"{node.program!r} uses {mistake}", False
    if _has_name(names, source, node.name):
        return "", False
    closest = closest_name(package, source, names, 0.6)
    hint = f"did you mean {closest!r}?" if closest else f"it has {listed_names(names, source)}"
    problem = f"{node.program!r} has no topic, service or action {source!r}: nothing is remapped"
    return f"{problem}; {hint}", not closest


def _mistake(node: Remapped, names: set[str], source: str, target: str | None) -> str:
    """Return the name that the node uses instead of a misspelled one; empty if unknown."""
    full_name = _misses_namespace(names, source, node.namespace)
    if full_name:
        right = source.removeprefix("/")
        return f"{full_name!r} in its namespace: nothing is remapped; write {right!r}"
    private = _misses_privacy(names, source)
    if private:
        return f"the private name {private!r}: nothing is remapped; write {private!r}"
    if _is_reversed(names, source, target, node.name):
        why = "nothing is remapped; the name in the code comes first"
        return f"{target!r}, not {source!r}: {why}"
    return ""


def _remapped_nodes(package: Package) -> Iterator[Remapped]:
    """Yield the nodes with remappings in launch files of a package."""
    for started in started_nodes(package):
        owner = started.owner(package) if started.remappings else None
        if owner is not None:
            given = {item.name for item in started.parameters}
            yield Remapped(
                owner,
                str(started.executable),
                started.name(package),
                started.namespace,
                started.remappings,
                None if started.has_more_parameters else given,
            )
    for file in markup_files(package):
        for node in file.nodes:
            remappings = [
                (
                    source.value,
                    target.value if target and is_known(target) else None,
                    source.location,
                )
                for source, target in node.remappings
                if is_known(source)
            ]
            if not remappings or node.package is None or node.executable is None:
                continue
            owner = code_of(package, node.package.value, node.executable.value)
            if owner is not None:
                name = node.name.value if node.name is not None else owner.node_name
                yield Remapped(
                    owner,
                    node.executable.value,
                    name,
                    None,
                    remappings,
                    node.parameter_names,
                )


def _misses_privacy(names: set[str], source: str) -> str:
    """Return the private name that a node has, if a remapping names it without its ``~/``."""
    is_plain = "/" not in source and "~" not in source and ":" not in source
    others = {name.rpartition("/")[2] for name in names if name != f"~/{source}"}
    return f"~/{source}" if is_plain and f"~/{source}" in names and source not in others else ""


def _has_name(names: set[str], source: str, node: object) -> bool:
    """Return whether a remapping may apply to a name of a node."""
    wanted = source.rpartition(":")[2].partition("/_action/")[0].removeprefix("~").strip("/")
    last = wanted.rpartition("/")[2]
    if (
        wanted in _ALWAYS
        or source.startswith(("__", "rosservice", "rostopic"))
        or "parameter" in last
    ):
        return True
    plain = {name.removeprefix("~").strip("/") for name in names}
    plain |= {f"{node}/{name}" for name in plain}
    return any(
        name == wanted or name.endswith(f"/{wanted}") or wanted.endswith(f"/{name}")
        for name in plain
    )


def _is_reversed(names: set[str], source: str, target: str | None, node: object) -> bool:
    """Return whether a remapping is reversed: the node has the target, not the source."""
    if target is None or any(name.startswith("/") for name in names):
        return False
    plain = {name.removeprefix("~").strip("/") for name in names}
    wanted = {source, source.removeprefix("~/"), source.removeprefix(f"{node}/")}
    if wanted & plain or source.startswith("/") or source.strip("/") in _ALWAYS:
        return False
    return target in names


def _is_absolute_in(names: set[str], target: str | None) -> bool:
    """Return whether a node has the target of a remapping as a full name, whatever is remapped."""
    return target is not None and f"/{target.lstrip('/')}" in names


def _misses_namespace(names: set[str], source: str, namespace: object) -> str:
    """Return the name that a node has in its namespace, if a remapping names it without that."""
    name = source.removeprefix("/")
    if not isinstance(namespace, str) or not namespace.strip("/") or name == source:
        return ""
    if name in _ALWAYS or name not in names or source in names:
        return ""
    return f"/{namespace.strip('/')}/{name}"
