"""LF086: launch arguments are read."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Package, Severity
from scaffold.api.launch import LaunchFile, unread_arguments

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
        for call, name in unread_arguments(package, launch):
            message = f"nothing reads the argument {name!r}: another value changes nothing"
            yield self.report(call, message)
