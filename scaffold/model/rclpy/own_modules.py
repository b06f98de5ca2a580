"""The other modules of the package that a file with rclpy code imports from."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from typing import Protocol, TypeVar

from scaffold.model import reads
from scaffold.model.package import Package
from scaffold.model.python.evaluation.values import UNKNOWN
from scaffold.model.python.module import PythonModule
from scaffold.model.rclpy.evaluation.constants import constants_of
from scaffold.source import ViewError

View = TypeVar("View")


class Modules(Protocol):
    """A source of the other modules of a package, such as a ``Package``."""

    def has(self, path: str) -> bool:
        """Return whether a file exists."""

    def module(self, path: str) -> PythonModule:
        """Return a parsed Python file; raises ViewError."""

    def remember(self, key: object, build: Callable[[], View]) -> View:
        """Return the result of ``build``, which is called once per key."""


class OwnModules:
    """Finds the modules of a package that a file names.

    Args:
        module: The file.
        modules: The package; ``None`` for a file alone.
    """

    def __init__(self, module: PythonModule, modules: Modules | None) -> None:
        self._path = module.path
        self._modules = modules
        self._reads = reads.current()

    def paths_of(self, module: str) -> Iterator[str]:
        """Yield the other files of the package that a dotted name may be the module of."""
        modules = self._modules
        for path in _paths(self._path, module) if modules is not None and module else ():
            if path != self._path and modules is not None and modules.has(path):
                yield path

    def is_of_neighbor(self, module: str) -> bool:
        """Return whether a dotted name is a module of another package of the workspace."""
        root = module.partition(".")[0]
        if not isinstance(self._modules, Package) or root == self._modules.name:
            return False
        with reads.recorded(self._reads):
            neighbor = self._modules.workspace.get(root)
            return neighbor is not None and neighbor.has(f"{module.replace('.', '/')}.py")

    def constant(self, name: str) -> object:
        """Return the value of a dotted name if it is a constant of another module."""
        module, _, names = name.rpartition(".")
        while module.strip(".") and isinstance(self._modules, Package):
            for path in self.paths_of(module):
                with reads.recorded(self._reads), suppress(ViewError):
                    return constants_of(self._modules, path).get(names, UNKNOWN)
            module, _, last = module.rpartition(".")
            names = f"{last}.{names}"
        return UNKNOWN


def _paths(path: str, module: str) -> Iterator[str]:
    """Yield the files that a module seen from a file may be in."""
    directory = path.rpartition("/")[0]
    if module.startswith("."):
        name = module.lstrip(".")
        for _ in range(len(module) - len(name) - 1):
            directory = directory.rpartition("/")[0]
        bases = [directory]
    else:
        name = module
        bases = ["", "src", directory]
    for base in dict.fromkeys(bases):
        stem = "/".join(part for part in (base, *name.split(".")) if part)
        yield f"{stem}.py"
        yield f"{stem}/__init__.py"
