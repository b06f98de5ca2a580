"""LF053: an included launch file gets the arguments that it has, and the source that reads it."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.launch_includes import Included, given_arguments, included
from scaffold.model.launch_py import LaunchCall, LaunchFile

_ENDINGS: Mapping[str, tuple[str, ...]] = {
    "PythonLaunchDescriptionSource": (".launch.xml", ".launch.yaml", ".launch.yml", ".xml"),
    "XMLLaunchDescriptionSource": (".py", ".yaml", ".yml"),
    "YAMLLaunchDescriptionSource": (".py", ".xml"),
}
_INCLUDED = (
    "from launch import LaunchDescription\n"
    "from launch.actions import DeclareLaunchArgument, LogInfo\n"
    "from launch.substitutions import LaunchConfiguration\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n        DeclareLaunchArgument('robot_name'),\n"
    "        LogInfo(msg=LaunchConfiguration('robot_name')),\n    ])\n"
)
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import IncludeLaunchDescription\n"
    "from launch.launch_description_sources import PythonLaunchDescriptionSource\n"
    "from launch.substitutions import PathJoinSubstitution\n"
    "from launch_ros.substitutions import FindPackageShare\n\n\n"
    "def generate_launch_description():\n"
    "    path = PathJoinSubstitution([FindPackageShare('talker'), 'launch', '{}'])\n"
    "    return LaunchDescription([\n        IncludeLaunchDescription(\n"
    "            PythonLaunchDescriptionSource(path),\n"
    "            launch_arguments={}.items(),\n        ),\n    ])\n"
)
_MANIFEST = "<package format='3'>\n  <name>talker</name>\n</package>\n"


def _files(path: str, given: str) -> dict[str, str]:
    return {
        "package.xml": _MANIFEST,
        "launch/a.launch.py": _LAUNCH.format(path, given),
        "launch/b.launch.py": _INCLUDED,
    }


class IncludeDoesNotFit(Rule):
    """An include gives another argument than the launch file has, or a value that is no text.

    **Why.** ``ros2 launch`` stops: ``Included launch description missing required argument
    'robot_name'``; ``'bool' object is not iterable``; ``invalid syntax`` where Python reads XML. An
    argument that the file does not have is dropped without a word.

    **Fix.** Write the name that the included file declares, and texts as values.

    **Source.** ``launch/actions/include_launch_description.py``.
    """

    code = "LF053"
    name = "include-does-not-fit"
    examples = (
        Example("given", _files("b.launch.py", "{'robot_name': 'a'}")),
        Example(
            "required, but not given",
            _files("b.launch.py", "{}"),
            at=("launch/a.launch.py:11",),
        ),
        Example(
            "misspelt, and a number",
            _files("b.launch.py", "{'robot_nam': 3}"),
            at=("launch/a.launch.py:13", "launch/a.launch.py:13"),
        ),
        Example(
            "XML for Python",
            _files("b.launch.xml", "{}"),
            at=("launch/a.launch.py:12",),
        ),
        Example("itself", _files("a.launch.py", "{}"), at=("launch/a.launch.py:11",)),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for launch in LaunchFile.of_package(package):
            for call in launch.find("IncludeLaunchDescription"):
                for name, _, value in given_arguments(launch, call) or ():
                    problem = _value_problem(launch, value)
                    if problem:
                        yield self.report(launch.location(value), f"{name!r} gets {problem}")
                node = call.given.get("launch_arguments")
                problem = "" if node is None else _shape_problem(node)
                if problem and node is not None:
                    yield self.report(launch.location(node), problem)
                other = included(package, launch, call)
                if other is not None:
                    yield from self._check_names(launch, call, other)
            for kind, endings in _ENDINGS.items():
                for source in launch.find(kind):
                    path = launch.text(source, "launch_file_path")
                    if isinstance(path, str) and path.endswith(endings):
                        name = path.rpartition("/")[2]
                        meant = "write AnyLaunchDescriptionSource"
                        yield self.report(source, f"{kind} cannot read {name}: {meant}")

    def _check_names(
        self, launch: LaunchFile, call: LaunchCall, other: Included
    ) -> Iterator[Diagnostic]:
        if other.path == launch.path and "condition" not in call.given:
            yield self.report(call, "this file includes itself, without end")
            return
        given = given_arguments(launch, call)
        if given is None:
            return
        names = {name for name, _, _ in given}
        misspelt = False
        for name, node, _ in given:
            near = get_close_matches(name, sorted(other.names - names), 1, 0.75)
            if name not in other.names and near and not other.is_open:
                misspelt = True
                message = f"{other.path} has no argument {name!r}; {near[0]!r} is meant"
                yield self.report(launch.location(node), message)
        missing = sorted(other.required - names)
        if missing and not misspelt and _is_understood(call):
            message = f"{other.path} requires the argument {missing[0]!r}, which is not given here"
            yield self.report(call, message)


def _is_understood(call: LaunchCall) -> bool:
    known = {"launch_description_source", "launch_arguments", "condition"}
    return known.issuperset(call.words)


def _shape_problem(node: ast.expr) -> str:
    """Return what is wrong about arguments that are no pairs; dictionaries have a rule."""
    pairs = "launch takes pairs, {...}.items() or [('name', 'value')]"
    match node:
        case ast.Set():
            return f"this is a set: {pairs}"
        case ast.Attribute(value=ast.Dict(), attr="items"):
            return "items is not called: write .items()"
        case ast.List(elts=items) | ast.Tuple(elts=items):
            if any(isinstance(one, ast.Constant | ast.JoinedStr) for one in items):
                return f"these are no pairs: {pairs}"
    return ""


def _value_problem(launch: LaunchFile, node: ast.expr) -> str:
    value = launch.evaluator.evaluate(node)
    if isinstance(node, ast.Constant) and not isinstance(node.value, str):
        return f"{node.value!r}, which is no text: write {str(node.value).lower()!r}"
    if type(value) in {bool, int, float}:
        return f"{value!r}, which is no text"
    if isinstance(node, ast.List) and any(
        isinstance(one, ast.Constant) and type(one.value) in {bool, int, float} for one in node.elts
    ):
        return "a list with a number, which launch cannot join"
    return ""
