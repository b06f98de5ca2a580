"""Functions, methods and classes that nothing reaches, judging by their names."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.files.limits import most_bytes
from scaffold.formats.hash_comments import code_with
from scaffold.model.contents.parts import GUARD, TOP, nodes_of, part_at, parts_mentioning
from scaffold.model.contents.python_facts import paths_importing
from scaffold.model.contents.words import files_with
from scaffold.model.facts import fact
from scaffold.model.install.reach import (
    code_about,
    has_programs,
    is_only_importable,
    is_unreached,
    loaders,
)
from scaffold.model.install.unused import TEXTS, is_named
from scaffold.model.rclpy.api import NODE, has
from scaffold.model.rclpy.own_modules import OwnModules
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule
    from scaffold.model.python.scopes import FunctionNode

_CALLBACK = lazy_re.compile(r"(?i)call_?back$|_cb$")
"""Matches the names of methods that are passed on and unknown to a base class."""
_COMPUTED = lazy_re.compile(r"\bgetattr\([^,\n]{0,200},\s{0,9}(?![\"'\s])")
"""Matches the computation of the name of an attribute."""
_OF_PYTEST = lazy_re.compile(
    r"(?i)_?test|setup|teardown|set_?up|tear_?down|pytest_|generate_|load_tests"
)
"""Matches the names of functions that pytest, unittest or launch_testing call."""
_ENTRIES = frozenset({"main", "generate_launch_description"})
_OF_FILES = frozenset({"write", "flush", "read", "readline", "close"})
"""Methods that Python calls for objects that replace files, such as ``sys.stdout``."""
_BY_NAME = frozenset({"property", "staticmethod", "classmethod"})
"""Decorators of methods that are still used by their names."""
_CPP = (".cpp", ".hpp")
_TELLING = (".cfg", ".toml", ".xml", *_CPP)
"""The endings of other files that may call a function of Python, or tell who does."""
_IN_PYTHON = rb"(?<!\w)%b(?!\w)"
_IN_CPP = rb"\"(?:[\w.]{0,99}\.)?%b[\"(]"
_IN_DATA = rb"[.:]%b(?!\w)"
_IDENTIFIER = lazy_re.compile(rb"[A-Za-z_]\w*")
_LAUNCH = frozenset({"launch", "launch_ros"})
_MOST_BASES = 4
"""More base classes in other modules are not followed."""
_MOST_PARTS = 200
"""More functions and classes that only use each other are not followed."""
_LOOKUPS = ("globals(", "locals(", "vars(", "__dict__", "eval(", "exec(")
"""Functions that look up names computed at run time."""
_TEST_OF_NAME = lazy_re.compile(r"[\"']\w+[\"'] (?:not )?in (?:globals|locals|vars)\(\)")
"""Matches a test whether a variable is set, ``'node' in locals()``."""
_MODULES = ("sys.modules", "import_module", "__import__")
"""Expressions that return a module, whose functions are its attributes."""
_BASES = frozenset({NODE, "rclpy.Node", "object", "abc.ABC"})
"""Classes that call no methods but those that they have themselves."""


def is_uncalled(package: Package, path: str, line: int) -> bool:
    """Return whether nothing that is run reaches the function, class or main guard at a line.

    Follows the names of functions and classes through the workspace. A library is used from
    elsewhere, but for what helps the programs of its package, or launch files; a method may be
    called by an unknown base, or by Python.

    Raises:
        ViewError: the file cannot be read.
    """
    part = part_at(package, path, line)
    return package.remember(
        ("uncalled", path, part), lambda: _Search().is_unreached(package, path, part)
    )


class _Search:
    """Follows the users of a part of a file, up to one that is run."""

    def __init__(self) -> None:
        self._count = 0

    def is_unreached(
        self,
        package: Package,
        path: str,
        part: str,
        seen: frozenset[tuple[str, str, str]] = frozenset(),
    ) -> bool:
        """Return whether a part is only used by parts that are not reached, or by itself."""
        place = (package.name, path, part)
        if place in seen or (path.endswith(".py") and is_unreached(package, path)):
            return True
        self._count += 1
        if self._count > _MOST_PARTS or not path.endswith(".py") or part == TOP:
            return False
        if part == GUARD:
            return _is_unused_guard(package, path)
        owner = part.rpartition(".")[0]
        seen |= {place}
        if owner and self.is_unreached(package, path, owner, seen):
            return True
        try:
            return _is_used_by_name(package, path, part) and all(
                self.is_unreached(user, file, using, seen)
                for user, file, using in _users(package, path, part)
            )
        except ViewError:  # of a file that may use it
            return False


def _users(package: Package, path: str, part: str) -> Iterator[tuple[Package, str, str]]:
    """Yield the parts of the workspace that may use a part of a file.

    Those of a program are in modules that import it, or that it imports base classes from.
    """
    is_startable = _is_startable(package, path)
    name = part.rpartition(".")[2].encode()
    data = package.data(path)
    for user in [package] if is_startable else package.workspace:
        is_known = user is package or _may_know(user, package, path)
        for file in _files_with(user, name, is_own=user is package) if is_known else ():
            if user is not package and not _knows(user, package, path):
                break
            if is_startable and not (
                file == path or _stem(path) in user.data(file) or _stem(file) in data
            ):
                continue
            if file.endswith(".py"):
                yield from ((user, file, using) for using in parts_mentioning(user, file, part))
            else:
                yield user, file, TOP


def _stem(path: str) -> bytes:
    return path.rpartition("/")[2].removesuffix(".py").encode()


@fact
def _is_startable(package: Package, path: str) -> bool:
    """Return whether a module is a launch file, or may be a program, or is a test."""
    module = package.module(path)
    is_program = module.has_main_guard or "main" in module.functions
    return is_program or _is_launch_file(path) or module.in_tests


@fact
def _is_used_by_name(package: Package, path: str, part: str) -> bool:
    """Return whether whatever uses a function, method or class has to mention its name."""
    module = package.module(path)
    nodes = nodes_of(module, part)
    if not nodes or _looks_up_names(module) or any(loaders(package, path)):
        return False
    if not _is_for_programs(package, module):
        return False
    return all(
        _has_known_users(package, module, node)
        if isinstance(node, ast.ClassDef)
        else _is_called_by_name(package, module, node)
        for node in nodes
    )


def _is_for_programs(package: Package, module: PythonModule) -> bool:
    """Return whether a module is a program, or is there for launch files or own programs."""
    is_for_launch = not _LAUNCH.isdisjoint(module.imports_by_root)
    return is_for_launch or _is_startable(package, module.path) or has_programs(package)


def _is_launch_file(path: str) -> bool:
    return path.endswith("launch.py")


def _looks_up_names(module: PythonModule) -> bool:
    """Return whether a file may look up a function or class by a name computed at run time."""
    if not module.mentions(*_LOOKUPS):
        return False
    text = _TEST_OF_NAME.sub("", module.source.text)
    return any(lookup in text for lookup in _LOOKUPS)


def _has_known_users(
    package: Package, module: PythonModule, class_: ast.ClassDef, depth: int = _MOST_BASES
) -> bool:
    """Return whether no decorator, metaclass or base may register a class."""
    is_plain = not (class_.decorator_list or class_.keywords or module.in_tests)
    return is_plain and _has_known_bases(package, module, class_, depth)


def _has_known_bases(
    package: Package, module: PythonModule, class_: ast.ClassDef, depth: int = _MOST_BASES
) -> bool:
    """Return whether no base but own ones calls methods that it does not have itself."""
    for base in class_.bases:
        own = module.classes.get(base.id) if isinstance(base, ast.Name) else None
        name = module.qualified_name(base) or ""
        if own is not None and own.node.lineno < class_.lineno:
            if not _has_known_users(package, module, own.node, depth):
                return False
        elif name not in _BASES and not _is_known_base(package, module, name, depth):
            return False
    return True


def _is_known_base(package: Package, module: PythonModule, name: str, depth: int) -> bool:
    """Return whether a class of another module of the package has no unknown bases."""
    holder, _, class_name = name.rpartition(".")
    for path in OwnModules(module, package).paths_of(holder) if depth else ():
        other = package.module(path)
        found = other.classes.get(class_name)
        return found is not None and _has_known_users(package, other, found.node, depth - 1)
    return False


def _is_called_by_name(package: Package, module: PythonModule, function: FunctionNode) -> bool:
    """Return whether a function is not called implicitly by Python, rclpy, or an unknown base."""
    name = function.name
    if name in _ENTRIES | _OF_FILES or name.startswith("__"):
        return False
    if _is_decorated(module, function) or _may_be_computed(module, function):
        return False
    class_ = module.enclosing_class(function)
    if module.in_tests:
        return class_ is None and _OF_PYTEST.match(name) is None
    if class_ is None:
        return True
    if class_.decorator_list or class_.keywords or has(NODE, name):
        return False
    return _has_known_bases(package, module, class_) or bool(_CALLBACK.search(name))


def _is_decorated(module: PythonModule, function: FunctionNode) -> bool:
    """Return whether a function may be reached other than by its name; never so for a property.

    Tests ask for a fixture of their file by its name.
    """
    given = function.decorator_list
    if module.in_tests and not module.path.endswith("conftest.py"):
        given = [item for item in given if module.qualified_name(item) != "pytest.fixture"]
    return any(getattr(item, "id", "") not in _BY_NAME for item in given)


def _may_be_computed(module: PythonModule, function: FunctionNode) -> bool:
    """Return whether getattr with a computed name may return a method or a module's function."""
    if module.enclosing_class(function) is None and not module.mentions(*_MODULES):
        return False
    return _COMPUTED.search(module.source.text) is not None


