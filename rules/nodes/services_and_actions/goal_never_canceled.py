"""ND114: goals can be canceled while they are executed."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, RclpyRule, Report, Severity
from scaffold.api.programs import spins_in_one_thread
from scaffold.api.python import FunctionNode, last_name
from scaffold.api.rclpy import GOAL_HANDLE, LOG_METHODS, ActionServer, RclpyFile, class_of

_WAITING = frozenset({"sleep", "wait", "sleep_for", "sleep_until"})
_NODE = (
    "import time\n\nfrom example_interfaces.action import Fibonacci\nimport rclpy\n"
    "from rclpy.action import ActionServer, CancelResponse\n"
    "from rclpy.executors import MultiThreadedExecutor\nfrom rclpy.node import Node\n\n\n"
    "class Server(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('server')\n"
    "        self.server = ActionServer(self, Fibonacci, 'count', self.work{0})\n\n"
    "    def work(self, goal_handle):\n"
    "        for _ in range(10):\n"
    "            if goal_handle.is_cancel_requested:\n"
    "                goal_handle.canceled()\n"
    "                return Fibonacci.Result()\n"
    "            time.sleep(1.0)\n"
    "        goal_handle.succeed()\n"
    "        return Fibonacci.Result()\n\n"
    "    def cancel(self, goal_handle):\n"
    "        return CancelResponse.ACCEPT\n\n\n"
    "def main():\n"
    "    rclpy.init()\n"
    "    rclpy.spin(Server(){1})\n"
)
_CANCEL = ", cancel_callback=self.cancel"
_THREADS = ", executor=MultiThreadedExecutor()"


class GoalNeverCanceled(RclpyRule):
    """An action server checks for cancel requests that it can never receive, or never checks.

    **Why.** Without a ``cancel_callback``, every cancel request is rejected. With one thread, the
    request is only processed after the goal is done, because the execute callback occupies the
    thread.

    **Fix.** Pass ``cancel_callback=self.cancel``, which returns ``CancelResponse.ACCEPT``, and spin
    with a ``MultiThreadedExecutor``, or use an ``async`` execute callback that awaits.

    **Source.** ``rclpy/action/server.py``, ``default_cancel_callback``; ros2/examples,
    ``minimal_action_server``.
    """

    code = "ND114"
    name = "goal-never-canceled"
    effect = Effect.WRONG_BEHAVIOR
    other_severities = {
        Severity.WARNING: "canceled() is called after an error: rclpy aborts the goal instead"
    }
    examples = (
        Example("two threads", {"server.py": _NODE.format(_CANCEL, _THREADS)}),
        Example(
            "one thread",
            {"server.py": _NODE.format(_CANCEL, "")},
            "17:16: never true in time: the only thread executes the goal and handles cancel "
            "requests afterward; use a MultiThreadedExecutor",
        ),
        Example(
            "a goal without a cancel request",
            {
                "server.py": _NODE.format(_CANCEL, _THREADS).replace(
                    "if goal_handle.is_cancel_requested:", "if self.failed:"
                )
            },
            "18:17: no cancel request was received: canceled() raises RCLError; check "
            "is_cancel_requested, or call abort()",
        ),
        Example(
            "a goal without a cancel request, after an error",
            {
                "server.py": _NODE.format(_CANCEL, _THREADS)
                .replace("if goal_handle.is_cancel_requested:", "try:")
                .replace(
                    "                goal_handle.canceled()\n",
                    "                self.move()\n            except OSError:\n"
                    "                goal_handle.canceled()\n",
                )
            },
            Report(
                "20:17",
                "no cancel request was received: canceled() raises RCLError; check "
                "is_cancel_requested, or call abort()",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a goal without a cancel request, in a coroutine that awaits nothing",
            {
                "server.py": _NODE.format(_CANCEL, _THREADS)
                .replace("if goal_handle.is_cancel_requested:", "if self.failed:")
                .replace("    def work", "    async def work")
            },
            "18:17: no cancel request was received: canceled() raises RCLError; check "
            "is_cancel_requested, or call abort()",
        ),
        Example(
            "a cancel callback that stores the request",
            {
                "server.py": _NODE.format(_CANCEL, _THREADS)
                .replace("if goal_handle.is_cancel_requested:", "if self.is_stopped():")
                .replace(
                    "        return CancelResponse",
                    "        self.stopped = True\n        return CancelResponse",
                )
                .replace(
                    "    def cancel(",
                    "    def is_stopped(self):\n        return self.stopped\n\n    def cancel(",
                )
            },
        ),
        Example(
            "requests that are accepted, and never checked",
            {
                "server.py": _NODE.format(_CANCEL, _THREADS)
                .replace("            if goal_handle.is_cancel_requested:\n", "")
                .replace("                goal_handle.canceled()\n", "")
                .replace("                return Fibonacci.Result()\n", "")
            },
            "13:89: cancel requests are accepted without effect: the execute callback never reads "
            "is_cancel_requested; check it in the loop, and call canceled()",
        ),
        Example(
            "canceled too early",
            {
                "server.py": _NODE.format(_CANCEL, _THREADS).replace(
                    "        return CancelResponse",
                    "        goal_handle.canceled()\n        return CancelResponse",
                )
            },
            "25:9: the goal is canceled only after the cancel callback: canceled() raises "
            "RCLError here; return CancelResponse.ACCEPT",
        ),
        Example(
            "all requests are rejected",
            {"server.py": _NODE.format("", _THREADS)},
            "17:16: never true: without a cancel_callback, rclpy rejects all cancel requests; "
            "pass cancel_callback",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_too_early(file)
        if not file.module.mentions("is_cancel_requested") or file.module.in_tests:
            yield from self._check_unasked(file)
            return
        for server in file.action_servers:
            asked = _where_asked(file, server)
            if asked is None:
                continue
            if not _has_cancel_callback(file, server):
                message = (
                    "never true: without a cancel_callback, rclpy rejects all cancel requests; "
                    "pass cancel_callback"
                )
                yield self.report(file.module.location(asked), message)
            elif spins_in_one_thread(file) and _waits(file, server):
                message = (
                    "never true in time: the only thread executes the goal and handles cancel "
                    "requests afterward; use a MultiThreadedExecutor"
                )
                yield self.report(file.module.location(asked), message)

    def _check_too_early(self, file: RclpyFile) -> Iterator[Diagnostic]:
        """Check the callbacks that accept or reject cancel requests."""
        for server in file.action_servers if not file.module.in_tests else ():
            given = server.argument("cancel_callback")
            function = file.callback(given.node).function if given is not None else None
            for call in _cancels(file, function) if function is not None else ():
                message = (
                    "the goal is canceled only after the cancel callback: canceled() raises "
                    "RCLError here; return CancelResponse.ACCEPT"
                )
                yield self.report(file.module.location(call), message)

    def _check_unasked(self, file: RclpyFile) -> Iterator[Diagnostic]:
        """Check a file that never reads ``is_cancel_requested``."""
        for server in file.action_servers if not file.module.in_tests else ():
            work = _execution(file, server)
            kept = _kept_on_cancel(file, server)
            used = (item for node in work for item in file.module.below(node, ast.Attribute))
            if any(item.attr in kept for item in used):
                continue
            canceled = [call for function in work for call in _cancels(file, function)]
            for call in canceled:
                message = (
                    "no cancel request was received: canceled() raises RCLError; "
                    "check is_cancel_requested, or call abort()"
                )
                is_after_error = any(
                    isinstance(parent, ast.ExceptHandler) for parent in file.module.parents(call)
                )
                severity = Severity.WARNING if is_after_error else None
                yield self.report(file.module.location(call), message, severity=severity)
            if not canceled:
                yield from self._check_ignored(file, server)

    def _check_ignored(self, file: RclpyFile, server: ActionServer) -> Iterator[Diagnostic]:
        """Check a server that accepts cancel requests and ignores them."""
        given = server.argument("cancel_callback")
        if given is not None and _accepts(file, given.node) and _only_reports(file, server):
            message = (
                "cancel requests are accepted without effect: the execute callback never "
                "reads is_cancel_requested; check it in the loop, and call canceled()"
            )
            yield self.report(given, message)


def _accepts(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether a cancel callback accepts requests and does nothing else but log."""
    function = file.callback(node).function
    if function is None:
        return False
    names = [
        file.module.qualified_name(item) for item in file.module.below(function, ast.Attribute)
    ]
    return "rclpy.action.CancelResponse.ACCEPT" in names and all(
        isinstance(call.func, ast.Attribute) and call.func.attr in {*LOG_METHODS, "get_logger"}
        for call in file.calls_in(function)
    )


