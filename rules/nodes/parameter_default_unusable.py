"""ND083: parameters have a default or a type that rclpy takes."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.python import is_harmless
from scaffold.api.rclpy import PARAMETER, Parameter, RclpyFile, class_of, is_of_node

_TYPES = "rcl_interfaces.msg.ParameterType.PARAMETER_"
_TYPE = "the type is Parameter.Type.{}"
_CLASSES = {"bool": "BOOL", "float": "DOUBLE", "int": "INTEGER", "str": "STRING"}
_NODE = (
    "from rcl_interfaces.msg import ParameterDescriptor, ParameterType\n"
    "from rclpy.node import Node\nfrom rclpy.parameter import Parameter\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', {}, ParameterDescriptor({}))\n"
    "        self.declare_parameters('', [('mode', {}), ('gain', 1.0)])\n"
)


class ParameterDefaultUnusable(RclpyRule):
    """The default of a parameter is none: nothing, a class, a constant of ``ParameterType``.

    **Why.** ``ValueError: Cannot declare a statically typed parameter with default value of type
    PARAMETER_NOT_SET``, or ``TypeError: The given value is not one of the allowed types``. The
    constants of ``ParameterType`` are numbers, so one in place of a default makes an integer.

    **Fix.** Without a default give ``Parameter.Type.DOUBLE``, or a descriptor with
    ``dynamic_typing=True``. The ``type`` of a descriptor is ignored.

    **Source.** ``rclpy/node.py``, ``declare_parameters``; ``rclpy/parameter.py``.
    """

    code = "ND083"
    name = "parameter-default-unusable"
    examples = (
        Example("a default", {"talker.py": _NODE.format("1.0", "description='Hz'", "'slow'")}),
        Example(
            "a type; any type",
            {"talker.py": _NODE.format("None", "dynamic_typing=True", "Parameter.Type.STRING")},
        ),
        Example(
            "nothing",
            {"talker.py": _NODE.format("None", "description='Hz'", "None")},
            reports=(
                Report(
                    "talker.py:9:40",
                    "parameter 'rate' has no default: write one, or a Parameter.Type: ValueError",
                ),
                Report(
                    "talker.py:10:47",
                    "parameter 'mode' has no default: write one, or a Parameter.Type: ValueError",
                ),
            ),
        ),
        Example(
            "a class; a number in place of a type",
            {"talker.py": _NODE.format("float", "", "ParameterType.PARAMETER_STRING")},
            reports=(
                Report(
                    "talker.py:9:40",
                    "this is the class float: the type is Parameter.Type.DOUBLE: TypeError",
                ),
                Report(
                    "talker.py:10:47",
                    "this is a number, so the parameter is an integer; the type is "
                    "Parameter.Type.STRING",
                ),
            ),
        ),
    )

    def check_file(self, facts: RclpyFile) -> Iterator[Diagnostic]:
        for one in (one for one in facts.parameters if is_of_node(facts, one)):
            node = one.default_node
            problem = _type_problem(one) or (_default_problem(facts, one, node) if node else "")
            error = problem.rpartition(": ")[2]
            if problem and not is_harmless(facts.module, one.call, error):
                yield self.report(facts.module.location(node or one.call), problem)


def _default_problem(facts: RclpyFile, one: Parameter, node: ast.expr) -> str:
    full = facts.module.qualified_name(node) or ""
    if full.startswith(_TYPES):
        kind = full.removeprefix(_TYPES)
        return f"this is a number, so the parameter is an integer; {_TYPE.format(kind)}"
    is_builtin = isinstance(node, ast.Name) and not facts.module.index.lookup(node.id, node)
    if isinstance(node, ast.Name) and is_builtin and node.id in _CLASSES:
        return f"this is the class {node.id}: {_TYPE.format(_CLASSES[node.id])}: TypeError"
    if class_of(facts, node) == PARAMETER:
        return "this is a Parameter, and its value belongs here: TypeError"
    is_dictionary = isinstance(one.default, dict) and "parameters" in one.arguments
    if is_dictionary or isinstance(node, ast.Set) or isinstance(one.default, bytes):
        word = "set" if isinstance(node, ast.Set) else type(one.default).__name__
        return f"a parameter holds no {word}: TypeError"
    return ""


def _type_problem(one: Parameter) -> str:
    """Return what is wrong about a default that is none, by the descriptor."""
    if one.declared_type == "not_set":
        return "a parameter of the type NOT_SET holds nothing: ValueError"
    if one.descriptor is None:
        return ""
    if one.declared_type is not None and one.descriptor.is_dynamic:
        return "either a type or dynamic_typing=True, not both: ValueError"
    is_none = one.default is None or (one.default_node is None and "name" in one.arguments)
    is_alone = one.descriptor_node is None and "name" in one.arguments
    if not is_none or one.descriptor.is_dynamic or is_alone:
        return ""
    name = repr(one.name) if isinstance(one.name, str) else "of this name"
    return f"parameter {name} has no default: write one, or a Parameter.Type: ValueError"
