"""Uses of names that the target distribution removed or deprecated."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold import lazy_re
from scaffold.changes import Change
from scaffold.edits import Edit
from scaffold.model.python.conditions.distribution_branches import cases
from scaffold.model.python.conditions.distribution_conditions import asks, holds, open_parts
from scaffold.model.python.conditions.guards import (
    all_conditions,
    has_fallback,
    is_handled,
    values_asked,
)
from scaffold.model.python.conditions.handlers import IMPORT_ERRORS, last_names
from scaffold.model.python.conditions.import_flags import asks_which_release
from scaffold.model.python.imports import IMPORT_OR_SKIP
from scaffold.model.python.module import PythonModule
from scaffold.model.rclpy.api import class_of
from scaffold.model.rclpy.evaluation.arrays import ARRAY, DTYPE, is_array, type_names
from scaffold.model.rclpy.file import RclpyFile
from scaffold.record import NamedTuple
from scaffold.source import Location

_LOGGER = "rclpy.impl.rcutils_logger.RcutilsLogger"
_IMPORTS = (ast.Import, ast.ImportFrom)
_OF_IMPORT = frozenset({"ImportError", "ModuleNotFoundError"})
_ABOVE = {"ModuleNotFoundError": "ImportError"}
"""The class above an error."""
_VERSION = lazy_re.compile(
    r"version_info|__version__|VERSION|\b[Vv]ersion(?:\.parse)?\(|(?i:distro)"
    r"|(?i:ros|rclpy|numpy|np|python)_?version"
)
"""Matches conditions on a version of Python, of ROS or of a package."""
_FINDERS = frozenset({"importlib.util.find_spec", "pkgutil.find_loader", IMPORT_OR_SKIP})
"""Functions that test whether a module exists."""
_MAX_POSITIONAL = 3
"""The number of positional arguments from which a call may give any of them."""


class ChangedUse(NamedTuple):
    """A use of a name, or a call, that a distribution changed."""

    change: Change
    location: Location
    shown: str
    """The name in messages."""
    error: str
    """The error if the name was removed."""
    replacement: str = ""
    """The replacement; empty if there is none."""
    edits: tuple[Edit, ...] = ()
    """The edits that use the replacement."""


def changed_uses(module: PythonModule, changes: Sequence[Change]) -> Iterator[ChangedUse]:
    """Yield the uses of changed names that are not guarded by a version check.

    Args:
        module: The file.
        changes: The changes of names.
    """
    wanted = [
        change for change in changes if any(_is_mentioned(module, name) for name in change.names)
    ]
    if wanted:
        search = _Search(module, wanted)
        yield from search.imports()
        yield from search.attributes()
        yield from search.calls()
        yield from search.type_names()


def _is_mentioned(module: PythonModule, name: str) -> bool:
    """Return whether a file may use a name; methods of rclpy objects need no import."""
    root, word = name.partition(".")[0], name.rpartition(".")[2].rstrip("*")
    return module.mentions(word) and (root == "rclpy" or module.mentions(root))


class _Search:
    def __init__(self, module: PythonModule, changes: Sequence[Change]) -> None:
        self._module = module
        self._path = module.source.path
        self._file = RclpyFile(module)
        self._calls = [change for change in changes if change.is_of_call]
        self._plain = {
            name: change
            for change in changes
            for name in change.names
            if not name.endswith("*") and not change.is_of_call
        }
        self._members = {
            name.rpartition(".")[2] for name in self._plain if not name.startswith("numpy.")
        }
        self._patterns = [
            (name.rstrip("*"), change)
            for change in changes
            for name in change.names
            if name.endswith("*")
        ]

    def _match(self, name: str) -> tuple[Change, str] | None:
        """Return the change of a full name, and the last part of its replacement."""
        if name in self._plain:
            change = self._plain[name]
            return change, change.use
        for start, change in self._patterns:
            if name.startswith(start):
                return change, change.use.replace("*", name.removeprefix(start))
        return None

    def imports(self) -> Iterator[ChangedUse]:
        """Yield the uses in imports."""
        for node in self._module.walk(ast.ImportFrom):
            if not node.level and node.module:
                yield from self._imported_from(node, node.module)
        for plain in self._module.walk(ast.Import):
            for alias in plain.names:
                matched = self._match(alias.name)
                if matched is not None:
                    start, end = self._module.span(alias)
                    last = start + len(alias.name)
                    old = len(alias.name.rpartition(".")[2])
                    at = self._module.source.location(start, end)
                    error = "ModuleNotFoundError"
                    yield from self._use(plain, at, alias.name, error, matched, (last - old, last))

    def _imported_from(self, node: ast.ImportFrom, name: str) -> Iterator[ChangedUse]:
        start, _ = self._module.span(node)
        text = self._module.source.text
        matched = self._match(name)
        if matched is not None:
            begin = text.index(name, start)
            at = self._module.source.location(begin, begin + len(name))
            last = (begin + len(name) - len(name.rpartition(".")[2]), begin + len(name))
            yield from self._use(node, at, name, "ModuleNotFoundError", matched, last)
        for alias in node.names:
            full = f"{name}.{alias.name}"
            matched = self._match(full)
            if matched is not None:
                begin, end = self._module.span(alias)
                at = self._module.source.location(begin, end)
                is_bound = alias.asname is not None
                change, use = matched
                written = use if is_bound or not use else f"{use} as {alias.name}"
                place = (begin, begin + len(alias.name))
                yield from self._use(node, at, full, "ImportError", (change, written), place)

    def attributes(self) -> Iterator[ChangedUse]:
        """Yield the uses as attributes of modules, classes and objects."""
        for node in self._module.walk(ast.Attribute):
            for name in self._names(node):
                matched = self._match(name)
                if matched is None:
                    continue
                _, end = self._module.span(node)
                at = self._module.location(node)
                place = (end - len(node.attr), end)
                yield from self._use(node, at, name, "AttributeError", matched, place)
                break

    def calls(self) -> Iterator[ChangedUse]:
        """Yield the calls with or without a changed argument."""
        for call in self._module.walk(ast.Call) if self._calls else ():
            given = [call.func, *(word.value for word in call.keywords)]
            names = frozenset().union(*map(self._module.qualified_names, given))
            for change in self._calls:
                name = next((name for name in change.names if name in names), "")
                node = _argument_meant(call, change) if name else None
                if node is not None:
                    keyword = f"with {change.having}" if change.having else ""
                    shown = f"{name} {keyword or f'without {change.without}'}"
                    at = self._module.location(node)
                    error = change.raises or "TypeError"
                    for use in self._use(call, at, name, error, (change, change.use), (0, 0)):
                        yield use._replace(shown=shown)

    def type_names(self) -> Iterator[ChangedUse]:
        """Yield the strings with a NumPy type."""
        if not any(name.startswith(f"{DTYPE}.") for name in self._plain):
            return
        for node in type_names(self._file):
            name = f"{DTYPE}.{node.value!s}"
            matched = self._match(name)
            if matched is not None:
                start, end = self._module.span(node)
                at, place = self._module.location(node), (start + 1, end - 1)
                for use in self._use(node, at, name, "TypeError", matched, place):
                    yield use._replace(shown=f"{DTYPE}({node.value!r})")

    def _names(self, node: ast.Attribute) -> Iterator[str]:
        yield from sorted(self._module.qualified_names(node))
        if f"{_LOGGER}.{node.attr}" in self._plain and self._is_logger(node.value):
            yield f"{_LOGGER}.{node.attr}"
        elif f"{ARRAY}.{node.attr}" in self._plain:
            if is_array(self._file, node.value):
                yield f"{ARRAY}.{node.attr}"
        elif node.attr in self._members:
            class_ = class_of(self._file, node.value)
            if class_ is not None:
                yield f"{class_}.{node.attr}"

    def _is_logger(self, node: ast.expr) -> bool:
        """Return whether an expression is the logger of any node."""
        value = self._file.evaluator.single_value(node)
        match value:
            case ast.Call(func=ast.Attribute(attr="get_logger", value=of), args=[], keywords=[]):
                return self._file.uses_rclpy or self._file.owner_of(of) is not None
            case ast.Call(func=ast.Attribute(attr="get_child", value=of)):
                return self._is_logger(of)
        return class_of(self._file, node) == _LOGGER

    def _is_fallback(self, node: ast.AST, replacement: str) -> bool:
        """Return whether an import or name is a fallback for another import or its replacement."""
        child = node
        for parent in self._module.parents(node):
            match parent, child:
                case ast.Try(body=body), ast.ExceptHandler(type=caught):
                    names = last_names(caught) if caught else {"BaseException"}
                    if isinstance(node, _IMPORTS):
                        is_tried = any(isinstance(item, _IMPORTS) for item in body)
                        if names & (IMPORT_ERRORS if is_tried else _OF_IMPORT):
                            return True
                    elif "AttributeError" in names and _mentions(
                        body, replacement.rpartition(".")[2]
                    ):
                        return True
            child = parent
        return False

    def _use(
        self,
        node: ast.AST,
        at: Location,
        name: str,
        error: str,
        matched: tuple[Change, str],
        place: tuple[int, int],
    ) -> Iterator[ChangedUse]:
        """Yield a use, unless the code handles it."""
        change, written = matched
        # `except Exception` around much code is no handler for the name.
        is_broad = error in _OF_IMPORT
        errors = {error, _ABOVE.get(error, error)}
        if any(is_handled(self._module, node, item, is_broad=is_broad) for item in errors):
            return
        if not is_broad and has_fallback(self._module, node, is_rare=False):
            return
        if is_asked_for(self._module, node, name, written):
            return
        if self._is_fallback(node, written):
            return
        old = self._module.source.text[slice(*place)]
        # Before Python 3.12 positions in f-strings are unknown.
        is_there = old == name.rpartition(".")[2]
        can_write = bool(written) and change.has_replacement and is_there
        edits = (Edit(self._path, *place, written),) if can_write else ()
        replacement = written.partition(" as ")[0]
        yield ChangedUse(change, at, name, error, replacement, edits)


def _argument_meant(call: ast.Call, change: Change) -> ast.AST | None:
    """Return the changed part of a call; ``None`` if it is not affected."""
    words = {word.arg: word for word in call.keywords}
    if change.having or None in words:
        return words.get(change.having) if change.having else None
    is_by_position = len(call.args) > _MAX_POSITIONAL or any(
        isinstance(argument, ast.Starred) for argument in call.args
    )
    return None if change.without in words or is_by_position else call.func


def _mentions(body: Sequence[ast.stmt], attribute: str) -> bool:
    return any(
        isinstance(node, ast.Attribute) and node.attr == attribute
        for statement in body
        for node in ast.walk(statement)
    )


def is_asked_for(module: PythonModule, node: ast.AST, name: str, replacement: str = "") -> bool:
    """Return whether a node is guarded by conditions on a version or a name.

    Args:
        module: The file.
        node: The use of the name.
        name: The full name.
        replacement: The replacement.
    """
    asked = _Asked(module, name, {name.rpartition(".")[2], replacement} - {""})
    for condition in all_conditions(module, node):
        if holds(module, condition.test) is (not condition.needed):
            return True
        for part in open_parts(module, condition.test):
            if asks(module, part) or asked.is_behind(part):
                return True
        if asks_which_release(module, condition, name.partition(".")[0]):
            return True
    return any(_is_unsure_case(module, parent, child) for parent, child in _ancestors(module, node))


def is_tried(module: PythonModule, call: ast.Call, keyword: str) -> bool:
    """Return whether code handles the case that a function rejects the arguments of a call.

    It catches ``TypeError``, has a fallback, or checks the argument or a version first.

    Args:
        module: The file.
        call: The call.
        keyword: The argument.
    """
    return (
        is_handled(module, call, "TypeError", is_broad=False)
        or has_fallback(module, call, is_rare=False)
        or is_asked_for(module, call, f"{ast.unparse(call.func)}.{keyword}")
    )


def _ancestors(module: PythonModule, node: ast.AST) -> Iterator[tuple[ast.AST, ast.AST]]:
    """Yield the ancestors of a node, each with the child on the path."""
    for parent in module.parents(node):
        yield parent, node
        node = parent


def _is_unsure_case(module: PythonModule, parent: ast.AST, child: ast.AST) -> bool:
    if not isinstance(parent, ast.Match) or not isinstance(child, ast.match_case):
        return False
    is_run = cases(module, parent)[parent.cases.index(child)]
    return is_run is None and asks(module, parent.subject)


class _Asked(NamedTuple):
    """A condition around the use of a name."""

    module: PythonModule
    name: str
    """The full name."""
    words: set[str]
    """The last parts of the name and its replacement."""

    def is_behind(self, test: ast.expr) -> bool:
        """Return whether a condition, directly or through names, tests a version or a word.

        A version of Python, of ROS or of a package.
        """
        return any(
            _VERSION.search(self.module.text(value)) or self._is_word_asked_for(value)
            for value in values_asked(self.module, test)
        )

    def _is_word_asked_for(self, test: ast.expr) -> bool:
        for node in ast.walk(test):
            match node:
                case ast.Call(
                    func=ast.Name(id="hasattr" | "getattr"),
                    args=[holder, ast.Constant(value=word), *_],
                ):
                    if word in self.words or self._is_of_package(holder):
                        return True
                case ast.Call(func=ast.Name(id="hasattr")):
                    return True
                case ast.Compare(left=ast.Constant(value=word), ops=[ast.In() | ast.NotIn()]) if (
                    word in self.words
                ):  # 'warn' in dir(logger)
                    return True
                case ast.Call(func=func, args=[ast.Constant(value=str(word)), *_]):
                    is_of_it = f"{self.name}.".startswith(f"{word}.")
                    if is_of_it and self.module.qualified_name(func) in _FINDERS:
                        return True
        return False

    def _is_of_package(self, holder: ast.expr) -> bool:
        """Return whether an expression is a module or a class of the package of the name."""
        roots = {name.partition(".")[0] for name in self.module.qualified_names(holder)}
        return roots == {self.name.partition(".")[0]}
