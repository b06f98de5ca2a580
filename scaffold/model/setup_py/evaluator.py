"""Evaluation of setup.py: the files next to it are known, and what runs before setup()."""

from __future__ import annotations

import ast
import posixpath
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.evaluator import Elements, Evaluator
from scaffold.model.python.evaluation.list_changes import statement_of
from scaffold.model.python.evaluation.values import UNKNOWN, Glob, Lazy, PathValue
from scaffold.model.remembered import remembered
from scaffold.model.setup_py.globs import matches

if TYPE_CHECKING:
    from scaffold.model.package_files import PackageFiles
    from scaffold.model.python.module import PythonModule


class SetupEvaluator(Evaluator):
    """An evaluator that executes what comes before an expression, if it has to.

    Args:
        module: The setup.py.
        files: The files next to it.
    """

    def __init__(self, module: PythonModule, files: PackageFiles | None = None) -> None:
        super().__init__(module)
        self._files = files
        self._executed: dict[ast.expr, object] = {}

    # -- execution

    def value(self, node: ast.expr) -> object:
        """Return the value of an expression where it is."""
        value = self.evaluate(node)
        return self._value_reached(node) if value is UNKNOWN else value

    def elements(self, node: ast.expr) -> Elements:
        """Return the items of a list where it is, each with its location."""
        elements = super().elements(node)
        is_settled = elements.complete and all(_is_settled(x.value) for x in elements.items)
        if is_settled or self._frames or self._depth:
            return elements
        value = self._value_reached(node)
        if not isinstance(value, list | tuple) or UNKNOWN in value:
            return elements
        items = (self.element(node, item) for item in value)
        return Elements(tuple(x._replace(origin=x.origin or node) for x in items), complete=True)

    def _value_reached(self, node: ast.expr) -> object:
        if node not in self._executed:
            self._executed[node] = self.value_after(self._blocks_before(node), node)
        return self._executed[node]

    def _blocks_before(self, node: ast.expr) -> list[Sequence[ast.stmt]]:
        """Return the blocks around an expression, each up to what is around the expression."""
        blocks: list[Sequence[ast.stmt]] = []
        inner = statement_of(self.module, node)
        while inner is not None:
            parent = self.module.parent(inner)
            field, number = self.module.index.place(inner)
            if isinstance(inner, ast.FunctionDef):
                blocks.insert(0, [x for x in self.module.tree.body if x is not inner])
            elif number >= 0:
                blocks.insert(0, getattr(parent, field)[:number])
            inner = parent if isinstance(parent, ast.stmt) else None
        return blocks

    # -- files

    def paths(self, pattern: Glob) -> Sequence[object] | None:
        """Return the files and directories that a pattern matches."""
        if self._files is None or not _is_inside(pattern.pattern):
            return None
        directories = sorted(self._files.tree.directories)
        if pattern.pattern.endswith("/"):
            return [f"{path}/" for path in matches(pattern, directories)]
        found = matches(pattern, [*self._files.files, *directories])
        return [PathValue(path) for path in found] if pattern.is_path else found

    def attribute(self, node: ast.Attribute) -> object:
        """Return the value of an attribute of a path."""
        path = self.evaluate(node.value)
        if not isinstance(path, PathValue):
            return UNKNOWN
        head, name = posixpath.split(path.text)
        stem, suffix = posixpath.splitext(name)
        values: Mapping[str, object] = {
            "parent": PathValue(head or "."),
            "name": name,
            "stem": stem,
            "suffix": suffix,
            "parts": tuple(path.text.split("/")),
        }
        return values.get(node.attr, UNKNOWN)

    def call(self, node: ast.Call) -> object:
        """Return the result of a function of paths."""
        name = self.module.qualified_name(node.func)
        if name is not None:
            function, args = _FUNCTIONS.get(name), node.args
        elif isinstance(node.func, ast.Attribute):
            function, args = _METHODS.get(node.func.attr), [node.func.value, *node.args]
        else:
            return UNKNOWN
        has_others = any(word.arg not in _WITHOUT_EFFECT for word in node.keywords)
        if function is None or has_others or self._files is None:
            return UNKNOWN
        values = [self.evaluate(arg) for arg in args]
        if name is None and not isinstance(values[0], PathValue):
            return UNKNOWN
        texts = [value.text if isinstance(value, PathValue) else value for value in values]
        paths = [text for text in texts if isinstance(text, str) and _is_inside(text)]
        if not paths or len(paths) < len(texts):
            return UNKNOWN
        try:
            return function(self._files, *paths)
        except TypeError:  # other arguments
            return UNKNOWN


