"""ND116: servers are known before something is sent to them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.programs import in_constructors
from scaffold.api.rclpy import RclpyFile, class_of

_SENDING = {
    "send_goal_async": ("rclpy.action.client.ActionClient", "goal", "wait_for_server()"),
    "call_async": ("rclpy.client.Client", "request", "wait_for_service()"),
}
_ASKING = ("wait_for_server", "server_is_ready", "wait_for_service", "service_is_ready")
_NODE = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.client = self.create_client(Trigger, 'reset')\n"
    "{}"
    "        self.future = self.client.call_async(Trigger.Request())\n"
)


class SentBeforeKnown(RclpyRule):
    """The constructor of a node sends a goal or a request with a client that it has just made.

    **Why.** The client does not know the server yet, so the message is lost: the future is never
    done, without any error.

    **Fix.** ``self.client.wait_for_server(timeout_sec=5.0)``, or send it from a timer when
    ``server_is_ready()``.

    **Source.** ROS 2 documentation, "Writing an action server and client (Python)".
    """

    code = "ND116"
    name = "sent-before-known"
    examples = (
        Example(
            "waits", {"caller.py": _NODE.format("        self.client.wait_for_service(5.0)\n")}
        ),
        Example(
            "again and again",
            {
                "caller.py": _NODE.format("").replace(
                    "        self.future =",
                    "        for _ in range(9):\n            self.call()\n\n"
                    "    def call(self):\n        self.future =",
                )
            },
        ),
        Example(
            "at once",
            {"caller.py": _NODE.format("")},
            Report(
                "9:23",
                "the request is sent before the server is known: it is lost, and "
                "the future is never done; call wait_for_service() first",
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.module.mentions(*_SENDING) or file.module.mentions(*_ASKING):
            return
        for executed in in_constructors(file):
            for call in file.calls_in(executed.function):
                func = call.func
                if not isinstance(func, ast.Attribute) or func.attr not in _SENDING:
                    continue
                class_, what, wait = _SENDING[func.attr]
                if class_of(file, func.value) == class_ and not _is_repeated(file, call):
                    message = (
                        f"the {what} is sent before the server is known: it is lost, and the "
                        f"future is never done; call {wait} first"
                    )
                    yield self.report(file.module.location(call), message)


def _is_repeated(file: RclpyFile, call: ast.Call) -> bool:
    """Tell whether a loop sends it again, here or where the function is called."""
    module = file.module
    function = module.enclosing_function(call)
    name = function.name if function is not None else ""
    callers = (
        item
        for item in module.walk(ast.Call)
        if isinstance(item.func, ast.Attribute) and item.func.attr == name != "__init__"
    )
    return any(
        isinstance(parent, ast.For | ast.While)
        for item in (call, *callers)
        for parent in module.parents(item)
    )
