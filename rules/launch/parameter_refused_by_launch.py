"""LF061: values of parameters in launch files are of one type that parameters have."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import NODES, LaunchFile, parameters_given

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='a', executable='b', parameters=[{{'a': {}}}])\n    ])\n"
)


def _launch(value: str) -> dict[str, str]:
    return {"launch/a.launch.py": _LAUNCH.format(value)}


class ParameterRefusedByLaunch(LaunchRule):
    """A parameter in a launch file is ``None``, an empty list or a list of mixed types.

    **Why.** ``ros2 launch`` stops: ``Unexpected type for parameter value None``, ``Expected a
    non-empty sequence, with items of uniform type``.

    **Fix.** Leave the parameter out, so that the node takes its default, or write values of one
    type.

    **Source.** ``launch_ros/utilities/normalize_parameters.py``.
    """

    code = "LF061"
    name = "parameter-refused-by-launch"
    examples = (
        Example("values of one type", _launch("[1, 2]")),
        Example(
            "nothing",
            _launch("None"),
            Report("7:61", "the parameter 'a' is None, which is not a value of a parameter"),
        ),
        Example(
            "an empty list",
            _launch("[]"),
            Report("7:61", "the parameter 'a' is an empty list, whose type is unknown"),
        ),
        Example(
            "a mixed list",
            _launch("[1, 'a']"),
            Report("7:61", "the parameter 'a' mixes types in a list"),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find(*NODES, "ComposableNode"):
            for name, _, node in parameters_given(launch, call):
                problem = _problem(node)
                if problem:
                    yield self.report(launch.location(node), f"the parameter {name!r} {problem}")


def _problem(node: ast.expr) -> str:
    match node:
        case ast.Constant(value=None):
            return "is None, which is not a value of a parameter"
        case ast.List(elts=[]) | ast.Tuple(elts=[]):
            return "is an empty list, whose type is unknown"
        case ast.List(elts=items) | ast.Tuple(elts=items):
            kinds = {
                type(item.value) if isinstance(item, ast.Constant) else object for item in items
            }
            if object not in kinds and len(kinds) > 1 and kinds != {int, float}:
                return "mixes types in a list"
    return ""
