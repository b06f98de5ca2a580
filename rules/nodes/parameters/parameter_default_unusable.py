"""ND083: parameters have a type or a default that rclpy accepts, within its range."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Effect, Example, Package, RclpyRule, Report, Severity, fact
from scaffold.api.launch import started_nodes
from scaffold.api.parameters import parameter_files
from scaffold.api.python import PythonModule, is_handled, joined_names
from scaffold.api.rclpy import PARAMETER, Parameter, RclpyFile, class_of, is_of_node

from ._parameter_objects import fields_read

_TYPES = "rcl_interfaces.msg.ParameterType.PARAMETER_"
_TYPE = "expected Parameter.Type.{}"
_CLASSES = {"bool": "BOOL", "float": "DOUBLE", "int": "INTEGER", "str": "STRING"}
_PATHS = frozenset({"pathlib.Path", "pathlib.Path.cwd", "pathlib.Path.home"})
"""The calls that return a Path."""
_EMPTY = {
    "bool_value": "False",
    "integer_value": "0",
    "double_value": "0.0",
    "string_value": "''",
}
"""The fields of ParameterValue that are no arrays, as they are in a new message."""
_NO_DEFAULT = "parameters without a default"
_NODE = (
    "from rcl_interfaces.msg import ParameterDescriptor, ParameterType\n"
    "from rclpy.node import Node\nfrom rclpy.parameter import Parameter\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', {}, ParameterDescriptor({}))\n"
    "        self.declare_parameters('', [('mode', {}), ('gain', 1.0)])\n"
)
_PLAIN = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.declare_parameter({})\n"
)
_RIGHT = {"integer": "integer_range", "double": "floating_point_range"}
_NODE_RANGE = (
    "from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        limits = FloatingPointRange(from_value=0.0, to_value=1.0{})\n"
    "        descriptor = ParameterDescriptor(floating_point_range=[limits])\n"
    "        self.declare_parameter('gain', {}, descriptor)\n"
)


class ParameterDefaultUnusable(RclpyRule):
    """The default of a parameter is missing, empty, a class, lacks a comma, or is out of its range.

    **Why.** ``ValueError: Cannot declare a statically typed parameter with default value of type
    PARAMETER_NOT_SET``, ``TypeError: The given value is not one of the allowed types``, or
    ``InvalidParameterValueException: ... Parameter gain out of range Min: 0.0, Max: 1.0, value:
    5.0``; a range for the other number type is ignored. The constants of ``ParameterType`` are
    numbers: as a default, they make the parameter an integer. Without a default and a descriptor,
    rclpy only warns, and the value is None until it is set. An empty list declares a byte array, so
    rclpy rejects a list of strings later. Python joins adjacent strings: ``['north' 'south']`` is a
    list with one name.

    **Fix.** Without a default, pass ``Parameter.Type.DOUBLE``, or a descriptor with
    ``dynamic_typing=True``; the ``type`` of a descriptor is ignored. Change the default or the
    range; write ``1.0`` for a floating_point_range.

    **Source.** ``rclpy/node.py``, ``declare_parameters``, ``_apply_descriptor``;
    ``rclpy/parameter.py``; rclpy issue 1030.
    """

    code = "ND083"
    name = "parameter-default-unusable"
    effect = Effect.STOPS_START
    other_severities = {
        Severity.WARNING: "the parameter has no default, and a file of the package sets it, or the "
        "code only tests whether it is true or reads a field of ``get_parameter_value()``"
    }
    examples = (
        Example("a default", {"talker.py": _NODE.format("1.0", "description='Hz'", "'slow'")}),
        Example(
            "a type; any type",
            {"talker.py": _NODE.format("None", "dynamic_typing=True", "Parameter.Type.STRING")},
        ),
        Example(
            "the type in the descriptor",
            {"talker.py": _NODE.format("None", "type=4", "Parameter.Type.STRING")},
        ),
        Example(
            "no default",
            {"talker.py": _NODE.format("None", "description='Hz'", "None")},
            "9:40: parameter 'rate' needs a default or a Parameter.Type: ValueError",
            "10:47: parameter 'mode' needs a default or a Parameter.Type: ValueError",
        ),
        Example(
            "a class; a constant of ParameterType",
            {"talker.py": _NODE.format("float", "", "ParameterType.PARAMETER_STRING")},
            "9:40: expected Parameter.Type.DOUBLE, not the class 'float': TypeError",
            "10:47: this constant makes the parameter an integer; expected Parameter.Type.STRING",
        ),
        Example(
            "a Parameter, a set, NOT_SET, a type with dynamic_typing",
            {
                "a.py": _NODE.format("Parameter('rate', value=1.0)", "", "{'slow'}"),
                "b.py": _NODE.format(
                    "Parameter.Type.DOUBLE", "dynamic_typing=True", "Parameter.Type.NOT_SET"
                ),
            },
            "a.py:9:40: expected the default itself, not a Parameter: TypeError",
            "a.py:10:47: a parameter cannot hold a set: TypeError",
            "b.py:9:40: a type and dynamic_typing=True exclude each other: ValueError",
            "b.py:10:47: a parameter of type NOT_SET cannot be declared: ValueError",
        ),
        Example(
            "a Path; the text of one",
            {
                "talker.py": "from pathlib import Path\n\n"
                + _PLAIN.format("'map', Path.home() / 'maps' / 'office.yaml'")
                + "        folder = Path('/opt/maps')\n"
                "        self.declare_parameter('folder', folder)\n"
                "        self.declare_parameter('other', str(folder / 'other'))\n"
            },
            "9:39: a parameter cannot hold a Path: TypeError; pass str(...)",
            "11:42: a parameter cannot hold a Path: TypeError; pass str(...)",
        ),
        Example(
            "parameters of unknown names without a default",
            {
                "talker.py": _NODE.format("1.0", "", "None")
                .replace("__init__(self)", "__init__(self, name)")
                .replace("'mode'", "name")
            },
            "10:45: parameter of this name needs a default or a Parameter.Type: ValueError",
        ),
        Example("only a name and a default", {"talker.py": _PLAIN.format("'rate', 2.0")}),
        Example(
            "only a name",
            {"talker.py": _PLAIN.format("'rate'")},
            "7:32: parameter 'rate' has no default: its value is None until it is set",
        ),
        Example(
            "a value from an unset parameter that the node tests",
            {
                "talker.py": _PLAIN.format("'joints'")
                + "        self.joints = self.get_parameter('joints').value\n"
                "        if self.joints is None or len(self.joints) == 0:\n"
                "            raise ValueError('joints is not set')\n"
            },
            Report(
                "7:32",
                "parameter 'joints' has no default: its value is None until it is set",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "parameters whose values are only tested",
            {
                "talker.py": _PLAIN.format("'quiet'")
                + "        self.declare_parameter('dry_run')\n"
                "        self.quiet = self.get_parameter('quiet').value\n"
                "        self.mode = 'dry' if self.get_parameter('dry_run').value else 'wet'\n\n"
                "    def talk(self):\n"
                "        if not self.quiet:\n"
                "            self.get_logger().info(self.mode)\n",
            },
            Report(
                "7:32",
                "parameter 'quiet' has no default: its value is None until it is set",
                severity=Severity.WARNING,
            ),
            Report(
                "8:32",
                "parameter 'dry_run' has no default: its value is None until it is set",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a parameter of which only a field of its message is read",
            {
                "talker.py": _PLAIN.format("'step'")
                + "        step = self.get_parameter('step').get_parameter_value().integer_value\n"
                "        self.declare_parameter('topic')\n"
                "        topic = self.get_parameter('topic')\n"
                "        self.topic = topic.get_parameter_value().string_value\n"
                "        self.step = step + 1\n"
            },
            Report(
                "7:32",
                "parameter 'step' has no default: its integer_value is 0 until it is set",
                severity=Severity.WARNING,
            ),
            Report(
                "9:32",
                "parameter 'topic' has no default: its string_value is '' until it is set",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a parameter whose value is tested in one place and used in another",
            {
                "talker.py": _PLAIN.format("'rate'")
                + "        self.rate = self.get_parameter('rate').value\n\n"
                "    def talk(self):\n"
                "        if self.rate:\n"
                "            self.get_logger().info('fast')\n"
                "        return 1.0 / self.rate\n",
            },
            "7:32: parameter 'rate' has no default: its value is None until it is set",
        ),
        Example(
            "parameters that a YAML file and a launch file set",
            {
                "talker.py": _PLAIN.format("'rate'").replace("'rate'", "'gain'", 1)
                + "        self.declare_parameter('rate')\n",
                "config/talker.yaml": "/**:\n  ros__parameters:\n    gain: 2\n",
                "launch/talk.launch.py": "from launch import LaunchDescription\n"
                "from launch_ros.actions import Node\n\n\n"
                "def generate_launch_description():\n"
                "    talker = Node(package='a', executable='b', parameters=[{'rate': 1.0}])\n"
                "    return LaunchDescription([talker])\n",
            },
            Report(
                "talker.py:7:32",
                "parameter 'gain' has no default: its value is None until it is set",
                severity=Severity.WARNING,
            ),
            Report(
                "talker.py:8:32",
                "parameter 'rate' has no default: its value is None until it is set",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a parameter that the launch file of another package sets",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "talker.py": _PLAIN.format("'rate'"),
            },
            Report(
                "talker.py:7:32",
                "parameter 'rate' has no default: its value is None until it is set",
                severity=Severity.WARNING,
            ),
            neighbors={
                "bringup": {
                    "package.xml": "<package><name>bringup</name></package>\n",
                    "launch/talk.launch.py": "from launch import LaunchDescription\n"
                    "from launch_ros.actions import Node\n\n\n"
                    "def generate_launch_description():\n"
                    "    rate = {'rate': 1.0}\n"
                    "    talker = Node(package='talker', executable='talk', parameters=[rate])\n"
                    "    return LaunchDescription([talker])\n",
                },
            },
        ),
        Example(
            "a parameter without a default, next to one with a default, that a YAML file sets",
            {
                "talker.py": _PLAIN.format("'rate', 2.0")
                + "        self.declare_parameter('gain')\n",
                "config/talker.yaml": "/**:\n  ros__parameters:\n    gain: 2\n",
            },
            Report(
                "talker.py:8:32",
                "parameter 'gain' has no default: its value is None until it is set",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "an empty list",
            {"talker.py": _PLAIN.format("'names', []")},
            "7:32: parameter 'names' becomes a byte array: the default is an empty list; write "
            "its type instead, such as Parameter.Type.STRING_ARRAY",
        ),
        Example(
            "a comma is missing",
            {"talker.py": _PLAIN.format("'stations', ['north' 'south']")},
            "7:45: missing comma after 'north': it is joined to 'south'",
        ),
        Example(
            "strings on two lines",
            {
                "talker.py": _PLAIN.format(
                    "'hints', ['turn left at the '\n            'first corner', 'north']"
                )
            },
        ),
        Example("in the range of its descriptor", {"talker.py": _NODE_RANGE.format("", "0.55")}),
        Example("on a step of the range", {"talker.py": _NODE_RANGE.format(", step=0.1", "0.7")}),
        Example(
            "above the range",
            {"talker.py": _NODE_RANGE.format("", "5.0")},
            "10:40: default 5.0 is outside the range 0.0 to 1.0 of the descriptor: "
            "InvalidParameterValueException",
        ),
        Example(
            "between two steps of the range",
            {"talker.py": _NODE_RANGE.format(", step=0.1", "0.25")},
            "10:40: default 0.25 is outside the range 0.0 to 1.0 in steps of 0.1 of the "
            "descriptor: InvalidParameterValueException",
        ),
        Example(
            "an integer with a range of doubles",
            {"talker.py": _NODE_RANGE.format("", "1")},
            "10:40: default 1 is an integer: the double range of the descriptor is ignored; use "
            "integer_range",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_default(package, file)
        yield from self._check_range(file)

    def _check_default(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        for parameter in (p for p in file.parameters if is_of_node(file, p)):
            node = parameter.default_node
            problem = _type_problem(parameter) or (
                _default_problem(file, parameter, node) if node else ""
            )
            error = problem.rpartition(": ")[2]
            if problem and not is_handled(file.module, parameter.call, error):
                cause = _NO_DEFAULT if error == "ValueError" else ""
                yield self.report(
                    file.module.location(node or parameter.call), problem, cause=cause
                )
        for parameter in file.parameters:
            yield from self._check_commas(file, parameter)
            fields = () if parameter.default_node else fields_read(file, parameter.name)
            problem = _missing_problem(parameter, fields)
            if problem:
                is_harmless = parameter.default_node is None and (
                    len(fields) > 0
                    or _is_set(package, str(parameter.name))
                    or _is_only_tested(file, parameter)
                )
                yield self.report(
                    parameter.name_location,
                    problem,
                    severity=Severity.WARNING if is_harmless else Severity.ERROR,
                    cause=_NO_DEFAULT if parameter.default_node is None else "",
                )

    def _check_commas(self, file: RclpyFile, parameter: Parameter) -> Iterator[Diagnostic]:
        node = parameter.default_node
        listed = file.evaluator.single_value(node) if node else None
        for item in listed.elts if isinstance(listed, ast.List | ast.Tuple) else ():
            names = joined_names(file.module, item)
            if names:
                message = f"missing comma after {names[0]!r}: it is joined to {names[1]!r}"
                yield self.report(file.module.location(item), message)

    def _check_range(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for parameter in (p for p in file.parameters if is_of_node(file, p)):
            message = _problem(parameter) if parameter.default_node is not None else ""
            if message and not is_handled(
                file.module, parameter.call, "InvalidParameterValueException"
            ):
                at = parameter.default_node or parameter.call
                yield self.report(file.module.location(at), message)


def _is_set(package: Package, name: str) -> bool:
    """Return whether a file of the package, or of one that starts its nodes, sets a parameter."""
    return name in _set_names(package) or any(
        name in _set_names(other) and any(x.package == package.name for x in started_nodes(other))
        for other in package.workspace
    )


@fact
def _set_names(package: Package) -> frozenset[str]:
    """Return the names of all parameters that files of the package set, of any node."""
    sections = [section for file in parameter_files(package) for section in file.sections]
    names = {entry.name for section in sections for entry in section.entries}
    names |= {given.name for node in started_nodes(package) for given in node.parameters}
    return frozenset(names)


def _is_only_tested(file: RclpyFile, parameter: Parameter) -> bool:
    """Return whether the code only reads a parameter, or handles None."""
    module = file.module
    reads = [read.call for read in file.parameter_reads if read.name == parameter.name]
    values = [value for call in reads for value in _uses(module, call)]
    if any(_is_compared_with_none(module, value) for value in values):
        return True
    return bool(values) and all(_is_tested(module, value) for value in values)


def _is_compared_with_none(module: PythonModule, value: ast.AST) -> bool:
    match module.parent(value):
        case ast.Compare(ops=[ast.Is() | ast.IsNot()], comparators=[ast.Constant(value=None)]):
            return True
    return False


def _uses(module: PythonModule, call: ast.Call) -> Sequence[ast.AST]:
    """Return the uses of the value of ``get_parameter(...)``, also through one variable."""
    value = module.parent(call)
    if not isinstance(value, ast.Attribute) or value.attr != "value":
        return [call]
    match module.parent(value):
        case ast.Assign(targets=[ast.Attribute(attr=name)]):
            named = [node for node in module.walk(ast.Attribute) if node.attr == name]
            return [node for node in named if isinstance(node.ctx, ast.Load)]
        case ast.Assign(targets=[ast.Name(id=name)]):
            loads = [node for node in module.walk(ast.Name) if node.id == name]
            return [node for node in loads if isinstance(node.ctx, ast.Load)]
    return [value]


def _is_tested(module: PythonModule, value: ast.AST) -> bool:
    match module.parent(value):
        case ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test):
            return test is value
        case ast.UnaryOp(op=ast.Not()):
            return True
        case ast.Compare(ops=[ast.Is() | ast.IsNot() | ast.Eq() | ast.NotEq()]):
            return True
    return False


def _default_problem(file: RclpyFile, parameter: Parameter, node: ast.expr) -> str:
    full = file.module.qualified_name(node) or ""
    if full.startswith(_TYPES):
        kind = full.removeprefix(_TYPES)
        return f"this constant makes the parameter an integer; {_TYPE.format(kind)}"
    is_builtin = isinstance(node, ast.Name) and not file.module.index.lookup(node.id, node)
    if isinstance(node, ast.Name) and is_builtin and node.id in _CLASSES:
        return f"{_TYPE.format(_CLASSES[node.id])}, not the class {node.id!r}: TypeError"
    if class_of(file, node) == PARAMETER:
        return "expected the default itself, not a Parameter: TypeError"
    if _is_path(file, node):
        return "a parameter cannot hold a Path: TypeError; pass str(...)"
    is_dictionary = isinstance(parameter.default, dict) and "parameters" in parameter.arguments
    if is_dictionary or isinstance(node, ast.Set) or isinstance(parameter.default, bytes):
        word = "set" if isinstance(node, ast.Set) else type(parameter.default).__name__
        return f"a parameter cannot hold a {word}: TypeError"
    return ""


def _is_path(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether a value is a ``pathlib.Path``, or one with parts appended to it."""
    value = file.evaluator.single_value(node)
    while isinstance(value, ast.BinOp) and isinstance(value.op, ast.Div):
        value = file.evaluator.single_value(value.left)
    if not isinstance(value, ast.Call):
        return False
    return file.module.qualified_name(value.func) in _PATHS


