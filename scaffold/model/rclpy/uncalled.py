"""Functions and methods that are never called, judging by their names."""

from __future__ import annotations

import ast
import re
from collections import Counter
from typing import TYPE_CHECKING

from scaffold.files.limits import most_bytes
from scaffold.formats.hash_comments import code_with, without_comments
from scaffold.model.contents.ament_cmake import programs
from scaffold.model.facts import fact
from scaffold.model.install.console_scripts import has_program_files
from scaffold.model.install.package_data import installed_data
from scaffold.model.install.unused import TEXTS, is_in_python_package, is_named, names_file
from scaffold.model.python.module import is_in_tests
from scaffold.model.rclpy.api import NODE, has
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule
    from scaffold.model.python.scopes import FunctionNode

_CALLBACK = re.compile(r"(?i)call_?back$|_cb$")
"""Matches the names of methods that are passed on and unknown to a base class."""
_COMPUTED = re.compile(r"\bgetattr\([^,\n]{0,200},\s{0,9}(?![\"'\s])")
"""Matches the computation of the name of an attribute."""
_IMPORTS_RELATIVELY = re.compile(rb"(?m)^[ \t]*from[ \t]+\.")
_WORD = re.compile(r"\w+")
_DEFINITION = re.compile(r"\b(?:class|def)\s+(\w+)")
_OF_PYTEST = re.compile(
    r"(?i)_?test|setup|teardown|set_?up|tear_?down|pytest_|generate_|load_tests"
)
"""Matches the names of functions that pytest, unittest or launch_testing call."""
_ENTRIES = frozenset({"main", "generate_launch_description"})
_OF_FILES = frozenset({"write", "flush", "read", "readline", "close"})
"""Methods that Python calls for objects that replace files, such as ``sys.stdout``."""
_CPP = (".cpp", ".hpp")
_NAMING = (".py", ".cfg", ".toml", *_CPP)
"""The endings of files that may call a function of Python, or tell who does."""
_LAUNCH = frozenset({"launch", "launch_ros"})
_MOST_CALLERS = 10
"""More functions that only call each other are not followed."""
_LOOKUPS = ("globals(", "locals(", "vars(", "__dict__", "eval(", "exec(")
"""Functions that look up names computed at run time."""
_TEST_OF_NAME = re.compile(r"[\"']\w+[\"'] (?:not )?in (?:globals|locals|vars)\(\)")
"""Matches a test whether a variable is set, ``'node' in locals()``."""
_MODULES = ("sys.modules", "import_module", "__import__")
"""Expressions that return a module, whose functions are its attributes."""


class _Unmentioned(NamedTuple):
    """A function, class or main guard that its own file does not use."""

    names: tuple[str, ...]
    """The words with which another file would use it; empty if none can."""
    endings: tuple[str, ...] = _NAMING
    """The endings of files that may use it."""
    is_for_all: bool = True
    """Whether other packages may use it."""
    is_guard: bool = False
    """Whether it is a main guard, which any of the names starts."""
    callers: tuple[str, ...] = ()
    """The functions of the file that mention it, none of which is called in the file."""


def is_in_uncalled_function(package: Package, path: str, line: int) -> bool:
    """Return whether a line is in an uncalled function, unused class, or unused main guard.

    Those of programs, launch files and tests count. A library is used from elsewhere, but for what
    helps the programs of its package, or launch files; a class may be called by an unknown base.

    Raises:
        ViewError: the file cannot be read.
    """
    return any(
        not _is_used_elsewhere(package, path, item) for item in _unmentioned_at(package, path, line)
    )


def _is_used_elsewhere(package: Package, path: str, item: _Unmentioned) -> bool:
    if item.is_guard:
        return any(is_named(package, path, name, TEXTS) for name in item.names)
    users = package.workspace if item.is_for_all else [package]
    names = (item.names, *((*item.names[:-1], caller) for caller in item.callers))
    return any(_is_named_in(user, path, each, item.endings) for user in users for each in names)


@fact
def _unmentioned_at(package: Package, path: str, line: int) -> tuple[_Unmentioned, ...]:
    """Return what a line is part of, if only other files may use it."""
    if not any(start <= line for start in _lines_of_unmentioned(package, path)):
        return ()
    module = package.module(path)
    guard = _guard_at(package, module, line)
    is_helper = not (module.in_tests or _is_startable(module))
    found = [guard]
    if not is_helper or _helps_programs(package, module):
        found += (_class_at(module, line), _function_at(module, line, is_helper=is_helper))
    return tuple(item for item in found if item is not None)


