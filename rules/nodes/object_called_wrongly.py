"""ND061: only callable objects are called."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile, class_of, has, is_method

_WHOLE = r"(?!rclpy\.)\w+\.(srv|action)\.[A-Z][A-Za-z0-9]*"
_PRESETS = "rclpy.qos.qos_profile_"
_NOT_CALLED = frozenset(
    {"rclpy.client.Client", "rclpy.clock.Clock", "rclpy.publisher.Publisher"}
    | {"rclpy.subscription.Subscription", "rclpy.task.Future", "rclpy.timer.Timer"}
)
_VALUES = frozenset(
    {"accepted", "goal_id", "is_active", "is_cancel_requested", "nanoseconds", "request", "status"}
)
_NODE = (
    "from rclpy.node import Node\n"
    "from rclpy.qos import qos_profile_sensor_data\n"
    "from std_msgs.msg import String\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.pub = self.create_publisher(String, 'a', qos_profile_sensor_data{})\n"
    "        self.client = self.create_client(Trigger, 'b')\n"
    "        self.start = self.get_clock().now()\n"
    "        self.client.call_async({}).add_done_callback({})\n\n"
    "    def done(self, future):\n"
    "        self.pub{}(String())\n"
)
_RIGHT = ("", "Trigger.Request()", "self.done", ".publish")


class ObjectCalledWrongly(RclpyRule):
    """An object that is not callable is called, or a function that should be passed.

    **Why.** ``TypeError: 'QoSProfile' object is not callable``, ``NotImplementedError: Service
    classes can not be instantiated``; a callback that is called instead of passed is ``None``.

    **Fix.** ``Trigger.Request()``, ``add_done_callback(self.done)``,
    ``publisher.publish(message)``.

    **Source.** ``rclpy/qos.py``, ``rclpy/publisher.py``, ``rclpy/task.py``; rosidl_generator_py.
    """

    code = "ND061"
    name = "object-called-wrongly"
    examples = (
        Example("the right calls", {"talker.py": _NODE.format(*_RIGHT)}),
        Example(
            "four calls",
            {"talker.py": _NODE.format("()", "Trigger()", "self.done()", "")},
            Report(
                "10:55",
                "qos_profile_sensor_data is a profile, not a function: TypeError; remove the ()",
            ),
            Report("13:9", "done() is called here; pass the function itself, without ()"),
            Report(
                "13:32",
                "Trigger cannot be instantiated: NotImplementedError; write Trigger.Request()",
            ),
            Report("16:9", "a Publisher is not callable: TypeError; call one of its methods"),
        ),
        Example(
            "a method of Node that is replaced after the call",
            {
                "talker.py": _NODE.format(*_RIGHT).replace(
                    "        self.client = ",
                    "        self.client = self.create_client = ",
                )
            },
        ),
        Example(
            "a method of a profile",
            {
                "talker.py": "from rclpy.qos import qos_profile_system_default\n\n"
                "PROFILE = qos_profile_system_default.get_c_qos_profile()\n"
            },
        ),
        Example(
            "a class of a module named action",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "talker/action.py": "class Step:\n    pass\n",
                "talker/node.py": "import rclpy\nfrom talker.action import Step\n\nSTEP = Step()\n",
            },
        ),
        Example(
            "a property",
            {"talker.py": _NODE.format(*_RIGHT).replace("now()", "now().nanoseconds()")},
            Report("12:22", "'nanoseconds' is a property, not a method: TypeError; remove the ()"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.module.walk(ast.Call):
            problem = _problem(file, call)
            if problem:
                yield self.report(file.module.location(call), problem)


def _problem(file: RclpyFile, call: ast.Call) -> str:
    name = file.module.qualified_name(call.func) or ""
    problem = ""
    if name.startswith(_PRESETS) and "." not in name.removeprefix(_PRESETS):
        problem = f"{name[10:]} is a profile, not a function: TypeError; remove the ()"
    elif re.fullmatch(_WHOLE, name) and file.interface(call.func):
        part = "Goal" if ".action." in name else "Request"
        kind = name.rpartition(".")[2]
        problem = f"{kind} cannot be instantiated: NotImplementedError; write {kind}.{part}()"
    elif isinstance(call.func, ast.Attribute | ast.Name) and not name:
        class_ = class_of(file, call.func) or ""
        if class_ in _NOT_CALLED and not _is_replaced(file, call.func):
            problem = (
                f"a {class_.rpartition('.')[2]} is not callable: TypeError; call one of its methods"
            )
        elif isinstance(call.func, ast.Attribute) and _is_value(file, call.func):
            problem = f"{call.func.attr!r} is a property, not a method: TypeError; remove the ()"
    match call:
        case ast.Call(func=ast.Attribute(attr="add_done_callback"), args=[ast.Call() as given]):
            callback = file.callback(given)
            if callback.is_called and not callback.is_partial:
                problem = f"{callback.name}() is called here; pass the function itself, without ()"
    return problem


def _is_replaced(file: RclpyFile, func: ast.Attribute | ast.Name) -> bool:
    """Return whether the object replaces a method of Node, which earlier calls still reach."""
    if not isinstance(func, ast.Attribute) or file.owner_of(func.value) is None:
        return False
    return is_method("rclpy.node.Node", func.attr)


def _is_value(file: RclpyFile, node: ast.Attribute) -> bool:
    """Return whether an attribute of an rclpy object is a property."""
    if node.attr not in _VALUES:
        return False
    owner = class_of(file, node.value)
    return owner is not None and has(owner, node.attr) and not is_method(owner, node.attr)
