"""LF051: conditions have a value that launch can evaluate as true or false."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report, Severity
from scaffold.api.launch import NODES, LaunchCall, LaunchFile

from ._substitutions import failure, never_equal, never_equals

_TRUTHS = frozenset({"true", "false", "1", "0"})
_CONDITIONS = ("IfCondition", "UnlessCondition")
_SWITCH = re.compile(r"(?:use|start|launch|run|enable|with|show|open)_(\w{3,})")
"""The name of an argument that turns something on."""
_BY_NAME = ("LaunchConfigurationEquals", "LaunchConfigurationNotEquals")
_SUBSTITUTIONS = tuple(
    f"{name}Substitution" for name in ("And", "Or", "Not", "Any", "All", "Equals", "NotEquals")
)
_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch.actions import DeclareLaunchArgument\n"
    "from launch.conditions import IfCondition\n"
    "from launch.substitutions import LaunchConfiguration, PythonExpression\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    use = LaunchConfiguration('use')\n"
    "    return LaunchDescription([\n"
    "        DeclareLaunchArgument('use', default_value='{}'),\n"
    "        Node(package='a', executable='b', condition=IfCondition({})),\n    ])\n"
)
_SWITCHES = (
    "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\n"
    "from launch.conditions import {0}Condition\n"
    "from launch.substitutions import LaunchConfiguration\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
    "    use_rviz = LaunchConfiguration('use_rviz')\n"
    "    return LaunchDescription([\n"
    "        DeclareLaunchArgument('use_rviz', default_value='true'),\n"
    "        Node(package='rviz2', executable='{1}', condition={0}Condition(use_rviz)),\n    ])\n"
)


class ConditionUnusable(LaunchRule):
    """launch cannot evaluate a condition as true or false, or it is never true.

    **Why.** ``ros2 launch`` stops: ``'bool' object is not iterable`` for Python values, ``invalid
    condition expression, expected one of [true, 1, false, 0]`` for other strings, ``name 'true' is
    not defined`` for ``not true`` in a PythonExpression. String comparison is case-sensitive:
    ``true`` is not ``True``, and the node is not started, without an error. ``UnlessCondition`` of
    ``use_rviz`` starts RViz for those who do not want it.

    **Fix.** Write ``IfCondition(LaunchConfiguration('use'))``, ``UnlessCondition(...)`` instead of
    ``not``, and quotes around strings: ``PythonExpression(["'", mode, "' == 'fast'"])``.

    **Source.** ``launch/conditions``; ``launch/substitutions/python_expression.py``.
    """

    code = "LF051"
    name = "condition-unusable"
    other_severities = {Severity.WARNING: "the value may be set on the command line"}
    examples = (
        Example("a launch argument", {"launch/a.launch.py": _LAUNCH.format("true", "use")}),
        Example(
            "an expression with quotes",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "fast", "PythonExpression([\"'\", use, \"' == 'fast'\"])"
                )
            },
        ),
        Example(
            "a default that makes no expression",
            {"launch/a.launch.py": _LAUNCH.format("1", "PythonExpression([use, ' or'])")},
            "12:65: with the defaults this is '1 or', which is not a Python expression",
        ),
        Example(
            "another spelling of true",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "true", "PythonExpression([\"'\", use, \"' == 'True'\"])"
                ),
                "launch/b.launch.py": _LAUNCH.format(
                    "false", "PythonExpression([\"'\", use, \"' == 'True'\"])"
                ),
                "launch/c.launch.py": _LAUNCH.format(
                    "no", "PythonExpression([\"'\", use, \"' == 'true'\"])"
                ).replace("'no'", "'no', choices=['no', 'yes']"),
                "launch/d.launch.py": _LAUNCH.format(
                    "true", "PythonExpression([\"'\", use, \"'.lower() == 'true'\"])"
                ),
                "launch/f.launch.py": _LAUNCH.format("true", "'use', 'True'").replace(
                    "IfCondition", "LaunchConfigurationEquals"
                ),
                "launch/e.launch.py": _LAUNCH.format(
                    "true",
                    "PythonExpression([\"'\", use, \"' == 'True' or '\", use, \"' == 'true'\"])",
                ),
            },
            "launch/a.launch.py:12:65: 'use' is 'true' by default, which does not equal 'True'",
            Report(
                "launch/b.launch.py:12:65",
                "'use' is 'false' by default: setting it to 'true' does not give 'True'",
                severity=Severity.WARNING,
            ),
            "launch/c.launch.py:12:65: 'use' takes 'no', 'yes': it never equals 'true'",
            "launch/f.launch.py:12:53: 'use' is 'true' by default, which does not equal 'True'",
        ),
        Example(
            "a Python value",
            {"launch/a.launch.py": _LAUNCH.format("true", "not use")},
            "12:65: `not` tests the LaunchConfiguration object, not its value; use NotSubstitution",
        ),
        Example(
            "a switch that is turned on, one that is turned off, and one for either of two",
            {
                "launch/a.launch.py": _SWITCHES.format("If", "rviz2"),
                "launch/b.launch.py": _SWITCHES.format("Unless", "rviz2"),
                "launch/c.launch.py": _SWITCHES.format("Unless", "player"),
            },
            "launch/b.launch.py:12:61: rviz2 is started unless use_rviz is true: write IfCondition",
        ),
        Example(
            "the name of the argument",
            {"launch/a.launch.py": _LAUNCH.format("true", "'use'")},
            "12:65: 'use' is neither true nor false: the launch stops; did you mean "
            "LaunchConfiguration('use')?",
        ),
        Example(
            "an expression without quotes",
            {"launch/a.launch.py": _LAUNCH.format("true", "PythonExpression(['not ', use])")},
            "12:65: with the defaults this is 'not true': the name 'true' is not defined",
        ),
        Example(
            "a nested condition, a bool, a list, and a value instead of a name",
            {
                "launch/a.launch.py": _LAUNCH.format("true", "UnlessCondition(use)").replace(
                    "import If", "import UnlessCondition, If"
                ),
                "launch/b.launch.py": _LAUNCH.format("true", "True"),
                "launch/c.launch.py": _LAUNCH.format("true", "use)]")
                .replace("=IfCondition", "=[IfCondition")
                .replace("])),", "]),"),
                "launch/d.launch.py": _LAUNCH.format("true", "use, 'a'").replace(
                    "IfCondition", "LaunchConfigurationEquals"
                ),
            },
            "launch/a.launch.py:12:65: IfCondition takes a string, not another condition",
            "launch/b.launch.py:12:65: True is not a string: TypeError; write 'true', or remove "
            "the condition",
            "launch/c.launch.py:12:53: a condition must be one object, such as IfCondition(...), "
            "not a list",
            "launch/d.launch.py:12:79: LaunchConfigurationEquals takes the name of the launch "
            "argument, a string",
        ),
        Example(
            "conditions in a substitution",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "true", "OrSubstitution(IfCondition(use), use)"
                ).replace("import Launch", "import OrSubstitution, Launch"),
                "launch/b.launch.py": _LAUNCH.format(
                    "true", "AndSubstitution(use, LaunchConfigurationEquals('use', '1'))"
                )
                .replace("import Launch", "import AndSubstitution, Launch")
                .replace("import If", "import LaunchConfigurationEquals, If"),
                "launch/c.launch.py": _LAUNCH.format(
                    "true", "AndSubstitution(use, NotSubstitution(use))"
                ).replace("import Launch", "import AndSubstitution, NotSubstitution, Launch"),
            },
            "launch/a.launch.py:12:80: OrSubstitution takes substitutions, not the condition "
            "IfCondition; pass its argument",
            "launch/b.launch.py:12:86: AndSubstitution takes substitutions, not the condition "
            "LaunchConfigurationEquals; use EqualsSubstitution",
        ),
        Example(
            "`or` between two substitutions",
            {"launch/a.launch.py": _LAUNCH.format("true", "use or PythonExpression(['1'])")},
            "12:65: `and/or` tests the LaunchConfiguration object, not its value; use "
            "AndSubstitution, OrSubstitution",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find(*_CONDITIONS, *_BY_NAME):
            node = next(iter(call.given.values()), None)
            problem = "" if node is None else _problem(launch, call, node)
            if problem and node is not None:
                yield self.report(launch.location(node), problem)
            elif call.kind in _BY_NAME:
                why, is_sure = never_equals(launch, call)
                if why:
                    yield self.report(call, why, severity=None if is_sure else Severity.WARNING)
        for node, problem in (*_misplaced(launch), *_inverted(launch)):
            yield self.report(launch.location(node), problem)
        for call in launch.find("PythonExpression"):
            why = failure(launch, call.given.get("expression"))
            if why:
                yield self.report(call, why)
                continue
            why, is_sure = never_equal(launch, call.given.get("expression"))
            if why:
                yield self.report(call, why, severity=None if is_sure else Severity.WARNING)


def _inverted(launch: LaunchFile) -> Iterator[tuple[ast.expr, str]]:
    """Yield the conditions by which an argument named after a program, `use_rviz`, prevents it."""
    asked = [_argument(launch, call) for call in launch.find("IfCondition")]
    for call in launch.find(*NODES, "ExecuteProcess"):
        condition = launch.call_of(call.given.get("condition"))
        name = _argument(launch, condition) if condition is not None else ""
        program = launch.text(call, "executable")
        match = _SWITCH.fullmatch(name)
        if condition is None or condition.kind != "UnlessCondition" or name in asked:
            continue
        if match is not None and isinstance(program, str):
            words = re.split(r"[_\d]+", program)
            if set(match[1].split("_")) <= set(words):
                message = f"{program} is started unless {name} is true: write IfCondition"
                yield condition.call.func, message


def _argument(launch: LaunchFile, condition: LaunchCall) -> str:
    """Return the launch argument that a condition is; empty if it is something else."""
    view = launch.call_of(next(iter(condition.given.values()), None))
    is_plain = view is not None and view.kind == "LaunchConfiguration"
    name = launch.text(view, "variable_name") if is_plain and view is not None else ""
    return name if isinstance(name, str) else ""


def _misplaced(launch: LaunchFile) -> Iterator[tuple[ast.expr, str]]:
    """Yield lists for conditions, and conditions for substitutions."""
    for call in launch.calls:
        listed = call.given.get("condition")
        is_value = call.kind == "IfElseSubstitution"
        if isinstance(listed, ast.List | ast.Tuple) and not is_value:
            yield listed, "a condition must be one object, such as IfCondition(...), not a list"
    for call in launch.find(*_SUBSTITUTIONS):
        for node in dict.fromkeys((*call.given.values(), *call.call.args)):
            view = launch.call_of(node)
            if view is not None and view.kind in {*_CONDITIONS, *_BY_NAME}:
                is_plain = view.kind in _CONDITIONS
                hint = "pass its argument" if is_plain else "use EqualsSubstitution"
                message = f"{call.kind} takes substitutions, not the condition {view.kind}; {hint}"
                yield node, message
                break


def _problem(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> str:
    view = launch.call_of(node)
    kind = view.kind if view is not None else ""
    if call.kind in _BY_NAME:
        is_value = kind == "LaunchConfiguration"
        return f"{call.kind} takes the name of the launch argument, a string" if is_value else ""
    if kind in _CONDITIONS:
        return f"{call.kind} takes a string, not another condition"
    match node:
        case ast.Constant(value=bool() | int() | None as value):
            return (
                f"{value!r} is not a string: TypeError; write {str(value).lower()!r}, or "
                f"remove the condition"
            )
        case ast.UnaryOp(op=ast.Not()) | ast.BoolOp():
            return _by_python(launch, node)
        case ast.Constant(value=str(text)) if text.strip().lower() not in _TRUTHS:
            hint = (
                f"; did you mean LaunchConfiguration({text!r})?" if text in launch.declared else ""
            )
            return f"{text!r} is neither true nor false: the launch stops{hint}"
    return ""


def _by_python(launch: LaunchFile, node: ast.UnaryOp | ast.BoolOp) -> str:
    """Return the problem with Python operators on substitutions."""
    values = [node.operand] if isinstance(node, ast.UnaryOp) else node.values
    for value in values:
        call = launch.call_of(value)
        if call is not None and call.kind in {"LaunchConfiguration", "PythonExpression"}:
            operator = "not" if isinstance(node, ast.UnaryOp) else "and/or"
            use = "NotSubstitution" if operator == "not" else "AndSubstitution, OrSubstitution"
            return f"`{operator}` tests the {call.kind} object, not its value; use {use}"
    return ""
