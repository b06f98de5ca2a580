"""LF041: substitutions are not text while the launch file is read."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import CONDITION, LaunchFile, text_uses

_SHOWN = frozenset({"in an f-string", "in str()", "in a % format", "in format()"})
"""Uses that do not fail: the text tells what the object is."""
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


class SubstitutionUsedAsText(LaunchRule):
    """A substitution such as LaunchConfiguration is used as text.

    **Why.** It has a value only later, when actions are executed: ``TypeError: join() argument
    must be str ... not 'LaunchConfiguration'``; in an f-string, a comparison or after ``if`` it is
    an object, and the result silently wrong.

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
            "looked at by its author",
            {"launch/a.launch.py": _LAUNCH.format("'a'\n    print(f'{name}', str(name))", "name")},
        ),
        Example(
            "joined by Python",
            {"launch/a.launch.py": _LAUNCH.format("os.path.join('a', name)", "'x' + name")},
            Report(
                "10:30",
                "the value of a LaunchConfiguration is not known yet in "
                "os.path.join(): it is evaluated later",
            ),
            Report(
                "12:74",
                "the value of a LaunchConfiguration is not known yet in a sum: it "
                "is evaluated later",
            ),
        ),
        Example(
            "filled into a text, a choice of Python",
            {"launch/a.launch.py": _LAUNCH.format("'%s.a' % name", "'a' if name else 'b'")},
            Report(
                "10:21",
                "the value of a LaunchConfiguration is not known yet in a % format: "
                "it is evaluated later",
            ),
            Report(
                "12:81",
                "the LaunchConfiguration object is tested, not its value: always "
                "true; use IfCondition",
            ),
        ),
        Example(
            "in an f-string",
            {"launch/a.launch.py": _LAUNCH.format("'a'", "f'x{name}'")},
            Report(
                "12:74",
                "the value of a LaunchConfiguration is not known yet in an "
                "f-string: it is evaluated later",
            ),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for node, kind, what in text_uses(launch):
            if what in _SHOWN and _is_printed(launch, node):
                continue
            message = f"the value of a {kind} is not known yet {what}: it is evaluated later"
            if what == CONDITION:
                message = (
                    f"the {kind} object is tested, not its value: always true; use IfCondition"
                )
            yield self.report(launch.location(node), message)


def _is_printed(launch: LaunchFile, node: ast.expr) -> bool:
    """Tell whether only ``print`` gets the text, to show what the object is."""
    return any(
        isinstance(parent, ast.Call) and launch.module.qualified_name(parent.func) == "print"
        for parent in launch.module.parents(node)
    )
