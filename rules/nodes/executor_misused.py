"""ND096: executors have nodes and are spun."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.programs import used_of_executor
from scaffold.api.rclpy import RclpyCall, RclpyFile

_NODE = (
    "import rclpy\nfrom rclpy.executors import SingleThreadedExecutor\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, print)\n\n\n"
    "def main():\n    rclpy.init()\n    node = Talker()\n"
    "    executor = SingleThreadedExecutor()\n{}"
)
_ADD = "    executor.add_node(node)\n"
_SPIN = "    executor.spin()\n"


class ExecutorMisused(RclpyRule):
    """An executor has no node, gets a class instead of a node, or is never spun.

    **Why.** No callback is ever called: an executor without nodes waits forever, and does nothing
    unless it is spun. A class instead of a node raises ``TypeError: 'property' object is not
    iterable``. ``rclpy.spin(node)`` takes the node to another executor, with one thread.

    **Fix.** ``executor.add_node(node)`` and ``executor.spin()``.

    **Source.** ``rclpy/executors.py``.
    """

    code = "ND096"
    name = "executor-misused"
    other_severities = {Severity.WARNING: "callbacks run, but in one thread"}
    examples = (
        Example("with a node, spun", {"talker.py": _NODE.format(_ADD + _SPIN)}),
        Example(
            "a class",
            {"talker.py": _NODE.format(_ADD.replace("node)", "Talker)") + _SPIN)},
            Report("16:23", "'Talker' is a class, not a node: TypeError; write Talker()"),
        ),
        Example(
            "no node",
            {"talker.py": _NODE.format(_SPIN)},
            Report("16:5", "executor without nodes: no callback ever runs; call add_node() first"),
        ),
        Example(
            "not spun",
            {"talker.py": _NODE.format(_ADD)},
            Report("15:16", "executor is never spun: the callbacks of its nodes never run"),
        ),
        Example(
            "one of many threads",
            {
                "talker.py": _NODE.replace("SingleThreaded", "MultiThreaded")
                .replace("Executor()", "Executor(num_threads=1)")
                .format(_ADD + _SPIN)
            },
            Report(
                "15:16",
                "a MultiThreadedExecutor with one thread runs callbacks one at a "
                "time; leave num_threads out",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "with many threads that are not used",
            {
                "talker.py": _NODE.replace("SingleThreaded", "MultiThreaded").format(
                    _ADD + "    rclpy.spin(node)\n"
                )
            },
            Report(
                "17:5",
                "rclpy.spin() does not use the executor of line 15: callbacks run "
                "one at a time; call spin() of the executor",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.module.walk(ast.Call):
            added = _added_class(file, call)
            if added:
                message = f"'{added}' is a class, not a node: TypeError; write {added}()"
                yield self.report(file.module.location(call.args[0]), message)
            if _has_one_thread(file, call):
                message = (
                    "a MultiThreadedExecutor with one thread runs callbacks one at a time; "
                    "leave num_threads out"
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
            elif "add_node" in used and not is_spun and not file.spin_calls:
                message = "executor is never spun: the callbacks of its nodes never run"
                yield self.report(file.module.location(call), message)
            elif "add_node" in used and not is_spun and _has_many_threads(call):
                for other in _other_spins(file, used["add_node"]):
                    message = (
                        f"rclpy.spin() does not use the executor of line {call.lineno}: "
                        "callbacks run one at a time; call spin() of the executor"
                    )
                    yield self.report(other, message, severity=Severity.WARNING)


def _added_class(file: RclpyFile, call: ast.Call) -> str:
    """Return the name of a node class that is passed to ``add_node`` instead of a node."""
    match call:
        case ast.Call(func=ast.Attribute(attr="add_node"), args=[ast.Name() as node]):
            class_ = file.evaluator.named_class(node)
            if class_ is not None and file.node_class(class_) is not None:
                return class_.name
    return ""


def _has_many_threads(call: ast.Call) -> bool:
    return ast.unparse(call.func).endswith("MultiThreadedExecutor")


def _has_one_thread(file: RclpyFile, call: ast.Call) -> bool:
    if not _has_many_threads(call) or file.module.in_tests:
        return False
    given = [*call.args[:1], *(word.value for word in call.keywords if word.arg == "num_threads")]
    return bool(given) and file.evaluator.evaluate(given[0]) == 1


def _other_spins(file: RclpyFile, add_node: ast.AST) -> Iterator[RclpyCall]:
    """Yield the calls of ``rclpy.spin`` for the node that was added to an executor."""
    added = file.module.parent(add_node)
    for spin in file.spin_calls:
        match added, spin.call:
            case ast.Call(args=[ast.Name(id=node)]), ast.Call(args=[ast.Name(id=other)]):
                if node == other and not spin.call.keywords and spin.name == "spin":
                    yield spin
