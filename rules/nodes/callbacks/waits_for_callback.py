"""ND117: callbacks do not wait for other callbacks."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule
from scaffold.api.programs import (
    Executed,
    in_callbacks,
    in_constructors,
    in_tasks,
    may_run_meanwhile,
    share_group,
)
from scaffold.api.rclpy import RclpyFile

from ._loop_conditions import attributes_asked

_NODE = (
    "import threading\nimport time\n\nfrom rclpy.node import Node\n"
    "from std_msgs.msg import String\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Relay(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('relay')\n"
    "        self.last = None\n"
    "        self.arrived = threading.Event()\n"
    "        self.create_subscription(String, 'chatter', self.hear, 10)\n"
    "        self.create_service(Trigger, 'ask', self.answer)\n\n"
    "    def hear(self, msg):\n"
    "        self.last = msg\n"
    "        self.arrived.set()\n\n"
    "    def answer(self, request, response):\n"
    "{}"
    "        response.message = self.last.data\n"
    "        return response\n"
)
_THREADS = (
    "\n\ndef main():\n    rclpy.init()\n    executor = MultiThreadedExecutor()\n"
    "    executor.add_node(Relay())\n    executor.spin()\n"
)
_WAITS = (
    "import rclpy\nfrom rclpy.executors import MultiThreadedExecutor\n"
    + _NODE.format("        self.arrived.wait()\n")
    + _THREADS
)


class WaitsForCallback(RclpyRule):
    """A callback or constructor waits for an attribute or event that another callback sets.

    **Why.** One thread runs all callbacks: while one waits, the other cannot run, and the node
    hangs.

    **Fix.** Return, and continue in the callback that sets the attribute. Or use a
    ``MultiThreadedExecutor`` and another callback group.

    **Source.** ROS 2 documentation, "Using callback groups".
    """

    code = "ND117"
    name = "waits-for-callback"
    examples = (
        Example(
            "an event that the constructor spins for",
            {
                "relay.py": _NODE.format("        self.arrived.wait()\n").replace(
                    "self.answer)\n\n",
                    "self.answer)\n        while not self.arrived.is_set():\n"
                    "            rclpy.spin_once(self)\n\n",
                )
            },
        ),
        Example(
            "a loop over an attribute named like a message field",
            {
                "drive.py": "from geometry_msgs.msg import Twist\n"
                "from nav_msgs.msg import Odometry\n"
                "from rclpy.node import Node\n\n\n"
                "class Driver(Node):\n    def __init__(self):\n        super().__init__('driver')\n"
                "        self.x = 0.0\n"
                "        self.pub = self.create_publisher(Twist, 'cmd_vel', 10)\n"
                "        self.create_subscription(Odometry, 'odom', self.on_odom, 10)\n"
                "        self.create_timer(1.0, self.drive)\n\n"
                "    def on_odom(self, msg):\n        self.x = msg.pose.pose.position.x\n\n"
                "    def drive(self):\n        cmd = Twist()\n        cmd.linear.x = 0.2\n"
                "        while self.x < 1.0:\n            self.pub.publish(cmd)\n"
            },
            "20:9: callback 'drive' waits for self.x, which another callback sets: that callback "
            "cannot run meanwhile, and the node hangs",
        ),
        Example(
            "no wait",
            {
                "relay.py": _NODE.format(
                    "        if self.last is None:\n            return response\n"
                )
            },
        ),
        Example(
            "a loop",
            {
                "relay.py": _NODE.format(
                    "        while self.last is None:\n            time.sleep(0.1)\n"
                )
            },
            "22:9: callback 'answer' waits for self.last, which another callback sets: that "
            "callback cannot run meanwhile, and the node hangs",
        ),
        Example(
            "loops over a constant, a sum, a number of messages, a result",
            {
                "relay.py": _NODE.format(
                    "        while self.last:\n"
                    "            time.sleep(0.1)\n"
                    "        while abs(self.last - self.goal) > 0.1:\n"
                    "            time.sleep(0.1)\n"
                    "        while len(self.last) < request.count:\n"
                    "            pass\n"
                    "        while not self.has_come():\n"
                    "            pass\n"
                    "        while self.last and time.time() < 5.0:\n"
                    "            pass\n"
                    "        while self.goal > 0.1:\n"
                    "            pass\n"
                ).replace(
                    "    def hear",
                    "    def has_come(self):\n        return self.last is not None\n\n    def hear",
                )
            },
            "25:9: callback 'answer' waits for self.last, which another callback sets: that "
            "callback cannot run meanwhile, and the node hangs",
            "27:9: callback 'answer' waits for self.last, which another callback sets: that "
            "callback cannot run meanwhile, and the node hangs",
            "29:9: callback 'answer' waits for self.last, which another callback sets: that "
            "callback cannot run meanwhile, and the node hangs",
            "31:9: callback 'answer' waits for self.last, which another callback sets: that "
            "callback cannot run meanwhile, and the node hangs",
        ),
        Example(
            "a loop over a field of the message",
            {
                "relay.py": _NODE.format(
                    "        while self.last.data != 'ready':\n            pass\n"
                )
            },
            "22:9: callback 'answer' waits for self.last, which another callback sets: that "
            "callback cannot run meanwhile, and the node hangs",
        ),
        Example(
            "a loop that ends after some time",
            {
                "relay.py": _NODE.format(
                    "        end = time.time() + 5.0\n"
                    "        while self.last is None and time.time() < end:\n"
                    "            time.sleep(0.1)\n"
                )
            },
        ),
        Example(
            "a loop that calls the function that sets the field",
            {
                "relay.py": _NODE.format(
                    "        while self.last.data != 'ready':\n            self.hear(String())\n"
                )
            },
        ),
        Example(
            "loops that take from a queue, down to a length that another callback sets",
            {
                "relay.py": _NODE.format(
                    "        while len(self.queue) > self.last:\n"
                    "            self.queue.pop(0)\n"
                    "        while self.sizes['a'] > self.last:\n"
                    "            self.drop('a')\n"
                ).replace(
                    "    def hear",
                    "    def drop(self, key):\n        self.sizes[key] -= 1\n\n    def hear",
                )
            },
        ),
        Example(
            "an event",
            {"relay.py": _NODE.format("        self.arrived.wait()\n")},
            "22:9: callback 'answer' waits for self.arrived, which another callback sets: that "
            "callback cannot run meanwhile, and the node hangs",
        ),
        Example(
            "an event with a timeout",
            {
                "relay.py": _NODE.format(
                    "        if not self.arrived.wait(timeout=1.0):\n            return response\n"
                )
            },
            "22:16: callback 'answer' waits for self.arrived, which another callback sets: that "
            "callback cannot run meanwhile, and the wait always times out",
        ),
        Example(
            "an event, with several threads and one callback group",
            {"relay.py": _WAITS},
            "24:9: callback 'answer' waits for self.arrived, which another callback sets: that "
            "callback cannot run meanwhile, and the node hangs",
        ),
        Example(
            "an event, with several threads and two callback groups",
            {
                "relay.py": _WAITS.replace(
                    "self.hear, 10)", "self.hear, 10, callback_group=G())"
                ).replace(
                    "import MultiThreadedExecutor\n",
                    "import MultiThreadedExecutor\n"
                    "from rclpy.callback_groups import MutuallyExclusiveCallbackGroup as G\n",
                )
            },
        ),
        Example(
            "an event that a callback of another group also sets",
            {
                "relay.py": _WAITS.replace(
                    "        self.create_service",
                    "        self.create_timer(1.0, self.start, callback_group=G())\n"
                    "        self.create_service",
                )
                .replace(
                    "        self.last = msg\n        self.arrived.set()\n",
                    "        self.start()\n",
                )
                .replace(
                    "    def answer",
                    "    def start(self):\n        self.arrived.set()\n\n    def answer",
                )
                .replace(
                    "import MultiThreadedExecutor\n",
                    "import MultiThreadedExecutor\n"
                    "from rclpy.callback_groups import MutuallyExclusiveCallbackGroup as G\n",
                )
            },
        ),
        Example(
            "a loop that waits with a timeout and spins",
            {
                "relay.py": _NODE.format(
                    "        while True:\n            rclpy.spin_once(self)\n"
                    "            if self.arrived.wait(timeout=0.1):\n                break\n"
                )
            },
        ),
        Example("with a timeout", {"relay.py": _NODE.format("        self.arrived.wait(1.0)\n")}),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.module.mentions("while ", ".wait("):
            return
        seen: set[ast.AST] = set()
        executions = (*in_callbacks(file), *in_constructors(file), *in_tasks(file))
        callbacks = {x.function for x in executions if x.entity is not None}
        for executed in executions:
            for node, names in _waits(file, executed):
                set_by = {name: _setters(file, name, node) for name in sorted(names)}
                setters = set().union(*set_by.values())
                if (
                    node in seen
                    or _calls(node, setters)
                    or not setters
                    or not setters <= callbacks - {executed.function}
                ):
                    continue
                name = next(name for name, functions in set_by.items() if functions)
                if _is_spun_for(file, name):
                    continue
                if may_run_meanwhile(file, executed) and not _excludes(file, executed, setters):
                    continue
                seen.add(node)
                effect = "the wait always times out" if _is_limited(node) else "the node hangs"
                message = (
                    f"{executed.origin} waits for self.{name}, which another callback sets: that "
                    f"callback cannot run meanwhile, and {effect}"
                )
                yield self.report(file.module.location(node), message)


def _is_spun_for(file: RclpyFile, name: str) -> bool:
    """Return whether a loop spins until an attribute or an event is set."""
    for loop in file.module.walk(ast.While):
        asked = {node.attr for node in ast.walk(loop) if isinstance(node, ast.Attribute)}
        if name in asked and any("spin" in attribute for attribute in asked):
            return True
    return False


def _excludes(file: RclpyFile, executed: Executed, setters: set[ast.AST | None]) -> bool:
    """Return whether a callback prevents all callbacks that could end its wait from running."""
    entity = executed.entity
    if entity is None or executed.is_task or file.module.mentions("Thread("):
        return False
    if any(task.function in setters for task in in_tasks(file)):
        return False
    others = [
        other
        for other, callback in file.callbacks
        if callback.function and not setters.isdisjoint(file.reached(callback.function))
    ]
    return all(share_group(file, entity, other) for other in others)


def _waits(file: RclpyFile, executed: Executed) -> Iterator[tuple[ast.expr | ast.While, set[str]]]:
    """Yield the waits in a function, with the attributes of ``self`` that may end them."""
    for node in file.module.below(executed.function, ast.While, ast.Call):
        if file.function_of(node) is not executed.function:
            continue
        match node:
            case ast.Call(func=ast.Attribute(attr="wait", value=ast.Attribute(attr=name) as event)):
                made = file.evaluator.single_value(event)
                is_event = isinstance(made, ast.Call) and (
                    file.module.qualified_name(made.func) == "threading.Event"
                )
                is_for_good = is_event and (not _is_limited(node) or _is_asked(file, node))
                if is_for_good and not _is_in_spinning_loop(file, node):
                    yield node, {name}
            case ast.While() if not _may_end(node):
                names = attributes_asked(file, node)
                if names and not _changes(file, node, names):
                    yield node, names


def _changes(file: RclpyFile, loop: ast.While, names: set[str]) -> bool:
    """Return whether a loop, or what it calls, changes the content of an attribute."""
    places: list[ast.AST] = [*loop.body]
    for call in file.module.below(loop, ast.Call):
        called = file.callback(call.func).function
        places += file.reached(called) if called else []
    return any(
        isinstance(node, ast.Attribute) and node.attr in names and _is_changed(file, node)
        for place in places
        for node in ast.walk(place)
    )


def _is_changed(file: RclpyFile, node: ast.AST) -> bool:
    """Return whether an item is set in a value, or a method of it is called."""
    parent = file.module.parent(node)
    while isinstance(parent, ast.Subscript | ast.Attribute) and parent.value is node:
        if not isinstance(parent.ctx, ast.Load):
            return True
        node, parent = parent, file.module.parent(parent)
        if isinstance(node, ast.Attribute) and isinstance(parent, ast.Call):
            return parent.func is node
    return False


def _is_limited(node: ast.AST) -> bool:
    """Return whether a call waits with a timeout."""
    return isinstance(node, ast.Call) and bool(node.args or node.keywords)


def _is_asked(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether the result of the wait is used; otherwise it may be a mere sleep."""
    match file.module.parent(call):
        case ast.UnaryOp(op=ast.Not()) as negated:
            return isinstance(file.module.parent(negated), ast.If)
        case ast.If():
            return True
    return False


