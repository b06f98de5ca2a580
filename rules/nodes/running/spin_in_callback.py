"""ND033: callbacks do not spin their own node."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.programs import (
    in_callbacks,
    in_constructors,
    in_tasks,
    names_callback_group,
    names_other_executor,
)
from scaffold.api.python import argument_of, arguments_for, conditions_on
from scaffold.api.rclpy import Entity, NodeClass, RclpyFile

MOST = 2
"""The maximum number of arguments without an executor: the node and a future."""
_ENDING = re.compile(r"\b(?:destroy_node|shutdown|exit)\(")
"""Matches calls that end a node."""
_PLAIN = (ast.Expr, ast.Raise)
"""Statements whose parts are always executed."""
_NODE = (
    "import rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.create_timer(1.0, self.ask)\n\n"
    "    def ask(self):\n"
    "        future = self.client.call_async(self.request)\n"
    "        {}\n\n"
    "    def answer(self, future):\n        pass\n"
)
_SPINNING = (
    "import rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, print)\n"
    "        rclpy.spin(self)\n{}"
)


class SpinInCallback(RclpyRule):
    """A callback or the constructor of a node spins the node itself.

    **Why.** ``rclpy.spin_...`` moves the node to another executor and removes it afterward: the
    first call works, but then no callback of the node runs. If the node is in the same executor,
    ``spin_until_future_complete`` waits forever for a callback of the same callback group.
    ``rclpy.spin`` in the constructor returns only at shutdown: until then, the caller does not get
    the node.

    **Fix.** Spin the node in ``main``, after it is constructed. In callbacks, use
    ``future.add_done_callback``, or an ``async`` callback that awaits the future.

    **Source.** rclpy issue 1313; ROS 2 documentation, "Synchronous vs. asynchronous service
    clients".
    """

    code = "ND033"
    name = "spin-in-callback"
    other_severities = {
        Severity.WARNING: "it is in the constructor, and the node is not spun elsewhere"
    }
    examples = (
        Example("a callback", {"caller.py": _NODE.format("future.add_done_callback(self.answer)")}),
        Example(
            "a method that spins only for callers outside of callbacks",
            {
                "caller.py": _NODE.format(
                    "self.call(future, False)\n\n"
                    "    def prepare(self, future):\n        self.call(future, True)\n\n"
                    "    def call(self, future, wait):\n        if wait:\n"
                    "            rclpy.spin_until_future_complete(self, future)"
                )
            },
        ),
        Example(
            "a separate node for service calls",
            {
                "caller.py": _NODE.format("rclpy.spin_until_future_complete(self, future)").replace(
                    "        self.create_timer(1.0, self.ask)\n", ""
                )
                + "\n\nclass Asker(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('asker')\n"
                "        self.caller = Caller()\n"
                "        self.create_timer(1.0, self.tick)\n\n"
                "    def tick(self):\n        self.caller.ask()\n"
            },
        ),
        Example(
            "a separate node for service calls, made in a callback of a plain node",
            {
                "caller.py": _NODE.format("rclpy.spin_until_future_complete(self, future)").replace(
                    "        self.create_timer(1.0, self.ask)\n", ""
                )
                + "\n\ndef tick():\n    Caller().ask()\n\n\n"
                "node = Node('asker')\ntimer = node.create_timer(1.0, tick)\n"
            },
        ),
        Example(
            "a timer that a function creates for the node",
            {
                "caller.py": _NODE.format("rclpy.spin_until_future_complete(self, future)").replace(
                    "        self.create_timer(1.0, self.ask)\n", ""
                )
                + "\n\ncaller = Caller()\ncaller.create_timer(1.0, caller.ask)\n"
            },
            "11:9: rclpy.spin_until_future_complete(self) runs in callback 'ask' of the same "
            "node: no callback runs afterward; use add_done_callback() or await",
        ),
        Example(
            "a spin before the node exits",
            {
                "caller.py": _NODE.format("rclpy.spin_until_future_complete(self, future)").replace(
                    "self.ask)", "self.tick)"
                )
                + "\n    def tick(self):\n        if self.is_done:\n            self.ask()\n"
                "            self.destroy_node()\n            raise SystemExit\n"
            },
        ),
        Example(
            "a spin until the first message arrives, before the callbacks start",
            {
                "caller.py": _NODE.format("future.add_done_callback(self.answer)")
                .replace(
                    "        self.create_timer(1.0, self.ask)\n",
                    "        self.count = 0\n"
                    "        self.client = self.create_client(Trigger, 'reset')\n",
                )
                .replace(
                    "    def ask(self):\n",
                    "    def on_state(self, message):\n        self.count += 1\n\n"
                    "    def ask(self):\n        while self.count < 1:\n"
                    "            rclpy.spin_once(self)\n",
                )
                .replace("        pass\n", "        self.ask()\n")
            },
        ),
        Example(
            "a spin",
            {"caller.py": _NODE.format("rclpy.spin_until_future_complete(self, future)")},
            "12:9: rclpy.spin_until_future_complete(self) runs in callback 'ask' of the same "
            "node: no callback runs afterward; use add_done_callback() or await",
        ),
        Example(
            "a client with a callback group of its own, in the executor of rclpy",
            {
                "caller.py": _NODE.format("rclpy.spin_until_future_complete(self, future)").replace(
                    "        self.create_timer",
                    "        group = MutuallyExclusiveCallbackGroup()\n"
                    "        self.client = self.create_client(\n"
                    "            Trigger, 'reset', callback_group=group)\n"
                    "        self.create_timer",
                )
                + "\n\nrclpy.spin(Caller())\n"
            },
        ),
        Example(
            "a client with a callback group of its own, in another executor",
            {
                "caller.py": _NODE.format("rclpy.spin_until_future_complete(self, future)").replace(
                    "        self.create_timer",
                    "        group = MutuallyExclusiveCallbackGroup()\n"
                    "        self.client = self.create_client(\n"
                    "            Trigger, 'reset', callback_group=group)\n"
                    "        self.create_timer",
                )
                + "\n\nexecutor = MultiThreadedExecutor()\nexecutor.add_node(Caller())\n"
                "executor.spin()\n"
            },
            "15:9: rclpy.spin_until_future_complete(self) runs in callback 'ask' of the same "
            "node: no callback runs afterward; use add_done_callback() or await",
        ),
        Example(
            "a spin, after which the program exits",
            {
                "caller.py": _NODE.format(
                    "rclpy.spin_until_future_complete(self, future)\n        rclpy.shutdown()"
                )
            },
        ),
        Example(
            "a spin, after which the program may exit",
            {
                "caller.py": _NODE.format(
                    "rclpy.spin_until_future_complete(self, future)\n"
                    "        if not future.done():\n            rclpy.shutdown()"
                )
            },
            "12:9: rclpy.spin_until_future_complete(self) runs in callback 'ask' of the same "
            "node: no callback runs afterward; use add_done_callback() or await",
        ),
        Example(
            "a spin when a future is done",
            {
                "caller.py": _NODE.format("future.add_done_callback(self.answer)")
                .replace(
                    "        pass\n", "        rclpy.spin_until_future_complete(self, future)\n"
                )
                .replace(
                    "        self.create_timer",
                    "        self.client = self.create_client(Trigger, 'reset')\n"
                    "        self.create_timer",
                )
            },
            "16:9: rclpy.spin_until_future_complete(self) runs in callback 'answer' of the same "
            "node: no callback runs afterward; use add_done_callback() or await",
        ),
        Example(
            "a constructor that spins",
            {"talker.py": _SPINNING.format("")},
            Report(
                "9:9",
                "spin() runs in the constructor of Talker, and returns only at "
                "shutdown: the code after it runs too late; spin the node in main()",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a constructor that spins, and main() as well",
            {"talker.py": _SPINNING.format("\n\ndef main():\n    rclpy.spin(Talker())\n")},
            "9:9: spin() runs in the constructor of Talker, and returns only at shutdown: the "
            "code after it runs too late; spin the node in main()",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_constructors(file)
        executions = (*in_callbacks(file), *in_tasks(file))
        for function, origin, entity in {x.function: x for x in reversed(executions)}.values():
            for call in file.spin_calls:
                if call.name.startswith("executor.") or len(call.call.args) > MOST:
                    continue
                node = call.call.args[0] if call.call.args else None
                if file.function_of(call.call) is not function or call.call.keywords:
                    continue
                if not isinstance(node, ast.Name):
                    continue
                spun = file.evaluator.self_class(node)
                if spun is None or (entity and not _is_of(file, entity, spun)):
                    continue  # another node than the one with the callback
                is_once = _is_last(file, function) or _waits_once(file, call.call)
                if is_once or _depends_on_caller(file, call.call):
                    continue
                if any(isinstance(x, _PLAIN) for x in _endings_after(file, call.call)):
                    continue
                if call.name == "spin_until_future_complete" and _is_in_one_executor(file):
                    continue
                message = f"rclpy.{call.name}({node.id}) runs in {origin} of the same node"
                yield self.report(
                    call, f"{message}: no callback runs afterward; use add_done_callback() or await"
                )

    def _check_constructors(self, file: RclpyFile) -> Iterator[Diagnostic]:
        functions = {executed.function: executed.origin for executed in in_constructors(file)}
        outside = [call for call in file.spin_calls if file.function_of(call.call) not in functions]
        for call in file.spin_calls:
            function = file.function_of(call.call)
            origin = functions.get(function) if function is not None else None
            if origin is None or call.name not in {"spin", "executor.spin"}:
                continue
            if call.name == "spin" and not _is_self(file, call.call):
                continue
            message = (
                f"spin() runs in {origin}, and returns only at shutdown: the code after it runs "
                f"too late; spin the node in main()"
            )
            severity = None if outside else Severity.WARNING
            yield self.report(call, message, severity=severity)


def _is_of(file: RclpyFile, entity: Entity, spun: ast.ClassDef) -> bool:
    """Return whether the node with a callback is of the class of the spun one."""
    class_ = file.module.enclosing_class(entity.call)
    if class_ is None and isinstance(entity.owner, NodeClass):
        class_ = entity.owner.node
    return class_ in file.related_classes(spun)


def _depends_on_caller(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether only some callers of a function ask it to spin: ``wait=True``."""
    names = (
        name
        for test in conditions_on(file.module, call)
        for name in ast.walk(test)
        if isinstance(name, ast.Name)
    )
    return any(
        len({ast.dump(value) for value in arguments_for(file.module, name)}) > 1 for name in names
    )


