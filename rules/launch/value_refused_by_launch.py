"""LF055: periods, choices and commands are what launch takes."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import NODES, LaunchCall, LaunchFile
from scaffold.api.python import is_known

_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch.actions import DeclareLaunchArgument, ExecuteProcess, TimerAction\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    node = Node(package='a', executable='b')\n"
    "    return LaunchDescription([\n"
    "        DeclareLaunchArgument('mode', default_value='{}', choices=['fast', 'slow']),\n"
    "        ExecuteProcess(cmd={}),\n        TimerAction(period={}, actions=[node]),\n    ])\n"
)


class ValueRefusedByLaunch(LaunchRule):
    """A period, a choice or a command is of a kind that launch refuses.

    **Why.** ``ros2 launch`` stops: ``'TimerAction' expected 'period' to be one of ... float``,
    ``Provided default_value "fst" is not in provided choices``; a command that is one text is
    looked for as one program: ``No such file or directory: 'ls -l'``.

    **Fix.** ``period=1.0``; a default out of the choices; ``cmd=['ls', '-l']``.

    **Source.** ``launch/actions/timer_action.py``, ``declare_launch_argument.py``,
    ``execute_process.py``.
    """

    code = "LF055"
    name = "value-refused-by-launch"
    examples = (
        Example("taken", {"launch/a.launch.py": _LAUNCH.format("fast", "['ls', '-l']", "1.0")}),
        Example(
            "refused",
            {"launch/a.launch.py": _LAUNCH.format("fst", "'ls -l'", "1")},
            Report("9:68", "the default 'fst' is not among the choices"),
            Report("10:28", "launch splits a string into letters: write a list of words"),
            Report("11:28", "a period must be a float: write 1.0"),
        ),
        Example(
            "two words in one",
            {"launch/a.launch.py": _LAUNCH.format("fast", "['ls -l']", "1.0")},
            Report(
                "10:28",
                "this is one word, so a program 'ls -l' is looked for: write a list of words",
            ),
        ),
        Example(
            "the name of a type",
            {
                "launch/a.launch.py": "from launch.substitutions import LaunchConfiguration\n"
                "from launch_ros.parameter_descriptions import ParameterValue\n\n\n"
                "def generate_launch_description():\n"
                "    rate = LaunchConfiguration('rate', default='1')\n"
                "    return [ParameterValue(rate, value_type=int),\n"
                "            ParameterValue(rate, value_type='int')]\n"
            },
            Report("8:45", "value_type must be a type, not a string: write int"),
        ),
        Example(
            "other kinds",
            {
                "launch/a.launch.py": _LAUNCH.format("fast", "['ls'], respawn='true'", "True"),
                "launch/b.launch.py": _LAUNCH.format("fast", "['ls']", "'soon'").replace(
                    "['fast', 'slow']", "'fast'"
                ),
                "launch/c.launch.py": _LAUNCH.format("1", "['ls']", "'1.0'").replace(
                    "['fast', 'slow']", "[1, 2]"
                ),
            },
            Report(
                "launch/a.launch.py:10:44",
                "respawn must be a bool, not a string: write True or False",
            ),
            Report("launch/a.launch.py:11:28", "a period must be a number of seconds, such as 1.0"),
            Report(
                "launch/b.launch.py:9:69",
                "choices must be a list of strings: every letter of this string is a choice",
            ),
            Report("launch/b.launch.py:11:28", "a period must be a number of seconds, not 'soon'"),
            Report(
                "launch/c.launch.py:9:66",
                "choices must be strings: a value of the command line never equals a number",
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
    match call.kind, name:
        case "TimerAction", "period":
            return _period_problem(node)
        case "DeclareLaunchArgument", "choices":
            return _choices_problem(launch, call, node)
        case "ExecuteProcess", "cmd":
            return _command_problem(launch, call, node)
        case "ParameterValue", "value_type":
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                return f"value_type must be a type, not a string: write {node.value}"
        case kind, "respawn" if kind in {*NODES, "ExecuteProcess"}:
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                return "respawn must be a bool, not a string: write True or False"
    return ""


def _period_problem(node: ast.expr) -> str:
    match node:
        case ast.Constant(value=bool() | None):
            return "a period must be a number of seconds, such as 1.0"
        case ast.Constant(value=int(number)):
            return f"a period must be a float: write {number}.0"
        case ast.Constant(value=str(text)):
            try:
                float(text)
            except ValueError:
                return f"a period must be a number of seconds, not {text!r}"
    return ""


def _choices_problem(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> str:
    choices = launch.evaluator.evaluate(node)
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return "choices must be a list of strings: every letter of this string is a choice"
    if not isinstance(choices, list | tuple) or not all(map(is_known, choices)):
        return ""
    if any(type(choice) in {bool, int, float} for choice in choices):
        return "choices must be strings: a value of the command line never equals a number"
    default = launch.text(call, "default_value")
    if isinstance(default, str) and default not in choices:
        return f"the default {default!r} is not among the choices"
    return ""


def _command_problem(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> str:
    value = launch.evaluator.evaluate(node)
    if isinstance(value, str) or isinstance(node, ast.JoinedStr):
        return "launch splits a string into letters: write a list of words"
    if not isinstance(node, ast.List) or not node.elts or "shell" in call.given or call.is_open:
        return ""
    first = node.elts[0]
    if isinstance(first, ast.Constant) and isinstance(first.value, str):
        text = first.value.strip()
        if " " in text and "\\ " not in text and not text.startswith(("/", "'", '"')):
            return f"this is one word, so a program {text!r} is looked for: write a list of words"
    return ""