def _may_end(loop: ast.While) -> bool:
    """Return whether a loop may end by itself, or lets callbacks run."""
    return any(
        isinstance(node, ast.Break | ast.Return | ast.Raise | ast.Yield | ast.Await) or _spins(node)
        for node in ast.walk(loop)
    )


def _is_in_spinning_loop(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether callbacks run between one wait and the next."""
    return any(
        isinstance(parent, ast.While) and any(map(_spins, ast.walk(parent)))
        for parent in file.module.parents(call)
    )


def _spins(node: ast.AST) -> bool:
    return isinstance(node, ast.Attribute) and "spin" in node.attr


def _calls(loop: ast.AST, functions: set[ast.AST | None]) -> bool:
    """Return whether a loop calls one of some methods itself."""
    names = {getattr(function, "name", "") for function in functions}
    return any(isinstance(node, ast.Attribute) and node.attr in names for node in ast.walk(loop))


def _setters(file: RclpyFile, name: str, node: ast.AST) -> set[ast.AST | None]:
    """Return the functions that set an attribute, or an event, outside of constructors."""
    if isinstance(node, ast.Call):
        places: list[ast.AST] = [
            use
            for use in file.module.index.attributes("set")
            if isinstance(use.value, ast.Attribute) and use.value.attr == name
        ]
    else:
        places = [
            store.node
            for store in file.evaluator.stores(name)
            if not _is_field_of_local_message(file, store.node)
        ]
    functions = {file.function_of(place) for place in places}
    return {x for x in functions if getattr(x, "name", "") != "__init__"}


def _is_field_of_local_message(file: RclpyFile, stored: ast.AST) -> bool:
    """Return whether the target is a field of a message created in the same function."""
    while isinstance(stored, ast.Attribute):
        stored = stored.value
    made = file.evaluator.single_value(stored) if isinstance(stored, ast.Name) else None
    if not isinstance(made, ast.Call):
        return False
    name = file.module.qualified_name(made.func) or ""
    return not {"msg", "srv", "action"}.isdisjoint(name.split("."))
