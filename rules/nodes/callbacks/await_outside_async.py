"""ND053: await is used in async functions only."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, PythonRule
from scaffold.api.python import PythonModule

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Caller(Node):\n"
    "    {}def ask(self):\n"
    "        await self.client.call_async(self.request)\n"
)


class AwaitOutsideAsync(PythonRule):
    """``await`` is used in a function that is not ``async``.

    **Why.** The file does not compile: ``SyntaxError: 'await' outside async function``. colcon does
    not report it; the node fails at start.

    **Fix.** Write ``async def``; rclpy supports async callbacks.

    **Source.** Python documentation, "Await expression"; rclpy, ``executors.py``.
    """

    code = "ND053"
    name = "await-outside-async"
    examples = (
        Example("async", {"caller.py": _NODE.format("async ")}),
        Example(
            "not async",
            {"caller.py": _NODE.format("")},
            "6:9: 'await' outside of an async function: SyntaxError; write async def",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for node in module.walk(ast.Await):
            for parent in module.parents(node):
                if isinstance(parent, ast.AsyncFunctionDef):
                    break
                if isinstance(parent, ast.FunctionDef | ast.Lambda | ast.Module):
                    message = "'await' outside of an async function: SyntaxError; write async def"
                    yield self.report(module.location(node), message)
                    break