def _only_reports(file: RclpyFile, server: ActionServer) -> bool:
    """Return whether an execute callback waits in a loop, with no other user of its goal handle."""
    function = server.callback.function if server.callback else None
    if function is None or not function.args.args or not _waits(file, server):
        return False
    handle = function.args.args[-1].arg
    return all(
        isinstance(file.module.parent(name), ast.Attribute)
        for name in file.module.below(function, ast.Name)
        if name.id == handle
    )


def _cancels(file: RclpyFile, function: FunctionNode | ast.Lambda) -> Iterator[ast.Call]:
    """Yield the calls of ``canceled()`` of goals in a function."""
    for call in file.calls_in(function):
        func = call.func
        if not isinstance(func, ast.Attribute) or func.attr != "canceled":
            continue
        if class_of(file, func.value) == GOAL_HANDLE:
            yield call


def _kept_on_cancel(file: RclpyFile, server: ActionServer) -> frozenset[str]:
    """Return the attributes that the cancel callback sets, which the work may check."""
    given = server.argument("cancel_callback")
    function = file.callback(given.node).function if given is not None else None
    names: set[str] = set()
    for item in file.module.below(function, ast.Attribute) if function is not None else ():
        if isinstance(item.ctx, ast.Store):
            names.add(item.attr)
        elif item.attr == "set" and isinstance(item.value, ast.Attribute):
            names.add(item.value.attr)  # an event
    return frozenset(names)