def _lines_of_unmentioned(package: Package, path: str) -> tuple[int, ...]:
    """Return the lines where such code may start, without parsing the file."""

    def find() -> tuple[int, ...]:
        try:
            text = package.data(path).decode()
        except UnicodeDecodeError:
            return (1,)
        if _is_launch_file(path) and "__main__" in text:
            return (1,)
        guard = text.find("__main__")
        at_guard = [text.count("\n", 0, guard) + 1] if guard >= 0 else []
        count = Counter(_WORD.findall(without_comments(text)))
        is_any = any(count[match[1]] == 1 for match in _DEFINITION.finditer(text))
        return (1,) if is_any else tuple(at_guard)  # helpers may come before

    return package.remember(("named once", path), find)


def _function_at(module: PythonModule, line: int, *, is_helper: bool) -> _Unmentioned | None:
    """Return the function or method at a line, if no code of its file that may run mentions it."""
    function = _outermost_function(module, line)
    if _looks_up_names(module):
        return None
    functions = [function]
    for item in functions:  # which grows
        if item is None or _is_decorated(module, item) or not _is_called_by_name(module, item):
            return None
        if _may_be_computed(module, item):
            return None
        is_method = module.enclosing_class(item) is not None
        index = module.index
        uses = index.attributes(item.name) if is_method else index.names(item.name)
        if _named_in(without_comments(module.source.text), item.name) > 1 + len(uses):
            return None
        around = {_outermost_function(module, use.lineno) for use in uses}
        functions += around.difference(functions)
        if len(functions) > _MOST_CALLERS:
            return None
    name, *callers = (item.name for item in functions if item is not None)
    stem = module.path.rpartition("/")[2].removesuffix(".py")
    names = (name,) if is_helper else (stem, name)
    return _Unmentioned(names, is_for_all=is_helper, callers=tuple(sorted(callers)))


def _is_launch_file(path: str) -> bool:
    return path.endswith("launch.py")


def _looks_up_names(module: PythonModule) -> bool:
    """Return whether a file may look up a function or class by a name computed at run time."""
    if not module.mentions(*_LOOKUPS):
        return False
    text = _TEST_OF_NAME.sub("", module.source.text)
    return any(lookup in text for lookup in _LOOKUPS)


def _may_be_computed(module: PythonModule, function: FunctionNode) -> bool:
    """Return whether getattr with a computed name may return a method or a module's function."""
    if module.enclosing_class(function) is None and not module.mentions(*_MODULES):
        return False
    return _COMPUTED.search(module.source.text) is not None


def _class_at(module: PythonModule, line: int) -> _Unmentioned | None:
    """Return the class with a method at a line, if its file does not mention it again."""
    for class_ in () if module.in_tests else module.tree.body:
        if not isinstance(class_, ast.ClassDef) or not _covers(class_, line):
            continue
        functions = (item for item in class_.body if isinstance(item, ast.FunctionDef))
        is_run_later = line == class_.lineno or any(
            item.body[0].lineno <= line and _covers(item, line) for item in functions
        )
        if not is_run_later or class_.decorator_list or class_.keywords:
            return None
        if not _has_known_bases(module, class_) or _looks_up_names(module):
            return None
        if _is_named_once(module, class_.name):
            return _Unmentioned((class_.name,), (*_NAMING, ".xml"))
        return None
    return None


def _is_named_once(module: PythonModule, name: str) -> bool:
    return _named_in(without_comments(module.source.text), name) == 1


def _covers(node: ast.stmt, line: int) -> bool:
    return node.lineno <= line <= (node.end_lineno or node.lineno)


def _has_known_bases(module: PythonModule, class_: ast.ClassDef) -> bool:
    bases = {module.qualified_name(base) for base in class_.bases}
    return bases <= {NODE, "rclpy.Node", "object"}


def _is_startable(module: PythonModule) -> bool:
    """Return whether a module is a launch file, or may be a program."""
    is_program = module.has_main_guard or "main" in module.functions
    return is_program or _is_launch_file(module.path)


def is_unused_module(package: Package, path: str) -> bool:
    """Return whether no file mentions a module next to programs, and it is no program itself.

    Searches the text of files, without parsing them. A module with ``main()`` or a main guard may
    be started as a file, unless it is installed in a Python package without an entry point, where
    ``ros2 run`` does not find it.

    Raises:
        ViewError: the file cannot be read.
    """
    name = path.rpartition("/")[2]
    stem = name.removesuffix(".py")
    if is_in_tests(path) or name.startswith("__") or stem.endswith("launch"):
        return False

    def find() -> bool:
        text = package.data(path)
        has_guard = b"__main__" in text and not _IMPORTS_RELATIVELY.search(text)
        is_startable = has_guard or b"def main(" in text
        if (
            not _has_programs(package)
            or (is_startable and not _is_only_importable(package, path))
            or is_named(package, path, stem, TEXTS if is_startable else ())
        ):
            return False
        return not any(_is_file_named_in(user, path, stem) for user in package.workspace)

    return package.remember(("unused module", path), find)


