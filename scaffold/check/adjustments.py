"""Adjusts findings to the configuration: severities, exclusions, style."""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterable, Iterator, Mapping

from scaffold import lazy_re
from scaffold.ament.codes import STYLE
from scaffold.ament.settings import settings_of
from scaffold.check import conflicts
from scaffold.check.rules.engine_rules import RuleCrashed, UnparsableFile
from scaffold.configuration.exclusion import Exclusion
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.model.contents.dead_code import is_dead
from scaffold.model.contents.python_facts import imports_of, paths_importing
from scaffold.model.discovery.colcon import is_ignored
from scaffold.model.discovery.foreign import ENVIRONMENTS, Foreign
from scaffold.model.install.reach import is_never_run, is_unreached
from scaffold.model.install.unused import is_apart, is_copy_of_old_code
from scaffold.model.launch.unused.unlaunched import is_in_unlaunched_action
from scaffold.model.launch.unused.unused_files import is_left_alone
from scaffold.model.messages.sent import sends_nothing
from scaffold.model.package import Package
from scaffold.model.python.conditions.guards import all_conditions, is_unevaluated
from scaffold.model.python.module import PythonModule
from scaffold.model.rclpy.running.stopping import only_while_stopping
from scaffold.model.rclpy.running.uncalled import is_uncalled
from scaffold.record import NamedTuple
from scaffold.source import Location, ViewError

_OF_LINTERS = ("E9", "F")
_OF_SYNTAX = "E9"
"""The first part of codes that also concern whoever compiles an installed file."""
_OF_PROGRAMS = ("IM", "LF", "MS", "ND", "TY")
"""Areas of rules about run-time behavior."""
_OF_BUILDS = ("CM", "LY", "PX", "SP")
"""Areas of rules about building, installing and testing with colcon."""
_OF_ACTIONS = (
    *(
        "LF006",
        "LF010",
        "LF016",
        "LF044",
        "LF045",
        "LF053",
        "LF058",
        "LF060",
        "LF065",
        "LF066",
        "LF067",
    ),
    *("LF08", "PF"),
)
"""Areas and codes of rules about what happens when an action of a launch file is executed."""
_OF_DATA = ("PF", "UR", UnparsableFile.code)
"""Areas and codes of rules about data files of programs."""
_ENDINGS_OF_DATA = (".yaml", ".yml", ".urdf", ".xacro", ".sdf")
_RAISED_ANYWAY = "F901"
"""``raise NotImplemented()`` raises another exception."""
_OF_TESTS = frozenset({"LY020", "LY021", "PX050"})
"""Codes that are errors only if a test of the package checks the file."""
_QUOTED = lazy_re.compile(r"'([^']+)'")
_UNDEFINED = "F821"
_OF_FIELDS = "MS006"
"""The code of values in fields of messages."""
_UNSENT = "it cannot be published"
"""The end of what the type checker reports about fields of messages."""
_OF_CALLS = "never call"
"""Part of messages about code that is not called, but should be."""
_OF_FORMATS = ("F50", "F52")
"""The first parts of codes about the format of a text."""
_UNDECLARED = "PX020"
"""Codes of undeclared dependencies, reported at an import."""
_OF_ROS1 = "IM044"
"""The code of imports from ROS 1."""
_FALSE = frozenset({"false", "none", "null"})
"""Names of other languages, or misspelled ones, for what is not true."""
_PLATFORMS = ("os.name", "sys.platform", "platform.system")
"""Words of conditions on the platform."""


