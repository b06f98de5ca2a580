"""LF052: what a launch configuration gives is text, which Python takes for true."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import LaunchFile, truth_tests

_TRUTHS = frozenset({"true", "false", "0", "1"})
_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch.actions import DeclareLaunchArgument, OpaqueFunction\n"
    "from launch.substitutions import LaunchConfiguration\n\n\n"
    "def set_up(context):\n"
    "    use = LaunchConfiguration('use').perform(context)\n"
    "    return [] if {} else None\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        DeclareLaunchArgument('use', default_value='{}'),\n"
    "        OpaqueFunction(function=set_up),\n    ])\n"
)


class TextTakenForTruth(LaunchRule):
    """The value of a launch argument, a string, is used as a bool.

    **Why.** ``use:=false`` gives the text ``'false'``, which Python takes for true; ``'true' ==
    True`` is false. The branch is always taken, or never, without a word.

    **Fix.** ``if use.perform(context).lower() == 'true':``, or ``condition=IfCondition(use)``.

    **Source.** ``launch/substitutions/launch_configuration.py``; Python documentation, "Truth Value
    Testing".
    """

    code = "LF052"
    name = "text-taken-for-truth"
    examples = (
        Example("compared", {"launch/a.launch.py": _LAUNCH.format("use == 'true'", "false")}),
        Example("a text that may be empty", {"launch/a.launch.py": _LAUNCH.format("use", "")}),
        Example(
            "its truth",
            {"launch/a.launch.py": _LAUNCH.format("use", "false")},
            Report("8:18", "this is a string such as 'false', which is always true"),
        ),
        Example(
            "compared with a truth value",
            {"launch/a.launch.py": _LAUNCH.format("use == True", "false")},
            Report("8:18", "this is a string, which never equals True"),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for node in [*truth_tests(launch.module), *_made_bool(launch)]:
            text = _default(launch, node)
            if text is not None and text.lower() in _TRUTHS:
                message = f"this is a string such as {text!r}, which is always true"
                yield self.report(launch.location(node), message)
        for comparison in launch.module.walk(ast.Compare):
            other = _compared_with(comparison)
            if other and _performed(launch, comparison.left) is not None:
                message = f"this is a string, which never equals {other}"
                yield self.report(launch.location(comparison), message)


def _compared_with(comparison: ast.Compare) -> str:
    """Return the truth value or number that something is compared with, as it is written."""
    if isinstance(comparison.ops[0], ast.Eq | ast.NotEq | ast.Is | ast.IsNot):
        match comparison.comparators[0]:
            case ast.Constant(value=bool() | int() | float() as value):
                return repr(value)
    return ""


def _made_bool(launch: LaunchFile) -> Iterator[ast.expr]:
    for call in launch.module.walk(ast.Call):
        if launch.module.qualified_name(call.func) == "bool" and len(call.args) == 1:
            yield call.args[0]


def _default(launch: LaunchFile, node: ast.expr) -> str | None:
    """Return the default of the launch configuration whose text an expression is."""
    holder = _performed(launch, node)
    value = launch.default_of(holder) if holder is not None else None
    return value if isinstance(value, str) else None


def _performed(launch: LaunchFile, node: ast.expr) -> ast.expr | None:
    """Return the launch configuration of ``configuration.perform(context)``."""
    if isinstance(node, ast.Name):
        lookup = launch.module.index.lookup(node.id, node)
        values = [binding.value for binding in lookup[1]] if lookup else []
        if len(values) != 1 or values[0] is None:
            return None
        node = values[0]
    match node:
        case ast.Call(func=ast.Attribute(value=holder, attr="perform"), args=[_]):
            call = launch.call_of(holder)
            return holder if call is not None and call.kind == "LaunchConfiguration" else None
    return None