@fact
def _is_unused_guard(package: Package, path: str) -> bool:
    """Return whether nobody runs a file with a main guard.

    A launch file launches nothing then; a module of a Python package is started by entry points.
    """
    module = package.module(path)
    if _is_launch_file(path):
        return not module.mentions("LaunchService")
    if module.in_tests or not is_only_importable(package, path):
        return False
    dotted = path.removesuffix(".py").replace("/", ".")
    names = (path.rpartition("/")[2], f"-m {dotted}")
    return not any(is_named(package, path, name, TEXTS) for name in names)


def _may_know(user: Package, package: Package, path: str) -> bool:
    """Return whether code of a package mentions another one, or is C++."""
    about = code_about(user, package.name, path.partition("/")[0])
    return bool(about) or any(item.endswith(_CPP) for item in user.files)


def _knows(user: Package, package: Package, path: str) -> bool:
    """Return whether a package may use the Python code of another one."""
    roots = (package.name, path.partition("/")[0])
    return (
        user is package
        or any(paths_importing(user, *roots))
        or any(True for item in user.files if item.endswith(_CPP))
    )


def _files_with(package: Package, word: bytes, *, is_own: bool) -> Iterator[str]:
    """Yield the files of a package that mention a word outside of comments.

    The words of other packages are not looked up, as they would be cached for each package.
    """

    def files() -> list[str]:
        return [path for path in package.files if path.endswith((".py", *_TELLING))]

    for path in files_with(package, "that may call", files, word) if is_own else files():
        is_python = path.endswith(".py")
        if is_own and is_python and _IDENTIFIER.fullmatch(word):
            yield path  # or the file cannot be read, which its parts will tell
            continue
        data = _data_of(package, path)
        if word in data:
            use = _IN_PYTHON if is_python else _IN_CPP if path.endswith(_CPP) else _IN_DATA
            if re.search(use % re.escape(word), code_with(data, word)):
                yield path


def _data_of(package: Package, path: str) -> bytes:
    """Return the content of a file; empty if it is too large for one that calls Python."""

    def read() -> bytes:
        try:
            return package.bytes_of(path, most_bytes(path))
        except OSError:
            return b""

    return package.remember(("C++", path), read) if path.endswith(_CPP) else package.data(path)
