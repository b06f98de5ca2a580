"""The attributes that a node sets and reads on ``self``."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from collections.abc import Set as AbstractSet
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.rclpy.api import known_names
from scaffold.model.rclpy.evaluation.named_attributes import set_by_name
from scaffold.source import ViewError

_LIFECYCLE = "rclpy.lifecycle.node.LifecycleNode"

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.file import RclpyFile
    from scaffold.model.rclpy.nodes import NodeClass


def defined_by(node: NodeClass) -> set[str]:
    """Return the names defined by a class and its bases, in methods and on ``self``."""
    result: set[str] = set()
    owner: NodeClass | None = node
    if node.is_lifecycle:
        result.update(name.removesuffix("()") for name in known_names()[_LIFECYCLE])
    while owner is not None:
        result |= set(owner.file.module.index.bindings(owner.node))
        result |= set_by_name(owner.file) or set()
        for attribute in owner.file.module.below(owner.node, ast.Attribute):
            if isinstance(attribute.ctx, ast.Load):
                continue
            parent = owner.file.module.parent(attribute)
            if not isinstance(parent, ast.AugAssign):  # which needs an initial value
                result.add(attribute.attr)
        result |= {_mangled(name, owner.name) for name in result if _is_private(name)}
        owner = owner.base
    return result


def _is_private(name: str) -> bool:
    """Return whether Python adds the name of the class to an attribute."""
    return name.startswith("__") and not name.endswith("__")


def _mangled(name: str, class_: str) -> str:
    """Return the full name of a private attribute, by which other classes use it."""
    return f"_{class_.lstrip('_')}{name}"


def is_read_in_full(node: NodeClass) -> bool:
    """Return whether a class and its bases are fully known, and define no names at run time."""
    owner: NodeClass | None = node
    while owner is not None:
        bindings = owner.file.module.index.bindings(owner.node)
        if len(owner.node.bases) != 1 or owner.node.keywords or owner.node.decorator_list:
            return False
        if "__getattr__" in bindings or "__getattribute__" in bindings:
            return False
        if owner.file.module.mentions("__dict__", "vars(self") or set_by_name(owner.file) is None:
            return False
        owner = owner.base
    return True


def is_used_elsewhere(package: Package, file: RclpyFile, attribute: str) -> bool:
    """Return whether other modules of the workspace use an attribute set by a class of a file.

    A class that sets an attribute of the same name on ``self`` uses its own.
    """
    return any(
        _is_used_in(package, path, attribute)
        for path in package.python_files
        if path != file.module.path
    ) or any(
        _is_used_in(other, path, attribute)
        for other in package.workspace
        for path in (other.python_files if other.name != package.name else ())
    )


def _is_used_in(package: Package, path: str, attribute: str) -> bool:
    with suppress(ViewError):
        return _uses_of_another(package, path, attribute)
    return False


@fact
def _uses_of_another(package: Package, path: str, attribute: str) -> bool:
    """Return whether a file uses an attribute that none of its classes sets on ``self``."""
    if attribute.encode() not in package.data(path):  # most files need not be parsed
        return False
    nodes = package.module(path).index.attributes(attribute)
    is_own = any(not isinstance(node.ctx, ast.Load) for node in nodes) and all(
        isinstance(node.value, ast.Name) and node.value.id == "self" for node in nodes
    )
    return bool(nodes) and not is_own


@fact
def names_of_bases(package: Package) -> frozenset[str]:
    """Return the classes of the package with subclasses, which may define more."""
    return _of_all_files(package, _bases_in)


def is_base_elsewhere(package: Package, class_: str) -> bool:
    """Return whether another package of the workspace has subclasses of a class."""
    return any(
        class_ in names_of_bases(other) for other in package.workspace if other.name != package.name
    )


def is_overridden(package: Package, method: FunctionNode, class_: ast.ClassDef) -> bool:
    """Return whether a class is never instantiated, but has subclasses with this method."""
    if class_.name not in names_of_bases(package):
        return False
    overriding = f"{class_.name}.{method.name}" in _overridden_methods(package)
    return overriding and class_.name not in _classes_called(package)


def is_set_by_subclass(package: Package, class_: str, attributes: AbstractSet[str]) -> bool:
    """Return whether a subclass in the workspace sets one of the attributes on ``self``."""
    bases, pending = {class_}, [class_]
    while pending:
        base = pending.pop()
        below = {name for other in package.workspace for name in _of_subclasses(other, base)}
        if not below.isdisjoint(f".{name}" for name in attributes):
            return True
        pending += [name for name in below - bases if not name.startswith(".")]
        bases |= below
    return False


@fact
def _of_subclasses(package: Package, base: str) -> frozenset[str]:
    """Return the names of direct subclasses, and ``.name`` of each attribute that they set."""
    result: set[str] = set()
    for path in package.python_files:
        if base.encode() in package.data(path):  # most files need not be parsed
            with suppress(ViewError):
                result |= _of_subclasses_in(package, path, base)
    return frozenset(result)


@fact
def _of_subclasses_in(package: Package, path: str, base: str) -> frozenset[str]:
    module = package.module(path)
    return frozenset(
        name
        for class_ in module.walk(ast.ClassDef)
        if base in _base_names(class_)
        for name in (class_.name, *_set_on_self(module, class_))
    )


def _set_on_self(module: PythonModule, class_: ast.ClassDef) -> Iterator[str]:
    for node in module.below(class_, ast.Attribute):
        if isinstance(node.ctx, ast.Store) and module.text(node.value) == "self":
            yield f".{node.attr}"


@fact
def _overridden_methods(package: Package) -> frozenset[str]:
    return _of_all_files(package, _overridden_in)


@fact
def _overridden_in(package: Package, path: str) -> frozenset[str]:
    return frozenset(
        f"{base}.{method.name}"
        for class_ in package.module(path).walk(ast.ClassDef)
        for base in _base_names(class_)
        for method in class_.body
        if isinstance(method, ast.FunctionDef | ast.AsyncFunctionDef)
    )


@fact
def _classes_called(package: Package) -> frozenset[str]:
    return _of_all_files(package, _called_in)


@fact
def _called_in(package: Package, path: str) -> frozenset[str]:
    called = [call.func for call in package.module(path).walk(ast.Call)]
    names = {func.id for func in called if isinstance(func, ast.Name)}
    return frozenset(names | {func.attr for func in called if isinstance(func, ast.Attribute)})


@fact
def given_from_outside(package: Package) -> frozenset[str]:
    """Return the attributes that code of the package sets on objects other than ``self``."""
    return _of_all_files(package, _given_in)


def _of_all_files(
    package: Package, names: Callable[[Package, str], frozenset[str]]
) -> frozenset[str]:
    result: set[str] = set()
    for path in package.python_files:
        with suppress(ViewError):
            result |= names(package, path)
    return frozenset(result)


@fact
def _bases_in(package: Package, path: str) -> frozenset[str]:
    classes = package.module(path).walk(ast.ClassDef)
    return frozenset(name for class_ in classes for name in _base_names(class_))


def _base_names(class_: ast.ClassDef) -> Iterator[str]:
    for base in class_.bases:
        if isinstance(base, ast.Attribute | ast.Name):
            yield base.attr if isinstance(base, ast.Attribute) else base.id


@fact
def _given_in(package: Package, path: str) -> frozenset[str]:
    return frozenset(
        node.attr
        for node in package.module(path).walk(ast.Attribute)
        if type(node.ctx) is ast.Store
        and isinstance(node.value, ast.Name)
        and node.value.id != "self"
    )