def _is_in_one_executor(file: RclpyFile) -> bool:
    """Return whether the executor of rclpy runs the node, maybe with several callback groups.

    It is also the one that waits for the future, so that the node stays in it.
    """
    others = any(call.name.startswith("executor.") for call in file.spin_calls)
    return names_callback_group(file) and not names_other_executor(file) and not others


def _is_last(file: RclpyFile, function: ast.AST) -> bool:
    """Return whether callbacks call a function only at the end of the node."""
    start = {executed.function for executed in in_constructors(file)}
    calls = [
        attribute
        for attribute in file.module.index.attributes(getattr(function, "name", ""))
        if file.function_of(attribute) not in start
    ]
    return bool(calls) and all(_ends_after(file, call) for call in calls)


def _waits_once(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether a spin waits for an attribute that stays set, such as a count of messages.

    Callers before the callback may have waited for it already.
    """
    loop = file.module.enclosing(call, ast.While)
    name = getattr(file.function_of(call), "name", "")
    if loop is None or any(isinstance(x, ast.Call) for x in ast.walk(loop.test)):
        return False
    is_called = all(map(file.module.call_with, file.module.index.attributes(name)))
    awaited = {x.attr for x in ast.walk(loop.test) if isinstance(x, ast.Attribute)}
    return is_called and bool(awaited) and all(_only_counts(file, item) for item in awaited)


def _only_counts(file: RclpyFile, name: str) -> bool:
    """Return whether an attribute only increases after the construction of the node."""
    start = {executed.function for executed in in_constructors(file)}
    stores = [
        file.module.parent(use)
        for use in file.module.index.attributes(name)
        if isinstance(use.ctx, ast.Store) and file.function_of(use) not in start
    ]
    return bool(stores) and all(
        isinstance(store, ast.AugAssign) and isinstance(store.op, ast.Add) for store in stores
    )


def _ends_after(file: RclpyFile, node: ast.AST) -> bool:
    """Return whether later statements in the block of a call may end the node."""
    return any(True for _ in _endings_after(file, node))


def _endings_after(file: RclpyFile, node: ast.AST) -> Iterator[ast.stmt]:
    """Yield the later statements in the block of a call that contain code that ends the node."""
    child = node
    for parent in file.module.parents(node):
        block = getattr(parent, "body", None)
        if isinstance(block, list) and child in block:
            for statement in block[block.index(child) + 1 :]:
                is_end = re.search(_ENDING, file.module.text(statement))
                if is_end or isinstance(statement, ast.Raise):
                    yield statement
            return
        child = parent


def _is_self(file: RclpyFile, call: ast.Call) -> bool:
    given = argument_of(call, "node", 0)
    return given is not None and file.evaluator.self_class(given) is not None
