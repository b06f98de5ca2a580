"""Which parameters a node declares, and whether these are surely all."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from scaffold.model.node_owners import NodeClass, NodeOwner
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.node_entities import Parameter
    from scaffold.model.package import Package

ALWAYS = frozenset({"use_sim_time", "start_type_description_service"})
"""Parameters that every node has."""
_ALWAYS_PREFIXES = ("qos_overrides.",)
_HARMLESS = ("rclpy.", "tf2_ros.", "message_filters.", "super", "isinstance", "print", "str", "id")
_COMPILED = (".cpp", ".cc", ".cxx", ".c", ".rs")


class Declared(NamedTuple):
    """The parameters of a node."""

    types: dict[str, str | None]
    """The type by name; ``None`` where it is not known, or may change."""
    places: dict[str, Parameter]
    complete: bool
    """Whether nothing else can be declared."""

    def has(self, name: str) -> bool:
        """Tell whether a parameter exists."""
        return name in self.types or name in ALWAYS or name.startswith(_ALWAYS_PREFIXES)


def declared_by(owner: NodeOwner, package: Package) -> Declared:
    """Return what a node declares: in its class, in base classes, and where it is made."""
    types: dict[str, str | None] = {}
    places: dict[str, Parameter] = {}
    complete = True
    current: NodeOwner | None = owner
    while current is not None:
        is_dynamic = "dynamic_typing" in current.facts.module.source.text
        for parameter in (*current.parameters, *_from_outside(package).get(current, ())):
            name = parameter.name
            if not isinstance(name, str) or parameter.has_unknown_arguments:
                complete = False
                continue
            kind = None if is_dynamic else _fixed_type(parameter)
            types[name] = kind if name not in types or types[name] == kind else None
            places.setdefault(name, parameter)
        complete = complete and not current.declares_automatically and not _escapes(current)
        complete = complete and all(item.owner is not None for item in current.facts.parameters)
        complete = complete and not (isinstance(current, NodeClass) and current.is_made_later)
        current = current.base if isinstance(current, NodeClass) else None
    return Declared(types, places, complete)


def _from_outside(package: Package) -> dict[NodeOwner, list[Parameter]]:
    """Return what other files declare on nodes: ``node = Talker(); node.declare_parameter()``."""

    def find() -> dict[NodeOwner, list[Parameter]]:
        found: dict[NodeOwner, list[Parameter]] = {}
        for facts in package.rclpy_files():
            for parameter in facts.parameters:
                owner = parameter.owner
                if owner is not None and owner.facts is not facts:
                    found.setdefault(owner, []).append(parameter)
        return found

    return package.remember("parameters_from_outside", find)


def own_nodes(package: Package) -> tuple[list[NodeOwner], bool]:
    """Return the nodes in the Python code of a package, and whether there are no others."""

    def find() -> tuple[list[NodeOwner], bool]:
        found = [node for facts in package.rclpy_files() for node in facts.nodes]
        compiled = any(
            path.endswith(_COMPILED) and not path.startswith("test") for path in package.files
        )
        return found, not compiled and all(isinstance(node.node_name, str) for node in found)

    return package.remember("own_nodes", find)


def _fixed_type(parameter: Parameter) -> str | None:
    """Return the type that overrides must have; an empty list has none that anyone expects."""
    if "ignore_override" in parameter.arguments or parameter.type in {"byte_array", "not_set"}:
        return None
    return parameter.type


def _escapes(owner: NodeOwner) -> bool:
    """Tell whether the node is handed to code that may declare more."""
    if not isinstance(owner, NodeClass):
        return _is_handed_on(owner, owner.facts.module.tree, owner.name)
    others = owner.node.bases[: owner.base_index] + owner.node.bases[owner.base_index + 1 :]
    return bool(others) or _is_handed_on(owner, owner.node, "self")


def _is_handed_on(owner: NodeOwner, scope: ast.AST, name: str) -> bool:
    module = owner.facts.module
    for call in ast.walk(scope):
        if not isinstance(call, ast.Call):
            continue
        values = [*call.args, *(word.value for word in call.keywords)]
        if not any(isinstance(value, ast.Name) and value.id == name for value in values):
            continue
        names = module.qualified_names(call.func)
        if not names or not all(one.startswith(_HARMLESS) for one in names):
            return not _is_base_init(call)
    return False


def _is_base_init(call: ast.Call) -> bool:
    return isinstance(call.func, ast.Attribute) and call.func.attr in {"__init__", "add_node"}
