"""ND093: methods are called, not only referenced."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity
from scaffold.api.rclpy import NODE, NodeClass, RclpyFile, class_of, is_method, only_while_stopping

_SHUTDOWN = frozenset({"rclpy.shutdown", "rclpy.try_shutdown"})
_FUNCTIONS = _SHUTDOWN | {"rclpy.init"}
_FUNCTION_HAS = ("func", "self")
"""Attributes of bound methods and wrappers."""
_NODE = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.client = self.create_client(Trigger, 'reset')\n"
    "        self.start = self.get_clock{}.now()\n"
    "        while rclpy.ok{} and not self.client.service_is_ready{}:\n"
    "            self.get_logger().info('waiting')\n"
    "        self.destroy_node{}\n"
    "        rclpy.shutdown{}\n"
)
_HEAD = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "def main(node: Node):\n"
    "    client = rclpy.create_node('asker').create_client(Trigger, 'reset')\n"
)
_VALUES = _HEAD + (
    "    log = rclpy.create_node('talker').get_logger()\n"
    "    say = getattr(log, 'warning', None) or log.warn\n"
    "    call = rclpy.ok() and client.call_async\n"
    "    say(f'{call}')\n"
)
_PARTS = _HEAD + (
    "    is_ready = client.service_is_ready and rclpy.ok()\n"
    "    if (rclpy.ok or client.service_is_ready) and not is_ready:\n"
    "        return 'early' if client.service_is_ready else 'late'\n"
    "    return ''\n"
)


class MethodNotCalled(RclpyRule):
    """A method of rclpy or of the node is not called, because its parentheses are missing.

    **Why.** ``AttributeError: 'function' object has no attribute 'now'``; as a condition, a
    method is always true, like a generator; as a statement, it does nothing.

    **Fix.** Add the parentheses; pass the generator to ``any()`` or ``all()``.

    **Source.** The classes of rclpy 7.1 (ROS 2 Jazzy).
    """

    code = "ND093"
    name = "method-not-called"
    other_severities = {
        Severity.WARNING: "it is a shutdown at the end of the program, or a log message"
    }
    examples = (
        Example(
            "lambdas in a table and in a callback, which return a method",
            {
                "keys.py": "import tkinter\n\nfrom rclpy.node import Node\n\n\n"
                "class Keys(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('keys')\n"
                "        self.actions = {'w': lambda: self.drive, 's': lambda: self.stop()}\n"
                "        self.button = tkinter.Button(command=lambda: self.stop)\n"
                "        self.later = lambda: self.stop\n\n"
                "    def drive(self):\n        pass\n\n"
                "    def stop(self):\n        pass\n"
            },
            "9:38: 'drive' is a method that is not called; write drive()",
            "10:54: 'stop' is a method that is not called; write stop()",
        ),
        Example("called", {"talker.py": _NODE.format("()", "()", "()", "()", "()")}),
        Example(
            "not called: as a value, as conditions, as a statement",
            {"talker.py": _NODE.format("", "", "", "", "")},
            "10:22: 'get_clock' is a method that is not called; write get_clock()",
            "11:15: rclpy.ok is a function: always true; write rclpy.ok()",
            "11:32: 'service_is_ready' is a method that is not called; write service_is_ready()",
            "13:9: 'destroy_node' is a method that is not called; write destroy_node()",
            "14:9: rclpy.shutdown is not called; add the parentheses",
        ),
        Example(
            "at the end of a program",
            {
                "talker.py": "import rclpy\nfrom rclpy.node import Node\n\n\ndef main():\n"
                "    rclpy.init()\n    node = Node('talker')\n    rclpy.spin(node)\n"
                "    node.get_logger().info\n    node.destroy_node\n    rclpy.shutdown\n\n\n"
                "class Listener(Node):\n    def __init__(self):\n"
                "        super().__init__('listener')\n        rclpy.shutdown()\n"
            },
            Report(
                "9:5",
                "'info' is a method that is not called; write info()",
                severity=Severity.WARNING,
            ),
            Report(
                "10:5",
                "'destroy_node' is a method that is not called; write destroy_node()",
                severity=Severity.WARNING,
            ),
            Report(
                "11:5",
                "rclpy.shutdown is not called; add the parentheses",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "before the shutdown of a program that spins once",
            {
                "talker.py": "import rclpy\nfrom rclpy.node import Node\n\n\ndef main():\n"
                "    rclpy.init()\n    node = Node('talker')\n    rclpy.spin_once(node)\n"
                "    node.destroy_node\n    rclpy.shutdown()\n"
            },
            Report(
                "9:5",
                "'destroy_node' is a method that is not called; write destroy_node()",
                severity=Severity.WARNING,
            ),
        ),
        Example("as values, one of which is called later", {"talker.py": _VALUES}),
        Example(
            "a method of the node as a condition, and as a value",
            {
                "talker.py": _NODE.format("()", "()", "()", "()", "()")
                + "        if not self.is_done and self.on_done:\n"
                "            self.later = self.is_done\n\n"
                "    def is_done(self):\n        return True\n\n"
                "    @property\n    def on_done(self):\n        return None\n"
            },
            "15:16: 'is_done' is a method that is not called; write is_done()",
        ),
        Example(
            "a method of the node as a statement, and compared",
            {
                "talker.py": _NODE.format("()", "()", "()", "()", "()") + "        self.stop\n"
                "        self.create_timer(1.0, self.tick)\n        self.tick\n"
                "        assert self.stop is True\n"
                "        assert self.stop is not None\n\n"
                "    def stop(self):\n        return True\n\n"
                "    def tick(self):\n        pass\n"
            },
            "15:9: 'stop' is a method that is not called; write stop()",
            "18:16: 'stop' is a method that is not called; write stop()",
        ),
        Example(
            "an event",
            {
                "talker.py": _NODE.format("()", "()", "()", "()", "()").replace(
                    "        while rclpy",
                    "        self.stopped = threading.Event()\n"
                    "        self.stopped.clear\n"
                    "        if self.stopped or self.stopped.is_set():\n            return\n"
                    "        while rclpy",
                )
                + "import threading\n"
            },
            "12:9: self.stopped.clear is not called; add the parentheses",
            "13:12: self.stopped is an Event, which is always true; write self.stopped.is_set()",
        ),
        Example(
            "generators, as a condition and in one",
            {
                "home.py": "import rclpy\n\nnode = rclpy.create_node('home')\n"
                "places = [1.0, None]\n"
                "if (place is not None for place in places):\n"
                "    node.get_logger().info('home')\n"
                "if all(place is not None for place in places):\n"
                "    node.get_logger().info('home')\n"
            },
            "5:4: a generator is always true; write any(...) or all(...) around it",
        ),
        Example(
            "in parts of conditions",
            {"talker.py": _PARTS},
            "8:16: 'service_is_ready' is a method that is not called; write service_is_ready()",
            "9:9: rclpy.ok is a function: always true; write rclpy.ok()",
            "9:21: 'service_is_ready' is a method that is not called; write service_is_ready()",
            "10:27: 'service_is_ready' is a method that is not called; write service_is_ready()",
        ),
        Example(
            "futures in a comprehension",
            {
                "chooser.py": "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
                "class Chooser(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('chooser')\n"
                "        self.client = self.create_client(Trigger, 'choose')\n"
                "        self.sent = []\n\n"
                "    def choose(self):\n"
                "        self.sent.append(self.client.call_async(Trigger.Request()))\n\n"
                "    def finished(self):\n"
                "        return [future for future in self.sent if future.done]\n"
            },
            "15:51: 'done' is a method that is not called; write done()",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if package.name == "rclpy":
            return
        yield from self._check_generators(file)
        for node in file.module.walk(ast.Attribute):
            if type(file.module.parent(node)) not in _PLACES or not isinstance(node.ctx, ast.Load):
                continue
            if not _needs_value(file, node):
                continue
            if file.module.qualified_name(node) == "rclpy.ok":
                message = "rclpy.ok is a function: always true; write rclpy.ok()"
                yield self.report(file.module.location(node), message)
            elif file.module.qualified_name(node) in _FUNCTIONS:
                message = f"{file.module.text(node)} is not called; add the parentheses"
                yield self.report(file.module.location(node), message, severity=_level(file, node))
            elif _is_condition(file, node) and _is_event(file, node):
                text = file.module.text(node)
                message = f"{text} is an Event, which is always true; write {text}.is_set()"
                yield self.report(file.module.location(node), message)
            elif _is_method_of_thread(file, node):
                message = f"{file.module.text(node)} is not called; add the parentheses"
                yield self.report(file.module.location(node), message)
            elif _is_method_of_rclpy(file, node) or _is_own_method(file, node):
                message = f"{node.attr!r} is a method that is not called; write {node.attr}()"
                yield self.report(file.module.location(node), message, severity=_level(file, node))

    def _check_generators(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for generator in file.module.walk(ast.GeneratorExp):
            if _is_condition(file, generator):
                message = "a generator is always true; write any(...) or all(...) around it"
                yield self.report(file.module.location(generator), message)


_PLACES = frozenset(
    {ast.Attribute, ast.BoolOp, ast.Compare, ast.Expr, ast.If, ast.IfExp, ast.Lambda}
    | {ast.UnaryOp, ast.While, ast.comprehension}
)
"""Nodes in which an uncalled method may be an error."""


def _level(file: RclpyFile, node: ast.Attribute) -> Severity:
    """Return the severity: cleanup at the end of a program is also done by the system."""
    statement = file.module.parent(node)
    if not isinstance(statement, ast.Expr):
        return Severity.ERROR
    is_late = only_while_stopping(file.module, node) or _is_before_shutdown(file, statement)
    is_late = is_late and node.attr in _TIDYING
    return Severity.WARNING if is_late or node.attr in _LOGGING else Severity.ERROR


def _is_before_shutdown(file: RclpyFile, statement: ast.stmt) -> bool:
    """Return whether a later statement of the same block shuts rclpy down."""
    field, start = file.module.index.place(statement)
    later = getattr(file.module.parent(statement), field)[start + 1 :]
    calls = [item.value for item in later if isinstance(item, ast.Expr)]
    return any(
        isinstance(call, ast.Call) and file.module.qualified_name(call.func) in _SHUTDOWN
        for call in calls
    )


_CALLBACKS = frozenset({"callback", "command", "on_press", "target"})
"""Arguments that are called without using the result."""
_LOGGING = frozenset({"debug", "info", "warn", "warning", "error", "fatal"})
_TIDYING = frozenset({"shutdown", "try_shutdown", "destroy_node"})
_OF_THREADS = {
    "threading.Event": frozenset({"set", "clear"}),
    "threading.Thread": frozenset({"start", "join"}),
    "threading.Lock": frozenset({"acquire", "release"}),
}
"""Methods that are only useful if called."""


def _is_method_of_thread(file: RclpyFile, node: ast.Attribute) -> bool:
    """Return whether a statement consists of an uncalled method of a thread, event or lock."""
    if not isinstance(file.module.parent(node), ast.Expr):
        return False
    made = file.evaluator.single_value(node.value)
    name = file.module.qualified_name(made.func) if isinstance(made, ast.Call) else None
    return node.attr in _OF_THREADS.get(name or "", ())


def _is_event(file: RclpyFile, node: ast.Attribute) -> bool:
    """Return whether an attribute is certainly an event of threading or asyncio."""
    values = file.evaluator.attribute_values(node) or ()
    names = [
        file.module.qualified_name(value.func) if isinstance(value, ast.Call) else None
        for value in values
    ]
    return bool(names) and {*names} <= {"threading.Event", "asyncio.Event"}


def _needs_value(file: RclpyFile, node: ast.Attribute) -> bool:
    """Return whether an uncalled method is an error in this place."""
    match file.module.parent(node):
        case ast.Attribute(attr=attr):
            return not attr.startswith("__") and attr not in _FUNCTION_HAS
        case ast.Expr():
            return True
        case ast.Lambda() as function:  # in a table of functions, or a callback
            match file.module.parent(function):
                case ast.Dict(values=values):
                    return function in values
                case ast.keyword(arg=name):
                    return name in _CALLBACKS
    return _is_compared(file, node) or _is_condition(file, node)


def _is_compared(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether it is compared with a plain value, to which it is never equal."""
    match file.module.parent(node):
        case ast.Compare(left=left, comparators=[ast.Constant(value=value)]):
            return left is node and value is not None
    return False


