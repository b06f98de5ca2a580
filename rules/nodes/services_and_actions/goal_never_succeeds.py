"""ND068: accepted goals are executed, and their state is set."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule
from scaffold.api.python import FunctionNode
from scaffold.api.rclpy import ActionServer, Callback, RclpyFile, worker

_ENDS = frozenset({"abort", "canceled"})
_FUNCTIONS = (ast.FunctionDef, ast.AsyncFunctionDef)
_MAX_DEPTH = 3
"""The maximum number of functions to follow a goal handle through."""
_NODE = (
    "from example_interfaces.action import Fibonacci\nfrom rclpy.action import ActionServer\n"
    "from rclpy.node import Node\n\n\n"
    "class Server(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('server')\n"
    "        self.server = ActionServer(self, Fibonacci, 'count', self.work)\n\n"
    "    def work(self, goal_handle):\n"
    "        if goal_handle.is_cancel_requested:\n"
    "            goal_handle.canceled()\n"
    "            return Fibonacci.Result()\n"
    "{}"
    "        return Fibonacci.Result()\n"
)
_ASKED = "is_cancel_requested"
_NODE_ACCEPTED = (
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


class GoalNeverSucceeds(RclpyRule):
    """An execute callback returns without setting the goal state, or is never called.

    **Why.** rclpy treats the goal as failed: "Goal state not set, assuming aborted"; the client
    gets ``STATUS_ABORTED``, with the result. A ``handle_accepted_callback`` replaces the default,
    which calls ``goal_handle.execute()``: the goal is accepted, but never executed.

    **Fix.** Call ``goal_handle.succeed()`` before returning the result, or ``canceled()`` after a
    cancel request. In the ``handle_accepted_callback``, call ``goal_handle.execute()``, immediately
    or later.

    **Source.** ``rclpy/action/server.py``, ``_execute_goal``, ``default_handle_accepted_callback``.
    """

    code = "ND068"
    name = "goal-never-succeeds"
    examples = (
        Example("succeeds", {"server.py": _NODE.format("        goal_handle.succeed()\n")}),
        Example("aborts", {"server.py": _NODE.format("        goal_handle.abort()\n")}),
        Example(
            "passes the goal handle to a function",
            {"server.py": _NODE.format("        self.end(goal_handle)\n")},
        ),
        Example(
            "passes the goal handle to a function that aborts",
            {
                "server.py": _NODE.format("        self.end(goal_handle)\n")
                + "\n    def end(self, goal_handle):\n        goal_handle.abort()\n"
            },
        ),
        Example(
            "passes the goal handle to a function that sets no state",
            {
                "server.py": _NODE.format("        self.end(goal_handle)\n")
                + "\n    def end(self, goal_handle):\n"
                "        self.order = goal_handle.request.order\n"
            },
            "16:9: returns the result without succeed(): goals of the action server in line 9 end "
            "as aborted; call goal_handle.succeed() first",
        ),
        Example(
            "with and without canceled()",
            {
                "server.py": _NODE.format("        goal_handle.succeed()\n"),
                "other.py": _NODE.format("        goal_handle.succeed()\n").replace(
                    "goal_handle.canceled()", "self.get_logger().info('canceled')"
                ),
            },
            "other.py:14:13: returns after a cancel request without canceled(): the goal ends as "
            "aborted; call goal_handle.canceled() first",
        ),
        Example(
            "succeeds after canceled() and a break",
            {
                "server.py": "from example_interfaces.action import Fibonacci\n"
                "from rclpy.action import ActionServer\nfrom rclpy.node import Node\n\n\n"
                "class Server(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('server')\n"
                "        self.server = ActionServer(self, Fibonacci, 'count', self.work)\n\n"
                "    def work(self, goal_handle):\n"
                "        for step in range(10):\n"
                "            if goal_handle.is_cancel_requested:\n"
                "                goal_handle.canceled()\n"
                "                break\n"
                "        goal_handle.succeed()\n"
                "        return Fibonacci.Result()\n\n"
                "    def other(self, goal_handle):\n"
                "        while True:\n"
                "            if goal_handle.is_cancel_requested:\n"
                "                goal_handle.canceled()\n"
                "                break\n"
                "        if goal_handle.is_active:\n"
                "            goal_handle.succeed()\n"
                "        return Fibonacci.Result()\n"
            },
            "14:17: succeed() in line 16 follows: RCLError, and the client gets an empty result; "
            "return the result after canceled()",
        ),
        Example(
            "sets no state",
            {"server.py": _NODE.format("")},
            "15:9: returns the result without succeed(): goals of the action server in line 9 end "
            "as aborted; call goal_handle.succeed() first",
        ),
        Example("executed at once", {"server.py": _NODE_ACCEPTED.format("goal_handle.execute()")}),
        Example(
            "accepted, and never executed",
            {"server.py": _NODE_ACCEPTED.format("self.goal = goal_handle")},
            "10:75: 'start' never calls execute(): goals are accepted, but never executed; call "
            "goal_handle.execute()",
        ),
        Example(
            "executed elsewhere",
            {
                "server.py": _NODE_ACCEPTED.format("self.goal = goal_handle"),
                "worker.py": "def work(node):\n    node.goal.execute()\n",
            },
        ),
        Example(
            "a lambda that calls the function with the goal",
            {
                "server.py": _NODE.format("").replace(
                    "self.work)\n\n", "lambda goal: self.work(goal))\n\n"
                )
            },
            "15:9: returns the result without succeed(): goals of the action server in line 9 end "
            "as aborted; call goal_handle.succeed() first",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_state(package, file)
        yield from self._check_accepted(package, file)

    def _check_state(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if package.name == "rclpy":
            return
        for canceled, succeeded in _succeeding_after_cancel(file):
            line = file.module.location(succeeded).line
            message = (
                f"succeed() in line {line} follows: RCLError, and the client gets an empty result; "
                "return the result after canceled()"
            )
            yield self.report(file.module.location(canceled), message)
        for returned in _returned_uncanceled(file):
            message = (
                "returns after a cancel request without canceled(): the goal ends as aborted; "
                "call goal_handle.canceled() first"
            )
            yield self.report(file.module.location(returned), message)
        seen: set[FunctionNode] = set()
        if file.module.index.attributes("succeed"):
            return
        for server in file.action_servers:
            function = _execute_callback(file, server)
            if function is not None and function not in seen:
                seen.add(function)
                if _leaves_open(function):
                    line = server.location.line
                    message = (
                        "returns the result without succeed(): goals of the action server in line "
                        f"{line} end as aborted; call goal_handle.succeed() first"
                    )
                    yield self.report(file.module.location(function.body[-1]), message)

    def _check_accepted(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
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
                    f"accepted, but never executed; call goal_handle.execute()"
                )
                yield self.report(given, message)


def _returned_uncanceled(file: RclpyFile) -> Iterator[ast.Return]:
    """Yield the returns of an execute callback after a cancel request without ``canceled()``."""
    for server in file.action_servers:
        function = _execute_callback(file, server)
        if function is None or any(x.finalbody for x in file.module.below(function, ast.Try)):
            continue
        for test in file.module.below(function, ast.If):
            asks = isinstance(test.test, ast.Attribute) and test.test.attr == _ASKED
            last = test.body[-1]
            if asks and isinstance(last, ast.Return) and not _ends_in(file, test.body):
                yield last


def _succeeding_after_cancel(file: RclpyFile) -> Iterator[tuple[ast.stmt, ast.stmt]]:
    """Yield calls of ``canceled()`` after which the same goal certainly succeeds, with both."""
    for attribute in file.module.index.attributes("canceled"):
        call = file.module.parent(attribute)
        statement = file.module.parent(call) if isinstance(call, ast.Call) else None
        if isinstance(statement, ast.Expr) and not file.module.in_tests:
            goal = file.module.text(attribute.value)
            for following in _executed_after(file, statement):
                match following:
                    case ast.Expr(value=ast.Call(func=ast.Attribute(attr="succeed", value=other))):
                        if file.module.text(other) == goal:
                            yield statement, following
                        break


def _executed_after(file: RclpyFile, statement: ast.stmt) -> Iterator[ast.stmt]:
    """Yield the statements that are certainly executed after one in its function."""
    module = file.module
    node: ast.AST | None = statement
    while isinstance(node, ast.stmt) and not isinstance(node, _FUNCTIONS):
        parent = module.parent(node)
        block, at = module.index.place(node)
        if parent is None or block != "body":
            return
        for following in getattr(parent, block)[at + 1 :]:
            if isinstance(following, ast.Break):
                node = module.enclosing(following, ast.For, ast.While)
                break
            yield following
            if not isinstance(following, ast.Expr | ast.Assign | ast.AugAssign | ast.AnnAssign):
                return
        else:
            node = None if isinstance(parent, ast.For | ast.While) else parent


def _ends_in(file: RclpyFile, body: list[ast.stmt]) -> bool:
    """Return whether statements, or functions of the file that they call, may end a goal."""
    for statement in body:
        for node in ast.walk(statement):
            if isinstance(node, ast.Attribute) and node.attr in {*_ENDS, "succeed"}:
                return True
            function = file.callback(node.func).function if isinstance(node, ast.Call) else None
            if function is not None and any(
                isinstance(inner, ast.Attribute) and inner.attr in {*_ENDS, "succeed"}
                for reached in file.reached(function)
                for inner in ast.walk(reached)
            ):
                return True
    return False


def _execute_callback(file: RclpyFile, server: ActionServer) -> FunctionNode | None:
    """Return the execute callback, unless it passes the goal handle to other modules."""
    callback = worker(file, server.callback) if server.callback else None
    function = callback.function if callback else None
    if callback is None or function is None or isinstance(function, ast.Lambda):
        return None
    if callback is not server.callback and not _hands_on_the_goal(server.callback):
        return None
    arguments = [*function.args.posonlyargs, *function.args.args][int(callback.is_bound) :]
    if callback.is_partial or callback.is_called or function.decorator_list or not arguments:
        return None
    return function if _is_kept(file, function, arguments[0].arg) else None


def _hands_on_the_goal(callback: Callback | None) -> bool:
    """Return whether a lambda only passes the goal handle to a function."""
    match callback.function if callback else None:
        case ast.Lambda(
            args=ast.arguments(args=[ast.arg(arg=handle)]),
            body=ast.Call(args=[ast.Name(id=given)], keywords=[]),
        ):
            return given == handle
    return False


def _is_kept(file: RclpyFile, function: FunctionNode, name: str, depth: int = 0) -> bool:
    """Return whether a goal handle is only used in a function and its callees in the file."""
    for use in ast.walk(function):
        if not isinstance(use, ast.Name) or use.id != name:
            continue
        match file.module.parent(use):
            case ast.Attribute():
                continue
            case ast.Call(args=args, keywords=[]) as call if use in args and depth < _MAX_DEPTH:
                if not _stays_open(file, call, args.index(use), depth):
                    return False
            case _:
                return False
    return True


def _stays_open(file: RclpyFile, call: ast.Call, at: int, depth: int) -> bool:
    """Return whether a call of a function of the file does not end its goal."""
    callback = file.callback(call.func)
    function = callback.function
    if function is None or isinstance(function, ast.Lambda) or function.decorator_list:
        return False
    arguments = [*function.args.posonlyargs, *function.args.args][int(callback.is_bound) :]
    if at >= len(arguments) or any(isinstance(argument, ast.Starred) for argument in call.args):
        return False
    ends = (node for node in ast.walk(function) if isinstance(node, ast.Attribute))
    if any(node.attr in _ENDS for node in ends):
        return False
    return _is_kept(file, function, arguments[at].arg, depth + 1)


def _leaves_open(function: FunctionNode) -> bool:
    """Return whether the last statement returns a result without ending the goal."""
    last = function.body[-1]
    if not isinstance(last, ast.Return) or last.value is None:
        return False
    return not any(
        isinstance(node, ast.Attribute) and node.attr in _ENDS
        for statement in function.body
        if not isinstance(statement, ast.If | ast.For | ast.While)
        for node in ast.walk(statement)
    )


def _executes(package: Package) -> bool:
    """Return whether any code of the package calls or passes a method ``execute``."""
    return any(
        isinstance(attribute.ctx, ast.Load)
        for module in package.modules(mentioning=(".execute",))
        if not module.in_tests
        for attribute in module.index.attributes("execute")
    )
