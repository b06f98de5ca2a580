"""The parameters that a node declares, and whether the list is complete."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.programs.known_nodes import KnownNode, known_nodes
from scaffold.model.python.evaluation.values import UNKNOWN
from scaffold.model.rclpy.evaluation.attributes import is_used_elsewhere
from scaffold.model.rclpy.file import rclpy_file
from scaffold.model.rclpy.files import rclpy_files, rclpy_paths
from scaffold.model.rclpy.nodes import NodeClass, NodeDefinition
from scaffold.model.rclpy.parameters.descriptors import Descriptor
from scaffold.model.rclpy.parameters.divisors import divisors
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import Location

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.rclpy.entities import Parameter
    from scaffold.model.rclpy.file import RclpyFile

ALWAYS = frozenset({"use_sim_time", "start_type_description_service"})
"""Parameters that every node has."""
_ALWAYS_PREFIXES = ("qos_overrides.",)
_HARMLESS = ("rclpy.", "tf2_ros.", "message_filters.", "super", "isinstance", "print", "str", "id")
_KNOWN = ("rclpy.", "tf2_ros.", "message_filters.", "cv_bridge.")
"""Packages whose classes receive a node but declare no parameters."""
_COMPILED = (".cpp", ".cc", ".cxx", ".c", ".rs")


class DeclaredParameter(NamedTuple):
    """A parameter declared by a node, for use by other files."""

    package: str
    """The name of the package with the code."""
    location: Location
    default: object
    """The default; ``UNKNOWN`` also if none is given, or it is no parameter value."""
    descriptor: Descriptor | None
    """``None`` if its value is unknown."""
    divides: bool
    """Whether the node divides by its value without a check."""


class Declared(NamedTuple):
    """The parameters of a node."""

    types: Mapping[str, str | None]
    """The type by name; ``None`` if it is unknown, or may change."""
    places: Mapping[str, DeclaredParameter]
    complete: bool
    """Whether no others can be declared."""

    def has(self, name: str) -> bool:
        """Return whether a parameter exists."""
        return name in self.types or has_always(name)


def has_always(name: str) -> bool:
    """Return whether rclpy declares a parameter on every node."""
    return name in ALWAYS or name.startswith(_ALWAYS_PREFIXES)


def declared_by(owner: NodeDefinition | KnownNode, package: Package) -> Declared:
    """Return the parameters of a node: of its class, base classes, and the code that creates it."""
    if isinstance(owner, KnownNode):
        return _declared_at(owner.home(package), owner.path, owner.number)
    owner_package = home_of(owner, package)
    number = next(at for at, node in enumerate(owner.file.nodes) if node is owner)
    return _declared_at(owner_package, owner.file.module.path, number)


@fact
def _declared_at(package: Package, path: str, number: int) -> Declared:
    owner = rclpy_file(package, path).nodes[number]
    types: dict[str, str | None] = {}
    places: dict[str, DeclaredParameter] = {}
    complete = True
    current: NodeDefinition | None = owner
    redefined: set[str] = set()
    while current is not None:
        divide = divisors(current.file)
        is_dynamic = current.file.module.mentions("dynamic_typing", "set_descriptor(")
        for parameter in (*current.parameters, *_from_outside(current, package)):
            name = parameter.name
            is_known = isinstance(name, str) and not _names_any(parameter, redefined)
            if not isinstance(name, str) or not is_known or parameter.has_unknown_arguments:
                complete = False
                continue
            kind = _fixed_type(parameter, may_be_dynamic=is_dynamic)
            types[name] = kind if name not in types or types[name] == kind else None
            if name not in places:
                places[name] = _place(parameter, package, divides=name in divide)
        complete = complete and not current.declares_automatically and not escapes(current, package)
        complete = complete and all(item.owner is not None for item in current.file.parameters)
        complete = complete and not (isinstance(current, NodeClass) and current.is_made_later)
        redefined.update(_class_names(current))
        current = current.base if isinstance(current, NodeClass) else None
    return Declared(types, places, complete)


def _place(parameter: Parameter, package: Package, *, divides: bool) -> DeclaredParameter:
    default = parameter.default
    is_plain = isinstance(default, str | int | float) or default == []
    return DeclaredParameter(
        package.name,
        parameter.location,
        default if is_plain else UNKNOWN,
        parameter.descriptor,
        divides,
    )


def home_of(owner: NodeDefinition, package: Package) -> Package:
    """Return the package with the code of a node, which may be another one."""
    from scaffold.model.package import Package as _Package  # which re-exports the name

    modules = owner.file.modules
    return modules if isinstance(modules, _Package) else package


def place_of(name: str, at: Location, package: Package) -> str:
    """Return where a parameter is declared or read, for messages about a package.

    Args:
        name: The package that the code is in.
        at: The location.
        package: The package of the message.
    """
    return f"{at.path}:{at.line}" + (f" of {name}" if name != package.name else "")


def declared_alone(file: RclpyFile) -> Iterator[tuple[NodeClass, list[Parameter]]]:
    """Yield the nodes with all their parameters declared in their own file.

    Unlike `declared_by`, it skips nodes with subclasses.
    """
    passed_on: dict[RclpyFile, frozenset[ast.ClassDef]] = {}
    bases = _bases(file)
    for node in file.classes:
        declared = None if node.node in bases else _declared(node, passed_on)
        if declared is not None:
            yield node, declared


def _declared(
    node: NodeClass, passed_on: dict[RclpyFile, frozenset[ast.ClassDef]]
) -> list[Parameter] | None:
    """Return the parameters of a class and its bases; ``None`` if others may declare more.

    The results of `_passed_on` for their files are cached.
    """
    parameters: list[Parameter] = []
    redefined: set[str] = set()
    owner: NodeClass | None = node
    while owner is not None:
        if owner.declares_automatically or owner.is_lifecycle or len(owner.node.bases) != 1:
            return None
        if any(
            not isinstance(parameter.name, str) or _names_any(parameter, redefined)
            for parameter in owner.parameters
        ):
            return None
        if owner.file not in passed_on:
            passed_on[owner.file] = _passed_on(owner.file)
        if owner.node in passed_on[owner.file]:
            return None
        parameters += owner.parameters
        redefined.update(_class_names(owner))
        owner = owner.base
    return None if _declares_on_others(node.file) else parameters


def _class_names(node: NodeDefinition) -> Iterable[str]:
    """Return the names that a class defines, which may replace those of its bases."""
    return node.file.module.index.bindings(node.node) if isinstance(node, NodeClass) else ()


def _names_any(parameter: Parameter, names: set[str]) -> bool:
    """Return whether a declaration is computed of an attribute that a derived class defines."""
    arguments = parameter.call.args if names else ()
    return any(
        isinstance(node, ast.Attribute) and node.attr in names
        for argument in arguments
        for node in ast.walk(argument)
    )


def _bases(file: RclpyFile) -> frozenset[ast.ClassDef | None]:
    """Return the classes of a file with subclasses there."""
    return frozenset(
        file.evaluator.named_class(base)
        for other in file.module.walk(ast.ClassDef)
        for base in other.bases
    )


def _declares_on_others(file: RclpyFile) -> bool:
    """Return whether the file declares parameters on an unknown object."""
    return any(parameter.owner is None for parameter in file.parameters)


def _passed_on(file: RclpyFile) -> frozenset[ast.ClassDef]:
    """Return the classes that pass ``self`` to code that may declare parameters.

    All of them if the file reads attributes of nodes by name.
    """
    if "has_parameter" in file.module.source.text:
        return frozenset(file.module.walk(ast.ClassDef))
    receivers: set[ast.ClassDef] = set()
    for call in file.module.walk(ast.Call):
        given = [*call.args, *(word.value for word in call.keywords)]
        names = [item for item in given if isinstance(item, ast.Name)]
        classes = {class_ for item in names if (class_ := file.evaluator.self_class(item))}
        if classes:
            name = file.module.qualified_name(call.func) or ""
            is_super = isinstance(call.func, ast.Attribute) and call.func.attr == "__init__"
            if not name.startswith(_KNOWN) and not is_super and name != "super":
                receivers |= classes
    return frozenset(receivers)


def _from_outside(owner: NodeDefinition, package: Package) -> Iterator[Parameter]:
    """Yield parameters declared by other files: ``node = Talker(); node.declare_parameter()``."""
    if isinstance(owner, NodeClass):
        for file in rclpy_files(package, mentioning=("declare_parameter", owner.name)):
            if file is not owner.file:
                yield from (parameter for parameter in file.parameters if parameter.owner is owner)


@remembered
def own_nodes(package: Package) -> tuple[list[KnownNode], bool]:
    """Return the nodes in the Python code of a package, and whether there are no others."""
    result = [node for path in rclpy_paths(package) for node in known_nodes(package, path)]
    compiled = any(
        path.endswith(_COMPILED) and not path.startswith("test") for path in package.files
    )
    return result, not compiled and all(isinstance(node.node_name, str) for node in result)


def _fixed_type(parameter: Parameter, *, may_be_dynamic: bool) -> str | None:
    """Return the type that overrides must have; for an empty list it is unexpected.

    Args:
        parameter: The parameter.
        may_be_dynamic: Whether an unknown descriptor may allow any type.
    """
    descriptor = parameter.descriptor
    if descriptor.is_dynamic if descriptor is not None else may_be_dynamic:
        return None
    if "ignore_override" in parameter.arguments or parameter.type in {"byte_array", "not_set"}:
        return None
    return parameter.type


def escapes(owner: NodeDefinition, package: Package) -> bool:
    """Return whether the node is passed to code, or used by files, that may declare more."""
    index = owner.file.module.index
    if isinstance(owner, NodeClass):
        others = owner.node.bases[: owner.base_index] + owner.node.bases[owner.base_index + 1 :]
        return bool(others) or _is_handed_on(owner, owner.node, "self", index.names("self"))
    kept = [use for use in index.attributes(owner.name) if isinstance(use.ctx, ast.Load)]
    uses = [*index.names(owner.name), *kept]
    return _is_handed_on(owner, owner.file.module.tree, owner.name, uses) or (
        bool(kept) and is_used_elsewhere(home_of(owner, package), owner.file, owner.name)
    )


def _is_handed_on(
    owner: NodeDefinition, scope: ast.AST, name: str, uses: Iterable[ast.expr]
) -> bool:
    module = owner.file.module
    for use in uses:
        parent = module.parent(use)
        if _is_kept_elsewhere(parent, name) and module.is_inside(use, scope):
            return True
        call = module.parent(parent) if isinstance(parent, ast.keyword) else parent
        if not isinstance(call, ast.Call) or use is call.func:
            continue
        names = module.qualified_names(call.func)
        is_harmless = bool(names) and all(candidate.startswith(_HARMLESS) for candidate in names)
        if not is_harmless and not _is_base_init(call) and module.is_inside(call, scope):
            return True
    return False


def _is_kept_elsewhere(parent: ast.AST | None, name: str) -> bool:
    """Return whether a statement stores a node in another object: ``part.node = self``."""
    return isinstance(parent, ast.Assign) and any(
        isinstance(target, ast.Attribute | ast.Subscript)
        and not (isinstance(target.value, ast.Name) and target.value.id == name)
        for target in parent.targets
    )


def _is_base_init(call: ast.Call) -> bool:
    return isinstance(call.func, ast.Attribute) and call.func.attr in {"__init__", "add_node"}
