"""ND017: the value of a parameter is used, not the Parameter object, a call or a field."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, RclpyRule, Report
from scaffold.api.python import is_expected
from scaffold.api.rclpy import FIELDS, PARAMETER, RclpyFile, class_of

from ._parameter_objects import objects_used

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        rate = self.get_parameter('rate'){}\n"
    "        self.create_timer(1.0 / rate, self.tick)\n\n"
    "    def tick(self):\n        pass\n"
)
_NODE_PASSING = (
    "from rclpy.node import Node\n\nfrom .settings import Settings\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        settings = Settings()\n"
    "        for name in ('rate', 'topic'):\n"
    "            self.declare_parameter(name, '')\n"
    "            parameter = self.get_parameter(name)\n"
    "            self.get_logger().info(f'set {parameter}')\n"
    "            settings.put(parameter)\n"
    "        mode = self.declare_parameter('mode', 'fast')\n"
    "        self.get_logger().info(f'keep {mode}')\n"
    "        settings.keep(mode)\n"
)
_OTHERS = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n"
    "        topic = self.declare_parameter('topic', 'chatter'){}\n"
    "        if self.get_parameter('topic'){} == 'chatter':\n"
    "            is_loud = not self.get_parameter('topic'){}\n"
    "        self.create_publisher(String, topic, 10 if is_loud else 1)\n"
)
_NODE_CALL = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        self.rate = self.get_parameter('rate').{}\n"
)
_NODE_FIELD = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 2.0)\n"
    "        self.rate = self.get_parameter('rate'){}.double_value\n"
)
_MISNAMED = ("array_value", "boolean_value", "float_value", "int_value", "str_value")
"""Names that are mistaken for fields of ParameterValue."""


class ParameterObjectUsed(RclpyRule):
    """A Parameter object is used instead of its value, or the value is called or has a field read.

    **Why.** ``TypeError: unsupported operand type(s) for /: 'float' and 'Parameter'``, ``'float'
    object is not callable``, ``AttributeError: 'float' object has no attribute 'double_value'``. A
    condition is always true, a comparison with a value is never true, and a str contains the
    address of the object.

    **Fix.** ``self.get_parameter('rate').value``, without parentheses or a field after it; the
    field is one of ``get_parameter_value()``.

    **Source.** ROS 2 documentation, "Using parameters in a class (Python)"; ``rclpy/parameter.py``;
    ``rcl_interfaces/msg/ParameterValue.msg``.
    """

    code = "ND017"
    name = "parameter-object-used"
    examples = (
        Example("the value", {"talker.py": _NODE.format(".value")}),
        Example(
            "the object in arithmetic",
            {"talker.py": _NODE.format("")},
            Report(
                "8:16",
                "this is the Parameter object (used in line 9), not its value; append .value",
                fix="Append .value",
            ),
            fixed={"talker.py": _NODE.format(".value")},
        ),
        Example(
            "the alternative to a parameter that is not declared",
            {
                "talker.py": _NODE.format("")
                .replace("get_parameter('rate')", "get_parameter_or('rate', 2.0)")
                .replace("declare_parameter('rate'", "declare_parameter('other'")
            },
        ),
        Example(
            "an object that is logged and passed to a function that takes a Parameter",
            {
                "talker.py": _NODE_PASSING,
                "settings.py": "from rclpy.parameter import Parameter\n\n\n"
                "class Settings:\n"
                "    def put(self, parameter: Parameter):\n"
                "        self.names = [parameter.name]\n\n"
                "    def keep(self, parameter):\n"
                "        self.value = parameter.get_parameter_value()\n",
            },
        ),
        Example(
            "an object that is logged and passed to a function that takes a value",
            {
                "talker.py": _NODE_PASSING,
                "settings.py": "class Settings:\n"
                "    def put(self, value):\n        self.value = value\n\n"
                "    def keep(self, value):\n        self.value = value\n",
            },
            Report(
                "talker.py:12:25",
                "this is the Parameter object (used in line 13), not its value; append .value",
                fix="Append .value",
            ),
            Report(
                "talker.py:15:16",
                "this is the Parameter object (used in line 16), not its value; append .value",
                fix="Append .value",
            ),
            fixed={
                "talker.py": _NODE_PASSING.replace("er(name)", "er(name).value").replace(
                    "'fast')", "'fast').value"
                )
            },
        ),
        Example(
            "a condition, a comparison, a name",
            {"talker.py": _OTHERS.format("", "", "")},
            Report(
                "7:17",
                "this is the Parameter object (used in line 10), not its value; append .value",
                fix="Append .value",
            ),
            Report(
                "8:12",
                "this is the Parameter object, not its value; append .value",
                fix="Append .value",
            ),
            Report(
                "9:27",
                "this is the Parameter object, not its value; append .value",
                fix="Append .value",
            ),
            fixed={"talker.py": _OTHERS.format(".value", ".value", ".value")},
        ),
        Example(
            "the value called",
            {"talker.py": _NODE_CALL.format("value()")},
            "8:21: 'value' is a property of Parameter, not a method: TypeError; remove the ()",
        ),
        Example(
            "a field of the message called",
            {"talker.py": _NODE_CALL.format("get_parameter_value().double_value()")},
            "8:21: 'double_value' is a field, not a method: TypeError; remove the ()",
        ),
        Example(
            "a field of the message", {"talker.py": _NODE_FIELD.format(".get_parameter_value()")}
        ),
        Example(
            "a field of the value",
            {"talker.py": _NODE_FIELD.format(".value")},
            "8:21: '.value' is the value itself, without 'double_value': AttributeError",
        ),
        Example(
            "a field of the value of a parameter that was set",
            {
                "talker.py": _NODE_FIELD.format(".get_parameter_value()")
                + "        self.add_on_set_parameters_callback(self.change)\n\n"
                "    def change(self, parameters):\n"
                "        for parameter in parameters:\n"
                "            self.rate = parameter.value.int_value\n"
            },
            "13:25: '.value' is the value itself, without 'int_value': AttributeError",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_object(package, file)
        yield from self._check_call(file)
        yield from self._check_field(file)

    def _check_object(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for read, use in objects_used(package, file):
            _, end = file.module.span(read.call)
            fix = Fix("Append .value", (Edit(file.module.path, end, end, ".value"),))
            line = file.module.location(use).line
            where = "" if line == read.location.line else f" (used in line {line})"
            message = f"this is the Parameter object{where}, not its value; append .value"
            yield self.report(read, message, fix)

    def _check_call(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call, called in file.module.method_calls("value", *FIELDS):
            if problem := _problem(file, called):
                message = f"{problem}: TypeError; remove the ()"
                yield self.report(file.module.location(call), message)

    def _check_field(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for field in (*FIELDS, *_MISNAMED):
            for attribute in file.module.index.attributes(field):
                match file.evaluator.single_value(attribute.value):
                    case ast.Attribute(attr="value", value=parameter):
                        is_parameter = class_of(file, parameter) == PARAMETER
                    case _:
                        continue
                if is_parameter and not is_expected(file.module, attribute, "AttributeError"):
                    message = f"'.value' is the value itself, without {field!r}: AttributeError"
                    yield self.report(file.module.location(attribute), message)


def _problem(file: RclpyFile, called: ast.expr) -> str:
    """Return the problem with calling an expression."""
    match called:
        case ast.Attribute(attr="value", value=owner) if class_of(file, owner) == PARAMETER:
            return "'value' is a property of Parameter, not a method"
        case ast.Attribute(attr=name, value=owner) if name in FIELDS and _is_message(file, owner):
            return f"{name!r} is a field, not a method"
    return ""


def _is_message(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether an expression is the result of ``get_parameter_value()``."""
    match file.evaluator.single_value(node):
        case ast.Call(func=ast.Attribute(attr="get_parameter_value", value=parameter)):
            return class_of(file, parameter) == PARAMETER
    return False
