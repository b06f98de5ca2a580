"""ND050: parameters are declared before they are read."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.handlers import is_harmless
from scaffold.model.near import nearest
from scaffold.model.node_entities import Parameter, ParameterRead
from scaffold.model.node_owners import NodeClass
from scaffold.model.nodes import NodeFacts

_ALWAYS = ("use_sim_time", "start_type_description_service", "qos_overrides.")
"""Parameters, or beginnings of their names, that rclpy declares."""
_KNOWN = ("rclpy.", "tf2_ros.", "message_filters.", "cv_bridge.")
"""Packages whose classes take a node and declare no parameters of their own."""
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "{}"
    "        self.rate = self.get_parameter('rate').value\n"
    "{}"
)
_DECLARED = "        self.declare_parameter('rate', 1.0)\n"


class ParameterReadUndeclared(Rule):
    """A node reads a parameter that it does not declare, or not yet.

    **Why.** ``rclpy.exceptions.ParameterNotDeclaredException`` when the line is reached.

    **Fix.** Call ``self.declare_parameter`` with a default first.

    **Source.** ``rclpy/node.py``, ``get_parameter``; ROS 2 documentation, "About parameters".
    """

    code = "ND050"
    name = "parameter-read-undeclared"
    examples = (
        Example("declared", {"talker.py": _NODE.format(_DECLARED, "")}),
        Example(
            "declared by whoever takes the node",
            {"talker.py": _NODE.format("        declare_all(self)\n", "")},
        ),
        Example(
            "declared through a variable",
            {
                "talker.py": _NODE.format(
                    "        declare = self.declare_parameter\n        declare('rate', 1.0)\n", ""
                )
            },
        ),
        Example(
            "another one declared",
            {"talker.py": _NODE.format(_DECLARED.replace("rate", "rates"), "")},
            at=("talker.py:8",),
        ),
        Example(
            "declared too late",
            {"talker.py": _NODE.format("", _DECLARED)},
            at=("talker.py:7",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        passed_on: dict[NodeFacts, frozenset[ast.ClassDef]] = {}
        for facts in package.rclpy_files():
            bases = _bases(facts)
            for node in facts.classes:
                declared = None if node.node in bases else _declared(node, passed_on)
                if declared is None:
                    continue
                by_name: dict[str, list[Parameter]] = {}
                for one in declared:
                    by_name.setdefault(str(one.name), []).append(one)
                for read in node.parameter_reads:
                    message = _message(package, read, by_name)
                    if message and not _is_ready(facts, read.call):
                        yield self.report(read, message)


def _message(package: Package, read: ParameterRead, declared: dict[str, list[Parameter]]) -> str:
    if read.method != "get_parameter" or not isinstance(read.name, str):
        return ""
    if read.name.startswith(_ALWAYS):
        return ""
    same = declared.get(read.name, [])
    if not same:
        near = nearest(package, read.name, declared, 0.7)
        hint = f"; {near!r} is" if near else ""
        return f"parameter {read.name!r} is not declared{hint}: ParameterNotDeclaredException"
    late = [
        one.location.line
        for one in same
        if one.function is read.function and one.location.line > read.location.line
    ]
    if len(late) == len(same) and not read.is_conditional:
        return f"parameter {read.name!r} is declared in line {late[0]} only: after it is read"
    return ""


def _declared(
    node: NodeClass, passed_on: dict[NodeFacts, frozenset[ast.ClassDef]]
) -> list[Parameter] | None:
    """Return what a class and its bases declare; ``None`` if others may declare more.

    Args:
        node: The class.
        passed_on: What `_passed_on` says of files, to be filled.
    """
    found: list[Parameter] = []
    owner: NodeClass | None = node
    while owner is not None:
        if owner.declares_automatically or owner.is_lifecycle or len(owner.node.bases) != 1:
            return None
        if any(not isinstance(one.name, str) for one in owner.parameters):
            return None
        if owner.facts not in passed_on:
            passed_on[owner.facts] = _passed_on(owner.facts)
        if owner.node in passed_on[owner.facts]:
            return None
        found += owner.parameters
        owner = owner.base
    return None if _declares_on_others(node.facts) else found


def _bases(facts: NodeFacts) -> frozenset[ast.ClassDef | None]:
    """Return the classes of a file that others there inherit from."""
    return frozenset(
        facts.evaluator.named_class(base)
        for other in facts.module.walk(ast.ClassDef)
        for base in other.bases
    )


def _declares_on_others(facts: NodeFacts) -> bool:
    """Tell whether the file declares parameters on an object that is not known."""
    return any(one.owner is None for one in facts.parameters)


def _passed_on(facts: NodeFacts) -> frozenset[ast.ClassDef]:
    """Return the classes that give themselves to something that may declare parameters.

    All of them where the file asks nodes what they have.
    """
    if "has_parameter" in facts.module.source.text:
        return frozenset(facts.module.walk(ast.ClassDef))
    found: set[ast.ClassDef] = set()
    for call in facts.module.walk(ast.Call):
        given = [*call.args, *(word.value for word in call.keywords)]
        classes = {class_ for one in given if (class_ := facts.evaluator.self_class(one))}
        if classes:
            name = facts.module.qualified_name(call.func) or ""
            is_super = isinstance(call.func, ast.Attribute) and call.func.attr == "__init__"
            if not name.startswith(_KNOWN) and not is_super and name != "super":
                found |= classes
    return frozenset(found)


def _is_ready(facts: NodeFacts, call: ast.Call) -> bool:
    """Tell whether the code expects that the parameter may not be declared."""
    return is_harmless(facts.module, call, "ParameterNotDeclaredException")