def _is_inside(path: str) -> bool:
    """Return whether a path is in the package, whatever the directory of the build is."""
    return not path.startswith("/") and ".." not in path.split("/")


def _is_settled(value: object) -> bool:
    if isinstance(value, list | tuple):
        return all(map(_is_settled, value))
    return value is not UNKNOWN


def _children(files: PackageFiles, top: str) -> tuple[list[str], list[str]] | None:
    """Return the names of the directories and files in a directory; ``None`` without it."""
    top = posixpath.normpath(top)
    if not files.has_directory(top):
        return None
    directories, names = _by_directory(files, of_files=False), _by_directory(files, of_files=True)
    return directories.get(top, []), names.get(top, [])


@remembered
def _by_directory(files: PackageFiles, *, of_files: bool) -> Mapping[str, list[str]]:
    """Return the names of the files, or of the directories, in each directory."""
    result: dict[str, list[str]] = {}
    for path in sorted(files.files if of_files else files.tree.directories):
        directory, name = posixpath.split(path)
        result.setdefault(directory or ".", []).append(name)
    return result


def _walk(files: PackageFiles, top: str) -> object:
    def steps(directory: str) -> Iterator[object]:
        names = _children(files, directory)
        if names is None:
            return
        below: list[object] = [*names[0]]
        yield (directory, below, [*names[1]])
        for name in below:  # which the loop may have changed
            if isinstance(name, str):
                yield from steps(posixpath.join(directory, name))

    return UNKNOWN if posixpath.normpath(top) == "." else Lazy(partial(steps, top))


def _listed(files: PackageFiles, top: str = ".") -> object:
    names = _children(files, top)
    is_root = posixpath.normpath(top) == "."  # with products of the build
    return UNKNOWN if names is None or is_root else sorted([*names[0], *names[1]])


def _paths_in(files: PackageFiles, top: str) -> object:
    names = _listed(files, top)
    if not isinstance(names, list):
        return UNKNOWN
    return [PathValue(posixpath.normpath(posixpath.join(top, name))) for name in names]


def _is_file(files: PackageFiles, path: str) -> bool:
    return files.has(posixpath.normpath(path))


def _is_directory(files: PackageFiles, path: str) -> bool:
    return files.has_directory(posixpath.normpath(path))


def _exists(files: PackageFiles, path: str) -> bool:
    return _is_file(files, path) or _is_directory(files, path)


def _relative(_: PackageFiles, path: str, start: str = ".") -> str:
    return posixpath.relpath(f"/{path}", f"/{start}")


_FUNCTIONS: Mapping[str, Callable[..., object]] = {
    "os.walk": _walk,
    "os.listdir": _listed,
    "os.path.isfile": _is_file,
    "os.path.isdir": _is_directory,
    "os.path.exists": _exists,
    "os.path.relpath": _relative,
    "os.path.dirname": lambda _, path: posixpath.dirname(path),
    "os.path.basename": lambda _, path: posixpath.basename(path),
    "os.path.normpath": lambda _, path: posixpath.normpath(path),
    "os.path.splitext": lambda _, path: posixpath.splitext(path),
}
_WITHOUT_EFFECT = frozenset({"topdown", "followlinks"})
"""Keyword arguments of these functions that change nothing here."""
_METHODS: Mapping[str, Callable[..., object]] = {
    "is_file": _is_file,
    "is_dir": _is_directory,
    "exists": _exists,
    "iterdir": _paths_in,
    "relative_to": lambda files, path, start: PathValue(_relative(files, path, start)),
}
