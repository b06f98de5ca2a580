"""ND061: services, properties and callbacks are not called."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile, class_of, has, is_method

_WHOLE = r"(?!rclpy\.)\w+\.(srv|action)\.[A-Z][A-Za-z0-9]*"
_VALUES = frozenset(
    {"accepted", "goal_id", "is_active", "is_cancel_requested", "nanoseconds", "request", "status"}
)
_NODE = (
    "from rclpy.node import Node\n"
    "from std_msgs.msg import String\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.pub = self.create_publisher(String, 'a', 10)\n"
    "        self.client = self.create_client(Trigger, 'b')\n"
    "        self.start = self.get_clock().now()\n"
    "        self.client.call_async({}).add_done_callback({})\n\n"
    "    def done(self, future):\n"
    "        self.pub.publish(String())\n"
)
_RIGHT = ("Trigger.Request()", "self.done")
_NODE_CALLBACKS = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, {})\n\n"
    "    def tick(self):\n"
    "        pass\n"
)


class ObjectCalledWrongly(RclpyRule):
    """A service type or a property is called, or a callback is called instead of passed.

    **Why.** A callback runs once, immediately, and its result, ``None``, becomes the callback:
    ``TypeError: 'NoneType' object is not callable``. ``NotImplementedError: Service classes can not
    be instantiated``, ``TypeError: 'int' object is not callable``.

    **Fix.** Write ``Trigger.Request()`` and ``add_done_callback(self.done)``, without extra
    parentheses.

    **Source.** ``rclpy/node.py``, ``create_timer`` and ``create_subscription``; ``rclpy/task.py``;
    rosidl_generator_py.
    """

    code = "ND061"
    name = "object-called-wrongly"
    examples = (
        Example("the right calls", {"talker.py": _NODE.format(*_RIGHT)}),
        Example(
            "a callback, a service",
            {"talker.py": _NODE.format("Trigger()", "self.done()")},
            "12:9: done() is called here; pass the function itself, without ()",
            "12:32: Trigger cannot be instantiated: NotImplementedError; write Trigger.Request()",
        ),
        Example(
            "a class of ROS 1, an unknown service, and a class that may be of ROS 1",
            {
                "reset.py": "import std_srvs as std\nfrom rover_msgs import srv as own\n"
                "from std_srvs import srv\n"
                "import rclpy\n\nrclpy.init()\n"
                "print(std.srv.TriggerResponse(), srv.Reset(), own.ResetResponse())\n"
            },
            "7:7: 'TriggerResponse' is a class of ROS 1: AttributeError; write Trigger.Response()",
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
            "a class of a module named action in another package",
            {"talker/node.py": "import rclpy\nfrom tasks.action import Step\n\nSTEP = Step()\n"},
            neighbors={
                "tasks": {
                    "package.xml": "<package><name>tasks</name></package>\n",
                    "tasks/action.py": "class Step:\n    pass\n",
                }
            },
        ),
        Example(
            "a property",
            {"talker.py": _NODE.format(*_RIGHT).replace("now()", "now().nanoseconds()")},
            "11:22: 'nanoseconds' is a property, not a method: TypeError; remove the ()",
        ),
        Example("a callback passed", {"talker.py": _NODE_CALLBACKS.format("self.tick")}),
        Example(
            "the callback of a timer or subscription called",
            {"talker.py": _NODE_CALLBACKS.format("self.tick()")},
            Report(
                "7:32",
                "self.tick() is called here, and its return value becomes the "
                "callback; remove the parentheses",
                fix="Remove the parentheses",
            ),
            fixed={"talker.py": _NODE_CALLBACKS.format("self.tick")},
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_objects(package, file)
        yield from self._check_callbacks(file)

    def _check_objects(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.module.walk(ast.Call):
            problem = _problem(package, file, call)
            if problem:
                yield self.report(file.module.location(call), problem)

    def _check_callbacks(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for _, callback in file.callbacks:
            if not callback.is_called:
                continue
            text = file.module.text(callback.node)
            fix = None
            if text.endswith("()"):
                _, end = file.module.span(callback.node)
                edit = Edit(file.module.path, end - 2, end, "")
                fix = Fix("Remove the parentheses", (edit,))
            message = (
                f"{text} is called here, and its return value becomes the callback; remove "
                f"the parentheses"
            )
            yield self.report(callback, message, fix)


def _problem(package: Package, file: RclpyFile, call: ast.Call) -> str:
    name = file.module.qualified_name(call.func) or ""
    problem = ""
    interface = file.interface(call.func) if re.fullmatch(_WHOLE, name) else None
    if interface:
        problem = _interface_problem(package, call, interface)
    elif isinstance(call.func, ast.Attribute) and not name and _is_value(file, call.func):
        problem = f"{call.func.attr!r} is a property, not a method: TypeError; remove the ()"
    match call:
        case ast.Call(func=ast.Attribute(attr="add_done_callback"), args=[ast.Call() as given]):
            callback = file.callback(given)
            if callback.is_called and not callback.is_partial:
                problem = f"{callback.name}() is called here; pass the function itself, without ()"
    return problem


def _interface_problem(package: Package, call: ast.Call, interface: str) -> str:
    """Return the problem with a call of a service or an action, or of a class of ROS 1."""
    root, kind, name = interface.split("/")
    definitions = package.workspace.interfaces
    of_ros1 = re.fullmatch(r"(\w+)(Request|Response)", name)
    is_uncertain = of_ros1 or root in definitions.packages()
    if definitions.find(interface) is not None or not is_uncertain:
        part = "Goal" if kind == "action" else "Request"
        return f"{name} cannot be instantiated: NotImplementedError; write {name}.{part}()"
    if of_ros1 and isinstance(call.func, ast.Attribute):  # otherwise TY002 reports the import
        whole, part = of_ros1.groups()
        if definitions.find(f"{root}/{kind}/{whole}") is not None:
            return f"{name!r} is a class of ROS 1: AttributeError; write {whole}.{part}()"
    return ""


def _is_value(file: RclpyFile, node: ast.Attribute) -> bool:
    """Return whether an attribute of an rclpy object is a property."""
    if node.attr not in _VALUES:
        return False
    owner = class_of(file, node.value)
    return owner is not None and has(owner, node.attr) and not is_method(owner, node.attr)
