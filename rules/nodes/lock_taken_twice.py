"""ND118: a thread does not wait for a lock that it holds."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, PythonRule, Report
from scaffold.api.python import PythonModule
from scaffold.api.rclpy import RclpyFile, rclpy_file

_LOCKS = frozenset({"threading.Lock", "_thread.allocate_lock"})
_NODE = (
    "import threading\n\n\n"
    "class Store:\n"
    "    def __init__(self):\n"
    "        self.lock = threading.{}()\n\n"
    "    def on_message(self, msg):\n"
    "        with self.lock:\n"
    "            self.keep(msg)\n\n"
    "    def keep(self, msg):\n"
    "        with self.lock:\n"
    "            self.msg = msg\n"
)


class LockTakenTwice(PythonRule):
    """Code that holds a ``threading.Lock`` takes it again.

    **Why.** It waits for itself: the thread hangs at the first call, and with it all callbacks.

    **Fix.** ``threading.RLock()``, which a thread may take again; or call the method after the
    ``with`` block.

    **Source.** Python documentation, ``threading.Lock``.
    """

    code = "ND118"
    name = "lock-taken-twice"
    examples = (
        Example("a lock that may be taken again", {"store.py": _NODE.format("RLock")}),
        Example(
            "a plain lock",
            {"store.py": _NODE.format("Lock")},
            Report(
                "10:13",
                "the lock of line 9 is taken again while it is held: the thread "
                "waits for itself; use threading.RLock()",
            ),
        ),
        Example(
            "called outside",
            {
                "store.py": _NODE.format("Lock").replace(
                    "            self.keep(msg)",
                    "            self.count += 1\n        self.keep(msg)",
                )
            },
        ),
    )

    def check_in(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        if not module.mentions("Lock(", "allocate_lock"):
            return
        file = rclpy_file(package, module.path)
        for block in module.walk(ast.With):
            for lock in (_lock(file, item.context_expr) for item in block.items):
                if lock is None:
                    continue
                for node in _taken_inside(file, block, lock):
                    message = (
                        f"the lock of line {block.lineno} is taken again while it is held: the "
                        "thread waits for itself; use threading.RLock()"
                    )
                    yield self.report(module.location(node), message)
                    break


def _lock(file: RclpyFile, node: ast.expr) -> ast.expr | None:
    """Return the call that makes the lock that an expression is, if it can be taken once."""
    made = file.evaluator.single_value(node)
    is_lock = isinstance(made, ast.Call) and not _LOCKS.isdisjoint(
        file.module.qualified_names(made.func)
    )
    return made if is_lock else None


def _taken_inside(file: RclpyFile, block: ast.With, lock: ast.expr) -> Iterator[ast.AST]:
    """Yield what takes a lock again: a block inside, or the call of a function that takes it."""
    if any(_lock(file, use.value) is lock for use in file.module.index.attributes("release")):
        return
    holder = file.function_of(block)
    for statement in block.body:
        for node in file.module.below(statement, ast.With, ast.Call):
            if file.function_of(node) is holder and (
                _is_taken(file, node, lock) or _is_taken_by_call(file, node, lock)
            ):
                yield node


def _is_taken_by_call(file: RclpyFile, node: ast.AST, lock: ast.expr) -> bool:
    """Return whether a call is of a function that takes a lock, itself or in what it calls."""
    function = file.callback(node.func).function if isinstance(node, ast.Call) else None
    if not isinstance(function, ast.FunctionDef):
        return False
    return any(_takes(file, inner, lock) for inner in file.reached(function))


def _takes(file: RclpyFile, function: ast.AST, lock: ast.expr) -> bool:
    """Return whether a function takes a lock under no condition."""
    return any(
        _is_taken(file, node, lock)
        for node in file.module.below(function, ast.With, ast.Call)
        if file.function_of(node) is function and not file.is_conditional(node)
    )


def _is_taken(file: RclpyFile, node: ast.AST, lock: ast.expr) -> bool:
    match node:
        case ast.With(items=items):
            return any(_lock(file, item.context_expr) is lock for item in items)
        case ast.Call(func=ast.Attribute(attr="acquire", value=value), args=[], keywords=[]):
            return _lock(file, value) is lock
    return False
