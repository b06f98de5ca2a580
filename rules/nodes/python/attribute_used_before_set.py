"""ND062: constructors set attributes before they use them."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity
from scaffold.api.programs import phases_of
from scaffold.api.python import FunctionNode, conditions_on, is_handled
from scaffold.api.rclpy import (
    NODE,
    NodeClass,
    RclpyFile,
    Service,
    Subscription,
    Synchronizer,
    Timer,
    defined_by,
    given_from_outside,
    has,
    is_read_in_full,
    names_of_bases,
)

from ._constructor_helpers import too_early

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "{}"
)
_MAKE = "        self.pub = self.create_publisher(String, 'chatter', 10)\n"
_USE = "        self.pub.publish(String())\n"
_TIMER = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n{}"
    "        self.create_subscription(String, 'chatter', self.hear, 12)\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def tick(self):\n"
    "        print({})\n\n"
    "    def hear(self, msg):\n"
    "        self.last = msg\n"
)
_BOTH = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import CameraInfo, Image\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.info = {}\n"
    "        self.create_subscription(Image, 'image', self.see, 10)\n"
    "        self.create_subscription(CameraInfo, 'info', self.learn, 10)\n\n"
    "    def see(self, msg):\n"
    "        print({})\n\n"
    "    def learn(self, msg):\n"
    "        self.info = msg\n"
)
_TRANSITIONS = ("on_configure", "on_activate")
"""The transition callbacks that precede the active state."""
_CALLED_BY_NODE = (
    *("get_name", "get_namespace", "get_logger", "get_clock", "create_publisher"),
    *("create_service", "declare_parameter", "declare_parameters", "has_parameter"),
    *("get_parameter", "add_on_set_parameters_callback"),
)
"""The methods that ``Node.__init__`` calls on the new node."""


class AttributeUsedBeforeSet(RclpyRule):
    """A node uses an attribute before it is set.

    **Why.** ``AttributeError: 'Talker' object has no attribute 'pub'`` at start. A timer may run
    before the first message.

    **Fix.** Set it first, in the constructor: to ``None`` if only a message provides a value. The
    constructor of Node calls methods such as ``get_name``: rename them.

    **Source.** Python documentation, "Classes";
    https://github.com/4am-robotics/cob_command_tools/issues/95.
    """

    code = "ND062"
    name = "attribute-used-before-set"
    other_severities = {Severity.WARNING: "it depends on whether a timer or a message comes first"}
    examples = (
        Example("set first", {"talker.py": _NODE.format(_MAKE + _USE)}),
        Example(
            "set by names in a table",
            {
                "talker.py": _NODE.format(
                    "        for name, value in {'rate': 1.0}.items():\n"
                    "            setattr(self, name, value)\n"
                    "        if self.rate < 0.0:\n            self.rate = 0.0\n"
                )
            },
        ),
        Example(
            "used first",
            {"talker.py": _NODE.format(_USE + _MAKE)},
            "8:9: self.pub is used before it is set in line 9: AttributeError",
        ),
        Example(
            "in a method that the constructor of rclpy's Node calls",
            {
                "talker.py": _NODE.format("        self.robot = 'robin'\n")
                + "\n    def get_name(self):\n        return self.robot\n"
            },
            "11:16: rclpy's Node calls get_name() during construction, before self.robot is set "
            "in line 8: AttributeError; rename the method",
        ),
        Example(
            "in a method that the constructor calls, also before the one of the base class",
            {
                "talker.py": _NODE.format("        self.say('first')\n" + _MAKE)
                + "        self.say('then')\n        self.greet()\n\n"
                "    def say(self, text):\n"
                "        self.pub.publish(String(data=text))\n\n"
                "    def greet(self):\n"
                "        if self.is_polite:\n            self.say(self.polite)\n\n\n"
                "class Loud(Talker):\n"
                "    def __init__(self):\n"
                "        self.say('early')\n"
                "        super().__init__()\n"
                "        self.say('late')\n"
                "        self.is_polite = False\n",
                "other.py": _NODE.format("").replace(
                    "        super", "        self.setup()\n        super"
                )
                + "\n    def setup(self):\n        self.create_publisher(String, 'a', 1)\n",
            },
            "other.py:7:9: setup() uses self.create_publisher() before super().__init__() in line "
            "8: AttributeError",
            "talker.py:8:9: say() uses self.pub, which is set later, in line 9: AttributeError",
            "talker.py:23:9: say() uses self.pub, which is set later, in line 24: AttributeError",
        ),
        Example(
            "a timer that uses an attribute that a message sets",
            {
                "talker.py": _TIMER.format("", "self.last"),
                "set.py": _TIMER.format("        self.last = None\n", "self.last"),
                "asked.py": _TIMER.format("", "getattr(self, 'last', None)"),
                "tried.py": _TIMER.format("", "self.heard and self.last").replace(
                    "12)\n", "12)\n        self.heard = False\n"
                ),
            },
            Report(
                "talker.py:12:15",
                "self.last is only set by the callback 'hear', and the timer may "
                "run before the first message: AttributeError; set it in the "
                "constructor",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a callback that uses an attribute that is None until another message arrives",
            {
                "talker.py": _BOTH.format("None", "self.info.width"),
                "whole.py": _BOTH.format("None", "self.info"),
                "set.py": _BOTH.format("CameraInfo()", "self.info.width"),
                "asked.py": _BOTH.format("None", "self.info.width if self.info else 0"),
            },
            Report(
                "talker.py:13:15",
                "self.info is None until the callback 'learn' sets it, and this may "
                "run before the first message there; check for None first",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a timer that runs before the node is configured",
            {
                "pump.py": "from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn\n"
                "from std_msgs.msg import String\n\n\n"
                "class Pump(LifecycleNode):\n"
                "    def __init__(self):\n"
                "        super().__init__('pump')\n"
                "        self.create_timer(1.0, self.tick)\n\n"
                "    def on_configure(self, state):\n"
                "        self.pub = self.create_lifecycle_publisher(String, 'flow', 10)\n"
                "        return TransitionCallbackReturn.SUCCESS\n\n"
                "    def tick(self):\n        self.pub.publish(String())\n"
            },
            Report(
                "15:9",
                "self.pub is only set by on_configure(), and the timer may run before "
                "the transition: AttributeError; set it in the constructor",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "in a method with another name",
            {
                "talker.py": _NODE.format("        self.robot = 'robin'\n")
                + "\n    def robot_name(self):\n        return self.robot\n"
            },
        ),
        Example(
            "a method that the constructor of a base class of the package calls",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/base.py": "from rclpy.node import Node\n\n\n"
                "class Controller(Node):\n"
                "    def __init__(self, name):\n"
                "        super().__init__(name)\n"
                "        self.limit = 1.0\n"
                "        self.setup()\n\n"
                "    def setup(self):\n        pass\n",
                "rover/steering.py": "from rover.base import Controller\n\n\n"
                "class Steering(Controller):\n"
                "    def __init__(self):\n"
                "        self.offset = 0.1\n"
                "        super().__init__('steering')\n"
                "        self.gains = [1.0]\n\n"
                "    def setup(self):\n"
                "        self.gain = self.limit * self.offset * self.gains[0]\n"
                "        self.get_logger().info(f'gain {self.gain}')\n",
            },
            "rover/steering.py:11:48: the constructor of Controller calls setup() during "
            "construction, before self.gains is set in line 8: AttributeError; set it before "
            "super().__init__()",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for node in file.classes:
            for call, message in too_early(file, node):
                yield self.report(file.module.location(call), message)
            if node.base is None and node.name not in names_of_bases(package):
                yield from self._check_timers(package, file, node)
            if node.constructor is None or len(node.node.bases) != 1:
                continue
            if node.base is not None:
                yield from self._check_overrides(file, node)
                continue
            for used, line in _used_early(file, node):
                message = (
                    f"self.{used.attr} is used before it is set in line {line}: AttributeError"
                )
                yield self.report(file.module.location(used), message)
            yield from self._check_overrides(file, node)

    def _check_timers(
        self, package: Package, file: RclpyFile, node: NodeClass
    ) -> Iterator[Diagnostic]:
        """Check the use of attributes in callbacks that only later messages or transitions set."""
        methods = {method: name for name, method in node.methods.items()}
        later = {
            callback.function
            for entity, callback in file.callbacks
            if isinstance(entity, Subscription | Synchronizer)
        } - phases_of(file).constructing
        if node.is_lifecycle:
            later |= {node.methods.get(name) for name in _TRANSITIONS}
        reported: set[str] = set()
        for entity, timed in _registered_first(file, node):
            for used in file.module.below(timed, ast.Attribute):
                name = used.attr
                if name in reported or name in given_from_outside(package):
                    continue
                setters, is_none = _setters(file, node, used)
                if not setters or not setters <= later or timed in setters:
                    continue
                if is_none and not _needs_value(file, used):
                    continue
                if file.function_of(used) is timed and _is_always_used(file, used):
                    reported.add(name)
                    setter = next(methods[item] for item in methods if item in setters)
                    is_timer = isinstance(entity, Timer)
                    message = _message(name, setter, is_timer=is_timer, is_none=is_none)
                    location = file.module.location(used)
                    yield self.report(location, message, severity=Severity.WARNING)

    def _check_overrides(self, file: RclpyFile, node: NodeClass) -> Iterator[Diagnostic]:
        """Check overridden methods that the constructor of the base class calls."""
        call = node.super_init
        caller = f"the constructor of {node.base.name}" if node.base else "rclpy's Node"
        given = defined_by(node.base) if node.base else set[str]()
        hint = "set it before super().__init__()" if node.base else "rename the method"
        for name in _called_by_base(node) if call is not None else ():
            method = node.methods.get(name)
            if method is not None and "attr(" in file.module.text(method):
                continue  # it checks: `hasattr(self, 'robot')`
            for used in file.module.below(method, ast.Attribute) if method is not None else ():
                if call is None or not isinstance(used.ctx, ast.Load):
                    continue
                if has(NODE, used.attr) or used.attr in file.module.index.bindings(node.node):
                    continue
                if used.attr in given or (node.base and not _is_always_used(file, used)):
                    continue
                if file.evaluator.self_class(used.value) is not node.node:
                    continue
                line = _first_line(file, node, used.attr)
                is_handled_there = is_handled(file.module, used, "AttributeError")
                if line > (call.end_lineno or call.lineno) and not is_handled_there:
                    message = (
                        f"{caller} calls {name}() during construction, before self.{used.attr} is "
                        f"set in line {line}: AttributeError; {hint}"
                    )
                    yield self.report(file.module.location(used), message)
                    break


def _called_by_base(node: NodeClass) -> Iterable[str]:
    """Return the methods that the constructor of the base class always calls."""
    base = node.base
    if base is None:
        return _CALLED_BY_NODE
    statements = base.constructor.body if base.constructor is not None else ()
    values = (item.value for item in statements if isinstance(item, ast.Expr | ast.Assign))
    functions = (value.func for value in values if isinstance(value, ast.Call))
    return [
        func.attr
        for func in functions
        if isinstance(func, ast.Attribute) and base.file.module.text(func.value) == "self"
    ]


def _registered_first(
    file: RclpyFile, node: NodeClass
) -> Iterator[tuple[Timer | Subscription | Synchronizer | Service, FunctionNode]]:
    """Yield the methods that may be called right after the constructor, with the reason."""
    if not is_read_in_full(node) or _may_wait(file, node):
        return
    methods = {*node.methods.values()}
    for entity, callback in file.callbacks:
        function = callback.function
        if not isinstance(entity, Timer | Subscription | Synchronizer | Service):
            continue
        is_made_there = file.function_of(entity.call) is node.constructor
        if is_made_there and function is not None and function in methods:
            yield entity, function


def _message(name: str, setter: str, *, is_timer: bool, is_none: bool) -> str:
    """Return the message about an attribute that a later callback sets."""
    if setter in _TRANSITIONS:
        setting, first = f"{setter}()", "the transition"
    else:
        setting, first = f"the callback {setter!r}", "the first message"
        first = first if is_timer else f"{first} there"
    early = f"the timer may run before {first}" if is_timer else f"this may run before {first}"
    if is_none:
        return f"self.{name} is None until {setting} sets it, and {early}; check for None first"
    return (
        f"self.{name} is only set by {setting}, and {early}: AttributeError; set it in the "
        "constructor"
    )


def _setters(
    file: RclpyFile, node: NodeClass, used: ast.Attribute
) -> tuple[set[FunctionNode | ast.Lambda | None], bool]:
    """Return the methods that set an attribute of a node, and whether it is None before.

    Empty if the class defines it.
    """
    if not isinstance(used.ctx, ast.Load) or has(NODE, used.attr):
        return set(), False
    if used.attr in file.module.index.bindings(node.node):
        return set(), False
    if file.evaluator.self_class(used.value) is not node.node:
        return set(), False
    stores = [*file.evaluator.stores(used.attr)]
    empty = [
        store
        for store in stores
        if isinstance(store.value, ast.Constant)
        and store.value.value is None
        and file.function_of(store.node) is node.constructor
    ]
    setters = {file.function_of(store.node) for store in stores if store not in empty}
    return setters, bool(empty)


def _needs_value(file: RclpyFile, used: ast.Attribute) -> bool:
    """Return whether a use of an attribute fails for None."""
    match file.module.parent(used):
        case ast.Attribute(value=value) | ast.Subscript(value=value):
            return value is used
    return False


def _may_wait(file: RclpyFile, node: NodeClass) -> bool:
    """Return whether the constructor waits for a message, or cancels a timer for now."""
    text = file.module.text(node.constructor) if node.constructor is not None else ""
    return any(word in text for word in ("while ", "spin", "wait_for", ".cancel("))


def _is_always_used(file: RclpyFile, used: ast.Attribute) -> bool:
    """Return whether a function uses an attribute unconditionally, without checking it."""
    in_loop = any(
        isinstance(parent, ast.For | ast.While | ast.comprehension)
        for parent in file.module.parents(used)
    )
    text = file.module.source.text
    is_asked = any(word in text for word in ("attr(", "__dict__", "vars(")) and (
        f"'{used.attr}'" in text or f'"{used.attr}"' in text
    )
    if in_loop or is_asked or conditions_on(file.module, used):
        return False
    return not is_handled(file.module, used, "AttributeError")


def _used_early(file: RclpyFile, node: NodeClass) -> Iterator[tuple[ast.Attribute, int]]:
    """Yield the first use of each attribute that is only set on later lines."""
    bound = file.module.index.bindings(node.node)
    reported: set[str] = set()
    first_lines: dict[str, int] = {}
    if node.constructor is None or not is_read_in_full(node) or file.module.mentions("setattr("):
        return
    for used in file.module.below(node.constructor, ast.Attribute):
        if not isinstance(used.ctx, ast.Load):
            continue
        if used.attr in reported or used.attr in bound or has(NODE, used.attr):
            continue
        if file.evaluator.self_class(used.value) is not node.node:
            continue
        if used.attr not in first_lines:
            first_lines[used.attr] = _first_line(file, node, used.attr)
        line = first_lines[used.attr]
        if used.lineno >= line or file.function_of(used) is not node.constructor:
            continue
        in_loop = any(
            isinstance(parent, ast.For | ast.While) for parent in file.module.parents(used)
        )
        if not in_loop and not is_handled(file.module, used, "AttributeError"):
            reported.add(used.attr)
            yield used, line


def _first_line(file: RclpyFile, node: NodeClass, name: str) -> int:
    """Return the first line that sets an attribute; 0 if other methods set it too."""
    stores = file.evaluator.stores(name)
    if {file.function_of(store.node) for store in stores} != {node.constructor}:
        return 0
    return min(store.node.lineno for store in stores)
