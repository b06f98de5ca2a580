"""ND014: nodes with callbacks are spun."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence

from scaffold.api import Diagnostic, Effect, Example, Package, RclpyRule
from scaffold.api.rclpy import (
    NodeClass,
    NodeDefinition,
    RclpyCall,
    RclpyFile,
    is_used_elsewhere,
)

_RUNNING = ("spin", "executor", "add_node", "run", "thread", "start", "launch", "wait")
_NODE = (
    "import rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def tick(self):\n"
    "        pass\n\n\n"
    "def main():\n"
    "    rclpy.init()\n"
    "    node = Talker()\n"
    "{}    node.destroy_node()\n\n\nif __name__ == '__main__':\n    main()\n"
)


class NodeNeverSpun(RclpyRule):
    """A node has timers or subscriptions, but nothing in the program spins it.

    **Why.** Callbacks only run while the node is spun: the program exits at once, or hangs without
    doing anything.

    **Fix.** Call ``rclpy.spin(node)``.

    **Source.** ``rclpy/__init__.py``, ``spin``; ROS 2 documentation, "About executors".
    """

    code = "ND014"
    name = "node-never-spun"
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("spun", {"talker.py": _NODE.format("    rclpy.spin(node)\n")}),
        Example(
            "never spun",
            {"talker.py": _NODE.format("")},
            "16:12: Talker is never spun: its callbacks never run; call rclpy.spin()",
        ),
        Example(
            "sleeping in a loop",
            {"talker.py": _NODE.format("    time.sleep(9)\n")},
            "16:12: Talker is never spun: its callbacks never run; call rclpy.spin()",
        ),
        Example(
            "sleeping in a loop of a method, in the same thread and in another one",
            {
                name: _NODE.format(f"    {start}\n").replace(
                    "        pass\n", "        pass\n\n    def run(self):\n        time.sleep(9)\n"
                )
                for name, start in {
                    "talker.py": "node.run()",
                    "threads.py": "threading.Thread(target=node.run).start()",
                }.items()
            },
            "talker.py:19:12: Talker is never spun: its callbacks never run; call rclpy.spin()",
        ),
        Example(
            "one of two nodes, and a node in a node",
            {
                "talker.py": _NODE.replace(
                    "        self.create_timer(1",
                    "        self.inner = rclpy.create_node('other')\n"
                    "        self.inner.create_timer(1.0, print)\n"
                    "        self.create_timer(1",
                ).format("    other = Talker()\n    rclpy.spin(other)\n"),
            },
            "8:22: the node from rclpy.create_node is never spun: its callbacks never run",
            "18:12: the node from Talker is never spun: its callbacks never run",
        ),
        Example(
            "spun in a loop",
            {"talker.py": _NODE.format("    while rclpy.ok():\n        rclpy.spin_once(node)\n")},
        ),
        Example(
            "once, for one message",
            {
                "talker.py": _NODE.replace(
                    "timer(1.0, self.tick)", "subscription(Empty, 'go', self.go, 1)"
                ).format("    rclpy.spin_once(node)\n")
            },
        ),
        Example(
            "spun once",
            {"talker.py": _NODE.format("    rclpy.spin_once(node)\n")},
            "17:5: spin_once() outside a loop runs at most one callback; use spin()",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        waiting = {node.name: node for node in file.classes if _waits(node)}
        if file.init_calls and file.spin_calls:
            for call in _left_out(package, file, waiting):
                name = file.module.text(call.func)
                message = f"the node from {name} is never spun: its callbacks never run"
                yield self.report(file.module.location(call), message)
        if not file.init_calls or not waiting:
            return
        lasts = any(node.timers or node.services for node in waiting.values())
        if lasts and len(file.spin_calls) == 1 and _is_once(file, file.spin_calls[0]):
            message = "spin_once() outside a loop runs at most one callback; use spin()"
            yield self.report(file.spin_calls[0], message)
        if file.spin_calls or self._may_run(file):
            return
        for call in file.module.walk(ast.Call):
            if isinstance(call.func, ast.Name) and call.func.id in waiting:
                message = (
                    f"{call.func.id} is never spun: its callbacks never run; call rclpy.spin()"
                )
                yield self.report(file.module.location(call), message)

    def _may_run(self, file: RclpyFile) -> bool:
        """Return whether anything in the file may run callbacks in another way."""
        names = {node.attr for node in file.module.walk(ast.Attribute)}
        names |= {node.id for node in file.module.walk(ast.Name)}
        names -= {node.name for node in file.module.walk(ast.FunctionDef)}  # also looked through
        return any(word in name.lower() for name in names for word in _RUNNING)


def _left_out(
    package: Package, file: RclpyFile, waiting: Mapping[str, NodeClass]
) -> Iterator[ast.Call]:
    """Yield the creations of nodes that are not passed on, so that nothing else can spin them."""
    objects = {node.constructor_call for node in file.objects if _waits(node)}
    for call in file.module.walk(ast.Call):
        uses: Sequence[ast.Name | ast.Attribute]
        class_ = waiting.get(call.func.id) if isinstance(call.func, ast.Name) else None
        if call not in objects and (class_ is None or _spins_itself(file, class_)):
            continue
        match file.module.parent(call):
            case ast.Assign(targets=[ast.Name() as name]):
                scope = file.module.index.lookup(name.id, name)
                uses = file.module.index.uses_of(name)
                is_own = scope is not None and len(scope[1]) == 1
                is_own = is_own and not isinstance(scope and scope[0], ast.Module)
            case ast.Assign(targets=[ast.Attribute(value=ast.Name(id="self"), attr=attribute)]):
                uses = file.module.index.attributes(attribute)
                is_own = not is_used_elsewhere(package, file, attribute)
            case _:
                continue
        if is_own and not any(_hands_on(file, use) for use in uses):
            yield call


def _spins_itself(file: RclpyFile, class_: NodeClass) -> bool:
    """Return whether a node, or an unknown base class, may spin the node itself."""
    names = (node.attr for node in file.module.below(class_.node, ast.Attribute))
    if any(map(_may_spin, names)) or _is_spun_by_code(file, class_.node):
        return True
    if class_.base is None:
        return False
    return class_.base.file is not file or _spins_itself(file, class_.base)


def _is_spun_by_code(file: RclpyFile, class_: ast.ClassDef) -> bool:
    # Unparsing is slow, and few files have these words.
    return _may_spin(file.module.text(class_)) and _may_spin(ast.unparse(class_))


def _may_spin(words: str) -> bool:
    return any(word in words.lower() for word in ("spin", "executor", "thread", "add_node"))


def _hands_on(file: RclpyFile, use: ast.Name | ast.Attribute) -> bool:
    """Return whether a node is passed on, besides calling its methods and reading attributes."""
    parent = file.module.parent(use)
    is_read = isinstance(parent, ast.Attribute) and isinstance(parent.ctx, ast.Load)
    return isinstance(use.ctx, ast.Load) and not is_read


def _is_once(file: RclpyFile, spin: RclpyCall) -> bool:
    """Return whether a program with this entry point spins its node once and ends."""
    if spin.name != "spin_once" or spin.function is None:
        return False
    is_program = file.module.has_main_guard or getattr(spin.function, "name", "") == "main"
    in_loop = any(
        isinstance(parent, ast.For | ast.While) and parent.lineno > spin.function.lineno
        for parent in file.module.parents(spin.call)
    )
    return (
        is_program and not in_loop and spin.function in {init.function for init in file.init_calls}
    )


def _waits(node: NodeDefinition) -> bool:
    return bool(node.timers or node.subscriptions or node.services or node.action_servers)