def _execution(file: RclpyFile, server: ActionServer) -> list[FunctionNode | ast.Lambda]:
    """Return the execute callback and its callees; empty if it may yield to other callbacks."""
    function = server.callback.function if server.callback else None
    if function is None or _gives_way(file, function):
        return []
    return [*file.reached(function)]


def _gives_way(file: RclpyFile, function: FunctionNode | ast.Lambda) -> bool:
    """Return whether the executor may run other callbacks before a callback is done."""
    return isinstance(function, ast.AsyncFunctionDef) and any(
        file.module.below(function, ast.Await, ast.AsyncFor, ast.AsyncWith)
    )


def _where_asked(file: RclpyFile, server: ActionServer) -> ast.Attribute | None:
    work = _execution(file, server)
    for asked in file.module.index.attributes("is_cancel_requested"):
        if file.function_of(asked) in work:
            return asked
    return None


def _has_cancel_callback(file: RclpyFile, server: ActionServer) -> bool:
    return (
        server.argument("cancel_callback") is not None
        or server.has_unknown_arguments
        or file.module.mentions("register_cancel_callback")
    )


def _waits(file: RclpyFile, server: ActionServer) -> bool:
    """Return whether the work on a goal takes time: it waits in a loop."""
    for function in _execution(file, server):
        for call in file.calls_in(function):
            if last_name(call.func) in _WAITING and any(
                isinstance(parent, ast.For | ast.While) for parent in file.module.parents(call)
            ):
                return True
    return False
