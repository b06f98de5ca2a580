"""ND031: constructors and callbacks return."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.programs import Executed, blocks_node, in_callbacks, in_constructors, in_tasks
from scaffold.api.rclpy import RclpyFile

from ._spinning import needs_spin

_EMERGENCY = re.compile(r"(?i)emergency|panic|e[-_]?stop(?![a-z])|halt(?![a-z])")
_NODE = (
    "import rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "{}"
    "    def tick(self):\n        pass\n"
)
_LOOP = "        while rclpy.ok():\n            self.tick()\n\n"
_DONE = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.client = self.create_client(Trigger, 'reset')\n"
    "        self.tries = 0\n"
    "        future = self.client.call_async(Trigger.Request())\n"
    "        future.add_done_callback(self.work)\n\n"
    "    def work(self, future):\n"
    "        while rclpy.ok():\n"
    "            self.tries += 1\n\n\n"
    "def main():\n"
    "    rclpy.init()\n"
    "    {}\n"
)
_CALLBACK = (
    "import rclpy\nfrom rclpy.callback_groups import ReentrantCallbackGroup\n"
    "from rclpy.executors import MultiThreadedExecutor\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.exits = 0\n"
    "        self.create_timer(1.0, self.work, callback_group=ReentrantCallbackGroup())\n\n"
    "    def work(self):\n"
    "        while rclpy.ok():\n"
    "            self.exits += 1\n\n\n"
    "def main():\n"
    "    rclpy.init()\n"
    "    {}\n"
)


class EndlessLoop(RclpyRule):
    """A constructor or callback of a node loops forever.

    **Why.** The program never reaches ``rclpy.spin``, or never returns to it: the node may publish,
    but its subscriptions, services and parameters do not work.

    **Fix.** Run one step of the loop in a timer callback.

    **Source.** ROS 2 documentation, "Migrating a Python package example"; "Executors".
    """

    code = "ND031"
    name = "endless-loop"
    other_severities = {
        Severity.WARNING: "the file has no callbacks or clients and only publishes, or the loop "
        "is only entered in an emergency"
    }
    examples = (
        Example(
            "a timer", {"talker.py": _NODE.format("        self.create_timer(1, self.tick)\n\n")}
        ),
        Example(
            "a loop",
            {"talker.py": _NODE.format("        self.create_timer(1, self.tick)\n" + _LOOP)},
            "9:9: endless loop: the constructor of Talker never returns; use a timer",
        ),
        Example(
            "a loop over all input",
            {
                "talker.py": _NODE.format(
                    "        self.create_timer(1, self.tick)\n        for line in sys.stdin:\n"
                    "            print(line)\n\n"
                ).replace("import rclpy", "import sys\n\nimport rclpy", 1)
            },
            "11:9: endless loop: the constructor of Talker never returns; use a timer",
        ),
        Example(
            "a loop of a node without callbacks",
            {"talker.py": _NODE.format(_LOOP)},
            Report(
                "8:9",
                "endless loop: the constructor of Talker never returns; use a timer",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a loop that sends requests and ignores the responses",
            {
                "caller.py": _NODE.format(
                    "        self.client = self.create_client(Trigger, 'reset')\n" + _LOOP
                )
                .replace(
                    "        pass",
                    "        self.client.call_async(Trigger.Request())",
                )
                .replace("Node\n", "Node\nfrom std_srvs.srv import Trigger\n", 1)
            },
            Report(
                "10:9",
                "endless loop: the constructor of Talker never returns; use a timer",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a loop while a thread spins",
            {
                "talker.py": _NODE.format(
                    "        threading.Thread(target=rclpy.spin, args=(self,)).start()\n" + _LOOP
                ).replace("import rclpy", "import threading\n\nimport rclpy", 1)
            },
        ),
        Example(
            "a loop next to a thread that does not spin",
            {
                "talker.py": _NODE.format(
                    "        threading.Thread(target=self.tick).start()\n"
                    "        self.create_timer(1, self.tick)\n" + _LOOP
                ).replace("import rclpy", "import threading\n\nimport rclpy", 1)
            },
            "12:9: endless loop: the constructor of Talker never returns; use a timer",
        ),
        Example(
            "a loop in a callback, with one thread and any callback group",
            {"talker.py": _CALLBACK.format("rclpy.spin(Talker())")},
            "14:9: endless loop: callback 'work' never returns; use a timer",
        ),
        Example(
            "a loop in a callback, with several threads",
            {"talker.py": _CALLBACK.format("rclpy.spin(Talker(), MultiThreadedExecutor())")},
        ),
        Example(
            "a loop when a future is done, in one thread",
            {"caller.py": _DONE.format("rclpy.spin(Caller())")},
            "15:9: endless loop: callback 'work' never returns; use a timer",
        ),
        Example(
            "a loop when a future is done, in several threads",
            {
                "caller.py": _DONE.format("rclpy.spin(Caller(), MultiThreadedExecutor())").replace(
                    "import rclpy\n",
                    "import rclpy\nfrom rclpy.executors import MultiThreadedExecutor\n",
                    1,
                )
            },
        ),
        Example(
            "a loop that stops a robot in an emergency",
            {
                "talker.py": _NODE.format("        self.create_timer(1, self.tick)\n\n").replace(
                    "        pass",
                    "        if self.emergency:\n            while True:\n"
                    "                self.stop()",
                )
            },
            Report(
                "12:13",
                "endless loop: callback 'tick' never returns; use a timer",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a loop that ends", {"talker.py": _NODE.format(_LOOP.replace("self.tick()", "break"))}
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        seen: set[ast.AST] = set()
        for executed in (*in_constructors(file), *in_callbacks(file), *in_tasks(file)):
            for loop in _endless_loops(file, executed):
                if loop not in seen and blocks_node(file, executed):
                    seen.add(loop)
                    message = f"endless loop: {executed.origin} never returns; use a timer"
                    is_meant = not needs_spin(file) or _is_in_emergency(file, loop)
                    severity = Severity.WARNING if is_meant else Severity.ERROR
                    yield self.report(file.module.location(loop), message, severity=severity)


def _is_in_emergency(file: RclpyFile, loop: ast.While | ast.For) -> bool:
    """Return whether a loop is in an emergency function, or in a condition."""
    function = file.function_of(loop)
    conditions = [item.test for item in file.module.parents(loop) if isinstance(item, ast.If)]
    names = [getattr(function, "name", ""), *map(file.module.text, conditions)]
    return any(map(_EMERGENCY.search, names))


def _endless_loops(file: RclpyFile, executed: Executed) -> Iterator[ast.While | ast.For]:
    below, function = file.module.below, executed.function
    loops: list[ast.While | ast.For] = [*below(function, ast.While), *below(function, ast.For)]
    for loop in loops:
        if file.function_of(loop) is not executed.function:
            continue
        if _is_endless(file, loop) and not any(_may_end(node) for node in ast.walk(loop)):
            yield loop


def _is_endless(file: RclpyFile, loop: ast.While | ast.For) -> bool:
    if isinstance(loop, ast.For):
        return file.module.qualified_name(loop.iter) == "sys.stdin"
    test = loop.test
    if isinstance(test, ast.Constant):
        return bool(test.value)
    return isinstance(test, ast.Call) and file.module.qualified_name(test.func) == "rclpy.ok"


def _may_end(node: ast.AST) -> bool:
    """Return whether a node may end a loop or let callbacks run in it."""
    match node:
        case ast.Break() | ast.Return() | ast.Raise() | ast.Yield() | ast.Await():
            return True
        case ast.Call(func=ast.Attribute(attr=name) | ast.Name(id=name)):
            return "spin" in name or "exit" in name or "shutdown" in name
    return False
