"""LF059: arguments of included launch files are pairs of texts."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import LaunchFile, given_arguments

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import IncludeLaunchDescription\n"
    "from launch.launch_description_sources import AnyLaunchDescriptionSource\n"
    "from launch.substitutions import PathJoinSubstitution\n"
    "from launch_ros.substitutions import FindPackageShare\n\n\n"
    "def generate_launch_description():\n"
    "    path = PathJoinSubstitution([FindPackageShare('talker'), 'launch', 'b.launch.py'])\n"
    "    return LaunchDescription([\n        IncludeLaunchDescription(\n"
    "            AnyLaunchDescriptionSource(path),\n"
    "            launch_arguments={},\n        ),\n    ])\n"
)
_PAIRS = "launch takes pairs, {...}.items() or [('name', 'value')]"


def _launch(arguments: str) -> dict[str, str]:
    return {"launch/a.launch.py": _LAUNCH.format(arguments)}


class IncludeArgumentUnusable(LaunchRule):
    """The arguments of an include are not pairs, or a value is not a string.

    **Why.** ``ros2 launch`` stops: ``'bool' object is not iterable``, ``not enough values to
    unpack``, ``'builtin_function_or_method' object is not iterable``.

    **Fix.** ``launch_arguments={'use_sim_time': 'true'}.items()``. A dictionary without
    ``.items()`` is what ``launch-arguments-not-pairs`` is about.

    **Source.** ``launch/actions/include_launch_description.py``.
    """

    code = "LF059"
    name = "include-argument-unusable"
    examples = (
        Example("pairs", _launch("{'a': 'b'}.items()")),
        Example(
            "a number",
            _launch("{'a': 3}.items()"),
            Report("13:36", "'a' gets 3, which is not a string: write '3'"),
        ),
        Example(
            "a number in a list",
            _launch("[('a', ['b', 1])]"),
            Report("13:37", "'a' gets a list with a number, which launch cannot join"),
        ),
        Example(
            "a set",
            _launch("{'a', 'b'}"),
            Report(
                "13:30", "this is a set: launch takes pairs, {...}.items() or [('name', 'value')]"
            ),
        ),
        Example(
            "not called",
            _launch("{'a': 'b'}.items"),
            Report("13:30", "items is not called: write .items()"),
        ),
        Example(
            "a list of texts",
            _launch("['a', 'b']"),
            Report(
                "13:30",
                "these are not pairs: launch takes pairs, {...}.items() or [('name', 'value')]",
            ),
        ),
        Example(
            "a number that is computed",
            _launch("{'a': 1 + 2}.items()"),
            Report("13:36", "'a' gets 3, which is not a string"),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find("IncludeLaunchDescription"):
            for name, _, value in given_arguments(launch, call) or ():
                problem = _value_problem(launch, value)
                if problem:
                    yield self.report(launch.location(value), f"{name!r} gets {problem}")
            node = call.given.get("launch_arguments")
            problem = "" if node is None else _shape_problem(node)
            if problem and node is not None:
                yield self.report(launch.location(node), problem)


def _shape_problem(node: ast.expr) -> str:
    """Return what is wrong about arguments that are not pairs; dictionaries have a rule."""
    match node:
        case ast.Set():
            return f"this is a set: {_PAIRS}"
        case ast.Attribute(value=ast.Dict(), attr="items"):
            return "items is not called: write .items()"
        case ast.List(elts=items) | ast.Tuple(elts=items):
            if any(isinstance(item, ast.Constant | ast.JoinedStr) for item in items):
                return f"these are not pairs: {_PAIRS}"
    return ""


def _value_problem(launch: LaunchFile, node: ast.expr) -> str:
    value = launch.evaluator.evaluate(node)
    if isinstance(node, ast.Constant) and not isinstance(node.value, str):
        return f"{node.value!r}, which is not a string: write {str(node.value).lower()!r}"
    if type(value) in {bool, int, float}:
        return f"{value!r}, which is not a string"
    if isinstance(node, ast.List) and any(
        isinstance(elt, ast.Constant) and type(elt.value) in {bool, int, float} for elt in node.elts
    ):
        return "a list with a number, which launch cannot join"
    return ""
