"""LF054: where launch joins texts, it gets texts and substitutions."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import ACTIONS, NODES, LaunchCall, LaunchFile

_NODE = ("executable", "package", "name", "namespace", "exec_name")
_TEXTS: Mapping[str, tuple[str, ...]] = {
    **dict.fromkeys(NODES, _NODE),
    "AppendEnvironmentVariable": ("name", "value"),
    "ComposableNode": ("package", "plugin", "name", "namespace"),
    "DeclareLaunchArgument": ("default_value",),
    "EnvironmentVariable": ("name", "default_value"),
    "FindExecutable": ("name",),
    "FindPackageShare": ("package",),
    "IfCondition": ("predicate_expression",),
    "IncludeLaunchDescription": ("launch_description_source",),
    "LaunchConfiguration": ("variable_name",),
    "LogInfo": ("msg",),
    "PathJoinSubstitution": ("substitutions",),
    "PushRosNamespace": ("namespace",),
    "PythonExpression": ("expression",),
    "SetEnvironmentVariable": ("name", "value"),
    "SetLaunchConfiguration": ("name", "value"),
    "SetRemap": ("src", "dst"),
    "TextSubstitution": ("text",),
    "UnlessCondition": ("predicate_expression",),
}
_CONDITIONS = ("IfCondition", "UnlessCondition")
_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch.actions import DeclareLaunchArgument, LogInfo\n"
    "from launch_ros.actions import Node\n\n\ndef generate_launch_description():\n"
    "    name = DeclareLaunchArgument('name', default_value='a')\n"
    "    return LaunchDescription([\n        name,\n        LogInfo(msg={}),\n"
    "        Node(package='a', executable='b', name={}, additional_env={{'RATE': {}}}),\n    ])\n"
)


class ValueNotText(LaunchRule):
    """Where launch needs a text, it gets a number, or the action that declares an argument.

    **Why.** ``ros2 launch`` stops: ``'int' object is not iterable``, ``'DeclareLaunchArgument'
    object is not iterable``, ``Failed to normalize given item of type '<class 'int'>'``.

    **Fix.** Write the number in quotes; ``LaunchConfiguration('name')`` for the value of an
    argument.

    **Source.** ``launch/utilities/normalize_to_list_of_substitutions_impl.py``.
    """

    code = "LF054"
    name = "value-not-text"
    examples = (
        Example("texts", {"launch/a.launch.py": _LAUNCH.format("['a', 'b']", "'n'", "'3'")}),
        Example(
            "a number, an action, a number in the environment",
            {"launch/a.launch.py": _LAUNCH.format("3", "name", "3")},
            Report("10:21", "this is not a string: write '3'"),
            Report(
                "11:48",
                "this is the action DeclareLaunchArgument, not a value: write "
                "LaunchConfiguration('name')",
            ),
            Report("11:78", "this is not a string: write '3'"),
        ),
        Example(
            "a number among texts",
            {"launch/a.launch.py": _LAUNCH.format("['a', 3]", "'n'", "'3'")},
            Report("10:27", "this is not a string: write '3'"),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.calls:
            for node in _texts(call):
                problem = _problem(launch, call, node)
                if problem:
                    yield self.report(launch.location(node), problem)


def _texts(call: LaunchCall) -> Iterator[ast.expr]:
    """Yield the parts that launch joins to texts."""
    values = [call.given[name] for name in _TEXTS.get(call.kind, ()) if name in call.given]
    if call.kind in {*NODES, "ExecuteProcess"}:
        for name in ("env", "additional_env"):
            environment = call.given.get(name)
            if isinstance(environment, ast.Dict):
                values += [value for value in environment.values if value is not None]
        command = call.given.get("cmd")
        values += [command] if isinstance(command, ast.List) else []
        remappings = call.given.get("remappings")
        for pair in remappings.elts if isinstance(remappings, ast.List) else ():
            values += pair.elts if isinstance(pair, ast.Tuple) else []
    for value in values:
        if isinstance(value, ast.List | ast.Tuple):
            yield from value.elts
        elif call.kind != "DeclareLaunchArgument":  # for which there is a rule
            yield value


def _problem(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> str:
    if isinstance(node, ast.Constant) and type(node.value) in {int, float, bool}:
        return (
            "" if call.kind in _CONDITIONS else f"this is not a string: write {str(node.value)!r}"
        )
    view = launch.call_of(node)
    if view is not None and view.kind in ACTIONS:
        name = launch.text(view, "name") if view.kind == "DeclareLaunchArgument" else None
        hint = f": write LaunchConfiguration({name!r})" if isinstance(name, str) else ""
        return f"this is the action {view.kind}, not a value{hint}"
    return ""
