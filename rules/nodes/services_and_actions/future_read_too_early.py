"""ND021: the result of a call is read after the future is done."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.python import (
    FunctionNode,
    PythonModule,
    conditions_on,
    is_handled,
    is_none_literal,
)
from scaffold.api.rclpy import RclpyFile

CALLS = frozenset({"call_async", "send_goal_async", "get_result_async", "cancel_goal_async"})
WAITS = frozenset({"spin_until_future_complete", "spin_once", "done", "wait", "spin", "join"})
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Caller(Node):\n"
    "    def ask(self):\n"
    "        future = self.client.call_async(self.request)\n"
    "        {}\n\n"
    "    def answer(self, future):\n"
    "        return future.result().success\n"
)


class FutureReadTooEarly(RclpyRule):
    """The result of an asynchronous call is read right after the call, or after a timeout.

    **Why.** No response has arrived yet: ``result()`` returns None, and ``AttributeError:
    'NoneType' object has no attribute ...`` follows.

    **Fix.** Read it in ``future.add_done_callback``, or ``await`` the future.

    **Source.** ROS 2 documentation, "Synchronous vs. asynchronous service clients".
    """

    code = "ND021"
    name = "future-read-too-early"
    other_severities = {
        Severity.WARNING: "a wait with a timeout comes first, or the result is not used"
    }
    examples = (
        Example(
            "when the future is done",
            {"caller.py": _NODE.format("future.add_done_callback(self.answer)")},
        ),
        Example(
            "a done callback that makes the next call",
            {
                "caller.py": _NODE.format("future.add_done_callback(self.answer)").replace(
                    "        return future.result().success\n",
                    "        if future.result().success:\n"
                    "            future = self.client.call_async(self.request)\n"
                    "            future.add_done_callback(self.answer)\n",
                )
            },
        ),
        Example(
            "an attribute that is read after the call in another way",
            {
                "caller.py": _NODE.format(
                    "self.sent = self.client.call_async(self.request)\n"
                    "        if self.sent.done():\n            return self.answer(self.sent)"
                )
            },
        ),
        Example(
            "an attribute that is read right after the call",
            {
                "caller.py": _NODE.format(
                    "if self.sent.done():\n"
                    "            self.sent = self.client.call_async(self.request)\n"
                    "            self.answer(self.sent)"
                )
            },
            "9:13: 'self.sent' is not done here: result() returns None; use add_done_callback()",
        ),
        Example(
            "right after the call",
            {"caller.py": _NODE.format("return future.result()")},
            "7:16: 'future' is not done here: result() returns None; use add_done_callback()",
        ),
        Example(
            "a result that is not used",
            {"caller.py": _NODE.format("future.result()")},
            Report(
                "7:9",
                "'future' is not done here: result() returns None; use add_done_callback()",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "after a wait with a timeout, with and without a check",
            {
                f"{name}.py": "import rclpy\n"
                + _NODE.format(
                    "rclpy.spin_until_future_complete(self, future, timeout_sec=1.0)\n"
                    f"        answer = future.result()\n{test}"
                    "        return answer.success"
                )
                for name, test in {
                    "asked": "        if answer is None:\n            return False\n",
                    "not_asked": "",
                }.items()
            },
            Report(
                "not_asked.py:10:16",
                "answer may be None here: the wait has a timeout; check done() first",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "in the callback, called directly",
            {"caller.py": _NODE.format("self.answer(future)")},
            "7:9: 'future' is not done here: result() returns None; use add_done_callback()",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for function in file.module.function_nodes:
            for read, text in _unchecked_reads(file, function):
                message = f"{text} may be None here: the wait has a timeout; check done() first"
                yield self.report(file.module.location(read), message, severity=Severity.WARNING)
            for name, line in _futures(file.module, function).items():
                if _waits(file.module, function, line):
                    continue
                for call in file.calls_in(function):
                    if call.lineno < line:
                        continue  # another future, passed to a done callback
                    is_read = self._reads_result(file, call, name)
                    if is_read and not _is_asked(file, call, name, line):
                        at = file.module.location(call)
                        message = f"{name!r} is not done here: result() returns None; "
                        message += "use add_done_callback()"
                        is_dropped = isinstance(file.module.parent(call), ast.Expr)
                        severity = Severity.WARNING if is_dropped and not call.args else None
                        yield self.report(at, message, severity=severity)

    def _reads_result(self, file: RclpyFile, call: ast.Call, name: str) -> bool:
        match call.func:
            case ast.Attribute(value=ast.Name() | ast.Attribute() as owner, attr="result"):
                return ast.unparse(owner) == name
        if not any(ast.unparse(arg) == name for arg in call.args):
            return False
        callback = file.callback(call.func)
        function = callback.function
        if function is None or isinstance(function, ast.Lambda) or len(call.args) != 1:
            return False
        parameter = function.args.args[-1].arg if function.args.args else ""
        return not _waits(file.module, function) and any(
            isinstance(inner.func, ast.Attribute)
            and inner.func.attr == "result"
            and isinstance(inner.func.value, ast.Name)
            and inner.func.value.id == parameter
            for inner in file.calls_in(function)
        )


def _unchecked_reads(file: RclpyFile, function: FunctionNode) -> Iterator[tuple[ast.expr, str]]:
    """Yield fields of results that are read after a wait with a timeout, without a check."""
    for call in file.calls_in(function):
        match call.func:
            case ast.Attribute(attr="spin_until_future_complete"):
                futures = [arg.id for arg in call.args if isinstance(arg, ast.Name)][-1:]
            case _:
                continue
        is_limited = any(
            word.arg == "timeout_sec" and not is_none_literal(word.value) for word in call.keywords
        )
        for future in futures if is_limited else ():
            yield from _first_read(file, function, call, future)


def _first_read(
    file: RclpyFile, function: FunctionNode, wait: ast.Call, future: str
) -> Iterator[tuple[ast.expr, str]]:
    """Yield the first access to a field of the result of a future after a wait."""
    names = {future}
    for statement in file.module.below(function, ast.Assign):
        match statement:
            case ast.Assign(targets=[ast.Name(id=name)], value=value) if _is_result(value, future):
                names.add(name)
    tests = file.module.below(function, ast.If, ast.IfExp, ast.While, ast.Assert)
    asked = (
        node.id
        for holder in tests
        if isinstance(holder, ast.If | ast.IfExp | ast.While | ast.Assert)
        for node in ast.walk(holder.test)
        if isinstance(node, ast.Name)
    )
    if not names.isdisjoint(asked):
        return
    for read in file.module.below(function, ast.Attribute):
        value = read.value
        is_field = _is_result(value, future) or (
            isinstance(value, ast.Name) and value.id in names - {future}
        )
        if is_field and read.lineno > wait.lineno and file.function_of(read) is function:
            if not is_handled(file.module, read, "AttributeError"):
                yield read, file.module.text(value)
            return


def _is_result(node: ast.expr, future: str) -> bool:
    match node:
        case ast.Call(func=ast.Attribute(attr="result", value=ast.Name(id=name))):
            return name == future
    return False


def _is_asked(file: RclpyFile, call: ast.Call, name: str, line: int) -> bool:
    """Return whether a condition from a line on makes sure that the future is done."""
    conditions = [test for test in conditions_on(file.module, call) if test.lineno >= line]
    return any(name in ast.unparse(test) for test in conditions)


def _futures(module: PythonModule, function: FunctionNode) -> dict[str, int]:
    """Return the variables and attributes with the future of a call, and their lines."""
    names: dict[str, int] = {}
    for statement in module.below(function, ast.Assign):
        match statement:
            case ast.Assign(
                targets=[ast.Name() | ast.Attribute(value=ast.Name()) as target],
                value=ast.Call(func=ast.Attribute(attr=method)),
            ) if method in CALLS:
                names.setdefault(ast.unparse(target), statement.lineno)
    return names


def _waits(module: PythonModule, function: FunctionNode, line: int = 0) -> bool:
    """Return whether anything in a function may wait for the future, from a line on."""
    if any(True for _ in module.below(function, ast.Await, ast.While, ast.Yield)):
        return True
    used = [node for node in module.below(function, ast.Attribute) if node.lineno >= line]
    attributes = [node.attr for node in used]
    names = [*attributes, *(node.id for node in module.below(function, ast.Name))]
    return not WAITS.isdisjoint(attributes) or any("spin" in x or "wait" in x for x in names)