def _is_only_importable(package: Package, path: str) -> bool:
    """Return whether setup.py installs a module in a Python package alone, not as a program."""
    if package.build_type != "ament_python" or not is_in_python_package(package, path):
        return False
    data = installed_data(package)
    return data is not None and path not in data and package.setup_py.entry_points_complete


def _helps_programs(package: Package, module: PythonModule) -> bool:
    """Return whether a module is there for launch files, or for programs of its own package."""
    return not _LAUNCH.isdisjoint(module.imports_by_root) or _has_programs(package)


@fact
def _has_programs(package: Package) -> bool:
    try:
        is_cmake = package.build_type == "ament_cmake"
        if is_cmake:
            return bool(programs(package))
        return bool(package.setup_py.console_scripts) or has_program_files(package)
    except ViewError:
        return False


def _guard_at(package: Package, module: PythonModule, line: int) -> _Unmentioned | None:
    """Return the main guard at a line, if it only runs if Python runs the file, which nobody does.

    A launch file launches nothing then; a module of a Python package is started by entry points.
    """
    guard = module.main_guard_node
    if guard is None or not guard.lineno <= line <= (guard.end_lineno or guard.lineno):
        return None
    path = module.path
    if _is_launch_file(path):
        return None if module.mentions("LaunchService") else _Unmentioned((), is_guard=True)
    if module.in_tests or not _is_only_importable(package, path):
        return None
    dotted = path.removesuffix(".py").replace("/", ".")
    return _Unmentioned((path.rpartition("/")[2], f"-m {dotted}"), is_guard=True)


def _outermost_function(module: PythonModule, line: int) -> FunctionNode | None:
    """Return the module-level function or method at a line."""
    for node in module.function_nodes:
        if node.lineno <= line <= (node.end_lineno or node.lineno):
            parents = [*module.parents(node)]
            is_outer = not any(isinstance(item, ast.FunctionDef | ast.Lambda) for item in parents)
            return node if is_outer else None
    return None


def _is_decorated(module: PythonModule, function: FunctionNode) -> bool:
    """Return whether a function may be reached other than by its name; always so for a property.

    Tests ask for a fixture of their file by its name.
    """
    given = function.decorator_list
    if module.in_tests and not module.path.endswith("conftest.py"):
        given = [item for item in given if module.qualified_name(item) != "pytest.fixture"]
    return any(getattr(item, "id", "") != "property" for item in given)


def _is_called_by_name(module: PythonModule, function: FunctionNode) -> bool:
    """Return whether a function is not called implicitly by Python, rclpy, or an unknown base."""
    if function.name in _ENTRIES | _OF_FILES or function.name.startswith("__"):
        return False
    class_ = module.enclosing_class(function)
    if module.in_tests:
        return class_ is None and _OF_PYTEST.match(function.name) is None
    if class_ is None:
        return True
    if class_.decorator_list or class_.keywords or has(NODE, function.name):
        return False
    return _has_known_bases(module, class_) or bool(_CALLBACK.search(function.name))


def _is_file_named_in(package: Package, module_path: str, stem: str) -> bool:
    """Return whether another file of a package may import or start a module."""
    for path in package.files:
        if not path.endswith(_NAMING) or path == module_path:
            continue
        try:
            data = package.data(path)
        except ViewError:
            return True
        code = code_with(data, stem.encode("utf-8", "surrogateescape"))
        if names_file(code, stem, is_python=path.endswith(".py")):
            return True
    return False


def _is_named_in(
    package: Package, module_path: str, names: tuple[str, ...], endings: tuple[str, ...]
) -> bool:
    """Return whether another module of a package mentions all of some names."""
    words = [name.encode("utf-8", "surrogateescape") for name in names]
    for path in package.files:
        if not path.endswith(endings) or path == module_path:
            continue
        try:
            data = _cpp(package, path) if path.endswith(_CPP) else package.data(path)
        except ViewError:
            return True
        if all(word in data for word in words):
            text = without_comments(data.decode(errors="replace"))
            if _has_names(text, names):
                return True
    return False


def _cpp(package: Package, path: str) -> bytes:
    """Return the code of a C++ file; empty if it is too large for one that calls Python."""

    def read() -> bytes:
        try:
            return package.bytes_of(path, most_bytes(path))
        except OSError:
            return b""

    return package.remember(("C++", path), read)


def _has_names(text: str, names: tuple[str, ...]) -> bool:
    """Return whether a text has all of some names, and the last one not as its own function."""
    own = len(re.findall(rf"\bdef\s+{re.escape(names[-1])}\b", text))
    return _named_in(text, *names) > 0 and _named_in(text, names[-1]) > own


def _named_in(text: str, *names: str) -> int:
    """Return the count of the least frequent of some names in a text."""
    return min(len(re.findall(rf"\b{re.escape(name)}\b", text)) for name in names)
