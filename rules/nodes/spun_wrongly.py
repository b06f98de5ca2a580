"""ND057: only live nodes are spun."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.programs import Shutdowns
from scaffold.api.rclpy import RclpyCall, RclpyFile, class_of

_NODE = (
    "import rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, print)\n\n\n"
    "def main():\n    rclpy.init()\n    node = Talker()\n{}"
)


class SpunWrongly(RclpyRule):
    """A class or executor is spun instead of a node, or a node after the shutdown.

    **Why.** ``rclpy.spin(Talker)`` fails with ``TypeError: 'property' object is not iterable``;
    after ``rclpy.shutdown()``, spinning has no effect. ``rclpy.spin`` returns only at the shutdown:
    a node that is spun after it never runs its callbacks. Two threads cannot spin at the same time.

    **Fix.** ``rclpy.spin(node)``, or ``executor.spin()``.

    **Source.** ``rclpy/__init__.py``.
    """

    code = "ND057"
    name = "spun-wrongly"
    examples = (
        Example(
            "a node",
            {"talker.py": _NODE.format("    rclpy.spin(node)\n")},
        ),
        Example(
            "a class",
            {"talker.py": _NODE.format("    rclpy.spin(Talker)\n")},
            Report("14:5", "'Talker' is a class, not a node: TypeError; write Talker()"),
        ),
        Example(
            "after shutdown",
            {"talker.py": _NODE.format("    rclpy.shutdown()\n    rclpy.spin(node)\n")},
            Report("15:5", "rclpy is already shut down in line 14: nothing is spun"),
        ),
        Example(
            "an executor",
            {
                "talker.py": _NODE.format(
                    "    executor = SingleThreadedExecutor()\n    executor.add_node(node)\n"
                    "    rclpy.spin(executor)\n"
                ).replace("\nfrom", "\nfrom rclpy.executors import SingleThreadedExecutor\nfrom", 1)
            },
            Report("17:5", "this is an executor, not a node: AttributeError; call its spin()"),
        ),
        Example(
            "two nodes, one after the other",
            {"talker.py": _NODE.format("    rclpy.spin(node)\n    rclpy.spin(Talker())\n")},
            Report(
                "15:5",
                "the spin of line 14 returns only at the shutdown: this node is "
                "never spun; add both to an executor",
            ),
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
            Report(
                "16:5",
                "the thread of line 15 spins 'node' already: ValueError: generator "
                "already executing; wait for the future in another way",
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
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
                if any(word.arg == "executor" for word in call.call.keywords):
                    continue
                if file.module.text(node) == name and _share_scope(file, thread, call.call):
                    message = (
                        f"the thread of line {thread.lineno} spins {name!r} already: ValueError: "
                        "generator already executing; wait for the future in another way"
                    )
                    yield self.report(call, message)


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
    line = _spun_before(file, call)
    if line:
        return (
            f"the spin of line {line} returns only at the shutdown: this node is never spun; "
            "add both to an executor"
        )
    return ""


def _spinning_threads(file: RclpyFile) -> Iterator[tuple[ast.Call, str]]:
    """Yield the threads that spin a node, with what the node is called."""
    for call in file.module.walk(ast.Call) if file.module.mentions("Thread(") else ():
        if file.module.qualified_name(call.func) != "threading.Thread":
            continue
        words = {word.arg: word.value for word in call.keywords}
        target, args = words.get("target"), words.get("args")
        if target is None or file.module.qualified_name(target) != "rclpy.spin":
            continue
        if isinstance(args, ast.Tuple | ast.List) and len(args.elts) == 1:
            yield call, file.module.text(args.elts[0])


def _share_scope(file: RclpyFile, thread: ast.Call, call: ast.Call) -> bool:
    """Return whether a name means the same node in two calls."""
    functions = [file.module.enclosing_function(node) for node in (thread, call)]
    classes = [file.module.enclosing_class(node) for node in (thread, call)]
    if functions[0] is functions[1]:
        return thread.lineno < call.lineno and not file.is_conditional(thread)
    return classes[0] is not None and classes[0] is classes[1] and "self" in ast.unparse(call)


def _spun_before(file: RclpyFile, call: RclpyCall) -> int:
    """Return the line of a call ahead in the same block that spins until the shutdown."""
    statement = file.module.parent(call.call)
    block = file.module.parent(statement) if isinstance(statement, ast.Expr) else None
    for other in file.spin_calls if call.name == "spin" else ():
        before = file.module.parent(other.call)
        if other.name != "spin" or not isinstance(before, ast.Expr) or before is statement:
            continue
        if file.module.parent(before) is block and before.lineno < call.call.lineno:
            return before.lineno if not _is_again(file, before, call.call) else 0
    return 0


def _is_again(file: RclpyFile, before: ast.stmt, call: ast.Call) -> bool:
    """Return whether rclpy is started anew between two calls."""
    return any(before.lineno < init.location.line < call.lineno for init in file.init_calls)
