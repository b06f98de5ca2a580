"""ND035: callbacks created in a loop bind the loop variable."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, RclpyRule
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Listener(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('listener')\n"
    "        for name in ('left', 'right'):\n"
    "            self.create_subscription(String, name, {}, 10)\n\n"
    "    def hear(self, message, name):\n        pass\n"
)


class LoopVariableInLambda(RclpyRule):
    """A lambda created in a loop reads the loop variable only when it is called.

    **Why.** By then, the loop has ended: all callbacks get the last value.

    **Fix.** Bind it: ``lambda message, name=name: ...``, or use ``functools.partial``.

    **Source.** Python documentation, "Why do lambdas defined in a loop with different values all
    return the same result?".
    """

    code = "ND035"
    name = "loop-variable-in-lambda"
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("bound", {"listener.py": _NODE.format("lambda m, name=name: self.hear(m, name)")}),
        Example(
            "not bound",
            {"listener.py": _NODE.format("lambda m: self.hear(m, name)")},
            "9:52: 'name' is read when the lambda is called: all callbacks get the last value; "
            "bind it: name=name",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for _, callback in file.callbacks:
            function = callback.function
            if isinstance(function, ast.Lambda) and callback.node is function:
                name = _late_name(file, function)
                if name:
                    message = (
                        f"{name!r} is read when the lambda is called: all callbacks get the last"
                    )
                    yield self.report(callback, f"{message} value; bind it: {name}={name}")


def _late_name(file: RclpyFile, function: ast.Lambda) -> str:
    """Return a variable of an enclosing loop that a lambda reads; empty if there is none."""
    given = {arg.arg for arg in ast.walk(function.args) if isinstance(arg, ast.arg)}
    read = {
        node.id
        for node in ast.walk(function.body)
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Load)
    }
    for parent in file.module.parents(function):
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            break
        if isinstance(parent, ast.For) and not _may_end_early(parent):
            names = {node.id for node in ast.walk(parent.target) if isinstance(node, ast.Name)}
            late = sorted((names & read) - given)
            if late:
                return late[0]
    return ""


def _may_end_early(loop: ast.For) -> bool:
    """Return whether a loop may end in its first iteration."""
    return any(isinstance(node, ast.Break | ast.Return) for node in ast.walk(loop))
