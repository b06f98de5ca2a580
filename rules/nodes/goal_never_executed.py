"""ND115: accepted goals are executed."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "from example_interfaces.action import Fibonacci\n"
    "from rclpy.action import ActionServer\nfrom rclpy.node import Node\n\n\n"
    "class Server(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('server')\n"
    "        self.server = ActionServer(\n"
    "            self, Fibonacci, 'count', self.work, handle_accepted_callback=self.start)\n\n"
    "    def start(self, goal_handle):\n"
    "        {}\n\n"
    "    def work(self, goal_handle):\n"
    "        goal_handle.succeed()\n"
    "        return Fibonacci.Result()\n"
)


class GoalNeverExecuted(RclpyRule):
    """A ``handle_accepted_callback`` is given, and nothing calls ``execute()`` of the goal.

    **Why.** The goal is accepted, and nothing happens: the callback replaces what rclpy does on
    its own, which is ``goal_handle.execute()``.

    **Fix.** Call ``goal_handle.execute()``, at once or later.

    **Source.** ``rclpy/action/server.py``, ``default_handle_accepted_callback``.
    """

    code = "ND115"
    name = "goal-never-executed"
    examples = (
        Example("at once", {"server.py": _NODE.format("goal_handle.execute()")}),
        Example(
            "never",
            {"server.py": _NODE.format("self.goal = goal_handle")},
            Report(
                "10:75",
                "'start' never calls execute(): goals are accepted, and nothing "
                "happens; call goal_handle.execute()",
            ),
        ),
        Example(
            "elsewhere",
            {
                "server.py": _NODE.format("self.goal = goal_handle"),
                "worker.py": "def work(node):\n    node.goal.execute()\n",
            },
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if file.module.in_tests:
            return
        for server in file.action_servers:
            given = server.argument("handle_accepted_callback")
            callback = file.callback(given.node) if given is not None else None
            if given is None or callback is None or callback.function is None:
                continue
            if not _executes(package):
                message = (
                    f"{callback.name or 'this callback'!r} never calls execute(): goals are "
                    "accepted, and nothing happens; call goal_handle.execute()"
                )
                yield self.report(given, message)


def _executes(package: Package) -> bool:
    """Return whether any code of the package calls, or passes on, ``execute`` of something."""
    return any(
        isinstance(attribute.ctx, ast.Load)
        for module in package.modules(mentioning=(".execute",))
        if not module.in_tests
        for attribute in module.index.attributes("execute")
    )
