"""Facts about Python modules for other files: their imports and definitions."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.python.module import MODULE_ATTRIBUTES
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.imports import Import
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.source import Location

_LOOKUPS = ("get_depends", "get_manifest", "get_path")
"""Methods of ``rospkg.RosPack``."""


class Exports(NamedTuple):
    """The names that other modules may import."""

    names: frozenset[str]
    doubtful: frozenset[str]
    """Names that may be deleted."""
    is_open: bool
    """Whether there may be more: a star import, a module ``__getattr__``, ``globals()``."""
    functions: tuple[str, ...]
    coroutines: tuple[str, ...]
    """The ``async`` functions without decorators."""
    classes: tuple[str, ...]

    def defines(self, name: str) -> bool | None:
        """Return whether an attribute of this name exists; ``None`` if unknown."""
        if name in self.names:
            return True
        return None if self.is_open or name in self.doubtful else False


@fact
def imports_of(package: Package, path: str) -> tuple[Import, ...]:
    """Return all imports of a Python file, in the order of the text; raises ViewError."""
    return tuple(package.module(path).imports)


@fact
def exports_of(package: Package, path: str) -> Exports:
    """Return the names that can be imported from a Python file; raises ViewError."""
    module = package.module(path)
    names = {*module.index.bindings(module.tree), *MODULE_ATTRIBUTES}
    return Exports(
        frozenset(name for name in names if module.defines(name) is True),
        frozenset(name for name in names if module.defines(name) is None),
        module.defines("") is None,
        (*module.functions,),
        tuple(name for name, function in module.functions.items() if _is_coroutine(function.node)),
        (*module.classes,),
    )


def _is_coroutine(function: FunctionNode) -> bool:
    return isinstance(function, ast.AsyncFunctionDef) and not function.decorator_list


def imports_by_path(package: Package) -> Iterator[tuple[str, tuple[Import, ...]]]:
    """Yield the Python files that can be parsed, each with its imports."""
    for path in package.python_files:
        with suppress(ViewError):
            yield path, imports_of(package, path)


def paths_importing(package: Package, *roots: str) -> Iterator[str]:
    """Yield the Python files that import one of some top-level packages."""
    for path in package.python_files:
        with suppress(ViewError):
            if not package.imports(path).isdisjoint(roots):
                yield path


@fact
def rospack_lookups(package: Package, path: str) -> tuple[Location, ...]:
    """Return the places where a ROS 2 node uses ``ROS_PACKAGE_PATH``.

    rospkg can be installed next to ROS 2, but only ROS 1 sets that variable.
    """
    roots = package.imports(path)
    if "rospkg" not in roots or "rclpy" not in roots:
        return ()
    module = package.module(path)
    return tuple(module.location(call) for call, _ in module.method_calls(*_LOOKUPS))
