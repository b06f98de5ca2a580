"""ND122: results of goals are requested."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, RclpyRule, Severity
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "from example_interfaces.action import Fibonacci\n"
    "from rclpy.action import ActionClient\nfrom rclpy.node import Node\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.client = ActionClient(self, Fibonacci, 'count')\n\n"
    "    def send(self):\n"
    "        self.client.wait_for_server()\n"
    "        future = self.client.send_goal_async(Fibonacci.Goal())\n"
    "        future.add_done_callback(self.on_response)\n\n"
    "    def on_response(self, future):\n"
    "        {}\n\n"
    "    def on_result(self, future):\n"
    "        self.result = future.result().result\n"
)


class ResultNeverAsked(RclpyRule):
    """A node has a callback for the results of its goals, but never requests a result.

    **Why.** The future of ``send_goal_async`` is done when the goal is accepted; the result must be
    requested separately: the callback is never called.

    **Fix.** Call ``goal_handle.get_result_async().add_done_callback(self.on_result)``.

    **Source.** ROS 2 documentation, "Writing an action server and client (Python)".
    """

    code = "ND122"
    name = "result-never-asked"
    severity = Severity.WARNING
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example(
            "requests the result",
            {
                "caller.py": _NODE.format(
                    "future.result().get_result_async().add_done_callback(self.on_result)"
                )
            },
        ),
        Example(
            "does not request the result",
            {"caller.py": _NODE.format("self.handle = future.result()")},
            "19:9: 'on_result' is never called, because the result is never requested; call "
            "goal_handle.get_result_async().add_done_callback(self.on_result)",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.module.mentions("send_goal_async") or file.module.in_tests:
            return
        if any(package.modules(mentioning=("get_result",))):
            return
        for node in file.classes:
            for name, method in node.methods.items():
                if "result" not in name or len(method.args.args) != _WITH_FUTURE:
                    continue
                if method.decorator_list:
                    continue
                if not package.is_mentioned_once(name, file.module.path):
                    continue
                message = (
                    f"{name!r} is never called, because the result is never requested; call "
                    f"goal_handle.get_result_async().add_done_callback(self.{name})"
                )
                yield self.report(file.module.name_location(method), message)


_WITH_FUTURE = 2
"""Parameters of such a callback: ``self`` and the future."""