class Adjustments(NamedTuple):
    """Applied to all findings, before anything is reported or fixed."""

    severities: Mapping[str, Severity] = {}
    """The severities by code prefix; the longest matching one decides."""
    has_own_style_only: bool = False
    """Whether style is only reported where a test of the package would do so."""
    exclusion: Exclusion = Exclusion()
    refused_at_release: Collection[str] = ()
    """Codes that are errors because they block a release."""
    foreign: Foreign | None = None
    """Decides which files are foreign; by default none."""

    def apply(self, package: Package, diagnostics: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
        """Yield the findings to report, with their severities."""
        excluded: dict[str, bool] = {}
        for diagnostic in diagnostics:
            path = diagnostic.location.path
            if path not in excluded:
                excluded[path] = self.excludes(package, path)
            if excluded[path] and diagnostic.code != RuleCrashed.code:
                continue
            if (
                self.has_own_style_only
                and diagnostic.code in STYLE
                and not runs_linter(package, diagnostic)
            ):
                continue
            severity = self._severity(diagnostic.code)
            is_error = diagnostic.severity is Severity.ERROR
            if severity is None and is_error and _is_harmless_there(package, diagnostic):
                severity = Severity.WARNING
            yield diagnostic if severity is None else diagnostic._replace(severity=severity)

    def excludes(self, package: Package, path: str) -> bool:
        """Return whether a file of a package is skipped."""
        return path in self.foreign_files(package) or self._is_excluded(package, path)

    def foreign_files(self, package: Package) -> Mapping[str, str]:
        """Return the foreign files of a package, each with its kind."""
        foreign = self.foreign
        if foreign is None or not package.directory:
            return {}

        def find() -> Mapping[str, str]:
            disk = package.outside
            top = disk.real(package.directory)
            kinds = (
                (path, foreign.kind_of(disk, f"{top}/{path}", is_directory=False))
                for path in package.files
            )
            environments = getattr(package.tree, "environments", ())
            foreign_paths = {path: kind for path, kind in kinds if kind}
            return {**foreign_paths, **dict.fromkeys(environments, ENVIRONMENTS)}

        return package.remember("foreign files", find)

    def _is_excluded(self, package: Package, path: str) -> bool:
        if not self.exclusion.patterns:
            return False
        place = package.remember(
            "relative to the configuration",
            lambda: self.exclusion.relative(package.outside, package.directory),
        )
        if place is None:
            return False
        return self.exclusion.covers_relative(f"{place}/{path}" if place else path)

    def _severity(self, code: str) -> Severity | None:
        fitting = [prefix for prefix in self.severities if code.startswith(prefix)]
        if fitting:
            return self.severities[max(fitting, key=len)]
        return Severity.ERROR if code in self.refused_at_release else None


def _is_harmless_there(package: Package, diagnostic: Diagnostic) -> bool:
    """Return whether an error is in a package that colcon never builds, or in unused code."""
    is_built = not is_ignored(package)
    if not is_built and diagnostic.code.startswith(_OF_BUILDS):
        return True
    return _is_of_unused_code(package, diagnostic)


def _is_of_unused_code(package: Package, diagnostic: Diagnostic) -> bool:
    """Return whether an error is in unused code that no test of the package checks."""
    path, code = diagnostic.location.path, diagnostic.code
    if code == _UNDECLARED:
        return _is_needed_by_unused_code(package, diagnostic)
    if code.startswith(_OF_DATA) and path.endswith(_ENDINGS_OF_DATA):
        if diagnostic.message.startswith(conflicts.MARKS):
            return False
        return is_copy_of_old_code(package, path) or is_left_alone(package, path)
    is_copy = code not in _OF_TESTS and is_copy_of_old_code(package, path)
    if not path.endswith(".py") or is_copy:
        return is_copy and not _is_tested(package, diagnostic)
    if code == _UNDEFINED and _is_harmless(package, diagnostic):
        return True
    return not _is_tested(package, diagnostic) and _is_unreached(package, diagnostic)


def _is_unreached(package: Package, diagnostic: Diagnostic) -> bool:
    """Return whether an error is in Python code that is never run."""
    path, code = diagnostic.location.path, diagnostic.code
    is_of_example = code not in _OF_TESTS and path.startswith(("doc/", "docs/"))
    if is_of_example or code == _RAISED_ANYWAY or _is_of_ros1(package, diagnostic):
        return True
    if code.startswith(_OF_ACTIONS) and _is_unlaunched(package, diagnostic.location):
        return True
    if code.startswith(_OF_SYNTAX):
        if _is_of_other_interpreter(package, path):
            return True
        return is_apart(package, path) and is_unreached(package, path)
    return code.startswith((*_OF_LINTERS, *_OF_PROGRAMS)) and (
        is_unreached(package, path)
        or _is_of_container(package, diagnostic)
        or _is_uncalled(package, diagnostic)
        or _is_hardly_reached(package, diagnostic)
    )


def _is_of_other_interpreter(package: Package, path: str) -> bool:
    """Return whether the first line of a file names a program other than Python, such as bash."""
    try:
        first = package.data(path).partition(b"\n")[0]
    except ViewError:
        return False
    return first.startswith(b"#!") and b"python" not in first


def _is_of_ros1(package: Package, diagnostic: Diagnostic) -> bool:
    """Return whether an error is in a file for ROS 1, which ROS 2 stops at ``import rospy``."""
    path, code = diagnostic.location.path, diagnostic.code
    if code == _OF_ROS1 or not code.startswith((*_OF_LINTERS, *_OF_PROGRAMS)):
        return False
    try:
        imports = imports_of(package, path) if b"rospy" in package.data(path) else ()
    except ViewError:
        return False
    needed = {item.root for item in imports if item.top_level and not item.guarded}
    return "rospy" in needed and "rclpy" not in needed


def _is_tested(package: Package, diagnostic: Diagnostic) -> bool:
    """Return whether a test of the package fails, even if the code is never run.

    An undefined name in unused code is a style finding, like an unused one.
    """
    code = diagnostic.code
    is_of_linters = code.startswith(_OF_LINTERS) and code != _UNDEFINED
    return is_of_linters and runs_linter(package, diagnostic)


def _is_needed_by_unused_code(package: Package, undeclared: Diagnostic) -> bool:
    """Return whether only unused code imports an undeclared package.

    It is reported at the first of the files that import it.
    """
    needed = _QUOTED.search(undeclared.message)
    if needed is None or not _is_unused_import(package, undeclared.location):
        return False  # before the imports of all files are looked at
    return all(
        _is_unused_import(package, item.location)
        for path in paths_importing(package, needed[1])
        for item in imports_of(package, path)
        if item.root == needed[1]
    )


def _is_unused_import(package: Package, at: Location) -> bool:
    """Return whether an import is in a file that is never run, or in code that is not reached."""
    return is_never_run(package, at.path) or _is_dead_or_uncalled(package, at)


def _is_of_container(package: Package, diagnostic: Diagnostic) -> bool:
    """Return whether a message has a wrong field in a package that sends none."""
    if diagnostic.code != _OF_FIELDS and not diagnostic.message.endswith(_UNSENT):
        return False
    try:
        return sends_nothing(package)
    except ViewError:
        return False


def _is_uncalled(package: Package, diagnostic: Diagnostic) -> bool:
    """Return whether an error is in code that is not reached.

    An undefined name in the first line of a function is evaluated when that is defined.
    """
    if _OF_CALLS in diagnostic.message:
        return False
    is_undefined = diagnostic.code == _UNDEFINED
    is_early = is_undefined and any(
        any(isinstance(item, ast.arguments) for item in module.parents(name))
        for module, name in _names_at(package, diagnostic)
    )
    return not is_early and _is_dead_or_uncalled(package, diagnostic.location)


def _is_dead_or_uncalled(package: Package, at: Location) -> bool:
    try:
        return is_dead(package, at.path, at.line) or is_uncalled(package, at.path, at.line)
    except ViewError:
        return False


def _is_unlaunched(package: Package, at: Location) -> bool:
    """Return whether code is in an action that is never put into the LaunchDescription."""
    try:
        return is_in_unlaunched_action(package, at.path, at.line, at.column)
    except ViewError:
        return False


def _is_hardly_reached(package: Package, undefined: Diagnostic) -> bool:
    """Return whether an undefined name is only evaluated after spin, elsewhere, or never.

    An undefined exception ends what the intended one would have ended, as does an error in the
    message of one that is handled and raised.
    """
    if undefined.code.startswith(_OF_FORMATS):
        return _is_before_raise(package, undefined.location)
    if undefined.code != _UNDEFINED:
        return False
    return any(
        only_while_stopping(module, name)
        or _is_of_platform(module, name)
        or _is_raised(module, name)
        for module, name in _names_at(package, undefined)
    )


def _is_before_raise(package: Package, at: Location) -> bool:
    """Return whether a line is in the handler of an exception that ends with another one."""
    try:
        module = package.module(at.path)
    except ViewError:
        return False
    return any(
        isinstance(handler.body[-1], ast.Raise) and handler.lineno <= at.line <= end
        for handler in module.walk(ast.ExceptHandler)
        if (end := handler.end_lineno or 0)
    )


def _is_raised(module: PythonModule, name: ast.expr) -> bool:
    """Return whether a name is that of an exception, so that a NameError is raised instead.

    ``assert false`` fails anyway.
    """
    above = module.parent(name)
    if isinstance(above, ast.Assert) and isinstance(name, ast.Name):
        return name is above.test and name.id.lower() in _FALSE
    if isinstance(above, ast.Call) and above.func is name:
        above = module.parent(above)
    return isinstance(above, ast.Raise)


def _is_of_platform(module: PythonModule, name: ast.expr) -> bool:
    """Return whether code is for one platform: ``if os.name == 'nt'``."""
    return module.mentions(*_PLATFORMS) and any(
        word in module.text(condition.test)
        for condition in all_conditions(module, name)
        for word in _PLATFORMS
    )


def _is_harmless(package: Package, undefined: Diagnostic) -> bool:
    """Return whether an undefined name is not evaluated, or exists at run time.

    Such as annotations, modules that ``from .talk import *`` adds to their package, and names that
    ``globals().update(...)`` or a function adds.
    """
    return any(
        is_unevaluated(module, name)
        or _is_own_module(module, name)
        or _adds_globals(module)
        or _is_set_by_function(module, name)
        for module, name in _names_at(package, undefined)
    )


def _is_set_by_function(module: PythonModule, name: ast.expr) -> bool:
    """Return whether a function sets a global variable that the module only annotates."""
    return isinstance(name, ast.Name) and any(
        name.id in statement.names for statement in module.walk(ast.Global)
    )


def _is_own_module(module: PythonModule, name: ast.expr) -> bool:
    if not module.path.endswith("__init__.py") or not isinstance(name, ast.Name):
        return False
    own = (item.module.partition(".")[0] for item in module.imports if item.level == 1)
    return name.id in own


def _adds_globals(module: PythonModule) -> bool:
    """Return whether a module sets global variables whose names are not in its text."""
    if not module.mentions("globals()"):
        return False
    calls = [node for node in module.walk(ast.Call) if module.text(node.func) != "eval"]
    written = (
        *(node.value for node in module.walk(ast.Attribute) if node.attr == "update"),
        *(node.value for node in module.walk(ast.Subscript) if isinstance(node.ctx, ast.Store)),
        *(
            value
            for call in calls
            for value in (*call.args, *(word.value for word in call.keywords))
        ),
    )
    return any(isinstance(node, ast.Call) and module.text(node) == "globals()" for node in written)


def _names_at(package: Package, diagnostic: Diagnostic) -> Iterator[tuple[PythonModule, ast.expr]]:
    """Yield the names and strings at the location of a finding, with their module."""
    at = diagnostic.location
    try:
        module = package.module(at.path)
    except ViewError:
        return
    for name in (*module.walk(ast.Name), *module.walk(ast.Constant)):
        if (name.lineno, name.col_offset + 1) == (at.line, at.column):
            yield module, name


def runs_linter(package: Package, style: Diagnostic) -> bool:
    """Return whether a test of the package itself would report a style finding."""
    return settings_of(package).is_tested(style.location.path, style.code)
