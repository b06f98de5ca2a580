"""ND120: callbacks do not hide all errors."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, RclpyRule, Severity
from scaffold.api.python import FunctionNode
from scaffold.api.rclpy import (
    Callback,
    RclpyFile,
    Service,
    Subscription,
    Synchronizer,
    Timer,
    worker,
)

_ALL = frozenset({"Exception", "BaseException"})
_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Listener(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('listener')\n"
    "        self.create_subscription(String, 'chatter', self.hear, 10)\n\n"
    "    def hear(self, msg):\n"
    "        try:\n"
    "            self.publish(int(msg.data))\n"
    "        except {}:\n"
    "            {}\n"
)


class ErrorsDropped(RclpyRule):
    """A callback catches all exceptions and ignores them.

    **Why.** A misspelled name, a wrong type or a missing transform drops every message without an
    error: the node seems to run, but does nothing.

    **Fix.** Catch the expected exceptions, such as ``ValueError``, and log them:
    ``self.get_logger().error(f'...: {error}', throttle_duration_sec=5.0)``.

    **Source.** PEP 8, "Programming recommendations".
    """

    code = "ND120"
    name = "errors-dropped"
    severity = Severity.WARNING
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("an expected exception", {"listener.py": _NODE.format("ValueError", "pass")}),
        Example(
            "logged",
            {"listener.py": _NODE.format("Exception as e", "self.get_logger().error(str(e))")},
        ),
        Example(
            "all exceptions",
            {"listener.py": _NODE.format("Exception", "pass")},
            "13:9: callback 'hear' ignores all exceptions: errors in it are never reported; log "
            "the exception",
        ),
        Example(
            "the method that a lambda calls",
            {
                "orders.py": "import json\n\nfrom rclpy.node import Node\n"
                "from std_msgs.msg import String\n\n\n"
                "class Orders(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('orders')\n"
                "        self.create_subscription(\n"
                "            String, 'orders', lambda msg: self.take(msg.data), 10)\n\n"
                "    def take(self, text):\n"
                "        try:\n"
                "            self.order = json.loads(text)['order']\n"
                "        except Exception:\n"
                "            pass\n"
            },
            "16:9: callback 'take' ignores all exceptions: errors in it are never reported; log "
            "the exception",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        seen: set[ast.AST] = set()
        for entity, given in file.callbacks:
            if not isinstance(entity, Subscription | Synchronizer | Service | Timer):
                continue
            callback = worker(file, given)
            function = callback.function
            if function in seen or not isinstance(function, FunctionNode):
                continue
            seen.add(function)
            for dropping in _dropping(function, callback):
                message = (
                    f"callback {function.name!r} ignores all exceptions: errors in it are never "
                    f"reported; log the exception"
                )
                yield self.report(file.module.location(dropping), message)


def _dropping(function: FunctionNode, callback: Callback) -> Iterator[ast.AST]:
    """Yield handlers and ``suppress`` calls that drop all errors of a callback's work."""
    last = function.body[-1]
    if not isinstance(last, ast.Try | ast.With) or not _is_work(function, callback, last.body):
        return
    if isinstance(last, ast.Try):
        for handler in last.handlers:
            if _catches_all(handler) and all(map(_does_nothing, handler.body)):
                yield handler
        return
    for item in last.items:
        match item.context_expr:
            case ast.Call(func=func, args=[ast.Name(id=name)]) if name in _ALL:
                if ast.unparse(func).endswith("suppress"):
                    yield item.context_expr


def _is_work(function: FunctionNode, callback: Callback, body: list[ast.stmt]) -> bool:
    """Return whether statements use the callback's arguments, or are its whole body."""
    arguments = [*function.args.posonlyargs, *function.args.args][int(callback.is_bound) :]
    names = {argument.arg for argument in arguments}
    if not names:
        return all(isinstance(statement, ast.Expr) for statement in function.body[:-1])
    return any(
        isinstance(node, ast.Name) and node.id in names
        for statement in body
        for node in ast.walk(statement)
    )


def _catches_all(handler: ast.ExceptHandler) -> bool:
    match handler.type:
        case None:
            return True
        case ast.Name(id=name):
            return name in _ALL
    return False


def _does_nothing(statement: ast.stmt) -> bool:
    match statement:
        case ast.Pass() | ast.Continue() | ast.Return(value=None):
            return True
        case ast.Return(value=ast.Constant(value=None)) | ast.Expr(value=ast.Constant()):
            return True
    return False
