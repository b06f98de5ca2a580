"""ND057: nodes are spun before the shutdown, by executors that contain them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, RclpyRule, Report, Severity
from scaffold.api.python import argument_of, last_name
from scaffold.api.rclpy import RclpyCall, RclpyFile, class_of

from ._executors import Shutdowns, used_of_executor
from ._spinning import needs_spin

_NODE = (
    "import rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, print)\n\n\n"
    "def main():\n    rclpy.init()\n    node = Talker()\n{}"
)
_NODE_EXECUTORS = (
    "import rclpy\nfrom rclpy.executors import SingleThreadedExecutor\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, print)\n\n\n"
    "def main():\n    rclpy.init()\n    node = Talker()\n"
    "    executor = SingleThreadedExecutor()\n{}"
)
_THREAD = (
    "import threading\n\nimport rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, print)\n"
    "{}\n"
    "    def start(self):\n"
    "        threading.Thread(target=rclpy.spin, args=(self,)).start()\n\n"
    "    def watch(self):\n"
    "{}        rclpy.spin_once(self)\n"
)
_ADD = "    executor.add_node(node)\n"
_SPIN = "    executor.spin()\n"


class SpunWrongly(RclpyRule):
    """``rclpy.spin`` gets no node or comes too late, or an executor is empty or never spun.

    **Why.** No callback ever runs: an executor without nodes waits forever, and one that is not
    spun does nothing. After ``rclpy.shutdown()``, which ends ``rclpy.spin``, spinning has no
    effect. A class instead of a node is a ``TypeError: 'property' object is not iterable``. Two
    threads cannot spin the same node, and ``rclpy.spin(node)`` moves the node to another executor,
    with one thread.

    **Fix.** Call ``rclpy.spin(node)``, or ``executor.add_node(node)`` and ``executor.spin()``.

    **Source.** ``rclpy/__init__.py``; ``rclpy/executors.py``.
    """

    code = "ND057"
    name = "spun-wrongly"
    effect = Effect.STOPS_START
    other_severities = {Severity.WARNING: "callbacks run in one thread, or there are none"}
    examples = (
        Example(
            "a node that is spun",
            {"talker.py": _NODE.format("    rclpy.spin(node)\n")},
        ),
        Example(
            "a class instead of a node",
            {"talker.py": _NODE.format("    rclpy.spin(Talker)\n")},
            "14:5: 'Talker' is a class, not a node: TypeError; write Talker()",
        ),
        Example(
            "a node after the shutdown",
            {"talker.py": _NODE.format("    rclpy.shutdown()\n    rclpy.spin(node)\n")},
            "15:5: rclpy is already shut down in line 14: nothing is spun",
        ),
        Example(
            "an executor",
            {
                "talker.py": _NODE.format(
                    "    executor = SingleThreadedExecutor()\n    executor.add_node(node)\n"
                    "    rclpy.spin(executor)\n"
                ).replace("\nfrom", "\nfrom rclpy.executors import SingleThreadedExecutor\nfrom", 1)
            },
            "17:5: this is an executor, not a node: AttributeError; call its spin()",
        ),
        Example(
            "an executor that is not spun, for a node without callbacks",
            {
                "talker.py": _NODE_EXECUTORS.format(
                    _ADD + "    while rclpy.ok():\n        pass\n"
                ).replace("        self.create_timer(1.0, print)\n", "")
            },
            Report(
                "14:16",
                "executor is never spun: the callbacks of its nodes never run",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "two nodes, one after the other",
            {"talker.py": _NODE.format("    rclpy.spin(node)\n    rclpy.spin(Talker())\n")},
            "15:5: the spin in line 14 returns only at shutdown: this node is never spun; add "
            "both to an executor",
        ),
        Example(
            "two nodes, in a loop",
            {
                "talker.py": _NODE.format("    for item in (node, Talker()):\n")
                + "        rclpy.spin(item)\n",
                "again.py": _NODE.format("    for item in (node, Talker()):\n")
                + "        rclpy.spin(item)\n        rclpy.init()\n",
            },
            "talker.py:15:9: the first spin of this loop returns only at shutdown: the other "
            "nodes are never spun; add them all to an executor",
        ),
        Example(
            "a node that a thread spins",
            {
                "talker.py": "import threading\n"
                + _NODE.format(
                    "    threading.Thread(target=rclpy.spin, args=(node,)).start()\n"
                    "    rclpy.spin_until_future_complete(node, node.ask())\n"
                )
            },
            "16:5: the thread in line 15 already spins 'node': ValueError: generator already "
            "executing; use add_done_callback()",
        ),
        Example(
            "a thread that another method starts, which this one does not call",
            {"talker.py": _THREAD.format("", "")},
        ),
        Example(
            "a thread that the constructor starts",
            {"talker.py": _THREAD.format("        self.start()\n", "")},
            "17:9: the thread in line 14 already spins 'self': ValueError: generator already "
            "executing; use add_done_callback()",
        ),
        Example(
            "a thread that the method starts itself",
            {"talker.py": _THREAD.format("", "        self.start()\n")},
            "17:9: the thread in line 13 already spins 'self': ValueError: generator already "
            "executing; use add_done_callback()",
        ),
        Example(
            "an executor with a node, spun", {"talker.py": _NODE_EXECUTORS.format(_ADD + _SPIN)}
        ),
        Example(
            "a class added to an executor",
            {"talker.py": _NODE_EXECUTORS.format(_ADD.replace("node)", "Talker)") + _SPIN)},
            "16:23: 'Talker' is a class, not a node: TypeError; write Talker()",
        ),
        Example(
            "an executor without a node",
            {"talker.py": _NODE_EXECUTORS.format(_SPIN)},
            "16:5: executor without nodes: no callback ever runs; call add_node() first",
        ),
        Example(
            "an executor that is not spun",
            {"talker.py": _NODE_EXECUTORS.format(_ADD)},
            "15:16: executor is never spun: the callbacks of its nodes never run",
        ),
        Example(
            "an executor that is not spun, while a thread spins its node",
            {
                "talker.py": "from threading import Thread\n\n"
                + _NODE_EXECUTORS.format(
                    _ADD + "    Thread(target=rclpy.spin, args=(node,)).start()\n"
                )
            },
        ),
        Example(
            "an executor that is not spun, while one of its nodes is",
            {
                "talker.py": _NODE_EXECUTORS.format(
                    "    other = Talker()\n"
                    + _ADD
                    + _ADD.replace("node)", "other)")
                    + "    rclpy.spin(node)\n"
                )
            },
            "15:16: executor is never spun: the callbacks of 'other' never run",
        ),
        Example(
            "one thread instead of several",
            {
                "talker.py": _NODE_EXECUTORS.replace("SingleThreaded", "MultiThreaded")
                .replace("Executor()", "Executor(num_threads=1)")
                .format(_ADD + _SPIN)
            },
            Report(
                "15:16",
                "a MultiThreadedExecutor with one thread runs callbacks one at a "
                "time; remove num_threads",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "several threads that are not used",
            {
                "talker.py": _NODE_EXECUTORS.replace("SingleThreaded", "MultiThreaded").format(
                    _ADD + "    rclpy.spin(node)\n"
                )
            },
            Report(
                "17:5",
                "rclpy.spin() does not use the executor in line 15: callbacks run one "
                "at a time; call spin() of the executor",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_spin(file)
        yield from self._check_executors(file)

    def _check_spin(self, file: RclpyFile) -> Iterator[Diagnostic]:
        shutdowns = Shutdowns(file)
        for call in file.spin_calls:
            problem = _problem(file, call, shutdowns)
            if problem:
                yield self.report(call, problem)
        for thread, name in _spinning_threads(file):
            for call in file.spin_calls:
                node = call.call.args[0] if call.call.args else None
                if call.name.startswith("executor.") or node is None:
                    continue
                if argument_of(call.call, "executor") is not None:
                    continue
                if file.module.text(node) == name and _share_scope(file, thread, call.call):
                    message = (
                        f"the thread in line {thread.lineno} already spins {name!r}: ValueError: "
                        f"generator already executing; use add_done_callback()"
                    )
                    yield self.report(call, message)

    def _check_executors(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.module.walk(ast.Call):
            added = _added_class(file, call)
            if added:
                message = f"'{added}' is a class, not a node: TypeError; write {added}()"
                yield self.report(file.module.location(call.args[0]), message)
            if _has_one_thread(file, call):
                message = (
                    "a MultiThreadedExecutor with one thread runs callbacks one at a time; "
                    "remove num_threads"
                )
                yield self.report(file.module.location(call), message, severity=Severity.WARNING)
            used = used_of_executor(file, call)
            if used is None:
                continue
            is_spun = any(name.startswith("spin") for name in used)
            if is_spun and "add_node" not in used:
                spin = used["spin"] if "spin" in used else next(iter(used.values()))
                message = "executor without nodes: no callback ever runs; call add_node() first"
                yield self.report(file.module.location(spin), message)
            elif "add_node" in used and not is_spun and not _spins(file):
                message = "executor is never spun: the callbacks of its nodes never run"
                is_needed = needs_spin(file) or not file.classes
                severity = Severity.ERROR if is_needed else Severity.WARNING
                yield self.report(file.module.location(call), message, severity=severity)
            elif "add_node" in used and not is_spun and _left_out(file, call):
                names = " and ".join(map(repr, _left_out(file, call)))
                message = f"executor is never spun: the callbacks of {names} never run"
                yield self.report(file.module.location(call), message)
            elif "add_node" in used and not is_spun and _has_many_threads(call):
                for other in _other_spins(file, used["add_node"]):
                    message = (
                        f"rclpy.spin() does not use the executor in line {call.lineno}: callbacks "
                        f"run one at a time; call spin() of the executor"
                    )
                    yield self.report(other, message, severity=Severity.WARNING)


def _problem(file: RclpyFile, call: RclpyCall, shutdowns: Shutdowns) -> str:
    """Return the message for a wrong call that spins."""
    if call.name.startswith("executor.") or not call.call.args:
        return ""
    node = call.call.args[0]
    value = file.evaluator.single_value(node)
    class_ = file.evaluator.named_class(value)
    if class_ is not None and file.node_class(class_) is not None:
        return f"{class_.name!r} is a class, not a node: TypeError; write {class_.name}()"
    if (class_of(file, node) or "").endswith("Executor"):
        return "this is an executor, not a node: AttributeError; call its spin()"
    other = shutdowns.before(call.call)
    if other is not None:
        return f"rclpy is already shut down in line {other.location.line}: nothing is spun"
    return _spun_too_late(file, call, node)


def _spinning_threads(file: RclpyFile) -> Iterator[tuple[ast.Call, str]]:
    """Yield the threads that spin a node, with the name of the node."""
    for call in file.module.calls_of("threading.Thread"):
        words = {word.arg: word.value for word in call.keywords}
        target, args = words.get("target"), words.get("args")
        if target is None or file.module.qualified_name(target) != "rclpy.spin":
            continue
        if isinstance(args, ast.Tuple | ast.List) and len(args.elts) == 1:
            yield call, file.module.text(args.elts[0])


def _spins(file: RclpyFile) -> bool:
    """Return whether a file spins a node, here or in a thread."""
    return bool(file.spin_calls) or any(_spinning_threads(file))


def _share_scope(file: RclpyFile, thread: ast.Call, call: ast.Call) -> bool:
    """Return whether a name is the same node in two calls, during which the thread runs."""
    functions = [file.module.enclosing_function(node) for node in (thread, call)]
    classes = [file.module.enclosing_class(node) for node in (thread, call)]
    if functions[0] is functions[1]:
        return thread.lineno < call.lineno and not file.is_conditional(thread)
    if classes[0] is None or classes[0] is not classes[1] or "self" not in ast.unparse(call):
        return False
    starting = functions[0].name if functions[0] is not None else ""
    return starting == "__init__" or any(
        isinstance(attribute.ctx, ast.Load)
        and file.module.enclosing_class(attribute) is classes[0]
        and (around := file.module.enclosing_function(attribute)) is not None
        and (around.name == "__init__" or around is functions[1])
        for attribute in file.module.index.attributes(starting)
    )


def _spun_too_late(file: RclpyFile, call: RclpyCall, node: ast.expr) -> str:
    """Return the message for a call that comes after another one that spins until shutdown."""
    if _is_in_loop(file, call, node):
        return (
            "the first spin of this loop returns only at shutdown: the other nodes are never spun; "
            "add them all to an executor"
        )
    statement = file.module.parent(call.call)
    block = file.module.parent(statement) if isinstance(statement, ast.Expr) else None
    for other in file.spin_calls if call.name == "spin" else ():
        before = file.module.parent(other.call)
        if other.name != "spin" or not isinstance(before, ast.Expr) or before is statement:
            continue
        if file.module.parent(before) is block and before.lineno < call.call.lineno:
            if _is_again(file, before, call.call):
                return ""
            return (
                f"the spin in line {before.lineno} returns only at shutdown: this node is never "
                "spun; add both to an executor"
            )
    return ""


def _is_in_loop(file: RclpyFile, call: RclpyCall, node: ast.expr) -> bool:
    """Return whether a call spins one node after the other, each until shutdown."""
    loop = file.module.parent(file.module.parent(call.call) or call.call)
    if call.name != "spin" or not isinstance(loop, ast.For):
        return False
    is_each = isinstance(node, ast.Name) and ast.unparse(loop.target) == node.id
    return is_each and not any(loop in file.module.parents(x.call) for x in file.init_calls)


def _is_again(file: RclpyFile, before: ast.stmt, call: ast.Call) -> bool:
    """Return whether rclpy is initialized again between two calls."""
    return any(before.lineno < init.location.line < call.lineno for init in file.init_calls)


def _added_class(file: RclpyFile, call: ast.Call) -> str:
    """Return the name of a node class that is passed to ``add_node`` instead of a node."""
    match call:
        case ast.Call(func=ast.Attribute(attr="add_node"), args=[ast.Name() as node]):
            class_ = file.evaluator.named_class(node)
            if class_ is not None and file.node_class(class_) is not None:
                return class_.name
    return ""


def _has_many_threads(call: ast.Call) -> bool:
    return last_name(call.func).endswith("MultiThreadedExecutor")


def _has_one_thread(file: RclpyFile, call: ast.Call) -> bool:
    if file.module.in_tests or not _has_many_threads(call):
        return False
    given = argument_of(call, "num_threads", 0)
    return given is not None and file.evaluator.evaluate(given) == 1


def _left_out(file: RclpyFile, made: ast.Call) -> list[str]:
    """Return the nodes of an unspun executor that nothing else spins either."""
    function = file.module.enclosing_function(made)
    added = [
        call.args[0].id
        for call, _ in file.module.method_calls("add_node")
        if len(call.args) == 1
        and isinstance(call.args[0], ast.Name)
        and file.module.enclosing_function(call) is function
    ]
    spun = {name for _, name in _spinning_threads(file)}
    for spin in file.spin_calls:
        node = spin.call.args[0] if spin.call.args else None
        is_plain = isinstance(node, ast.Name) and not spin.call.keywords
        if not is_plain or file.module.enclosing_function(spin.call) is not function:
            return []
        spun.add(node.id if isinstance(node, ast.Name) else "")
    return [name for name in added if name not in spun]


def _other_spins(file: RclpyFile, add_node: ast.AST) -> Iterator[RclpyCall]:
    """Yield the calls of ``rclpy.spin`` for the node that was added to an executor."""
    added = file.module.parent(add_node)
    for spin in file.spin_calls:
        match added, spin.call:
            case ast.Call(args=[ast.Name(id=node)]), ast.Call(args=[ast.Name(id=other)]):
                if node == other and not spin.call.keywords and spin.name == "spin":
                    yield spin
