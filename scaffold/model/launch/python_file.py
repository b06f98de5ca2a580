"""Static analysis of a Python launch file."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from typing import TYPE_CHECKING

from scaffold.model.launch.calls import LaunchCall, launch_call
from scaffold.model.launch.evaluation.cases import Case, cases, innermost_frame
from scaffold.model.launch.evaluation.evaluator import LaunchEvaluator, share_path
from scaffold.model.package import mentions
from scaffold.model.python.evaluation.given_arguments import given_once
from scaffold.model.python.evaluation.values import UNKNOWN, Unknown
from scaffold.model.python.module import is_in_tests
from scaffold.model.remembered import remembered_list
from scaffold.record import NamedTuple
from scaffold.source import Location, ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.module import Function, PythonModule

FUNCTION = "generate_launch_description"
NODES = ("Node", "LifecycleNode", "ComposableNodeContainer")
"""Actions that start a process with a node."""

_ROOTS = frozenset({"launch", "launch_ros"})


class PackageUse(NamedTuple):
    """A reference to a package in a launch file."""

    name: str
    location: Location
    node: ast.expr
    action: LaunchCall | None
    """The node action; ``None`` if a file of the package is used."""


class SharePath(NamedTuple):
    """A path below the share directory of a package."""

    package: str
    path: str
    """Relative to ``share/<package>``, normalised."""
    location: Location
    node: ast.expr


@remembered_list
def launch_paths(package: Package) -> Iterator[str]:
    """Return the Python files that import launch, except those only used by tests."""
    for path in package.python_files:
        with suppress(ViewError):
            imports_launch = not _ROOTS.isdisjoint(package.imports(path))
            if imports_launch and not is_in_tests(path) and ".test." not in path:
                yield path


class LaunchFile:
    """A Python launch file."""

    def __init__(self, module: PythonModule, package_name: str) -> None:
        self.module = module
        self.path = module.path
        self.package_name = package_name
        self.evaluator = LaunchEvaluator(module, package_name)

    @classmethod
    def of(cls, package: Package, path: str) -> LaunchFile:
        """Return the view of a Python file.

        Raises:
            ViewError: there is no such file, or it cannot be parsed.
        """
        module = package.module(path)
        return package.remember(("launch_py", path), lambda: cls(module, package.name))

    @classmethod
    def mentioning(cls, package: Package, word: str) -> Iterator[LaunchFile]:
        """Yield the launch files of a package with a word, except those only used by tests."""
        for path in launch_paths(package):
            with suppress(ViewError):
                if mentions(package, path, word):
                    yield cls.of(package, path)

    @property
    def function(self) -> Function | None:
        """``generate_launch_description``."""
        return self.module.functions.get(FUNCTION)

    # -- calls

    @cached_property
    def calls(self) -> Sequence[LaunchCall]:
        """All calls of launch, in the order of the text."""
        views = (launch_call(self.module, call) for call in self.module.walk(ast.Call))
        calls = [call for call in views if call is not None]
        replaced = self._replaced
        if not replaced:
            return calls
        return [
            call
            for call in calls
            if not any(parent in replaced for parent in self.module.parents(call.call))
        ]

    @cached_property
    def _replaced(self) -> set[ast.stmt]:
        """The functions of the module that a later one of the same name replaces."""
        last: dict[str, ast.stmt] = {}
        result: set[ast.stmt] = set()
        for statement in self.module.tree.body:
            if isinstance(statement, ast.FunctionDef):
                earlier = last.get(statement.name)
                if earlier is not None:
                    result.add(earlier)
                last[statement.name] = statement
        return result

    def find(self, *kinds: str) -> list[LaunchCall]:
        """Return the calls of some kinds, in the order of the text."""
        return [call for call in self.calls if call.kind in kinds]

    def call_of(self, node: ast.expr | None) -> LaunchCall | None:
        """Return the call of an expression, also through a name assigned once."""
        for _ in range(10):
            if isinstance(node, ast.Call):
                return launch_call(self.module, node)
            bound = self.module.index.only_node(node)
            value = self.module.index.only_value(node)
            node = given_once(self.module, bound) if isinstance(bound, ast.arg) else value
        return None

    def text(self, call: LaunchCall, name: str) -> str | Unknown | None:
        """Return the text of an argument; ``None`` if not given."""
        if name not in call.given:
            return UNKNOWN if call.is_open else None
        return self.evaluator.joined_text(call.given[name])

    def cases(self, node: ast.AST) -> Sequence[Case]:
        """Return the calls of functions and turns of loops around an expression, if known."""
        return cases(self.evaluator, node)

    def location(self, node: ast.AST) -> Location:
        """Return the place of a node."""
        return self.module.location(node)

    # -- launch arguments

    @cached_property
    def declared(self) -> Mapping[str, LaunchCall]:
        """The launch arguments that are declared with a known name."""
        result: dict[str, LaunchCall] = {}
        for call in self.find("DeclareLaunchArgument"):
            name = self.text(call, "name")
            if isinstance(name, str):
                result.setdefault(name, call)
        return result

    def default_of(self, node: ast.expr | None) -> str | Unknown:
        """Return the text of a LaunchConfiguration that is not set."""
        call = self.call_of(node)
        if call is None or call.kind != "LaunchConfiguration":
            return UNKNOWN
        declared = self.declared.get(str(self.text(call, "variable_name")))
        if declared is not None:
            return self.text(declared, "default_value") or UNKNOWN
        return self.text(call, "default") or UNKNOWN

    # -- references

    @cached_property
    def package_uses(self) -> Sequence[PackageUse]:
        """The packages whose nodes it starts or whose files it uses."""
        uses: list[PackageUse] = []
        for call in self.calls:
            if call.kind in {*NODES, "ComposableNode"}:
                node, action = call.given.get("package"), call
            elif call.kind in {"FindPackageShare", "get_package_share_directory"} | {
                "get_package_share_path"
            }:
                node, action = next(iter(call.given.values()), None), None
            else:
                continue
            name = self.evaluator.joined_text(node)
            if node is not None and isinstance(name, str) and name:
                uses.append(PackageUse(name, self.location(node), node, action))
        return uses

    @cached_property
    def programs(self) -> Sequence[tuple[str, ast.expr]]:
        """The programs run by name, ``xacro`` or ``ros2 bag``, with their locations."""
        result: list[tuple[str, ast.expr]] = []
        looked_for = {self.text(call, "name") for call in self.find("FindExecutable")}
        for call in self.find("Command", "FindExecutable", "ExecuteProcess", "ExecuteLocal"):
            key = {"Command": "command", "FindExecutable": "name"}.get(call.kind, "cmd")
            node = call.given.get(key)
            if node is None and call.call.args:
                node = call.call.args[0]
            words, place = self._words(node)
            is_looked_for = (
                call.kind != "FindExecutable"
                and isinstance(place, ast.Call | ast.Name)
                and words[:1] != ["ros2"]
                and not looked_for.isdisjoint(words[:1])
            )
            if words and place is not None and not is_looked_for:
                name = " ".join(words[:2]) if words[0] == "ros2" else words[0]
                result.append((name, place))
        return result

    def _words(self, node: ast.expr | None) -> tuple[list[str], ast.expr | None]:
        """Return the known first words of a command, and their location."""
        text = self.evaluator.evaluate(node) if node is not None else UNKNOWN
        if isinstance(text, str):
            return text.split()[:2], node
        words: list[str] = []
        items = self.evaluator.elements(node).items if node is not None else ()
        for item in items[:2]:
            value = self.evaluator.evaluate(item.node)
            if not isinstance(value, str):
                break
            words += value.split()
        return words[:2], items[0].node if items else None

    def is_optional(self, node: ast.AST) -> bool:
        """Return whether an expression may fail, or is evaluated only under a Python condition.

        Or never, after a ``return``, or as one of several paths of which a loop takes one that
        exists.
        """
        kinds = (ast.If, ast.IfExp, ast.Try, ast.match_case)
        return any(
            isinstance(parent, kinds)
            or parent in self.module.passed_over
            or (isinstance(parent, ast.For) and self._tests_paths(parent))
            for parent in self.module.parents(node)
        )

    def _tests_paths(self, loop: ast.For) -> bool:
        """Return whether a loop over paths tests which of them exist."""
        tests = " ".join(
            self.module.text(item.test) for item in ast.walk(loop) if isinstance(item, ast.If)
        )
        is_written = isinstance(loop.iter, ast.Tuple | ast.List) and len(loop.iter.elts) > 1
        return is_written and any(name in tests for name in ("exists(", "isfile(", "is_file("))

    @cached_property
    def share_paths(self) -> Sequence[SharePath]:
        """The complete paths below share directories."""
        candidates: list[ast.expr] = [*self.module.walk(ast.Call), *self.module.walk(ast.BinOp)]
        candidates += self.module.walk(ast.List)
        candidates += self.module.walk(ast.JoinedStr)
        paths: list[SharePath] = []
        for node in self._path_expressions(candidates):
            path = share_path(self.evaluator.joined_text(node))
            if path is not None:
                paths.append(SharePath(*path, self.location(node), node))
        return [*paths, *self._paths_by_case({path.node for path in paths}, candidates)]

    def _paths_by_case(
        self, known: set[ast.expr], candidates: Sequence[ast.expr]
    ) -> Iterator[SharePath]:
        """Yield the paths in helper functions and loops, at the arguments that complete them."""
        inside: dict[ast.AST, list[ast.expr]] = {}
        for node in candidates:
            frame = innermost_frame(self.module, node)
            if frame is not None:
                inside.setdefault(frame, []).append(node)
        seen: set[tuple[str, str, ast.expr]] = set()
        for frame, nodes in inside.items():
            known_cases = cases(self.evaluator, nodes[0])
            if known_cases and self._tests_files(frame):
                continue
            for case in known_cases:
                with self.evaluator.bound(case.values):
                    for node in self._path_expressions(nodes):
                        path = share_path(self.evaluator.joined_text(node))
                        place = case.place(self.module, node)
                        is_new = path is not None and (*path, place) not in seen
                        if path is None or node in known or place is node or not is_new:
                            continue
                        seen.add((*path, place))
                        if not self.is_optional(place):
                            yield SharePath(*path, self.location(place), node)

    def _tests_files(self, frame: ast.AST) -> bool:
        """Return whether a function or loop handles files that do not exist."""
        text = self.module.text(frame)
        return any(word in text for word in ("try:", "exists(", "isfile(", "is_file("))

    def _path_expressions(self, candidates: Sequence[ast.expr]) -> Iterator[ast.expr]:
        """Yield the outermost expressions that are paths below a share directory."""
        paths = {node for node in candidates if self._is_path(node)}
        for node in sorted(paths, key=lambda node: (node.lineno, node.col_offset)):
            parent = self.module.parent(node)
            above = self.module.parent(parent) if parent is not None else None
            if parent in paths or (isinstance(parent, ast.List) and above in paths):
                continue
            if not self.is_extended(node):
                yield node

    def _is_path(self, node: ast.expr) -> bool:
        if isinstance(node, ast.List):
            parent = self.module.parent(node)
            call = launch_call(self.module, parent) if isinstance(parent, ast.Call) else None
            source = call is not None and call.kind.endswith(("Source", "ParameterFile"))
            if not source and not isinstance(parent, ast.keyword):
                return False
            if isinstance(parent, ast.keyword) and parent.arg != "default_value":
                return False
        return share_path(self.evaluator.joined_text(node)) is not None

    def is_extended(self, node: ast.expr) -> bool:
        """Return whether an expression is only the start of an unknown path."""
        parent = self.module.parent(node)
        match parent:
            case ast.BinOp() | ast.FormattedValue() | ast.Attribute():
                return True
            case ast.Assign() | ast.AnnAssign():
                return "." not in str(self.evaluator.joined_text(node)).rpartition("/")[2]
            case ast.List():
                above = self.module.parent(parent)
                call = launch_call(self.module, above) if isinstance(above, ast.Call) else None
                joins = {"PathJoinSubstitution", "Command", "PythonLaunchDescriptionSource"}
                return call is not None and (
                    call.kind in joins or call.kind.endswith(("Source", "Substitution"))
                )
            case ast.Call():
                return self.module.qualified_name(parent.func) == "os.path.join"
            case _:
                return False
