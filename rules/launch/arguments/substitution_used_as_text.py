"""LF041: substitutions are not used as strings or booleans while the launch file is loaded."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule
from scaffold.api.launch import LaunchFile
from scaffold.api.python import all_conditions

from ._substitutions import CONDITION, text_uses, truth_tests

_SHOWN = frozenset({"in an f-string", "in str()", "in a % format", "in format()"})
"""Uses that do not fail: the text is the representation of the object."""
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
_TRUTHS = frozenset({"true", "false", "0", "1"})
_LAUNCH_TRUTH = (
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


class SubstitutionUsedAsText(LaunchRule):
    """A substitution such as LaunchConfiguration is used as a string, or its value as a bool.

    **Why.** It only has a value later, when actions are executed: ``TypeError: join() argument must
    be str ... not 'LaunchConfiguration'``. In an f-string, a comparison or a condition, the object
    itself is used, and the result is wrong without an error. The value is a string: ``'false'`` is
    true in Python, and ``'true' == True`` is false.

    **Fix.** Use a list of parts, ``['/', LaunchConfiguration('name')]``, PathJoinSubstitution,
    PythonExpression, or an OpaqueFunction; ``condition=IfCondition(use)``, or ``if
    use.perform(context).lower() == 'true':``.

    **Source.** ROS 2 documentation, "Using substitutions";
    ``launch/substitutions/launch_configuration.py``; Python documentation, "Truth Value Testing".
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
            "printed for debugging",
            {"launch/a.launch.py": _LAUNCH.format("'a'\n    print(f'{name}', str(name))", "name")},
        ),
        Example(
            "methods of strings, and a comparison",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "name.upper()", "'b' if name == 'a' else name.lower()"
                )
            },
            "10:12: LaunchConfiguration has no value yet in upper(): it is evaluated when the "
            "launch runs",
            "12:81: LaunchConfiguration has no value yet in a comparison: it is evaluated when "
            "the launch runs",
            "12:98: LaunchConfiguration has no value yet in lower(): it is evaluated when the "
            "launch runs",
        ),
        Example(
            "joined by Python",
            {"launch/a.launch.py": _LAUNCH.format("os.path.join('a', name)", "'x' + name")},
            "10:30: LaunchConfiguration has no value yet in os.path.join(): it is evaluated when "
            "the launch runs",
            "12:74: LaunchConfiguration has no value yet in a sum: it is evaluated when the "
            "launch runs",
        ),
        Example(
            "in a format string, and in a Python condition",
            {"launch/a.launch.py": _LAUNCH.format("'%s.a' % name", "'a' if name else 'b'")},
            "10:21: LaunchConfiguration has no value yet in a % format: it is evaluated when the "
            "launch runs",
            "12:81: the LaunchConfiguration object is tested, not its value: always true; use "
            "IfCondition",
        ),
        Example(
            "in an f-string",
            {"launch/a.launch.py": _LAUNCH.format("'a'", "f'x{name}'")},
            "12:74: LaunchConfiguration has no value yet in an f-string: it is evaluated when the "
            "launch runs",
        ),
        Example(
            "formatted and joined by Python, and a key of a dictionary",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "'{}.a'.format(name)", "'/'.join(['a', name])"
                ),
                "launch/b.launch.py": _LAUNCH.format("{'a': 'b'}[name]", "name.perform()"),
            },
            "launch/a.launch.py:10:26: LaunchConfiguration has no value yet in format(): it is "
            "evaluated when the launch runs",
            "launch/a.launch.py:12:89: LaunchConfiguration has no value yet in join(): it is "
            "evaluated when the launch runs",
            "launch/b.launch.py:10:23: LaunchConfiguration has no value yet as a key: it is "
            "evaluated when the launch runs",
            "launch/b.launch.py:12:74: LaunchConfiguration has no value yet without a context: it "
            "is evaluated when the launch runs",
        ),
        Example(
            "its value compared",
            {"launch/a.launch.py": _LAUNCH_TRUTH.format("use == 'true'", "false")},
        ),
        Example(
            "a value that may be empty", {"launch/a.launch.py": _LAUNCH_TRUTH.format("use", "")}
        ),
        Example(
            "its value as a condition",
            {"launch/a.launch.py": _LAUNCH_TRUTH.format("use", "false")},
            "8:18: this is a string such as 'false', which is always true",
        ),
        Example(
            "its value compared with a bool",
            {"launch/a.launch.py": _LAUNCH_TRUTH.format("use == True", "false")},
            "8:18: this is a string, which never equals True",
        ),
        Example(
            "a sum for a string only",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "name + '/a' if isinstance(name, str) else name", "name"
                )
            },
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        yield from self._check_text(launch)
        yield from self._check_truth(launch)

    def _check_text(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for node, kind, use in text_uses(launch):
            if (use in _SHOWN and _is_printed(launch, node)) or _is_told_apart(launch, node):
                continue
            message = f"{kind} has no value yet {use}: it is evaluated when the launch runs"
            if use == CONDITION:
                message = (
                    f"the {kind} object is tested, not its value: always true; use IfCondition"
                )
            yield self.report(launch.location(node), message)

    def _check_truth(self, launch: LaunchFile) -> Iterator[Diagnostic]:
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


def _is_told_apart(launch: LaunchFile, node: ast.expr) -> bool:
    """Return whether a condition tests the type of the value."""
    tests = [launch.module.text(item.test) for item in all_conditions(launch.module, node)]
    names = {name.id for name in ast.walk(node) if isinstance(name, ast.Name)}
    return any(f"isinstance({name}," in test for name in names for test in tests)


def _is_printed(launch: LaunchFile, node: ast.expr) -> bool:
    """Return whether the text is only printed."""
    return any(
        isinstance(parent, ast.Call) and launch.module.qualified_name(parent.func) == "print"
        for parent in launch.module.parents(node)
    )


def _compared_with(comparison: ast.Compare) -> str:
    """Return the source text of the boolean or number in a comparison."""
    if isinstance(comparison.ops[0], ast.Eq | ast.NotEq | ast.Is | ast.IsNot):
        match comparison.comparators[0]:
            case ast.Constant(value=bool() | int() | float() as value):
                return repr(value)
    return ""


def _made_bool(launch: LaunchFile) -> Iterator[ast.expr]:
    for call in launch.module.calls_of("bool"):
        if len(call.args) == 1:
            yield call.args[0]


def _default(launch: LaunchFile, node: ast.expr) -> str | None:
    """Return the default of the launch configuration that an expression reads as text."""
    holder = _performed(launch, node)
    value = launch.default_of(holder) if holder is not None else None
    return value if isinstance(value, str) else None


def _performed(launch: LaunchFile, node: ast.expr) -> ast.expr | None:
    """Return the launch configuration of ``configuration.perform(context)``."""
    if isinstance(node, ast.Name):
        value = launch.module.index.only_value(node)
        if value is None:
            return None
        node = value
    match node:
        case ast.Call(func=ast.Attribute(value=holder, attr="perform"), args=[_]):
            call = launch.call_of(holder)
            return holder if call is not None and call.kind == "LaunchConfiguration" else None
    return None
