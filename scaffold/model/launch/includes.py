"""The launch files that a launch file includes, with given and required arguments."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from scaffold.model.launch.calls import LaunchCall
from scaffold.model.launch.evaluation.configurations import set_names
from scaffold.model.launch.evaluation.evaluator import share_path
from scaffold.model.launch.python_file import LaunchFile
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

Given = tuple[str, ast.expr, ast.expr]
"""Name, its location, and the value of an argument."""


class Included(NamedTuple):
    """A Python launch file of the same package that is included."""

    path: str
    names: frozenset[str]
    """The names that it declares, reads or sets."""
    required: frozenset[str]
    """The arguments that it declares without a default."""
    is_open: bool
    """Whether it may accept other names: it includes files, or has foreign actions."""


def given_arguments(launch: LaunchFile, call: LaunchCall) -> list[Given] | None:
    """Return the arguments of an include; ``None`` if not fully known."""
    node = call.given.get("launch_arguments")
    if node is None:
        return None if call.is_open else []
    pairs: list[tuple[ast.expr | None, ast.expr]] = []
    if isinstance(node, ast.Name):
        node = _read_once(launch, node) or node
    match node:
        case ast.Call(func=ast.Attribute(value=holder, attr="items")):
            literal = _dictionary(launch, holder)
            if literal is None:
                return None
            pairs = list(zip(literal.keys, literal.values, strict=True))
        case ast.List() | ast.Tuple():
            for item in node.elts:
                if not isinstance(item, ast.Tuple | ast.List) or len(item.elts) != 2:  # noqa: PLR2004  name and value
                    return None
                pairs.append((item.elts[0], item.elts[1]))
        case _:
            return None
    givens: list[Given] = []
    for key, value in pairs:
        name = launch.evaluator.joined_text(key)
        if key is None or not isinstance(name, str):
            return None
        givens.append((name, key, value))
    return givens


def _dictionary(launch: LaunchFile, node: ast.expr) -> ast.Dict | None:
    """Return the dictionary of an expression, or of a name that is read once."""
    literal = _read_once(launch, node) if isinstance(node, ast.Name) else node
    return literal if isinstance(literal, ast.Dict) else None


def _read_once(launch: LaunchFile, name: ast.Name) -> ast.expr | None:
    """Return the value of a name that is read only once, so that it is not changed."""
    uses = [use for use in launch.module.index.names(name.id) if isinstance(use.ctx, ast.Load)]
    return launch.module.index.only_value(name) if len(uses) == 1 else None


def included(package: Package, launch: LaunchFile, call: LaunchCall) -> Included | None:
    """Return the included file, if it is a Python launch file of the same package."""
    source = call.given.get("launch_description_source")
    inner = launch.call_of(source)
    is_source = inner is not None and inner.kind.endswith("Source")
    argument = next(iter(inner.given.values()), None) if inner and is_source else source
    path = share_path(launch.evaluator.joined_text(argument))
    if path is None or path[0] != package.name or not path[1].endswith(".py"):
        return None
    try:
        other = LaunchFile.of(package, path[1])
    except ViewError:
        return None
    if other.function is None:
        return None
    names, required = set(other.declared), set[str]()
    for declared in other.find("DeclareLaunchArgument"):
        name = other.text(declared, "name")
        is_plain = not declared.is_open and not _is_conditional(other, declared)
        if isinstance(name, str) and "default_value" not in declared.given and is_plain:
            required.add(name)
    is_open = set_names(package, other) is None or bool(other.find("IncludeLaunchDescription"))
    for read in other.find("LaunchConfiguration", "SetLaunchConfiguration"):
        text = next((other.evaluator.joined_text(item) for item in read.given.values()), None)
        is_open = is_open or not isinstance(text, str)
        names.add(str(text))
    return Included(other.path, frozenset(names), frozenset(required), is_open)


def _is_conditional(launch: LaunchFile, call: LaunchCall) -> bool:
    """Return whether an argument may be undeclared: under a condition, or in a group."""
    if "condition" in call.given or launch.is_optional(call.call):
        return True
    parents = [
        parent for parent in launch.module.parents(call.call) if isinstance(parent, ast.Call)
    ]
    result = [launch.call_of(parent) for parent in parents]
    return any(item is not None and item.kind == "GroupAction" for item in result)