def _type_problem(parameter: Parameter) -> str:
    """Return the message for a declaration without a usable default."""
    if parameter.declared_type == "not_set":
        return "a parameter of type NOT_SET cannot be declared: ValueError"
    if parameter.descriptor is None:
        return ""
    if parameter.declared_type is not None and parameter.descriptor.is_dynamic:
        return "a type and dynamic_typing=True exclude each other: ValueError"
    is_none = parameter.default is None or (
        parameter.default_node is None and "name" in parameter.arguments
    )
    is_alone = parameter.descriptor_node is None and "name" in parameter.arguments
    if not is_none or parameter.descriptor.is_dynamic or is_alone or parameter.descriptor.is_typed:
        return ""
    name = repr(parameter.name) if isinstance(parameter.name, str) else "of this name"
    return f"parameter {name} needs a default or a Parameter.Type: ValueError"


def _missing_problem(parameter: Parameter, fields: Sequence[str]) -> str:
    """Return the message for a declaration that rclpy accepts without a usable default."""
    is_typed = parameter.declared_type is not None or parameter.argument("descriptor") is not None
    if is_typed or not isinstance(parameter.name, str) or parameter.has_unknown_arguments:
        return ""
    if parameter.default_node is None:
        values = " and ".join(f"its {field} is {_EMPTY.get(field, '[]')}" for field in fields)
        values = values or "its value is None"
        return f"parameter {parameter.name!r} has no default: {values} until it is set"
    if parameter.default in ([], ()):
        return (
            f"parameter {parameter.name!r} becomes a byte array: the default is an empty list; "
            "write its type instead, such as Parameter.Type.STRING_ARRAY"
        )
    return ""


def _problem(parameter: Parameter) -> str:
    default, kind = parameter.default, parameter.type
    ranges = parameter.descriptor.ranges if parameter.descriptor is not None else []
    if not isinstance(default, int | float) or kind not in _RIGHT:
        return ""
    for limits in ranges:
        if limits.type == kind and not limits.allows(default):
            return (
                f"default {default} is outside the range {limits.text} of the descriptor: "
                "InvalidParameterValueException"
            )
    if ranges and all(limits.type != kind for limits in ranges):
        article = "an" if kind == "integer" else "a"
        return (
            f"default {default} is {article} {kind}: the {ranges[0].type} range of the "
            f"descriptor is ignored; use {_RIGHT[kind]}"
        )
    return ""
