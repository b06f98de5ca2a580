"""ND058: callbacks do not block on services."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.programs import has_more_threads, in_callbacks, in_constructors
from scaffold.api.rclpy import RclpyFile, class_of

_NODE = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.client = self.create_client(Trigger, 'reset')\n"
    "        self.create_timer(1.0, self.ask)\n\n"
    "    def ask(self):\n"
    "{}"
)
_BLOCKING = {
    "call": ("rclpy.client.Client", "a service response"),
    "send_goal": ("rclpy.action.client.ActionClient", "an action result"),
    "get_result": ("rclpy.action.client.ClientGoalHandle", "an action result"),
}


class CallInCallback(RclpyRule):
    """A callback or constructor calls a service and blocks until the response.

    **Why.** The executor receives the response, but waits for the callback: the node hangs
    forever, without an error.

    **Fix.** ``call_async`` with ``add_done_callback``, or an ``async`` callback that awaits.

    **Source.** ROS 2 documentation, "Synchronous vs. asynchronous service clients".
    """

    code = "ND058"
    name = "call-in-callback"
    examples = (
        Example(
            "asynchronous",
            {
                "caller.py": _NODE.format(
                    "        future = self.client.call_async(Trigger.Request())\n"
                    "        future.add_done_callback(print)\n"
                )
            },
        ),
        Example(
            "a call",
            {"caller.py": _NODE.format("        self.client.call(Trigger.Request())\n")},
            Report(
                "12:9",
                "waits for a service response in callback 'ask': deadlock, no "
                "response is processed meanwhile",
            ),
        ),
        Example(
            "an action",
            {
                "caller.py": "from rclpy.action import ActionClient\n"
                + _NODE.format(
                    "        ActionClient(self, Count, 'count').send_goal(Count.Goal())\n"
                )
            },
            Report(
                "13:9",
                "waits for an action result in callback 'ask': deadlock, no "
                "response is processed meanwhile",
            ),
        ),
        Example(
            "a loop",
            {
                "caller.py": _NODE.format(
                    "        future = self.client.call_async(Trigger.Request())\n"
                    "        while not future.done():\n            pass\n"
                )
            },
            Report(
                "13:9",
                "busy-waits for a future in callback 'ask': deadlock, no response "
                "is processed meanwhile",
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if has_more_threads(file):
            return
        seen: set[ast.AST] = set()
        for executed in (*in_callbacks(file), *in_constructors(file)):
            for node, what in _waits(file, executed.function):
                if node not in seen:
                    seen.add(node)
                    message = (
                        f"{what} in {executed.origin}: deadlock, no response is processed meanwhile"
                    )
                    yield self.report(file.module.location(node), message)


def _waits(file: RclpyFile, function: ast.AST) -> Iterator[tuple[ast.AST, str]]:
    for node in file.module.below(function, ast.Call, ast.While):
        match node:
            case ast.Call(func=ast.Attribute(attr=method, value=asked)) if method in _BLOCKING:
                class_, what = _BLOCKING[method]
                if class_of(file, asked) == class_:
                    yield node, f"waits for {what}"
            case ast.While(test=ast.UnaryOp(op=ast.Not(), operand=ast.Call(func=func))):
                if isinstance(func, ast.Attribute) and _loops_until_done(file, func, node):
                    yield node, "busy-waits for a future"


def _loops_until_done(file: RclpyFile, func: ast.Attribute, loop: ast.AST) -> bool:
    if func.attr != "done" or "spin" in ast.unparse(loop):
        return False
    return class_of(file, func.value) == "rclpy.task.Future"
