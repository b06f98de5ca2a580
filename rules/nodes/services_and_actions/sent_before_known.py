"""ND116: clients and publishers wait for discovery before they send."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, RclpyRule, Report, Severity
from scaffold.api.programs import in_callbacks, in_constructors, in_helpers
from scaffold.api.python import conditions_on
from scaffold.api.rclpy import RclpyFile, Timer, class_of

_SENDING = {
    "send_goal_async": ("rclpy.action.client.ActionClient", "goal", "wait_for_server()"),
    "call_async": ("rclpy.client.Client", "request", "wait_for_service()"),
}
_WAITING = ("get_subscription_count", "sleep(", "wait_for", "spin_once", "spin_until", "input(")
_ASKING = ("wait_for_server", "server_is_ready", "wait_for_service", "service_is_ready")
_NODE = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.client = self.create_client(Trigger, 'reset')\n"
    "{}"
    "        self.future = self.client.call_async(Trigger.Request())\n"
)
_PROGRAM = (
    "import rclpy\nfrom geometry_msgs.msg import Twist\n\n\n"
    "def main():\n"
    "    rclpy.init()\n"
    "    node = rclpy.create_node('stop')\n"
    "    publisher = node.create_publisher(Twist, 'cmd_vel', 10)\n{}"
    "    node.destroy_node()\n"
)


class SentBeforeKnown(RclpyRule):
    """A request, goal or message is sent immediately after creating the client or publisher.

    **Why.** The server is not discovered yet, so the message is lost: the future is never done,
    without an error.

    **Fix.** Call ``self.client.wait_for_server(timeout_sec=5.0)``, or send it from a timer if
    ``server_is_ready()``.

    **Source.** ROS 2 documentation, "Writing an action server and client (Python)".
    """

    code = "ND116"
    name = "sent-before-known"
    other_severities = {Severity.WARNING: "it is a message, which may be sent again"}
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example(
            "waits", {"caller.py": _NODE.format("        self.client.wait_for_service(5.0)\n")}
        ),
        Example(
            "sent after a message was received",
            {
                "caller.py": _NODE.format("        rclpy.spin_once(self)\n").replace(
                    "from", "import rclpy\nfrom", 1
                )
            },
        ),
        Example(
            "sent repeatedly",
            {
                "caller.py": _NODE.format("").replace(
                    "        self.future =",
                    "        for _ in range(9):\n            self.call()\n\n"
                    "    def call(self):\n        self.future =",
                )
            },
        ),
        Example(
            "a message sent immediately: transient local, and lost",
            {
                f"{name}.py": "from rclpy.node import Node\n"
                "from rclpy.qos import DurabilityPolicy, QoSProfile\n"
                "from std_msgs.msg import String\n\n\n"
                "class Hello(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('hello')\n"
                f"        self.publisher = self.create_publisher(String, 'hello', {qos})\n"
                + ("        self.create_timer(1.0, self.greet)\n" if name == "again" else "")
                + "        self.greet()\n\n"
                "    def greet(self):\n"
                "        self.publisher.publish(String(data='hello'))\n"
                for name, qos in {
                    "again": "10",
                    "kept": "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)",
                    "lost": "10",
                }.items()
            },
            Report(
                "lost.py:13:9",
                "no subscription has discovered the publisher yet: this message is lost; "
                "publish it from a timer, or with DurabilityPolicy.TRANSIENT_LOCAL",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a program that publishes once: immediately, and after spin",
            {
                "stop.py": _PROGRAM.format("    publisher.publish(Twist())\n"),
                "spun.py": _PROGRAM.format(
                    "    rclpy.spin(node)\n    publisher.publish(Twist())\n"
                ),
            },
            Report(
                "stop.py:9:5",
                "no subscription has discovered the publisher yet: this message is "
                "lost; publish it from a timer, or with "
                "DurabilityPolicy.TRANSIENT_LOCAL",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a message at the end of a keyboard loop",
            {
                "keys.py": "from geometry_msgs.msg import Twist\nfrom rclpy.node import Node\n\n\n"
                "class Keys(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('keys')\n"
                "        self.publisher = self.create_publisher(Twist, 'cmd_vel', 10)\n"
                "        while self.press():\n            pass\n"
                "        self.publisher.publish(Twist())\n"
            },
        ),
        Example(
            "sent immediately",
            {"caller.py": _NODE.format("")},
            "9:23: the request is sent before the server is discovered: it is lost, and the "
            "future is never done; call wait_for_service() first",
        ),
        Example(
            "a goal in a class that gets the node",
            {
                "goals.py": "from example_interfaces.action import Fibonacci\n"
                "from rclpy.action import ActionClient\n\n\n"
                "class Goals:\n"
                "    def __init__(self, node):\n"
                "        self.client = ActionClient(node, Fibonacci, 'count')\n"
                "        self.future = self.client.send_goal_async(Fibonacci.Goal(order=5))\n"
            },
            "8:23: the goal is sent before the server is discovered: it is lost, and the future "
            "is never done; call wait_for_server() first",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_publishers(file)
        if not file.module.mentions(*_SENDING) or file.module.mentions(*_ASKING):
            return
        for executed in (*in_constructors(file), *in_helpers(file)):
            for call in file.calls_in(executed.function):
                func = call.func
                if not isinstance(func, ast.Attribute) or func.attr not in _SENDING:
                    continue
                class_, what, wait = _SENDING[func.attr]
                if _is_repeated(file, call) or _is_spun_before(file, call):
                    continue
                if class_of(file, func.value) == class_:
                    message = (
                        f"the {what} is sent before the server is discovered: it is lost, and the "
                        f"future is never done; call {wait} first"
                    )
                    yield self.report(file.module.location(call), message)

    def _check_publishers(self, file: RclpyFile) -> Iterator[Diagnostic]:
        """Check messages that constructors publish with new publishers."""
        if file.module.mentions(*_WAITING):
            return
        lost = {
            publisher.call: publisher
            for publisher in file.publishers
            if publisher.qos is not None and publisher.qos.durability == "VOLATILE"
        }
        again = {x.function for x in in_callbacks(file) if isinstance(x.entity, Timer)}
        functions = [executed.function for executed in in_constructors(file)]
        makers = {file.function_of(made): None for made in lost}
        functions += [
            maker
            for maker in makers
            if isinstance(maker, ast.FunctionDef)
            and file.module.enclosing_class(maker) is None
            and not file.module.in_tests
        ]
        for function in functions:
            is_long = any(file.module.below(function, ast.While, ast.Await))
            if is_long or function in again:
                continue
            spun = [spin.call.lineno for spin in file.spin_calls if spin.function is function]
            for call in file.calls_in(function):
                func = call.func
                if not isinstance(func, ast.Attribute) or func.attr != "publish":
                    continue
                if any(line < call.lineno for line in spun):
                    continue
                made = file.evaluator.single_value(func.value)
                is_lost = made in lost and not _is_repeated(file, call)
                if is_lost and _is_made_here(file, made, function):
                    message = (
                        "no subscription has discovered the publisher yet: this message is lost; "
                        "publish it from a timer, or with DurabilityPolicy.TRANSIENT_LOCAL"
                    )
                    at = file.module.location(call)
                    yield self.report(at, message, severity=Severity.WARNING)


def _is_made_here(file: RclpyFile, made: ast.AST, where: ast.AST) -> bool:
    """Return whether a constructor or the same function always creates the publisher."""
    function = file.function_of(made)
    is_here = getattr(function, "name", "") == "__init__" or function is where
    return is_here and not conditions_on(file.module, made)


def _is_spun_before(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether the same function waits for a message before: it may be that of the server."""
    function = file.module.enclosing_function(call)
    return any(
        spin.function is function and spin.call.lineno < call.lineno for spin in file.spin_calls
    )


def _is_repeated(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether it is sent in a loop, here or around a call of the function."""
    module = file.module
    function = module.enclosing_function(call)
    name = function.name if function is not None else ""
    callers = (
        item
        for item in module.walk(ast.Call)
        if isinstance(item.func, ast.Attribute) and item.func.attr == name != "__init__"
    )
    return any(
        isinstance(parent, ast.For | ast.While)
        for item in (call, *callers)
        for parent in module.parents(item)
    )
