"""LF040: actions of launch get values that they can use."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import NODES, LaunchCall, LaunchFile

_OUTPUTS = frozenset({"screen", "log", "both", "own_log", "full"})
_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch.actions import DeclareLaunchArgument\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        DeclareLaunchArgument('rate', default_value={}),\n"
    "        Node(package='talker', executable='node', arguments={}),\n"
    "    ])\n"
)
_RIGHT = _LAUNCH.format("'2.0'", "['--rate', '3']")
_CHOICE = (
    "from launch.substitutions import IfElseSubstitution, LaunchConfiguration\n\n\n"
    "def generate_launch_description():\n"
    "    return IfElseSubstitution(LaunchConfiguration('a', default=''), 'b', 'c')\n"
)


class ValueUnusable(LaunchRule):
    """An action of launch gets a value of a kind that it cannot use.

    **Why.** ``ros2 launch`` stops with ``TypeError`` or ``ValueError``.

    **Fix.** Texts for defaults and arguments, ``IfCondition(...)`` for conditions.

    **Source.** ``launch/actions``, ``launch_ros/actions/node.py``,
    ``launch/utilities/normalize_to_list_of_substitutions_impl.py``.
    """

    code = "LF040"
    name = "value-unusable"
    examples = (
        Example("usable", {"launch/a.launch.py": _RIGHT, "launch/b.launch.py": _CHOICE}),
        Example(
            "a number, a number in a list",
            {"launch/a.launch.py": _LAUNCH.format("2.0", "['--rate', 3]")},
            Report("8:53", "a default must be a string, not a float: write '2.0'"),
            Report("9:61", "an argument must be a string: write '3'"),
        ),
        Example(
            "other arguments of a node",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "'2.0'",
                    "[],\n"
                    "             output='console', respawn_delay='1', additional_env=['A=b'],\n"
                    "             condition='true', parameters=[('rate', 2.0)]",
                )
            },
            Report(
                "10:21", "unknown output 'console'; choose from both, full, log, own_log, screen"
            ),
            Report("10:46", "respawn_delay must be a number, not a str"),
            Report("10:66", "the environment must be a dictionary, not a list"),
            Report("11:24", "a condition must be an object such as IfCondition(...), not a value"),
            Report(
                "11:43",
                "parameters must be files or dictionaries {'name': value}, not lists or pairs",
            ),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.calls:
            for name, node in call.given.items():
                problem = _problem(launch, call, name, node)
                if problem:
                    yield self.report(launch.location(node), problem)


def _problem(launch: LaunchFile, call: LaunchCall, name: str, node: ast.expr) -> str:
    value = launch.evaluator.evaluate(node)
    kind = _kind(value)
    problem = ""
    if call.kind == "DeclareLaunchArgument" and name == "default_value":
        is_wrong = type(value) in {int, float, bool}
        problem = (
            f"a default must be a string, not {kind}: write {str(value)!r}" if is_wrong else ""
        )
    elif name == "condition" and call.kind != "IfElseSubstitution":
        problem = _condition_problem(launch, node, value)
    elif call.kind not in NODES:
        return ""
    elif name in {"arguments", "ros_arguments"} and isinstance(node, ast.List | ast.Tuple):
        numbers = [elt for elt in node.elts if _is_number(elt)]
        problem = f"an argument must be a string: write {_text(numbers[0])!r}" if numbers else ""
    elif name == "output" and isinstance(value, str) and value not in _OUTPUTS:
        problem = f"unknown output {value!r}; choose from {', '.join(sorted(_OUTPUTS))}"
    elif name == "respawn_delay" and isinstance(value, str):
        problem = f"respawn_delay must be a number, not {kind}"
    elif name in {"env", "additional_env"} and isinstance(value, list):
        problem = "the environment must be a dictionary, not a list"
    elif name == "parameters" and isinstance(node, ast.List):
        problem = _parameter_problem(node)
    return problem


def _kind(value: object) -> str:
    return f"a {type(value).__name__}"


def _is_number(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and type(node.value) in {int, float, bool}


def _text(node: ast.expr) -> str:
    return str(node.value) if isinstance(node, ast.Constant) else ""


def _condition_problem(launch: LaunchFile, node: ast.expr, value: object) -> str:
    call = launch.call_of(node)
    is_text = isinstance(value, str | bool) or (
        call is not None and call.kind == "LaunchConfiguration"
    )
    if value is None or not is_text:
        return ""
    return "a condition must be an object such as IfCondition(...), not a value"


def _parameter_problem(node: ast.List) -> str:
    for elt in node.elts:
        if isinstance(elt, ast.Tuple | ast.List):
            return "parameters must be files or dictionaries {'name': value}, not lists or pairs"
    return ""
