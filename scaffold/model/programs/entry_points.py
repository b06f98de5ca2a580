"""The entry points of the Python programs of a package, and the nodes they create."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.model.contents.python_facts import imports_of
from scaffold.model.facts import fact
from scaffold.model.install.configured_scripts import configured_scripts, installs_configured
from scaffold.model.rclpy.file import rclpy_file
from scaffold.model.remembered import remembered, remembered_list
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.scopes import FunctionNode
    from scaffold.model.rclpy.file import RclpyFile
    from scaffold.model.rclpy.nodes import NodeDefinition

_MAX_FILES = 200


class EntryPoint(NamedTuple):
    """The entry point of a program of a package."""

    program: str
    path: str
    function: str | None
    """The entry function; without one, the file is run as a script."""


class Execution(NamedTuple):
    """The code of its own file that a program executes."""

    file: RclpyFile
    functions: Sequence[FunctionNode]
    """The functions reached from the entry."""
    calls: Sequence[ast.Call]
    """The calls in them; for a script, its own calls first."""

    def nodes(self) -> Iterator[tuple[ast.Call, NodeDefinition]]:
        """Yield the nodes that are certainly created, with the calls."""
        for call in self.calls:
            owner = None if self.file.is_conditional(call) else self.file.owner_of(call)
            if owner is not None:
                yield call, owner


@remembered_list
def entry_points_of(package: Package) -> Iterator[EntryPoint]:
    """Return the entry points of Python programs."""
    try:
        if package.build_type == "ament_python":
            yield from _console_scripts(package)
        elif package.build_type == "ament_cmake":
            yield from _programs(package)
        if installs_configured(package):
            yield from _configured(package)
    except ViewError:
        return


def execution_of(package: Package, path: str, function: str | None) -> Execution:
    """Return the code that a program executes; raises ViewError if it cannot be parsed."""
    return package.remember(("program_run", path, function), lambda: _run(package, path, function))


def imported_files(package: Package, path: str) -> Sequence[RclpyFile]:
    """Return a file and the files of its package that it imports; see `imported_paths`."""
    return [rclpy_file(package, other) for other in imported_paths(package, path)]


@remembered
def imported_paths(package: Package, path: str) -> list[str]:
    """Return the paths of a file and of its transitive imports in its package.

    The ``__init__.py`` of the packages around them are imported along with them.
    """
    result: list[str] = []
    pending = [path]
    while pending and len(result) < _MAX_FILES:
        current = pending.pop()
        if current in result or not package.has(current):
            continue
        with suppress(ViewError):
            pending += [*_imported(package, current)]
            result.append(current)
    return result


# -- entry points


def _configured(package: Package) -> Iterator[EntryPoint]:
    for script in configured_scripts(package):
        path = _file_of(package, script.module)
        if path is not None:
            yield EntryPoint(script.name, path, script.function)


def _console_scripts(package: Package) -> Iterator[EntryPoint]:
    for entry in package.setup_py.console_scripts:
        path = _file_of(package, entry.module)
        if path is not None and not entry.malformed:
            yield EntryPoint(entry.name, path, entry.function)


def _file_of(package: Package, module: str) -> str | None:
    stem = module.replace(".", "/")
    paths = (f"{top}{stem}{end}" for top in ("", "src/") for end in (".py", "/__init__.py"))
    return next((path for path in paths if package.has(path)), None)


def _programs(package: Package) -> Iterator[EntryPoint]:
    for install in package.cmake.installs:
        if install.kind != "PROGRAMS" or package.cmake.guarded_by_testing(install.command):
            continue
        for item in install.items:
            path = item.path
            if path is None or path not in package.python_files:
                continue
            # A node is intended for `ros2 run` wherever it is installed.
            if install.destination == f"lib/{package.name}" or _makes_nodes(package, path):
                yield EntryPoint(install.rename or path.rpartition("/")[2], path, None)


@fact
def _makes_nodes(package: Package, path: str) -> bool:
    return bool(rclpy_file(package, path).nodes)


# -- executed code


def _run(package: Package, path: str, entry: str | None) -> Execution:
    file = rclpy_file(package, path)
    outside = _calls_outside(file) if entry is None else []
    functions = _functions(file, entry, outside)
    calls = [call for function in functions for call in file.calls_in(function)]
    return Execution(file, functions, [*outside, *calls])


def _functions(
    file: RclpyFile, entry: str | None, outside: Iterable[ast.Call]
) -> list[FunctionNode]:
    """Return the functions of the file that are reached from the entry."""
    if entry is not None:
        function = file.module.functions.get(entry)
        begin = [function.node] if function else []
    else:
        called = [file.callback(call.func).function for call in outside]
        begin = [item for item in called if item is not None and not isinstance(item, ast.Lambda)]
    reached: dict[FunctionNode | ast.Lambda, None] = {}
    for node in begin:
        reached.update(dict.fromkeys(file.reached(node, reached)))
    return [item for item in reached if not isinstance(item, ast.Lambda)]


def _calls_outside(file: RclpyFile) -> list[ast.Call]:
    """Return the calls at module level, made by importing or running the file."""
    module = file.module
    return [
        call
        for call in module.walk(ast.Call)
        if module.enclosing_function(call) is None and module.enclosing_class(call) is None
    ]


# -- files of the package


def _imported(package: Package, path: str) -> Iterator[str]:
    """Yield the files that the imports of a file may refer to."""
    directory = path.rpartition("/")[0]
    yield f"{directory}/__init__.py"
    for item in imports_of(package, path):
        bases = ["", "src", directory]
        if item.level:
            parts = directory.split("/") if directory else []
            bases = ["/".join(parts[: len(parts) - item.level + 1])]
        names = item.module.strip(".").split(".") if item.module.strip(".") else []
        for base in dict.fromkeys(bases):
            at = [part for part in base.split("/") if part]
            for name in names:
                at.append(name)
                yield "/".join([*at, "__init__.py"])
            yield "/".join(at) + ".py"
            for imported in item.names:
                yield "/".join([*at, imported.name]) + ".py"
                yield "/".join([*at, imported.name, "__init__.py"])
