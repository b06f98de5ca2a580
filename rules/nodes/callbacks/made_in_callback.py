"""ND124: callbacks use existing publishers and clients."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, RclpyRule, Report, Severity
from scaffold.api.programs import in_callbacks
from scaffold.api.python import FunctionNode, conditions_on, last_name
from scaffold.api.rclpy import RclpyFile, Service

_MADE = {
    "create_publisher": "a publisher",
    "create_client": "a client",
    "TransformBroadcaster": "a broadcaster",
    "StaticTransformBroadcaster": "a broadcaster",
    "ActionClient": "an action client",
    "create_timer": "a timer",
}
_USES = {
    "a publisher": "messages published immediately are lost",
    "a broadcaster": "transforms sent immediately are lost",
}
_ENDS = ("cancel", "destroy_", "destroy", "unregister")
_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.timer = self.create_timer(1.0, self.tick)\n\n"
    "    def tick(self):\n"
    "{}"
    "        publisher = self.create_publisher(String, 'chatter', 10)\n"
    "        publisher.publish(String())\n"
)


class MadeInCallback(RclpyRule):
    """A callback creates a publisher, broadcaster, client or timer each time it is called.

    **Why.** Discovery takes a moment: messages published before that are lost, so every message is.
    The node keeps all of these objects, and their number grows with every call: with two timers,
    the callback runs twice as often.

    **Fix.** Create it in the constructor, and store it: ``self.publisher``.

    **Source.** ``rclpy/node.py``, ``create_publisher``; ROS 2 documentation, "Discovery".
    """

    code = "ND124"
    name = "made-in-callback"
    other_severities = {Severity.WARNING: "the object is stored, or is a client"}
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("once", {"talker.py": _NODE.format("        self.timer.cancel()\n")}),
        Example(
            "each time",
            {"talker.py": _NODE.format("")},
            "11:21: callback 'tick' creates a publisher on each call: messages published "
            "immediately are lost; create it in the constructor",
        ),
        Example(
            "a broadcaster and an action client each time",
            {
                "seek.py": "from geometry_msgs.msg import TransformStamped\n"
                "from nav2_msgs.action import NavigateToPose\n"
                "from rclpy.action import ActionClient\nfrom rclpy.node import Node\n"
                "from tf2_ros import TransformBroadcaster\n\n\n"
                "class Seek(Node):\n"
                "    def __init__(self):\n        super().__init__('seek')\n"
                "        self.timer = self.create_timer(1.0, self.tick)\n\n"
                "    def tick(self):\n"
                "        TransformBroadcaster(self).sendTransform(TransformStamped())\n"
                "        client = ActionClient(self, NavigateToPose, 'navigate_to_pose')\n"
                "        client.send_goal_async(NavigateToPose.Goal())\n"
            },
            "14:9: callback 'tick' creates a broadcaster on each call: transforms sent "
            "immediately are lost; create it in the constructor",
            Report(
                "15:18",
                "callback 'tick' creates an action client on each call: the node keeps "
                "them all; create it in the constructor",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "each time, and stored",
            {"talker.py": _NODE.format("").replace("        publisher", "        self.publisher")},
            Report(
                "11:26",
                "callback 'tick' creates a publisher on each call: messages published "
                "immediately are lost; create it in the constructor",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a timer for each message, and only one",
            {
                "talker.py": _NODE.replace("tick(self)", "tick(self, msg)").format(
                    "        if msg.data:\n            self.create_timer(1.0, print)\n"
                ),
                "once.py": _NODE.replace("tick(self)", "tick(self, msg)").format(
                    "        if msg.data and self.other is None:\n"
                    "            self.other = self.create_timer(1.0, print)\n"
                ),
            },
            "once.py:13:21: callback 'tick' creates a publisher on each call: messages published "
            "immediately are lost; create it in the constructor",
            Report(
                "talker.py:12:13",
                "callback 'tick' creates a timer on each call: all of them keep "
                "running; create it in the constructor",
                severity=Severity.WARNING,
            ),
            "talker.py:13:21: callback 'tick' creates a publisher on each call: messages "
            "published immediately are lost; create it in the constructor",
        ),
        Example(
            "only if it does not exist yet",
            {"talker.py": _NODE.format("        if self.ready:\n            return\n")},
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if file.module.in_tests:
            return
        for executed in in_callbacks(file):
            function = executed.function
            if isinstance(executed.entity, Service) or not isinstance(function, FunctionNode):
                continue
            calls = file.calls_in(function)
            if any(last_name(call.func).startswith(_ENDS) for call in calls):
                continue
            for call in calls:
                created = _MADE.get(last_name(call.func))
                if created is None or not _is_repeated(file, function, call):
                    continue
                if not _is_of_ros(file, call) or _is_stored_by_key(file, call):
                    continue
                happens = _USES.get(created, "the node keeps them all")
                happens = "all of them keep running" if created == _TIMER else happens
                message = (
                    f"{executed.origin} creates {created} on each call: {happens}; create it in "
                    f"the constructor"
                )
                _, variable = file.stored_in(call)
                is_local = variable or isinstance(file.module.parent(call), ast.Attribute)
                severity = None if is_local and created in _USES else Severity.WARNING
                yield self.report(file.module.location(call), message, severity=severity)


_TIMER = "a timer"


def _is_repeated(file: RclpyFile, function: FunctionNode, call: ast.Call) -> bool:
    """Return whether an object is created in each call of a callback."""
    if _MADE[last_name(call.func)] == _TIMER:
        return _adds_up(file, function, call)
    return not file.is_conditional(call) and not conditions_on(file.module, call)


def _adds_up(file: RclpyFile, function: FunctionNode, call: ast.Call) -> bool:
    """Return whether timers are never stopped, and created regardless of the node's state.

    Conditions may only depend on the message: ``if msg.data:``.
    """
    index = file.module.index
    if any(index.attributes(name) for name in ("cancel", "destroy_timer", "destroy")):
        return False
    given = {argument.arg for argument in function.args.args[1:]}
    names = {
        name.id
        for condition in conditions_on(file.module, call)
        for name in ast.walk(condition)
        if isinstance(name, ast.Name)
    }
    loops = any(isinstance(x, ast.For | ast.While | ast.Try) for x in file.module.parents(call))
    return names <= given and not loops


def _is_of_ros(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether the callee is a method of a node, or a class of tf2 or rclpy."""
    if isinstance(call.func, ast.Attribute) and file.owner_of(call.func.value) is not None:
        return True
    names = file.module.qualified_names(call.func)
    return any(name.startswith(("tf2_ros.", "rclpy.action.")) for name in names)


def _is_stored_by_key(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether it is stored under a key: ``self.publishers[name] = ...``."""
    parent = file.module.parent(call)
    return isinstance(parent, ast.Assign) and isinstance(parent.targets[0], ast.Subscript)
