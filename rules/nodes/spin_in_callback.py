"""ND033: callbacks do not spin their own node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.programs import in_callbacks
from scaffold.api.rclpy import RclpyFile

MOST = 2
"""Number of arguments without an executor: the node, and a future."""
_NODE = (
    "import rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.create_timer(1.0, self.ask)\n\n"
    "    def ask(self):\n"
    "        future = self.client.call_async(self.request)\n"
    "        {}\n\n"
    "    def answer(self, future):\n        pass\n"
)


class SpinInCallback(RclpyRule):
    """A callback spins its own node.

    **Why.** ``rclpy.spin_...`` moves the node to another executor and removes it from there when
    done: the first call works, and after that no callback of the node runs.

    **Fix.** Use ``future.add_done_callback``, or an ``async`` callback that awaits the future.

    **Source.** rclpy issue 1313; ROS 2 documentation, "Synchronous vs. asynchronous service
    clients".
    """

    code = "ND033"
    name = "spin-in-callback"
    examples = (
        Example("a callback", {"caller.py": _NODE.format("future.add_done_callback(self.answer)")}),
        Example(
            "a spin",
            {"caller.py": _NODE.format("rclpy.spin_until_future_complete(self, future)")},
            Report(
                "12:9",
                "rclpy.spin_until_future_complete(self) runs in callback 'ask' of "
                "the same node: no callback runs after that",
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for function, origin, _ in in_callbacks(file):
            for call in file.spin_calls:
                if call.name.startswith("executor.") or len(call.call.args) > MOST:
                    continue
                node = call.call.args[0] if call.call.args else None
                if file.function_of(call.call) is not function or call.call.keywords:
                    continue
                if not isinstance(node, ast.Name) or not file.evaluator.self_class(node):
                    continue
                message = f"rclpy.{call.name}({node.id}) runs in {origin} of the same node"
                yield self.report(call, f"{message}: no callback runs after that")
