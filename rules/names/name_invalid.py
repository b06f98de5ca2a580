"""NM001: names of nodes, namespaces, topics, services and actions are valid."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, RclpyRule, Report, Severity
from scaffold.api.launch import StartedNode, started_nodes
from scaffold.api.python import is_guarded_by
from scaffold.api.rclpy import (
    Endpoint,
    RclpyFile,
    namespace_problem,
    node_problem,
    part_problem,
    topic_problem,
)

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_publisher(String, '{}', 10)\n"
)
_TOPICS = (
    "from dataclasses import dataclass\n\nFRONT = 'front-scan'\n\n\n"
    "@dataclass\nclass Topics:\n    back: str = 'back-scan'\n"
)
_OTHER = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n"
    "import topics\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self, names):\n"
    "        super().__init__('talker')\n{}"
    "        self.create_publisher(String, topics.FRONT, 10)\n"
    "        self.names = topics.Topics()\n"
    "        self.create_publisher(String, self.names.back, 10)\n"
)
_SETTING = "        topics.FRONT = 'front'\n        names.back = 'back'\n"
_NODE_NODES = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__({})\n"
)


class NameInvalid(RclpyRule):
    """A node, namespace, topic, service or action has a name that ROS 2 does not accept.

    **Why.** ``InvalidTopicNameException``, ``InvalidNodeNameException`` or
    ``InvalidNamespaceException`` of ``rclpy.exceptions`` at start. A node name must not contain a
    namespace. Double underscores are reserved for the middleware, although no tool checks this.

    **Fix.** Use letters, digits, single ``_`` and, except in node names, ``/``; no digit at the
    start or after a ``/``, no ``/`` at the end.

    **Source.** design.ros2.org, "Topic and service name mapping"; ``rcl/validate_topic_name.c``;
    ``rmw/validate_node_name.c``; ``rmw/validate_namespace.c``.
    """

    code = "NM001"
    name = "name-invalid"
    effect = Effect.STOPS_PROGRAM
    other_severities = {Severity.WARNING: "it has a double underscore, which no tool rejects"}
    examples = (
        Example("valid topic names", {"talker.py": _NODE.format("~/scan_2d/front")}),
        Example(
            "a name from a parameter that may be set",
            {
                "talker.py": _NODE.replace("'{}'", "topic").replace(
                    "        self.create",
                    "        topic = self.declare_parameter('topic', '').value\n"
                    "        self.create",
                )
            },
        ),
        Example(
            "a part of the name from a parameter that may be set",
            {
                "talker.py": _NODE.replace("'{}'", "f'robot/{name}/scan'").replace(
                    "        self.create",
                    "        name = self.declare_parameter('name', '').value\n        self.create",
                )
            },
        ),
        Example(
            "a part of the name from a parameter that a launch file does not set",
            {
                "package.xml": "<package><name>demo</name>"
                "<export><build_type>ament_python</build_type></export></package>\n",
                "setup.py": "from setuptools import setup\n\n"
                "setup(name='demo', packages=['demo'],\n"
                "      entry_points={'console_scripts': ['talk = demo.talker:main']})\n",
                "demo/__init__.py": "",
                "demo/talker.py": _NODE.replace("'{}'", "f'/{self.name}/scan'").replace(
                    "        self.create",
                    "        self.name = self.declare_parameter('name', '').value\n"
                    "        self.create",
                )
                + "\n\ndef main():\n    Talker()\n",
                "launch/a.launch.py": "from launch import LaunchDescription\n"
                "from launch_ros.actions import Node\n\n\n"
                "def generate_launch_description():\n    return LaunchDescription([\n"
                "        Node(package='demo', executable='talk')])\n",
            },
            "demo/talker.py:9:39: ROS 2 rejects the name '//scan': '//' is not allowed; "
            "launch/a.launch.py:7 starts the node without 'name', which is empty by default",
        ),
        Example(
            "constants of another module that the file sets, and an object that it changes",
            {"topics.py": _TOPICS, "talker.py": _OTHER.format(_SETTING)},
        ),
        Example(
            "constants of another module, and the default of its dataclass",
            {"topics.py": _TOPICS, "talker.py": _OTHER.format("")},
            "talker.py:9:39: ROS 2 rejects the name 'front-scan': '-' is not allowed",
            "talker.py:11:39: ROS 2 rejects the name 'back-scan': '-' is not allowed",
        ),
        Example(
            "a dash",
            {"talker.py": _NODE.format("front-scan")},
            "8:39: ROS 2 rejects the name 'front-scan': '-' is not allowed",
        ),
        Example(
            "the constant parts of a format string",
            {
                "talker.py": _NODE.replace(
                    "        self.create_publisher(String, '{}', 10)\n",
                    "        name = self.get_namespace() + r'\\scan'\n"
                    "        self.create_publisher(String, name, 10)\n"
                    "        self.create_publisher(String, '/%s/front_scan' % side(), 10)\n"
                    "        self.create_publisher(String, '/{}/front scan'.format(side()), 10)\n"
                    "        self.create_publisher(String, f'{side()}/front/scan', 10)\n"
                    "        topic = (side() + '-a').replace('-', '_')\n"
                    "        self.create_publisher(String, topic, 10)\n",
                )
            },
            "9:39: ROS 2 rejects this name: '\\\\' is not allowed",
            "11:39: ROS 2 rejects this name: whitespace is not allowed",
        ),
        Example(
            "a program that is named like a test, and a test",
            {
                "talker/test_talker.py": _NODE.format("front-scan")
                + "\n\ndef main():\n    Talker()\n",
                "talker/test_listener.py": _NODE.format("front-scan")
                + "\n\ndef test_talker():\n    Talker()\n",
            },
            "talker/test_talker.py:8:39: ROS 2 rejects the name 'front-scan': '-' is not allowed",
        ),
        Example(
            "a leading digit",
            {"talker.py": _NODE.format("scan/2d")},
            "8:39: ROS 2 rejects the name 'scan/2d': '2d' begins with a digit",
        ),
        Example(
            "valid node names",
            {"talker.py": _NODE_NODES.format("'talker', namespace='left/arm'")},
        ),
        Example(
            "a namespace in the name of a node",
            {"talker.py": _NODE_NODES.format("'left/talker'")},
            "6:26: ROS 2 rejects the node name 'left/talker': '/' is not allowed",
        ),
        Example(
            "a namespace with a dash",
            {"talker.py": _NODE_NODES.format("'talker', namespace='left-arm'")},
            "6:26: ROS 2 rejects the namespace 'left-arm': '-' is not allowed",
        ),
        Example(
            "a double underscore",
            {"talker.py": _NODE.format("front__scan")},
            Report(
                "8:39",
                "the name 'front__scan' has a double underscore, which is reserved",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_topics(package, file)
        yield from self._check_nodes(file)
        yield from self._check_underscores(file)

    def _check_topics(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for entity in file.endpoints:
            argument = entity.name_argument
            if argument is None:
                continue
            if not isinstance(entity.name, str):
                parts = _written_parts(file.evaluator.single_value(argument.node))
                problem = next(filter(None, map(part_problem, parts)), None)
                if problem:
                    yield self.report(argument, f"ROS 2 rejects this name: {problem}")
                continue
            # An empty default is a placeholder.
            if entity.from_parameter and _has_gap(entity.name):
                start = _start_without_parameters(package, entity)
                problem = topic_problem(entity.name) if start is not None else ""
                if problem and start is not None:
                    message = (
                        f"ROS 2 rejects the name {entity.name!r}: {problem}; "
                        f"{start.launch}:{start.location.line} starts the node without "
                        f"{entity.from_parameter!r}, which is empty by default"
                    )
                    yield self.report(argument, message)
                continue
            if not entity.name and is_guarded_by(file.module, entity.call, argument.node):
                continue
            problem = topic_problem(entity.name)
            if problem:
                yield self.report(argument, f"ROS 2 rejects the name {entity.name!r}: {problem}")

    def _check_nodes(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.nodes:
            at = node.node_name_location
            if isinstance(node.node_name, str) and at.path == file.module.path:
                problem = node_problem(node.node_name)
                if problem:
                    message = f"ROS 2 rejects the node name {node.node_name!r}: {problem}"
                    yield self.report(at, message)
            if isinstance(node.namespace, str):
                problem = namespace_problem(node.namespace)
                if problem:
                    message = f"ROS 2 rejects the namespace {node.namespace!r}: {problem}"
                    yield self.report(at, message)

    def _check_underscores(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for entity in file.endpoints:
            argument = entity.name_argument
            name = entity.name
            if argument is None or not isinstance(name, str) or topic_problem(name):
                continue
            if "__" in name:
                message = f"the name {name!r} has a double underscore, which is reserved"
                yield self.report(argument, message, severity=Severity.WARNING)


def _written_parts(node: ast.expr) -> Iterator[str]:
    """Yield the literal parts of a name, between the inserted ones."""
    match node:
        case ast.Constant(value=str(text)):
            yield text
        case ast.JoinedStr(values=parts):
            for part in parts:
                yield from _written_parts(part)
        case ast.BinOp(left=left, op=ast.Add(), right=right):
            yield from _written_parts(left)
            yield from _written_parts(right)
        case ast.BinOp(left=ast.Constant(value=str(text)), op=ast.Mod()):
            yield from re.split(r"%[^a-zA-Z%]*[a-zA-Z%]", text)
        case ast.Call(func=ast.Attribute(attr="format", value=ast.Constant(value=str(text)))):
            yield from re.split(r"\{[^{}]*\}", text)


def _start_without_parameters(package: Package, entity: Endpoint) -> StartedNode | None:
    """Return where a launch file starts the node of an entity with the defaults of parameters."""
    if entity.owner is None or entity.is_conditional:
        return None
    for started in started_nodes(package):
        owner = started.owner(package)
        is_bare = not (started.has_parameters or started.has_more_parameters)
        if owner is None or not is_bare or not started.is_certain:
            continue
        if owner.definition(package).location == entity.owner.location:
            return started
    return None


def _has_gap(name: str) -> bool:
    """Return whether a part of a name is empty."""
    return not name or "//" in name or name.endswith("/")
