"""ND056: functions of rclpy get all required arguments."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile, class_of

_FUNCTIONS = {
    "rclpy.spin": ("node",),
    "rclpy.spin_once": ("node",),
    "rclpy.spin_until_future_complete": ("node", "future"),
    "rclpy.create_node": ("node_name",),
    "rclpy.action.ActionClient": ("node", "action_type", "action_name"),
    "rclpy.action.ActionServer": ("node", "action_type", "action_name", "execute_callback"),
}
_OF_NODE = {
    "create_subscription": ("msg_type", "topic", "callback", "qos_profile"),
    "create_timer": ("timer_period_sec", "callback"),
    "create_service": ("srv_type", "srv_name", "callback"),
    "create_client": ("srv_type", "srv_name"),
    "declare_parameter": ("name",),
    "declare_parameters": ("namespace", "parameters"),
    "get_parameter": ("name",),
}
_OF_OBJECTS = {
    ("rclpy.publisher.Publisher", "publish"): ("msg",),
    ("rclpy.client.Client", "call"): ("request",),
    ("rclpy.client.Client", "call_async"): ("request",),
    ("rclpy.task.Future", "add_done_callback"): ("callback",),
    ("rclpy.impl.rcutils_logger.RcutilsLogger", "info"): ("message",),
}
_LEFT_TO_ND010 = frozenset({"qos_profile"})
_NODE = (
    "import rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer({})\n\n\n"
    "def main():\n    rclpy.init()\n    rclpy.spin({})\n"
)


class ArgumentMissing(RclpyRule):
    """A function of rclpy is called without a required argument.

    **Why.** ``TypeError: Node.create_timer() missing 1 required positional argument: 'callback'``.

    **Fix.** Pass the argument.

    **Source.** ``rclpy/__init__.py``, ``rclpy/node.py``, ``rclpy/publisher.py``,
    ``rclpy/client.py``.
    """

    code = "ND056"
    name = "argument-missing"
    examples = (
        Example("all arguments", {"talker.py": _NODE.format("0.1, print", "Talker()")}),
        Example(
            "a callback, a node",
            {"talker.py": _NODE.format("0.1", "")},
            Report("8:9", "create_timer() is missing 'callback': TypeError"),
            Report("13:5", "spin() is missing 'node': TypeError"),
        ),
        Example(
            "an action server without its callback",
            {
                "talker.py": "from rclpy.action import ActionServer\n"
                + _NODE.format("0.1, print", "Talker()").replace(
                    "self.create_timer(0.1, print)", "ActionServer(self, Count, 'count')"
                )
            },
            Report("9:9", "ActionServer() is missing 'execute_callback': TypeError"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.module.walk(ast.Call):
            needed = _needed(file, call)
            if not needed or any(isinstance(argument, ast.Starred) for argument in call.args):
                continue
            words = {word.arg for word in call.keywords}
            missing = [key for key in needed[len(call.args) :] if key not in words]
            if None in words or not missing or set(missing) <= _LEFT_TO_ND010:
                continue
            name = file.module.text(call.func).rpartition(".")[2]
            message = f"{name}() is missing {', '.join(map(repr, missing))}: TypeError"
            yield self.report(file.module.location(call), message)


def _needed(file: RclpyFile, call: ast.Call) -> tuple[str, ...]:
    """Return the required parameters of the called function."""
    func = call.func
    name = file.module.qualified_name(func) or ""
    if name in _FUNCTIONS or not isinstance(func, ast.Attribute):
        return _FUNCTIONS.get(name, ())
    owner = file.owner_of(func.value) if func.attr in _OF_NODE else None
    if owner is not None:
        is_own = hasattr(owner, "method") and owner.method(func.attr) is not None
        return () if is_own or owner.is_lifecycle else _OF_NODE[func.attr]
    if any(func.attr == method for _, method in _OF_OBJECTS):
        return _OF_OBJECTS.get((class_of(file, func.value) or "", func.attr), ())
    return ()
