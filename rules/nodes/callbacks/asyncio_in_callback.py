"""ND020: coroutines of rclpy await rclpy futures only."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule
from scaffold.api.rclpy import RclpyFile

AWAITED = ("asyncio.sleep", "asyncio.wait", "asyncio.wait_for", "asyncio.gather")
_NODE = (
    "import asyncio\n\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    async def tick(self):\n"
    "        await {}\n"
)


class AsyncioInCallback(RclpyRule):
    """A callback awaits an asyncio function.

    **Why.** rclpy runs coroutines itself, without an asyncio event loop: ``RuntimeError: no
    running event loop``.

    **Fix.** Await an rclpy Future, or use a timer.

    **Source.** rclpy issue 1313; ``rclpy/task.py``.
    """

    code = "ND020"
    name = "asyncio-in-callback"
    examples = (
        Example("an rclpy future", {"talker.py": _NODE.format("self.client.call_async(None)")}),
        Example("no await", {"talker.py": _NODE.format("asyncio.sleep(0)")}),
        Example(
            "asyncio",
            {"talker.py": _NODE.format("asyncio.sleep(0.1)")},
            "12:9: asyncio.sleep() needs an asyncio event loop, which rclpy does not run: "
            "RuntimeError",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        functions = {id(callback.function) for _, callback in file.callbacks}
        if "asyncio.run" in file.module.source.text or "run_until" in file.module.source.text:
            return
        for node in file.module.walk(ast.Await):
            function = file.module.enclosing_function(node)
            if id(function) not in functions or not isinstance(node.value, ast.Call):
                continue
            name = file.module.qualified_name(node.value.func)
            # sleep(0) only yields, which works in any event loop.
            waits = ast.unparse(node.value) != "asyncio.sleep(0)"
            if name in AWAITED and waits:
                message = (
                    f"{name}() needs an asyncio event loop, which rclpy does not run: RuntimeError"
                )
                yield self.report(file.module.location(node), message)
