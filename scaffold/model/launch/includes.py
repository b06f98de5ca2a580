"""The launch files that a launch file includes, with given and required arguments."""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.model.install.share import share_of
from scaffold.model.launch.calls import LaunchCall
from scaffold.model.launch.evaluation.cases import Case, key_of
from scaffold.model.launch.evaluation.configurations import set_names
from scaffold.model.launch.evaluation.evaluator import share_path
from scaffold.model.launch.markup_file import MarkupFile, markup_files
from scaffold.model.launch.python_file import LaunchFile
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

Given = tuple[str, ast.expr, ast.expr]
"""Name, its location, and the value of an argument."""


class Included(NamedTuple):
    """A launch file of the workspace that is included."""

    package: str
    path: str
    names: frozenset[str]
    """The names that it declares, reads or sets."""
    required: frozenset[str]
    """The arguments that it declares without a default."""
    is_open: bool
    """Whether it may accept other names: it includes files, or has foreign actions."""
    choices: Mapping[str, Sequence[str]]
    """The values that an argument may have, if they are limited."""


def given_arguments(
    launch: LaunchFile, call: LaunchCall, case: Case | None = None
) -> list[Given] | None:
    """Return the arguments of an include; ``None`` if not fully known.

    Args:
        launch: The launch file.
        call: The include.
        case: The call of the function around it, whose ``**arguments`` it may pass on.
    """
    node = call.given.get("launch_arguments")
    if node is None:
        return None if call.is_open else []
    if isinstance(node, ast.Name):
        node = _read_once(launch, node) or node
    passed = _passed_on(launch, node, case) if case is not None else None
    if passed is not None:
        return passed
    pairs = _pairs(launch, node)
    givens: list[Given] = []
    for key, value in pairs or ():
        name = launch.evaluator.joined_text(key)
        if key is None or not isinstance(name, str):
            return None
        givens.append((name, key, value))
    return None if pairs is None else givens


def _pairs(launch: LaunchFile, node: ast.expr) -> list[tuple[ast.expr | None, ast.expr]] | None:
    """Return the names and values in a list of pairs or the items of a dictionary, if known."""
    pairs: list[tuple[ast.expr | None, ast.expr]] = []
    match node:
        case ast.Call(func=ast.Attribute(value=holder, attr="items")):
            literal = _dictionary(launch, holder)
            return None if literal is None else [*zip(literal.keys, literal.values, strict=True)]
        case ast.List() | ast.Tuple():
            for item in node.elts:
                if not isinstance(item, ast.Tuple | ast.List) or len(item.elts) != 2:  # noqa: PLR2004  name and value
                    return None
                pairs.append((item.elts[0], item.elts[1]))
            return pairs
    return None


def _dictionary(launch: LaunchFile, node: ast.expr) -> ast.Dict | None:
    """Return the dictionary of an expression, or of a name that is read once."""
    literal = _read_once(launch, node) if isinstance(node, ast.Name) else node
    return literal if isinstance(literal, ast.Dict) else None


def _read_once(launch: LaunchFile, name: ast.Name) -> ast.expr | None:
    """Return the value of a name that is read only once, so that it is not changed."""
    uses = [use for use in launch.module.index.names(name.id) if isinstance(use.ctx, ast.Load)]
    return launch.module.index.only_value(name) if len(uses) == 1 else None


def _passed_on(launch: LaunchFile, node: ast.expr, case: Case) -> list[Given] | None:
    """Return the arguments that a function gets as ``**arguments`` and passes on."""
    match node:
        case ast.Call(func=ast.Attribute(value=ast.Name() as holder, attr="items")):
            key = key_of(launch.module, holder)
        case _:
            return None
    values = case.values.get(key) if key is not None else None
    call = case.places.get(key) if key is not None else None
    if not isinstance(values, dict) or not isinstance(call, ast.Call):
        return None
    words = [word for word in call.keywords if word.arg in values]
    return [(str(word.arg), word.value, word.value) for word in words]


def included(package: Package, launch: LaunchFile, call: LaunchCall) -> Included | None:
    """Return the included file, if it is a launch file of the workspace."""
    source = call.given.get("launch_description_source")
    inner = launch.call_of(source)
    is_source = inner is not None and inner.kind.endswith("Source")
    argument = next(iter(inner.given.values()), None) if inner and is_source else source
    path = share_path(launch.evaluator.joined_text(argument))
    return included_at(package, *path) if path is not None else None


def included_at(package: Package, name: str, path: str) -> Included | None:
    """Return a launch file by its package and the path below its share directory."""
    owner = package if name == package.name else package.workspace.get(name)
    if owner is None:
        return None
    source = path if owner is package else share_of(owner).files.get(path, path)
    if source.endswith(".py"):
        with suppress(ViewError):
            return _in_python(owner, source)
        return None
    files = [file for file in markup_files(owner) if file.path == source]
    return _in_markup(owner, files[0]) if files else None


def _in_markup(owner: Package, file: MarkupFile) -> Included:
    declared = [item for item in file.elements if item.tag in {"arg", "let"}]
    names = {item.attributes["name"].value for item in declared if "name" in item.attributes}
    for attribute in file.attributes:
        names.update(re.findall(r"\$\(var ([\w-]+)", attribute.value))
    is_open = any(item.tag == "include" for item in file.elements)
    return Included(owner.name, file.path, frozenset(names), frozenset(), is_open, {})


def _in_python(owner: Package, path: str) -> Included | None:
    """Return a launch file in Python; raises ViewError."""
    other = LaunchFile.of(owner, path)
    if other.function is None:
        return None
    names, required = set(other.declared), set[str]()
    choices: dict[str, Sequence[str]] = {}
    for declared in other.find("DeclareLaunchArgument"):
        name = other.text(declared, "name")
        is_plain = not declared.is_open and not _is_conditional(other, declared)
        if isinstance(name, str) and "default_value" not in declared.given and is_plain:
            required.add(name)
        allowed = other.evaluator.evaluate(declared.given.get("choices"))
        if isinstance(name, str) and isinstance(allowed, list | tuple) and is_plain:
            texts = [item for item in allowed if isinstance(item, str)]
            choices |= {name: texts} if len(texts) == len(allowed) else {}
    is_open = set_names(owner, other) is None or bool(other.find("IncludeLaunchDescription"))
    is_open = is_open or other.module.mentions("launch_configurations")
    for read in other.find("LaunchConfiguration", "SetLaunchConfiguration"):
        text = next((other.evaluator.joined_text(item) for item in read.given.values()), None)
        is_open = is_open or not isinstance(text, str)
        names.add(str(text))
    return Included(owner.name, path, frozenset(names), frozenset(required), is_open, choices)


def _is_conditional(launch: LaunchFile, call: LaunchCall) -> bool:
    """Return whether an argument may be undeclared: under a condition, or in a group."""
    if "condition" in call.given or launch.is_optional(call.call):
        return True
    parents = [
        parent for parent in launch.module.parents(call.call) if isinstance(parent, ast.Call)
    ]
    result = [launch.call_of(parent) for parent in parents]
    return any(item is not None and item.kind == "GroupAction" for item in result)
