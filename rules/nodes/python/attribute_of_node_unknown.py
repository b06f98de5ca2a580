"""ND046: attributes that a node uses exist."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity, closest_name
from scaffold.api.python import is_expected
from scaffold.api.rclpy import (
    NODE,
    NodeClass,
    RclpyFile,
    defined_by,
    given_from_outside,
    has,
    is_base_elsewhere,
    is_read_in_full,
    known_names,
    names_of_bases,
    only_while_stopping,
    read_by_name,
)

_NODE = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.pub = self.create_publisher(String, 'chatter', 10)\n"
    "        self.create_timer(1.0, self.{})\n\n"
    "    def on_timer(self):\n"
    "        self.{}.publish(String())\n"
)
_MAIN = (
    "\n\ndef main():\n    rclpy.init()\n    talker = Talker()\n    rclpy.spin(talker)\n"
    "    talker.destroy()\n"
)
_ELSEWHERE = {
    "advertise": "create_publisher",
    "create_server": "create_service",
    "create_subscriber": "create_subscription",
    "create_wall_timer": "create_timer",
    "destroy": "destroy_node",
    "get_param": "get_parameter",
    "logger": "get_logger()",
    "now": "get_clock().now()",
    "set_parameter": "set_parameters",
    "spin": "rclpy.spin(...)",
}
"""Names in other libraries, and their names in rclpy."""
_OF_NODE = frozenset({"self", "cls", "this", "node"})
"""Names of arguments that are a node."""


class AttributeOfNodeUnknown(RclpyRule):
    """A node uses an attribute or method of ``self`` that is not defined.

    **Why.** ``AttributeError: 'Talker' object has no attribute 'create_subscriber'`` when the line
    is executed: in a constructor at start, in a callback at the first message.

    **Fix.** Correct the spelling, or define it.

    **Source.** ``rclpy/node.py``, ``Node``.
    """

    code = "ND046"
    name = "attribute-of-node-unknown"
    other_severities = {Severity.WARNING: "it only fails while the node shuts down"}
    examples = (
        Example(
            "attributes that a class of another package adds",
            {
                "package.xml": "<package><name>common</name></package>\n",
                "common/base.py": "from rclpy.node import Node\n\n\n"
                "class Base(Node):\n    def tick(self):\n        self.results.publish(None)\n",
            },
            neighbors={
                "rover": {
                    "package.xml": "<package><name>rover</name></package>\n",
                    "rover/drive.py": "from std_msgs.msg import String\n\n"
                    "from common.base import Base\n\n\n"
                    "class Drive(Base):\n    def start(self):\n"
                    "        self.results = self.create_publisher(String, 'results', 10)\n",
                }
            },
        ),
        Example(
            "attributes that are set and read by name",
            {
                "wheels.py": "from rclpy.node import Node\n"
                "from std_msgs.msg import Float64, String\n\n"
                "TOPICS = [('mode', String), ('gain', Float64)]\n\n\n"
                "class Wheels(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('wheels')\n"
                "        for side in ('left', 'right'):\n"
                "            publisher = self.create_publisher(Float64, side, 10)\n"
                "            setattr(self, side + '_pub', publisher)\n"
                "        for name, kind in TOPICS:\n"
                "            callback = getattr(self, f'on_{name}')\n"
                "            self.create_subscription(kind, name, callback, 10)\n\n"
                "    def on_mode(self, msg):\n"
                "        self.left_pub.publish(Float64())\n"
                "        self.rear_pub.publish(Float64())\n\n"
                "    def on_gains(self, msg):\n"
                "        pass\n"
            },
            "14:24: neither Wheels nor rclpy's Node has 'on_gain': AttributeError; did you mean "
            "'on_gains'?",
            "19:9: neither Wheels nor rclpy's Node has 'rear_pub': AttributeError",
        ),
        Example(
            "private attributes of a base class by their full names",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "talker/__init__.py": "",
                "talker/base.py": _NODE.format("on_timer", "_Talker__pub").replace(
                    "self.pub", "self.__pub"
                ),
                "talker/derived.py": "import rclpy\n\nfrom .base import Talker\n\n\n"
                "class Loud(Talker):\n"
                "    def shout(self):\n"
                "        print(self._Talker__pub, self._Talker__loud)\n",
            },
            "talker/derived.py:8:34: neither Loud nor rclpy's Node has '_Talker__loud': "
            "AttributeError; did you mean '_Talker__pub'?",
        ),
        Example(
            "handlers of any exception that log it, that say nothing and that replace the value",
            {
                "camera.py": "from rclpy.node import Node\n\n\n"
                "class Camera(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('camera')\n"
                "        self.frames = 0\n\n"
                "    def stop(self):\n"
                "        try:\n"
                "            self.grabber.release()\n"
                "        except Exception as error:\n"
                "            self.get_logger().error(f'cannot stop: {error}')\n"
                "        try:\n            self.light.close()\n"
                "        except Exception:\n            pass\n"
                "        try:\n            count = self.count\n"
                "        except Exception:\n            count = self.frames\n"
                "        return count\n"
            },
            "11:13: neither Camera nor rclpy's Node has 'grabber': AttributeError",
        ),
        Example("defined", {"talker.py": _NODE.format("on_timer", "pub")}),
        Example(
            "never reached",
            {
                "talker.py": _NODE.format("on_timer", "pub")
                + "\n    def stop(self):\n        return\n        self.client.cancel()\n"
            },
        ),
        Example(
            "after spin, and in a program that continues after spin",
            {
                "talker.py": _NODE.format("on_timer", "pub") + _MAIN,
                "worker.py": _NODE.format("on_timer", "pub").replace(
                    "String())", "rclpy.shutdown())"
                )
                + _MAIN,
            },
            Report(
                "talker.py:20:5",
                "neither Talker nor rclpy's Node has 'destroy': AttributeError; did "
                "you mean 'destroy_node'?",
                severity=Severity.WARNING,
            ),
            "worker.py:20:5: neither Talker nor rclpy's Node has 'destroy': AttributeError; did "
            "you mean 'destroy_node'?",
        ),
        Example(
            "misspelled",
            {"talker.py": _NODE.format("on_tick", "publisher")},
            "10:32: neither Talker nor rclpy's Node has 'on_tick': AttributeError",
            "13:9: neither Talker nor rclpy's Node has 'publisher': AttributeError; did you mean "
            "'publishers'?",
        ),
        Example(
            "a method without self",
            {
                "talker.py": _NODE.format("on_timer", "pub") + "        self.heading(String())\n\n"
                "    def heading(quaternion):\n"
                "        return quaternion.x * quaternion.y\n"
            },
            "16:5: heading() lacks 'self': 'quaternion' is the node, which has no 'x': "
            "AttributeError",
        ),
        Example(
            "a method that is indented too far",
            {
                "talker.py": _NODE.format("on_timer", "pub").replace(
                    "    def on_timer(self):\n        ", "        def on_timer(self):\n            "
                )
            },
            "10:32: neither Talker nor rclpy's Node has 'on_timer': AttributeError; the one in "
            "line 12 is inside another method; indent it less",
        ),
        Example(
            "a method of a lifecycle node",
            {
                "pump.py": "from rclpy.lifecycle import LifecycleNode\n\n\n"
                "class Pump(LifecycleNode):\n"
                "    def on_activate(self, state):\n"
                "        self.timer = self.create_lifecycle_timer(1.0, self.tick)\n"
                "        return super().on_activate(state)\n\n"
                "    def on_cleanup(self, state):\n"
                "        self.trigger_shutdown()\n\n"
                "    def tick(self):\n        self.get_logger().info('runs')\n"
            },
            "6:22: neither Pump nor rclpy's Node has 'create_lifecycle_timer': AttributeError; "
            "did you mean 'create_lifecycle_publisher'?",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        bases, given = names_of_bases(package), given_from_outside(package)
        used = _used_by_classes(file) if file.classes else {}
        for node in file.classes:
            if node.name in bases or not is_read_in_full(node):
                continue
            if node.node in used:
                yield from self._check(package, node, given, used[node.node])
            if file.module.mentions("getattr("):
                yield from self._check_by_name(package, node, given)

    def _check(
        self, package: Package, node: NodeClass, given: frozenset[str], used: list[ast.Attribute]
    ) -> Iterator[Diagnostic]:
        defined = defined_by(node)
        names: set[str] = set()
        module = node.file.module
        without_self = _without_self(node, {*defined, *given})
        for function, first in without_self.items():
            message = (
                f"{function.name}() lacks 'self': {module.text(first.value)!r} is the node, "
                f"which has no {first.attr!r}: AttributeError"
            )
            yield self.report(module.location(function), message)
        for attribute in used:
            name = attribute.attr
            if name in defined or name in given or _may_fail(node.file, attribute):
                continue
            if module.enclosing_function(attribute) in without_self:
                continue
            if is_base_elsewhere(package, node.name):
                return
            names = names or {*defined, *given, *_names_of_rclpy()}
            closest = _ELSEWHERE.get(name) or _closest(package, name, names)
            inner = _inner_function(node, name)
            hint = f"; did you mean {closest!r}?" if closest else ""
            if inner is not None:
                hint = f"; the one in line {inner.lineno} is inside another method; indent it less"
            message = f"neither {node.name} nor rclpy's Node has {name!r}: AttributeError{hint}"
            is_late = only_while_stopping(module, attribute)
            severity = Severity.WARNING if is_late else Severity.ERROR
            cause = f"attributes of {node.name} in {module.path}"
            yield self.report(module.location(attribute), message, severity=severity, cause=cause)

    def _check_by_name(
        self, package: Package, node: NodeClass, given: frozenset[str]
    ) -> Iterator[Diagnostic]:
        """Check the attributes that a node reads with getattr()."""
        module = node.file.module
        if module.mentions("hasattr("):
            return
        known = {*defined_by(node), *given, *_names_of_rclpy()}
        for call, name in read_by_name(node.file, node.node):
            if name not in known and not is_expected(module, call, "AttributeError"):
                closest = _closest(package, name, known)
                hint = f"; did you mean {closest!r}?" if closest else ""
                message = f"neither {node.name} nor rclpy's Node has {name!r}: AttributeError{hint}"
                yield self.report(module.location(call), message)


def _without_self(node: NodeClass, known: set[str]) -> dict[ast.FunctionDef, ast.Attribute]:
    """Return the methods that take the node for another object, with an attribute they read.

    Their first argument has another name than ``self``, and nothing that they read of it is known.
    """
    result: dict[ast.FunctionDef, ast.Attribute] = {}
    known = {*known, *_names_of_rclpy()}
    for function in node.node.body:
        if not isinstance(function, ast.FunctionDef) or function.decorator_list:
            continue
        read = [
            item
            for item in node.file.module.below(function, ast.Attribute)
            if isinstance(item.value, ast.Name)
            and item.value.id not in _OF_NODE
            and node.file.evaluator.self_class(item.value) is node.node
        ]
        if read and known.isdisjoint(item.attr for item in read):
            result[function] = read[0]
    return result


def _inner_function(node: NodeClass, name: str) -> ast.FunctionDef | None:
    """Return the nested function with this name in a method of a node."""
    module = node.file.module
    for function in module.below(node.node, ast.FunctionDef):
        if function.name == name and module.enclosing_function(function) is not None:
            return function
    return None


def _names_of_rclpy() -> Iterator[str]:
    return (name.removesuffix("()") for name in known_names()[NODE])


def _closest(package: Package, name: str, names: set[str]) -> str:
    # Private attributes of rclpy, with an underscore, are never the intended ones.
    hidden = "__" if name.startswith("_") else "_"
    return closest_name(package, name, [x for x in names if not x.startswith(hidden)], 0.7)


def _may_fail(file: RclpyFile, node: ast.Attribute) -> bool:
    """Return whether the code handles a missing attribute."""
    if is_expected(file.module, node, "AttributeError"):
        return True
    return f"'{node.attr}'" in file.module.source.text or (
        f'"{node.attr}"' in file.module.source.text
    )


def _used_by_classes(file: RclpyFile) -> dict[ast.ClassDef, list[ast.Attribute]]:
    """Return the attributes that classes read from ``self`` and the file never sets."""
    module = file.module
    read: list[ast.Attribute] = []
    stored: set[str] = set()
    for attribute in module.walk(ast.Attribute):
        if isinstance(attribute.ctx, ast.Load) or isinstance(
            module.parent(attribute), ast.AugAssign
        ):
            read.append(attribute)
        else:
            stored.add(attribute.attr)
    result: dict[ast.ClassDef, list[ast.Attribute]] = {}
    for attribute in read:
        if attribute.attr not in stored and not has(NODE, attribute.attr):
            class_ = _owner(file, attribute)
            if class_ is not None:
                result.setdefault(class_, []).append(attribute)
    return result


def _owner(file: RclpyFile, attribute: ast.Attribute) -> ast.ClassDef | None:
    """Return the class of an attribute access: that of ``self``, or of a variable."""
    class_ = file.evaluator.self_class(attribute.value)
    if class_ is None and isinstance(attribute.value, ast.Name):
        made = file.evaluator.single_value(attribute.value)
        if isinstance(made, ast.Call):
            class_ = file.evaluator.named_class(made.func)
    return class_
