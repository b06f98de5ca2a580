"""LF086: launch arguments are read."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Package, Severity, ViewError
from scaffold.api.launch import BY_LAUNCH, LaunchCall, LaunchFile, included, is_named_elsewhere

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\n"
    "from launch.substitutions import LaunchConfiguration\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        DeclareLaunchArgument('robot', default_value='robot', description='the robot'),\n"
    "        Node(package='talker', executable='talk'{}),\n    ])\n"
)
_INCLUDE = (
    "        IncludeLaunchDescription([FindPackageShare('{}'), '/launch/b.launch.py']),\n    ])\n"
)
_END = "    ])\n"
_IMPORT = "from launch.actions import DeclareLaunchArgument\n"
_IMPORTS = (
    "from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription\n"
    "from launch_ros.substitutions import FindPackageShare\n"
)


def _including(package: str) -> str:
    text = _LAUNCH.format("").replace(_END, _INCLUDE.format(package))
    return text.replace(_IMPORT, _IMPORTS)


class ArgumentUnread(LaunchRule):
    """A launch file declares an argument that nothing reads.

    **Why.** ``ros2 launch`` accepts it and ``--show-args`` shows it, but another value changes
    nothing: often a condition, a name or a parameter is missing.

    **Fix.** ``LaunchConfiguration('robot')`` where its value is needed, or remove it.

    **Source.** ``launch/actions/declare_launch_argument.py``.
    """

    code = "LF086"
    name = "argument-unread"
    severity = Severity.WARNING
    examples = (
        Example(
            "read", {"launch/a.launch.py": _LAUNCH.format(", name=LaunchConfiguration('robot')")}
        ),
        Example(
            "read by an included file, perhaps by one of another package, by a parameter file",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "launch/a.launch.py": _including("talker"),
                "launch/b.launch.py": _LAUNCH.format(", name=LaunchConfiguration('robot')"),
                "launch/c.launch.py": _including("other").replace("'robot'", "'arm'"),
                "launch/d.launch.py": _LAUNCH.format("").replace("'robot'", "'hand'"),
                "config/a.yaml": "talker:\n  ros__parameters:\n    name: $(var hand)\n",
            },
        ),
        Example(
            "not read",
            {"launch/a.launch.py": _LAUNCH.format("")},
            "9:9: nothing reads the argument 'robot': another value changes nothing",
        ),
    )

    def check_in(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        if launch.function is None or _is_open(package, launch):
            return
        for call in launch.find("DeclareLaunchArgument"):
            name = launch.text(call, "name")
            if not isinstance(name, str) or name in BY_LAUNCH or _is_mentioned(launch, call, name):
                continue
            if is_named_elsewhere(package, launch.path, name) or _is_in_yaml(package, name):
                continue
            message = f"nothing reads the argument {name!r}: another value changes nothing"
            yield self.report(call, message)


def _is_open(package: Package, launch: LaunchFile) -> bool:
    """Tell whether a file may read arguments by computed names, or unknown files may."""
    if launch.module.mentions("launch_configurations"):
        return True
    names = [launch.text(call, "variable_name") for call in launch.find("LaunchConfiguration")]
    includes = launch.find("IncludeLaunchDescription")
    return not all(isinstance(name, str) for name in names) or any(
        included(package, launch, call) is None for call in includes
    )


def _is_mentioned(launch: LaunchFile, declaration: LaunchCall, name: str) -> bool:
    """Tell whether a string outside of a declaration contains the name of the argument."""
    whole = re.compile(rf"(?<!\w){re.escape(name)}(?!\w)")
    return any(
        isinstance(node.value, str)
        and whole.search(node.value)
        and not launch.module.is_inside(node, declaration.call)
        for node in launch.module.walk(ast.Constant)
    )


def _is_in_yaml(package: Package, name: str) -> bool:
    """Tell whether a file with substitutions, such as a parameter file, has the argument."""
    for path in package.files:
        if path.endswith((".yaml", ".yml")):
            try:
                if f"$(var {name})" in package.source(path).text:
                    return True
            except ViewError:
                continue
    return False