def _is_condition(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether it only matters that a value is true.

    Outside of conditions, ``or`` may choose a method: ``getattr(log, "info", None) or log.warn``.
    """
    match file.module.parent(node):
        case ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test):
            return test is node
        case ast.comprehension(ifs=tests):
            return node in tests
        case ast.UnaryOp(op=ast.Not()):
            return True
        case ast.BoolOp(op=op, values=values) as both:
            is_tested = isinstance(op, ast.And) and values[-1] is not node
            return is_tested or _is_condition(file, both)
    return False


def _is_own_method(file: RclpyFile, node: ast.Attribute) -> bool:
    """Return whether an expression is an own method of the node that is never replaced."""
    if file.evaluator.stores(node.attr) or _is_read_from(file, node):
        return False
    owner = file.owner_of(node.value)
    function = owner.method(node.attr) if isinstance(owner, NodeClass) else None
    if function is None or function.decorator_list:
        return False
    return not isinstance(file.module.parent(node), ast.Expr) or not _is_passed(file, node)


def _is_passed(file: RclpyFile, node: ast.Attribute) -> bool:
    """Return whether the method is a callback elsewhere, so that a mention is harmless."""
    return any(
        not isinstance(above := file.module.parent(use), ast.Expr | ast.Compare)
        and not (isinstance(above, ast.Call) and above.func is use)
        for use in file.module.index.attributes(node.attr)
    )


def _is_read_from(file: RclpyFile, node: ast.Attribute) -> bool:
    """Return whether an attribute of the method is read, which may be set elsewhere."""
    return isinstance(file.module.parent(node), ast.Attribute)


def _is_method_of_rclpy(file: RclpyFile, node: ast.Attribute) -> bool:
    owner = file.owner_of(node.value)
    if owner is None:
        return is_method(class_of(file, node.value) or "", node.attr)
    if not is_method(NODE, node.attr) or file.evaluator.stores(node.attr):
        return False
    return not hasattr(owner, "method") or owner.method(node.attr) is None
