"""ND034: waits for servers have a timeout."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.programs import in_callbacks, in_constructors
from scaffold.api.rclpy import RclpyFile

WAITS = frozenset({"wait_for_service", "wait_for_server"})
_NODE = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.client = self.create_client(Trigger, 'report')\n"
    "        self.client.wait_for_service({})\n"
)


class WaitWithoutTimeout(RclpyRule):
    """A constructor or callback waits for a server without a timeout.

    **Why.** Without the server, the node hangs silently: no log message, no other callback.

    **Fix.** Pass ``timeout_sec``, and log what is missing.

    **Source.** rclpy, ``Client.wait_for_service``; ROS 2 documentation, "Writing a simple service
    and client (Python)".
    """

    code = "ND034"
    name = "wait-without-timeout"
    severity = Severity.WARNING
    examples = (
        Example("with a timeout", {"caller.py": _NODE.format("timeout_sec=1.0")}),
        Example(
            "without a timeout",
            {"caller.py": _NODE.format("")},
            Report(
                "caller.py:9:9",
                "wait_for_service() without timeout_sec blocks the constructor of "
                "Caller until the server is available",
            ),
        ),
    )

    def check_file(self, facts: RclpyFile) -> Iterator[Diagnostic]:
        seen: set[ast.AST] = set()
        for function, origin in (*in_constructors(facts), *in_callbacks(facts)):
            for call in facts.calls_in(function):
                match call:
                    case ast.Call(func=ast.Attribute(attr=name), args=[], keywords=[]):
                        if name in WAITS and call not in seen:
                            seen.add(call)
                            message = f"{name}() without timeout_sec blocks {origin} until the"
                            at = facts.module.location(call)
                            yield self.report(at, f"{message} server is available")
