"""LF086: launch arguments are read."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Location, Package, Severity
from scaffold.api.install import share_of
from scaffold.api.launch import LaunchFile, StartedNode, consumers, unread_arguments
from scaffold.api.parameters import ParameterFile, parameter_file

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\n"
    "from launch.substitutions import LaunchConfiguration\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        DeclareLaunchArgument('robot', default_value='robot', description='the robot'),\n"
    "        Node(package='talker', executable='talk'{}),\n    ])\n"
)
_GIVEN = (
    "[FindPackageShare('talker'), '/config/a.yaml']",
    "{'name': LaunchConfiguration('robot')}",
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
    """A launch file declares an argument that nothing reads, or that has no effect.

    **Why.** ``ros2 launch`` accepts it and ``--show-args`` shows it, but another value changes
    nothing: often a condition, a name or a parameter is missing. Of several parameter files and
    dictionaries, the last one with a value counts.

    **Fix.** ``LaunchConfiguration('robot')`` where its value is needed, or remove it; put the
    dictionary after the file.

    **Source.** ``launch/actions/declare_launch_argument.py``; ``launch_ros/actions/node.py``.
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
            "a parameter before and after a file that sets it",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "config/a.yaml": "talk:\n  ros__parameters:\n    name: ann\n    rate: 1.0\n",
                **{
                    f"launch/{name}.launch.py": _LAUNCH.format(
                        f", name='talk',\n             parameters=[{', '.join(parameters)}]"
                    ).replace(
                        "ions import Node\n",
                        "ions import Node\nfrom launch_ros.substitutions import FindPackageShare\n",
                    )
                    for name, parameters in (("right", _GIVEN), ("wrong", _GIVEN[::-1]))
                },
            },
            "launch/wrong.launch.py:12:35: the argument 'robot' changes nothing: config/a.yaml:3 "
            "sets 'name', and comes later; put the file first",
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
        for node in consumers(package):
            if node.launch == launch.path:
                yield from self._check_overridden(package, node)

    def _check_overridden(self, package: Package, node: StartedNode) -> Iterator[Diagnostic]:
        """Check that no later parameter file overrides the value of an argument."""
        overridden = [
            (given, named)
            for given in node.parameters
            for named in (given.later_files if isinstance(given.configuration, str) else ())
        ]
        if not overridden:
            return  # before the code of the node is looked at
        installed, full = share_of(package).files, node.full_name(package)
        for given, named in overridden if full is not None else ():
            path = installed.get(named, named)
            file = parameter_file(package, path) if package.has(path) else None
            at = _entry(file, str(full), given.name) if file is not None else None
            if at is not None:
                message = (
                    f"the argument {given.configuration!r} changes nothing: {at.path}:{at.line}"
                    f" sets {given.name!r}, and comes later; put the file first"
                )
                yield self.report(given.location, message)


def _entry(file: ParameterFile, node: str, name: str) -> Location | None:
    """Return the place of a parameter in the section of exactly this node."""
    for section in file.sections:
        if section.node.strip("/") == node.strip("/"):
            for entry in section.entries:
                if entry.name == name:
                    return entry.location
    return None
