"""Paths below share directories that modules read, also through helpers and parameters."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.facts import fact
from scaffold.model.launch.evaluation.evaluator import LaunchEvaluator, share_path
from scaffold.model.launch.python_file import LaunchFile, SharePath
from scaffold.model.package import mentions
from scaffold.model.python.conditions.handlers import last_name
from scaffold.model.python.evaluation.given_arguments import argument_of, given_argument
from scaffold.model.python.evaluation.values import UNKNOWN
from scaffold.model.rclpy.file import rclpy_file
from scaffold.model.remembered import remembered_list
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule
    from scaffold.model.rclpy.file import RclpyFile
    from scaffold.source import Location

_SHARE = "get_package_share_"
"""The start of the functions that return the share directory of a package."""
_READING = lazy_re.compile(
    r"(?i:(?:im|safe_|full_)?(?:read|load)\w*|parse|fromfile|from_file|loadtxt|genfromtxt)"
)
"""Matches functions that read a file."""
_TESTING = ("exists", "isfile", "isdir", "is_file", "is_dir")
"""Functions and methods that test whether there is a path."""
_GIVEN = "\0"
"""Stands for the argument of a call in the path of a helper."""


class NamedPath(NamedTuple):
    """A path below the share directory of a package in a launch file or a module."""

    package: str
    path: str
    location: Location


class HelperPath(NamedTuple):
    """A path that a function reads, with the place of one of its arguments."""

    function: str
    parameter: str
    package: str
    path: str
    """With ``_GIVEN`` in place of the argument."""


class ModuleFile(LaunchFile):
    """A module that is no launch file; its paths may name default values of parameters."""

    def __init__(self, file: RclpyFile, package_name: str) -> None:
        super().__init__(file.module, package_name)
        self.evaluator = _ModuleEvaluator(file, package_name)

    def is_extended(self, node: ast.expr) -> bool:
        """Return whether an expression is only the start of an unknown path, in no variable."""
        is_kept = isinstance(self.module.parent(node), ast.Assign | ast.AnnAssign)
        return not is_kept and super().is_extended(node)

    @classmethod
    def of(cls, package: Package, path: str) -> ModuleFile:
        """Return the view of a Python file; raises ViewError."""
        file = rclpy_file(package, path)
        return package.remember(("module_py", path), lambda: cls(file, package.name))


class _ModuleEvaluator(LaunchEvaluator):
    """An evaluator that knows the defaults of ROS parameters and of arguments."""

    def __init__(self, file: RclpyFile, package_name: str) -> None:
        super().__init__(file.module, package_name)
        self._file = file
        self.is_given = False
        """Whether the parameters of functions stand for themselves."""

    def argument(self, node: ast.arg) -> object:
        """Return the argument of the only call, else the default."""
        if self.is_given:
            return f"{_GIVEN}{node.arg}{_GIVEN}"
        value = super().argument(node)
        function = self.module.parent(self.module.parent(node) or node)
        if value is not UNKNOWN or not isinstance(function, ast.FunctionDef):
            return value
        nothing = ast.Call(ast.Name(""), [], [])
        return self.text(given_argument(function, nothing, node, is_method=False))

    def attribute(self, node: ast.Attribute) -> object:
        """Return the default of a parameter, or the only value of an attribute."""
        return self._file.evaluator.evaluate(node)


@fact
def helper_paths(package: Package, path: str) -> tuple[HelperPath, ...]:
    """Return the paths that the functions of a module read and that contain an argument."""
    file = rclpy_file(package, path)
    evaluator = _ModuleEvaluator(file, package.name)
    evaluator.is_given = True
    result: dict[HelperPath, None] = {}
    for call in file.module.walk(ast.Call):
        function = file.module.enclosing_function(call)
        if isinstance(function, ast.FunctionDef) and function.name in file.module.functions:
            found = share_path(evaluator.joined_text(call))
            is_read = found is not None and is_only_read(file.module, call)
            if found is not None and is_read and found[1].count(_GIVEN) == len(_GIVEN) * 2:
                before, parameter, after = found[1].split(_GIVEN)
                item = HelperPath(function.name, parameter, found[0], before + _GIVEN + after)
                result[item] = None
    return tuple(result)


@remembered_list
def _helpers(package: Package) -> Iterator[HelperPath]:
    """Return the helpers of all modules."""
    for path in package.python_files:
        with suppress(ViewError):
            if mentions(package, path, _SHARE):
                yield from helper_paths(package, path)


@fact
def paths_of_module(package: Package, path: str) -> tuple[NamedPath, ...]:
    """Return the paths that a module only reads, itself or through helpers of the package."""
    result: list[NamedPath] = []
    if mentions(package, path, _SHARE):
        file = ModuleFile.of(package, path)
        result = [
            NamedPath(item.package, item.path, item.location)
            for item in file.share_paths
            if not file.is_optional(item.node)
            and (is_only_read(file.module, item.node) or _is_in_sources(package, file, item))
        ]
    return (*result, *_paths_given(package, path))


def _is_in_sources(package: Package, file: ModuleFile, item: SharePath) -> bool:
    """Return whether a path is that of a file or directory in the sources, which is not tested."""
    if item.package != package.name or any(map(file.module.mentions, _TESTING)):
        return False
    return package.has(item.path) or package.has_directory(item.path.rstrip("/"))


def _paths_given(package: Package, path: str) -> Iterator[NamedPath]:
    """Yield the paths that helpers of the package read for the arguments of calls in a file."""
    names = {helper.function for helper in _helpers(package)}
    if not any(mentions(package, path, name) for name in names):
        return
    module = package.module(path)
    for call in module.walk(ast.Call):
        owner, _, name = (module.qualified_name(call.func) or "").rpartition(".")
        file = f"{owner.replace('.', '/')}.py" if owner else ""
        if not file or not package.has(file):
            continue
        with suppress(ViewError):
            for helper in helper_paths(package, file):
                if helper.function == name:
                    yield from _given(package, file, helper, call, path)


def _given(
    package: Package, file: str, helper: HelperPath, call: ast.Call, path: str
) -> Iterator[NamedPath]:
    function = package.module(file).functions[helper.function].node
    named = {item.arg: item for item in (*function.args.args, *function.args.kwonlyargs)}
    parameter = named.get(helper.parameter)
    if parameter is None or not isinstance(function, ast.FunctionDef):
        return
    match given_argument(function, call, parameter, is_method=False):
        case ast.Constant(value=str(text)) as node if node in ast.walk(call):
            at = package.module(path).location(node)
            yield NamedPath(helper.package, helper.path.replace(_GIVEN, text), at)


def is_only_read(module: PythonModule, node: ast.expr) -> bool:
    """Return whether a path is only opened for reading, and not passed to other functions."""
    holder = module.parent(node)
    targets = holder.targets if isinstance(holder, ast.Assign) else ()
    texts = {module.text(target) for target in targets} or {module.text(node)}
    calls = [
        call
        for call in module.walk(ast.Call)
        if not texts.isdisjoint(map(module.text, (*call.args, *_owner(call))))
    ]
    return bool(calls) and all(map(_is_read, calls))


def _owner(call: ast.Call) -> Iterator[ast.expr]:
    """Yield the object of a method call: the path in ``path.read_text()``."""
    if isinstance(call.func, ast.Attribute):
        yield call.func.value


def _is_read(call: ast.Call) -> bool:
    """Return whether a call reads the file passed to it."""
    name = last_name(call.func)
    if name != "open":
        return _READING.fullmatch(name) is not None
    mode = argument_of(call, "mode", 1)
    return mode is None or (isinstance(mode, ast.Constant) and not {*"wax+"} & {*str(mode.value)})
