"""ND085: parameter callbacks compare with declared names and types."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, closest_name
from scaffold.api.parameters import declared_alone, declared_by, has_always
from scaffold.api.rclpy import (
    NodeClass,
    RclpyFile,
    is_listed_parameter,
    name_asked,
    names_compared,
    types_compared,
)

_TYPES = ("rclpy.parameter.Parameter.Type.", "rclpy.Parameter.Type.")
_NODE = (
    "from rcl_interfaces.msg import SetParametersResult\n"
    "from rclpy.node import Node\nfrom rclpy.parameter import Parameter\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 1.0)\n"
    "        self.add_on_set_parameters_callback(self.on_set)\n\n"
    "    def on_set(self, parameters):\n"
    "        for one in parameters:\n"
    "            if one.name == '{}' and one.type_ == Parameter.Type.{}:\n"
    "                self.rate = one.value\n"
    "        return SetParametersResult(successful=True)\n"
)


class ParameterNeverMatched(RclpyRule):
    """A parameter callback compares with a name or type that the node does not declare.

    **Why.** No error: the condition is never true, and setting the parameter changes nothing.

    **Fix.** Use the declared name and type.

    **Source.** ``rclpy/node.py``, ``_set_parameters_atomically_common``: a callback gets only
    declared parameters, with their declared types.
    """

    code = "ND085"
    name = "parameter-never-matched"
    examples = (
        Example("declared", {"talker.py": _NODE.format("rate", "DOUBLE")}),
        Example(
            "another name",
            {"talker.py": _NODE.format("rates", "DOUBLE")},
            Report(
                "14:28", "never true: the node declares no parameter 'rates'; did you mean 'rate'?"
            ),
        ),
        Example(
            "another type",
            {"talker.py": _NODE.format("rate", "INTEGER")},
            Report("14:52", "never true: 'rate' is declared as double, not INTEGER"),
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        alone = {node: {str(p.name) for p in own} for node, own in declared_alone(file)}
        for attribute in file.module.index.attributes("name"):
            node = _owner(file, attribute)
            if node is not None and node in alone:
                yield from self._named(package, file, attribute, alone[node])
        for attribute in file.module.index.attributes("type_"):
            node = _owner(file, attribute)
            if node is not None:
                yield from self._typed(package, file, attribute, node)

    def _named(
        self, package: Package, file: RclpyFile, attribute: ast.Attribute, declared: set[str]
    ) -> Iterator[Diagnostic]:
        if not is_listed_parameter(file, attribute.value):
            return
        for item in names_compared(file, attribute):
            name = item.value if isinstance(item, ast.Constant) else None
            if isinstance(name, str) and name not in declared and not has_always(name):
                closest = closest_name(package, name, declared, 0.7)
                hint = f"; did you mean {closest!r}?" if closest else ""
                message = f"never true: the node declares no parameter {name!r}{hint}"
                yield self.report(file.module.location(item), message)

    def _typed(
        self, package: Package, file: RclpyFile, attribute: ast.Attribute, node: NodeClass
    ) -> Iterator[Diagnostic]:
        match file.module.parent(attribute), attribute.value:
            case ast.Compare(left=left, ops=[ast.Eq() | ast.NotEq()], comparators=[other]), (
                ast.Name(id=variable)
            ):
                full = file.module.qualified_name(other) or ""
                if left is not attribute or not full.startswith(_TYPES):
                    return
                if not is_listed_parameter(file, attribute.value):
                    return
                name = name_asked(file, attribute, variable) or ""
                declared = declared_by(node, package).types.get(name)
                asked = full.rpartition(".")[2]
                if declared in types_compared(file, attribute, name):
                    return  # the code handles several types
                if declared and declared != asked.lower():
                    message = f"never true: {name!r} is declared as {declared}, not {asked}"
                    yield self.report(file.module.location(other), message)


def _owner(file: RclpyFile, node: ast.AST) -> NodeClass | None:
    class_ = file.module.enclosing_class(node)
    return file.node_class(class_) if class_ is not None else None
