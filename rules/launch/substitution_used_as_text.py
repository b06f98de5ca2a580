"""LF041: substitutions are not text while the launch file is read."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.launch_py import LaunchFile

_KINDS = frozenset(
    {"Command", "EnvironmentVariable", "FindPackageShare", "LaunchConfiguration"}
    | {"PathJoinSubstitution", "PythonExpression", "TextSubstitution", "ThisLaunchFileDir"}
)
_TEXT_FUNCTIONS = frozenset(
    {"os.path.join", "os.path.exists", "open", "int", "float", "os.path.isfile", "pathlib.Path"}
)
_METHODS = frozenset({"lower", "upper", "replace", "split", "strip", "format", "startswith"})
_LAUNCH = (
    "import os\n\nfrom launch import LaunchDescription\n"
    "from launch.substitutions import LaunchConfiguration, PathJoinSubstitution\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    name = LaunchConfiguration('name')\n"
    "    path = {}\n"
    "    return LaunchDescription([\n"
    "        Node(package='talker', executable='node', arguments=[path], name={}),\n    ])\n"
)


class SubstitutionUsedAsText(Rule):
    """A substitution such as LaunchConfiguration is used as text.

    **Why.** It has a value only later, when actions are executed: ``TypeError: join() argument
    must be str ... not 'LaunchConfiguration'``; in an f-string or a comparison it is an object,
    and the result silently wrong.

    **Fix.** A list of parts, ``['/', LaunchConfiguration('name')]``, PathJoinSubstitution,
    PythonExpression, or an OpaqueFunction.

    **Source.** ROS 2 documentation, "Using substitutions".
    """

    code = "LF041"
    name = "substitution-used-as-text"
    examples = (
        Example(
            "joined by launch",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "PathJoinSubstitution(['a', name])", "['x', name]"
                )
            },
        ),
        Example(
            "joined by Python",
            {"launch/a.launch.py": _LAUNCH.format("os.path.join('a', name)", "'x' + name")},
            at=("launch/a.launch.py:10", "launch/a.launch.py:12"),
        ),
        Example(
            "in an f-string",
            {"launch/a.launch.py": _LAUNCH.format("'a'", "f'x{name}'")},
            at=("launch/a.launch.py:12",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for launch in LaunchFile.of_package(package):
            for node, kind, what in _uses(launch):
                message = f"a {kind} has no text yet {what}: it is filled in when actions run"
                yield self.report(launch.location(node), message)


_Use = tuple[ast.expr, str, str]
"""What is used, its kind, and where."""


def _uses(launch: LaunchFile) -> Iterator[_Use]:
    """Yield the substitutions that Python treats as text."""
    module = launch.module
    for sum_ in module.walk(ast.BinOp):
        yield from _in_sum(launch, sum_)
    for call in module.walk(ast.Call):
        yield from _in_call(launch, call)
    for part in module.walk(ast.FormattedValue):
        kind = _kind(launch, part.value)
        if kind:
            yield part.value, kind, "in an f-string"
    for comparison in module.walk(ast.Compare):
        kind = _kind(launch, comparison.left)
        if kind and isinstance(comparison.ops[0], ast.Eq | ast.NotEq):
            yield comparison.left, kind, "to compare"


def _in_sum(launch: LaunchFile, sum_: ast.BinOp) -> Iterator[_Use]:
    for node, other in ((sum_.left, sum_.right), (sum_.right, sum_.left)):
        kind = _kind(launch, node) if isinstance(sum_.op, ast.Add) else ""
        if kind and isinstance(launch.evaluator.evaluate(other), str):
            yield sum_, kind, "to be added to"
            return


def _in_call(launch: LaunchFile, call: ast.Call) -> Iterator[_Use]:
    is_text = launch.module.qualified_name(call.func) in _TEXT_FUNCTIONS
    for node in call.args if is_text else ():
        kind = _kind(launch, node)
        if kind:
            yield node, kind, f"for {launch.module.text(call.func)}()"
    if not isinstance(call.func, ast.Attribute):
        return
    kind = _kind(launch, call.func.value)
    if kind and call.func.attr in _METHODS:
        yield call.func.value, kind, f"for {call.func.attr}()"
    elif kind and call.func.attr == "perform" and not call.args and not call.keywords:
        yield call, kind, "without a context"


def _kind(launch: LaunchFile, node: ast.expr) -> str:
    call = launch.call_of(node)
    return call.kind if call is not None and call.kind in _KINDS else ""
