"""NM002: names of nodes and namespaces are accepted."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile, namespace_problem, node_problem

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__({})\n"
)


class NodeNameInvalid(RclpyRule):
    """A node or its namespace has a name that ROS 2 does not accept.

    **Why.** ``rclpy.exceptions.InvalidNodeNameException`` or ``InvalidNamespaceException`` at
    start. A namespace does not belong into the name of the node.

    **Fix.** Use letters, digits and ``_``, and begin with a letter.

    **Source.** ``rmw/validate_node_name.c``; ``rmw/validate_namespace.c``.
    """

    code = "NM002"
    name = "node-name-invalid"
    examples = (
        Example("accepted", {"talker.py": _NODE.format("'talker', namespace='left/arm'")}),
        Example(
            "a namespace in it",
            {"talker.py": _NODE.format("'left/talker'")},
            Report("6:26", "ROS 2 refuses the node name 'left/talker': '/' is not allowed"),
        ),
        Example(
            "a namespace with a dash",
            {"talker.py": _NODE.format("'talker', namespace='left-arm'")},
            Report("6:26", "ROS 2 refuses the namespace 'left-arm': '-' is not allowed"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.nodes:
            at = node.node_name_location
            if isinstance(node.node_name, str) and at.path == file.module.path:
                problem = node_problem(node.node_name)
                if problem:
                    message = f"ROS 2 refuses the node name {node.node_name!r}: {problem}"
                    yield self.report(at, message)
            if isinstance(node.namespace, str):
                problem = namespace_problem(node.namespace)
                if problem:
                    message = f"ROS 2 refuses the namespace {node.namespace!r}: {problem}"
                    yield self.report(at, message)
