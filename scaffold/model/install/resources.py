"""Files that Python modules of a package read relative to themselves."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.python.evaluation.evaluator import Evaluator
from scaffold.model.python.evaluation.values import UNKNOWN, PathValue
from scaffold.model.python.module import is_in_tests
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule
    from scaffold.source import Location

ROOT = "/<source>/"
"""The prefix of paths relative to the root of the package."""
_MAX_DEPTH = 50
"""The maximum depth of paths in a package."""
_MENTIONS = (b"__file__", b"resources", b"get_data", b"pkg_resources")
_SAME = frozenset({"resolve", "absolute", "expanduser"})
_READERS = frozenset(
    {"importlib.resources.open_text", "importlib.resources.read_text", "pkgutil.get_data"}
    | {"importlib.resources.open_binary", "importlib.resources.read_binary"}
    | {"importlib.resources.path", "importlib_resources.path", "pkg_resources.resource_string"}
    | {"pkg_resources.resource_filename", "pkg_resources.resource_stream"}
)


class OwnFile(NamedTuple):
    """A file that a module reads relative to itself."""

    path: str
    """Relative to the root of the package."""
    location: Location


class _FileEvaluator(Evaluator):
    """An evaluator that knows the value of ``__file__``."""

    def evaluate(self, node: ast.expr | None) -> object:
        """Return the value of an expression."""
        if isinstance(node, ast.Name) and node.id == "__file__":
            return ROOT + self.module.path
        return super().evaluate(node)

    def attribute(self, node: ast.Attribute) -> object:
        """Return the value of an attribute of a path."""
        if node.attr not in {"parent", "parents"}:
            return UNKNOWN
        path = self.evaluate(node.value)
        if not isinstance(path, PathValue):
            return UNKNOWN
        parents: list[PathValue] = []
        while "/" in path.text.removeprefix(ROOT) and len(parents) < _MAX_DEPTH:
            path = PathValue(_dirname(path.text))
            parents.append(path)
        if node.attr == "parents":
            return parents
        return parents[0] if parents else UNKNOWN

    def call(self, node: ast.Call) -> object:
        """Return the value of a call that returns a path."""
        names = self.module.qualified_names(node.func)
        name = next(iter(names), "")
        first = node.args[0] if node.args else None
        if name in _PATH_FUNCTIONS and first is not None:
            path = self.evaluate(first)
            text = path.text if isinstance(path, PathValue) else path
            return _PATH_FUNCTIONS[name](text) if isinstance(text, str) else UNKNOWN
        if name in {"importlib.resources.files", "importlib_resources.files"}:
            return self._package_directory(first)
        if name in _READERS and len(node.args) > 1:
            directory, rest = self._package_directory(first), self.evaluate(node.args[1])
            if isinstance(directory, PathValue) and isinstance(rest, str):
                return PathValue(f"{directory.text}/{rest}")
        if isinstance(node.func, ast.Attribute) and node.func.attr in _SAME and not names:
            return self.evaluate(node.func.value)
        return UNKNOWN

    def _package_directory(self, node: ast.expr | None) -> object:
        if isinstance(node, ast.Name) and node.id in {"__name__", "__package__"}:
            return PathValue(_dirname(ROOT + self.module.path))
        name = self.evaluate(node)
        return PathValue(ROOT + name.replace(".", "/")) if isinstance(name, str) else UNKNOWN


def own_files(package: Package) -> Iterator[OwnFile]:
    """Yield the files of the package that its modules read, with the places."""
    for path in package.python_files:
        with suppress(ViewError):
            if not is_in_tests(path):
                yield from _files_named_in(package, path)


@fact
def _files_named_in(package: Package, path: str) -> tuple[OwnFile, ...]:
    data = package.data(path)
    if not any(word in data for word in _MENTIONS):
        return ()
    return tuple(_named_in(package, package.module(path)))


def _named_in(package: Package, module: PythonModule) -> Iterator[OwnFile]:
    evaluator = _FileEvaluator(module)
    nodes: list[ast.expr] = [*module.walk(ast.Call), *module.walk(ast.BinOp)]
    nodes += module.walk(ast.JoinedStr)
    seen: set[str] = set()
    for node in nodes:
        if _is_in_main_guard(module, node):
            continue
        value = evaluator.evaluate(node)
        text = value.text if isinstance(value, PathValue) else value
        if not isinstance(text, str) or not text.startswith(ROOT):
            continue
        path = _normalized(text.removeprefix(ROOT))
        is_new = path != module.path and path not in seen and package.has(path)
        if is_new and not _is_tried(module, node):
            seen.add(path)
            yield OwnFile(path, module.location(node))


def _is_in_main_guard(module: PythonModule, node: ast.expr) -> bool:
    """Return whether code only runs where Python is given the source file."""
    guard = module.main_guard_node
    return guard is not None and guard.lineno <= node.lineno <= (guard.end_lineno or 0)


def _is_tried(module: PythonModule, node: ast.expr) -> bool:
    """Return whether a path is one of several candidates, one of which need exist."""
    holder = module.parent(node)
    is_one_of_several = isinstance(holder, ast.List | ast.Tuple) and len(holder.elts) > 1
    return is_one_of_several and module.mentions("exists(", "isfile(", "is_file(")


def _dirname(text: str) -> str:
    return text.rpartition("/")[0]


def _identity(text: str) -> str:
    return text


_PATH_FUNCTIONS: Mapping[str, Callable[[str], str]] = {
    "os.path.dirname": _dirname,
    "os.path.abspath": _identity,
    "os.path.realpath": _identity,
    "os.path.normpath": _identity,
}


def _normalized(path: str) -> str:
    parts: list[str] = []
    for part in path.split("/"):
        if part == ".." and parts:
            parts.pop()
        elif part not in {"", "."}:
            parts.append(part)
    return "/".join(parts)
