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
        Example(
            "in a coroutine that the callback awaits",
            {
                "talker.py": _NODE.format("self.rest()")
                + "\n    async def rest(self):\n        await asyncio.sleep(0.1)\n"
            },
            "15:9: asyncio.sleep() needs an asyncio event loop, which rclpy does not run: "
            "RuntimeError",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if "asyncio.run" in file.module.source.text or "run_until" in file.module.source.text:
            return
        for call in _awaited(file):
            name = file.module.qualified_name(call.func)
            # sleep(0) only yields, which works in any event loop.
            waits = ast.unparse(call) != "asyncio.sleep(0)"
            if name in AWAITED and waits:
                message = (
                    f"{name}() needs an asyncio event loop, which rclpy does not run: RuntimeError"
                )
                yield self.report(file.module.location(file.module.parent(call) or call), message)


def _awaited(file: RclpyFile) -> Iterator[ast.Call]:
    """Yield the calls that callbacks await, also in the coroutines that these await."""
    awaited: dict[ast.AST | None, list[ast.Call]] = {}
    for node in file.module.walk(ast.Await):
        if isinstance(node.value, ast.Call):
            awaited.setdefault(file.function_of(node), []).append(node.value)
    pending = [callback.function for _, callback in file.callbacks]
    while pending:
        for call in awaited.pop(pending.pop(), ()):
            yield call
            pending.append(file.callback(call.func).function)
