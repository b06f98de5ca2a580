"""ND042: a rate sleeps while another thread spins the node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, ViewError
from scaffold.model.node_owners import NodeClass
from scaffold.model.node_waits import in_callbacks
from scaffold.model.nodes import NodeFacts
from scaffold.model.program_starts import Run, files_of, run_of, starts_of

_OTHER_THREADS = ("thread", "concurrent", "process", "asyncio", "pool", "event", "group", "spin")
_NODE = (
    "import threading\n\nimport rclpy\n\n\n"
    "def main():\n"
    "    rclpy.init()\n"
    "    node = rclpy.create_node('talker')\n"
    "{}"
    "    rate = node.create_rate(10)\n"
    "    while rclpy.ok():\n"
    "        rate.sleep()\n"
)
_THREAD = "    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n"
_FILES = {
    "package.xml": "<package><name>demo</name>"
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(name='demo', packages=['demo'],\n"
    "      entry_points={'console_scripts': ['talker = demo.talker:main']})\n",
}
_ALONE = _NODE.format("").replace("import threading\n\n", "")


class RateNeverWakes(Rule):
    """``rate.sleep()`` waits for a timer that the same thread would have to run.

    **Why.** A rate of rclpy is woken by a timer of the node, and timers run only while the node
    is spun: without a second thread the program stands still at the first ``sleep``, for ever.

    **Fix.** Do the work of the loop in a timer, or spin the node in a thread of its own.

    **Source.** ``rclpy/timer.py``, ``Rate.sleep``; rclpy issue 443.
    """

    code = "ND042"
    name = "rate-never-wakes"
    examples = (
        Example("spun in a thread", {**_FILES, "demo/talker.py": _NODE.format(_THREAD)}),
        Example("nobody spins", {**_FILES, "demo/talker.py": _ALONE}, at=("demo/talker.py:9",)),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        reported: set[ast.Call] = set()
        for start in starts_of(package):
            try:
                run = run_of(package, start)
            except ViewError:
                continue
            if run.facts.module.in_tests or not run.facts.module.index.attributes("create_rate"):
                continue
            for call, where in _sleeps(run):
                if call in reported or any(map(_may_spin, files_of(package, start.path))):
                    continue
                reported.add(call)
                message = f"this sleep never ends: the thread that would wake it is {where}"
                yield self.report(run.facts.module.location(call), message)


def _sleeps(run: Run) -> Iterator[tuple[ast.Call, str]]:
    """Yield where the main thread, or a callback that it runs, sleeps with a rate."""
    functions: list[ast.AST] = [*run.functions]
    for _, owner in run.nodes():
        if isinstance(owner, NodeClass) and owner.constructor and owner.facts is run.facts:
            functions += run.facts.reached(owner.constructor)
    places = dict.fromkeys(functions, "the one that sleeps")
    for executed in in_callbacks(run.facts):
        class_ = run.facts.module.enclosing_class(executed.function)
        if class_ is not None and class_ not in _classes(run):
            continue
        places.setdefault(executed.function, f"in {executed.origin}")
    for call in run.facts.module.walk(ast.Call):
        function = run.facts.function_of(call)
        where = places.get(function) if function else None
        if where is None and call in run.calls:
            where = "the one that sleeps"
        if where and _is_sleep(run.facts, call):
            yield call, where


def _classes(run: Run) -> set[ast.ClassDef]:
    """Return the classes of the nodes that a program makes, with their bases in the file."""
    owners = [owner for _, owner in run.nodes() if isinstance(owner, NodeClass)]
    related = run.facts.related_classes
    return {one for owner in owners if owner.facts is run.facts for one in related(owner.node)}


def _is_sleep(facts: NodeFacts, call: ast.Call) -> bool:
    if not isinstance(call.func, ast.Attribute) or call.func.attr != "sleep":
        return False
    match facts.evaluator.single_value(call.func.value):
        case ast.Call(func=ast.Attribute(attr="create_rate", value=node)):
            return facts.owner_of(node) is not None
    return False


def _may_spin(facts: NodeFacts) -> bool:
    """Tell whether a file may spin a node in another thread, or step by step."""
    for call in facts.spin_calls:
        if call.name.rpartition(".")[2] != "spin":
            return True
    known = {call.call.func for call in facts.spin_calls}
    names = [name.id for name in facts.module.walk(ast.Name) if name not in known]
    names += [name.attr for name in facts.module.walk(ast.Attribute) if name not in known]
    names += [word.arg for word in facts.module.walk(ast.keyword) if word.arg]
    names = [name.lower() for name in names if name != "SingleThreadedExecutor"]
    if any(word in name for name in names for word in _OTHER_THREADS):
        return True
    return any(one.root in {"threading", "asyncio", "_thread"} for one in facts.module.imports)
