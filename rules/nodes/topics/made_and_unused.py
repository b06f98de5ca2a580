"""ND071: publishers, callbacks and callback groups are used."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, RclpyRule, Report, Severity
from scaffold.api.python import FunctionNode, Unknown, paths_importing
from scaffold.api.rclpy import NodeClass, RclpyFile, is_used_elsewhere

_NAMES = r"^on_[a-z]|^callback_|_callback$|_cb$"
_NODE = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.chatter_pub = self.create_publisher(String, 'chatter', 10)\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def tick(self):\n"
    "        {}\n\n\n"
    "def main():\n    rclpy.init()\n    rclpy.spin(Talker())\n"
)
_PARAMETERS = frozenset({("request", "response"), ("future",), ("goal_handle",)})
"""The parameters of callbacks of services, of clients and of action servers."""
_RESULT = "rcl_interfaces.msg.SetParametersResult"
_NODES = frozenset({"rclpy.node.Node", "rclpy.lifecycle.LifecycleNode", "rclpy.lifecycle.Node"})
_IMPORT = "import rclpy\nfrom rcl_interfaces.msg import SetParametersResult\n"
_MADE = {
    "create_subscription": "subscription",
    "create_publisher": "publisher",
    "create_timer": "timer",
    "create_service": "service",
}
_GROUPS = frozenset(
    f"rclpy.callback_groups.{kind}CallbackGroup" for kind in ("Reentrant", "MutuallyExclusive")
)
_NODE_GROUPS = (
    "from rclpy.callback_groups import ReentrantCallbackGroup\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.group = ReentrantCallbackGroup()\n"
    "        self.create_timer(1.0, self.tick{})\n\n"
    "    def tick(self):\n"
    "        pass\n"
)
_WINDOW = (
    "import cv2\nfrom rclpy.node import Node\nfrom sensor_msgs.msg import Image\n\n\n"
    "class Show(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('show')\n"
    "        self.create_subscription(Image, 'image', self.draw, 10)\n\n"
    "    def draw(self, msg):\n"
    "        cv2.imshow('image', self.convert(msg))\n{}"
)


class MadeAndUnused(RclpyRule):
    """A node has a publisher, a callback, a callback group or a window that is not used.

    **Why.** ``ros2 topic list`` shows the topic, but nothing is ever published on it. A callback
    that is never registered never runs: often, two subscriptions have the same callback, or the
    base class subscribes with another name. Without a callback group, callbacks stay in the default
    group, which runs them one at a time: callbacks that should run in parallel wait, or deadlock.
    OpenCV draws its windows in ``cv2.waitKey``.

    **Fix.** Publish, pass the callback to ``create_subscription`` and the group as
    ``callback_group=``, or remove the unused object.

    **Source.** ``rclpy/publisher.py``, ``publish``; ``rclpy/node.py``, ``create_subscription``; ROS
    2 documentation, "Using callback groups".
    """

    code = "ND071"
    name = "made-and-unused"
    severity = Severity.WARNING
    other_severities = {Severity.ERROR: "it is a window that is never drawn"}
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example(
            "a publisher that a base class in another package uses",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/talker.py": _NODE.format("self.tick()"),
            },
            neighbors={
                "common": {
                    "package.xml": "<package><name>common</name></package>\n",
                    "common/base.py": "def talk(node, message):\n"
                    "    node.chatter_pub.publish(message)\n",
                }
            },
        ),
        Example(
            "one callback for two topics",
            {
                "wheels.py": _NODE.format(
                    "self.chatter_pub.publish(String())\n\n"
                    "    def left_callback(self, msg):\n        pass\n\n"
                    "    def right_callback(self, msg):\n        pass\n"
                ).replace(
                    "        self.create_timer",
                    "        self.create_subscription(String, 'left', self.left_callback, 10)\n"
                    "        self.create_subscription(String, 'right', self.left_callback, 10)\n"
                    "        self.create_timer",
                )
            },
            "20:9: callback 'right_callback' is never registered: it never runs",
        ),
        Example(
            "callbacks by their parameters or results, registered or not",
            {
                "talker.py": _NODE.format(
                    "self.chatter_pub.publish(String())\n\n"
                    "    def check(self, parameters):\n"
                    "        return SetParametersResult(successful=True)\n\n"
                    "    def refuse(self, parameters):\n"
                    "        return SetParametersResult(successful=False)\n\n"
                    "    def show(self, future):\n        return future.result()\n\n"
                    "    def add(self, request, response):\n        return response\n"
                )
                .replace("import rclpy\n", _IMPORT)
                .replace(
                    "        self.create_timer",
                    "        self.add_on_set_parameters_callback(self.check)\n"
                    "        self.create_timer",
                ),
                "other.py": "def offer(node, kind):\n"
                "    node.create_service(kind, 'add', node.add)\n",
            },
            "talker.py:20:9: callback 'refuse' is never registered: it never runs",
            "talker.py:23:9: callback 'show' is never registered: it never runs",
        ),
        Example(
            "a publisher for each topic, and a function that is never called",
            {
                "talker.py": _NODE.format("self.chatter_pub.publish(String())\n\n{}").format(
                    "    def add_joystick(self):\n"
                    "        self.create_subscription(String, 'joy', print, 10)\n\n"
                    "    def add_lanes(self):\n"
                    "        for lane in ('a', 'b'):\n"
                    "            self.lane_pub = self.create_publisher(String, lane, 10)\n"
                    "        self.lane_pub.publish(String())\n"
                ),
                "other.py": "def start(node):\n    node.add_lanes()\n",
            },
            "talker.py:15:9: add_joystick() is never called, so its subscription does not exist",
            "talker.py:20:29: each iteration of the loop replaces 'lane_pub': messages only go to "
            "the last topic; store the publishers in a list or dict",
        ),
        Example(
            "a publisher that is used",
            {"talker.py": _NODE.format("self.chatter_pub.publish(String(data='a'))")},
        ),
        Example(
            "a publisher that another module uses",
            {
                "talker.py": _NODE.format("pass"),
                "other.py": "def talk(node, message):\n    node.chatter_pub.publish(message)\n",
            },
        ),
        Example(
            "a publisher that is never used",
            {"talker.py": _NODE.format("pass")},
            "9:28: publisher 'chatter_pub' is never used: no messages on 'chatter'",
        ),
        Example(
            "a group that is used",
            {"talker.py": _NODE_GROUPS.format(", callback_group=self.group")},
        ),
        Example(
            "a group that is unused",
            {"talker.py": _NODE_GROUPS.format("")},
            "8:22: callback group 'group' is never used: all callbacks run one at a time; pass "
            "callback_group=",
        ),
        Example(
            "a window that is drawn",
            {"draw.py": _WINDOW.format("        cv2.waitKey(1)\n")},
        ),
        Example(
            "a window that stays empty",
            {"draw.py": _WINDOW.format("")},
            Report(
                "12:9",
                "OpenCV does not draw the window without cv2.waitKey(1); call it after imshow()",
                severity=Severity.ERROR,
            ),
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for window in _windows_without_events(package, file):
            message = (
                "OpenCV does not draw the window without cv2.waitKey(1); call it after imshow()"
            )
            yield self.report(file.module.location(window), message, severity=Severity.ERROR)
        yield from self._check_entities(package, file)
        yield from self._check_groups(package, file)

    def _check_entities(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.init_calls or file.module.in_tests:
            return  # a class that other packages may inherit from, or use
        for publisher in file.publishers:
            name = _kept_in(file, publisher.call)
            if not name:
                continue
            is_known = not isinstance(publisher.name, Unknown) and not publisher.is_conditional
            is_once = package.is_mentioned_once(name, file.module.path)
            if is_known and is_once and not is_used_elsewhere(package, file, name):
                message = f"publisher {name!r} is never used: no messages on {publisher.name!r}"
                yield self.report(publisher, message)
            elif _is_replaced(file, publisher.call, name):
                message = (
                    f"each iteration of the loop replaces {name!r}: messages only go to the last "
                    f"topic; store the publishers in a list or dict"
                )
                yield self.report(publisher, message)
        for class_ in file.classes:
            for name, message in (*_uncalled_setups(file, class_), *_callbacks(file, class_)):
                if package.is_mentioned_once(name, file.module.path):
                    yield self.report(file.module.name_location(class_.methods[name]), message)
            for method in _unregistered(package, file, class_):
                message = f"callback {method.name!r} is never registered: it never runs"
                yield self.report(file.module.name_location(method), message)

    def _check_groups(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.module.mentions("CallbackGroup(") or file.module.in_tests:
            return
        for call in file.module.walk(ast.Call):
            if _GROUPS.isdisjoint(file.module.qualified_names(call.func)):
                continue
            attribute, variable = file.stored_in(call)
            uses: list[ast.Attribute | ast.Name] = []
            if attribute:
                uses += file.module.index.attributes(attribute)
            elif variable:
                uses += file.module.index.names(variable)
            else:
                continue
            if any(isinstance(use.ctx, ast.Load) for use in uses):
                continue
            if attribute and is_used_elsewhere(package, file, attribute):
                continue
            message = (
                f"callback group {attribute or variable!r} is never used: all callbacks run one "
                "at a time; pass callback_group="
            )
            yield self.report(file.module.location(call), message)


def _windows_without_events(package: Package, file: RclpyFile) -> Iterator[ast.Call]:
    """Yield the first window of a package that shows images but does not process GUI events."""
    if not file.module.mentions("imshow("):
        return
    words = ("waitKey", "pollKey", "startWindowThread")
    modules = package.modules(paths_importing(package, "cv2"))
    if any(module.mentions(*words) for module in modules):
        return
    for call in file.module.walk(ast.Call):
        if file.module.qualified_name(call.func) == "cv2.imshow":
            yield call
            return


def _callbacks(file: RclpyFile, class_: NodeClass) -> Iterator[tuple[str, str]]:
    """Yield the unregistered methods named like callbacks, with messages."""
    if class_.is_lifecycle or file.module.mentions("getattr(self"):
        return
    if len(class_.node.bases) != 1:
        return  # a mixin may register methods by name
    for name, method in class_.methods.items():
        takes_message = len(method.args.args) > 1
        is_named = re.search(_NAMES, name) is not None and (
            takes_message or name.endswith(("_callback", "_cb"))
        )
        if is_named and not method.decorator_list:
            yield name, f"callback {name!r} is never registered: it never runs"


def _unregistered(
    package: Package, file: RclpyFile, class_: NodeClass
) -> Iterator[ast.FunctionDef]:
    """Yield the methods that only make sense as callbacks, and that nothing mentions."""
    bases = class_.node.bases
    if len(bases) != 1 or not file.module.qualified_names(bases[0]) <= _NODES:
        return
    texts = {node.value for node in file.module.walk(ast.Constant)}
    for name, method in class_.methods.items():
        if re.search(_NAMES, name) or method.decorator_list or not _is_callback(file, method):
            continue
        uses = [use for use in file.module.index.attributes(name) if isinstance(use.ctx, ast.Load)]
        is_used = uses or name in texts or is_used_elsewhere(package, file, name)
        if isinstance(method, ast.FunctionDef) and not is_used:
            yield method


def _is_callback(file: RclpyFile, method: FunctionNode) -> bool:
    """Return whether a method is one by its parameters, or by its result."""
    arguments = method.args
    names = tuple(argument.arg for argument in arguments.args[1:])
    if arguments.vararg or arguments.kwarg or arguments.kwonlyargs or arguments.defaults:
        return False
    made = {file.module.qualified_name(call.func) for call in file.calls_in(method)}
    return names in _PARAMETERS or (len(names) == 1 and _RESULT in made)


def _kept_in(file: RclpyFile, call: ast.Call) -> str:
    """Return the attribute that the result of a call is assigned to."""
    match file.module.parent(call):
        case ast.Assign(targets=[ast.Attribute(value=ast.Name(), attr=name)]):
            return name
        case ast.AnnAssign(target=ast.Attribute(value=ast.Name(), attr=name)):
            return name
    return ""


def _uncalled_setups(file: RclpyFile, class_: NodeClass) -> Iterator[tuple[str, str]]:
    """Yield the uncalled methods without arguments that create entities, with messages."""
    if class_.is_lifecycle or class_.base is not None or len(class_.node.bases) != 1:
        return
    if file.module.mentions("getattr("):
        return
    for name, method in class_.methods.items():
        if len(method.args.args) != 1 or method.decorator_list or name.startswith("__"):
            continue
        made = [
            _MADE.get(call.func.attr, "")
            for call in file.calls_in(method)
            if isinstance(call.func, ast.Attribute)
            and isinstance(call.func.value, ast.Name)
            and call.func.value.id == "self"
        ]
        created = [kind for kind in made if kind]
        if created:
            yield name, f"{name}() is never called, so its {created[0]} does not exist"


def _is_replaced(file: RclpyFile, call: ast.Call, name: str) -> bool:
    """Return whether a loop over topics stores all publishers only in the same attribute."""
    loop = file.module.enclosing(call, ast.For)
    if loop is None or file.function_of(loop) is not file.function_of(call):
        return False
    counters = {x.id for x in ast.walk(loop.target) if isinstance(x, ast.Name)}
    topic = call.args[1] if len(call.args) > 1 else call
    varies = any(isinstance(x, ast.Name) and x.id in counters for x in ast.walk(topic))
    stores = [x for x in file.module.index.attributes(name) if isinstance(x.ctx, ast.Store)]
    inside = [x for x in ast.walk(loop) if isinstance(x, ast.Attribute) and x.attr == name]
    leaves = any(isinstance(x, ast.Break | ast.Return | ast.If) for x in ast.walk(loop))
    return varies and not leaves and len(stores) == 1 and inside == stores
