"""ND118: a thread does not acquire a lock that it holds."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from itertools import takewhile
from typing import NamedTuple

from scaffold.api import Diagnostic, Example, Package, PythonRule
from scaffold.api.python import FunctionNode, PythonModule
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
    """Code that holds a ``threading.Lock`` acquires it again, or returns without releasing it.

    **Why.** The thread waits for itself: it hangs at the first call, and with it all callbacks.

    **Fix.** Use ``threading.RLock()``, which a thread may acquire again, or call the method after
    the ``with`` block.

    **Source.** Python documentation, ``threading.Lock``.
    """

    code = "ND118"
    name = "lock-taken-twice"
    examples = (
        Example("a lock that may be acquired again", {"store.py": _NODE.format("RLock")}),
        Example(
            "a plain lock",
            {"store.py": _NODE.format("Lock")},
            "10:13: the lock acquired in line 9 is acquired again: deadlock; use threading.RLock()",
        ),
        Example(
            "returns without releasing the lock",
            {
                "store.py": "import threading\n\nLOCK = threading.Lock()\n\n\n"
                "def wrong(store):\n"
                "    LOCK.acquire()\n"
                "    if not store:\n        return None\n"
                "    item = store.pop()\n"
                "    LOCK.release()\n"
                "    return item\n\n\n"
                "def right(store):\n"
                "    LOCK.acquire()\n"
                "    if not store:\n        LOCK.release()\n        return None\n"
                "    item = store.pop()\n"
                "    LOCK.release()\n"
                "    return item\n\n\n"
                "def tried(store):\n"
                "    LOCK.acquire()\n"
                "    try:\n        return store.pop()\n"
                "    finally:\n        LOCK.release()\n"
            },
            "9:9: the lock acquired in line 7 is not released on this path: the next acquire "
            "waits forever; use 'with'",
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
        for held in (*_with_blocks(file), *_acquired_blocks(file)):
            for node in _taken_inside(file, held):
                message = (
                    f"the lock acquired in line {held.line} is acquired again: deadlock; use "
                    f"threading.RLock()"
                )
                yield self.report(module.location(node), message)
                break
        for held in _acquired_blocks(file):
            for left in _left_inside(file, held):
                message = (
                    f"the lock acquired in line {held.line} is not released on this path: the "
                    f"next acquire waits forever; use 'with'"
                )
                yield self.report(module.location(left), message)


class _Held(NamedTuple):
    """Statements that run while a lock is held."""

    lock: ast.expr
    line: int
    body: Sequence[ast.stmt]


def _with_blocks(file: RclpyFile) -> Iterator[_Held]:
    for block in file.module.walk(ast.With):
        for item in block.items:
            lock = _lock(file, item.context_expr)
            if lock is not None:
                yield _Held(lock, block.lineno, block.body)


def _acquired_blocks(file: RclpyFile) -> Iterator[_Held]:
    """Yield the statements between ``lock.acquire()`` and ``lock.release()`` of a block."""
    for func in file.module.index.attributes("acquire"):
        lock = _lock(file, func.value)
        call = file.module.parent(func)
        statement = file.module.parent(call) if isinstance(call, ast.Call) else None
        if lock is None or not isinstance(statement, ast.Expr) or _has_arguments(call):
            continue
        field, number = file.module.index.place(statement)
        following = getattr(file.module.parent(statement), field)[number + 1 :]
        yield _Held(lock, statement.lineno, _up_to_release(file, following, lock))


def _left_inside(file: RclpyFile, held: _Held) -> Iterator[ast.Return]:
    """Yield the returns between the acquire and the release of a lock."""
    if not held.body:
        return
    function = file.function_of(held.body[0])
    last = held.body[-1].end_lineno or 0
    is_released_later = any(
        func.lineno > last and file.function_of(func) is function
        for func in file.module.index.attributes("release")
        if _lock(file, func.value) is held.lock
    )
    for statement in held.body if is_released_later else ():
        for node in file.module.below(statement, ast.Return):
            tried = (x for x in file.module.parents(node) if isinstance(x, ast.Try))
            is_released = any(
                _releases(file, x, held.lock) for block in tried for x in block.finalbody
            )
            if file.function_of(node) is function and not is_released:
                yield node


def _up_to_release(
    file: RclpyFile, statements: Sequence[ast.stmt], lock: ast.expr
) -> Sequence[ast.stmt]:
    """Return the statements before the release of a lock."""
    first = statements[0] if statements else None
    if isinstance(first, ast.Try) and any(_releases(file, x, lock) for x in first.finalbody):
        return first.body
    return list(takewhile(lambda x: not _releases(file, x, lock), statements))


def _has_arguments(call: ast.AST | None) -> bool:
    return isinstance(call, ast.Call) and bool(call.args or call.keywords)


def _releases(file: RclpyFile, scope: ast.AST, lock: ast.expr) -> bool:
    return any(
        func.attr == "release" and _lock(file, func.value) is lock
        for func in file.module.below(scope, ast.Attribute)
    )


def _lock(file: RclpyFile, node: ast.expr) -> ast.expr | None:
    """Return the call that creates a lock, if it is not reentrant."""
    made = file.evaluator.single_value(node)
    is_lock = isinstance(made, ast.Call) and not _LOCKS.isdisjoint(
        file.module.qualified_names(made.func)
    )
    return made if is_lock else None


def _taken_inside(file: RclpyFile, held: _Held) -> Iterator[ast.AST]:
    """Yield nested acquires of a lock: a block, or the call of a function that acquires it."""
    if not held.body or any(_releases(file, statement, held.lock) for statement in held.body):
        return
    holder = file.function_of(held.body[0])
    for statement in held.body:
        for node in file.module.below(statement, ast.With, ast.Call, ast.Attribute):
            if file.function_of(node) is holder and (
                _is_taken(file, node, held.lock) or _is_taken_by_call(file, node, held.lock)
            ):
                yield node


def _is_taken_by_call(file: RclpyFile, node: ast.AST, lock: ast.expr) -> bool:
    """Return whether a call runs a function that acquires a lock, even indirectly."""
    function = file.callback(node.func).function if isinstance(node, ast.Call) else None
    if not isinstance(function, ast.FunctionDef):
        return False
    return any(_acquires(file, inner, lock) for inner in file.reached(function))


def _acquires(file: RclpyFile, function: FunctionNode | ast.Lambda, lock: ast.expr) -> bool:
    """Return whether a function unconditionally acquires a lock before releasing it."""
    released = [
        func.lineno
        for func in file.module.below(function, ast.Attribute)
        if func.attr == "release" and _lock(file, func.value) is lock
    ]
    return any(
        _is_taken(file, node, lock) and not any(line < node.lineno for line in released)
        for node in _unconditional(file, function)
    )


def _unconditional(
    file: RclpyFile, function: FunctionNode | ast.Lambda
) -> Iterator[ast.With | ast.Call]:
    """Yield the unconditional blocks and calls of a function."""
    for node in file.module.below(function, ast.With):
        if file.function_of(node) is function and not file.is_conditional(node):
            yield node
    for call in file.calls_in(function):
        if not file.is_conditional(call):
            yield call


def _is_taken(file: RclpyFile, node: ast.AST, lock: ast.expr) -> bool:
    match node:
        case ast.With(items=items):
            return any(_lock(file, item.context_expr) is lock for item in items)
        case ast.Call(func=ast.Attribute(attr="acquire", value=value), args=[], keywords=[]):
            return _lock(file, value) is lock
    return False
