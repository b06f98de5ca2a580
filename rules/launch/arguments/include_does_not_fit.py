"""LF053: included launch files get all required arguments, and no unknown ones."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, LaunchRule, Package
from scaffold.api.launch import Included, LaunchCall, LaunchFile, given_arguments, included

_INCLUDED = (
    "from launch import LaunchDescription\n"
    "from launch.actions import DeclareLaunchArgument, LogInfo\n"
    "from launch.substitutions import LaunchConfiguration\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n        DeclareLaunchArgument('robot_name'),\n"
    "        LogInfo(msg=LaunchConfiguration('robot_name')),\n    ])\n"
)
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import IncludeLaunchDescription\n"
    "from launch.launch_description_sources import PythonLaunchDescriptionSource\n"
    "from launch.substitutions import PathJoinSubstitution\n"
    "from launch_ros.substitutions import FindPackageShare\n\n\n"
    "def generate_launch_description():\n"
    "    path = PathJoinSubstitution([FindPackageShare('talker'), 'launch', '{}'])\n"
    "    return LaunchDescription([\n        IncludeLaunchDescription(\n"
    "            PythonLaunchDescriptionSource(path),\n"
    "            launch_arguments={}.items(),\n        ),\n    ])\n"
)
_MANIFEST = "<package format='3'>\n  <name>talker</name>\n</package>\n"


def _files(path: str, given: str) -> dict[str, str]:
    return {
        "package.xml": _MANIFEST,
        "launch/a.launch.py": _LAUNCH.format(path, given),
        "launch/b.launch.py": _INCLUDED,
    }


_SHORTEST = 3
"""The minimum length of the beginning of a name."""


class IncludeDoesNotFit(LaunchRule):
    """An include passes unknown arguments or lacks required ones, or a file includes itself.

    **Why.** ``ros2 launch`` stops: ``Included launch description missing required argument
    'robot_name'``. Unknown arguments are silently ignored.

    **Fix.** Write the name that the included file declares.

    **Source.** ``launch/actions/include_launch_description.py``.
    """

    code = "LF053"
    name = "include-does-not-fit"
    examples = (
        Example("the required argument", _files("b.launch.py", "{'robot_name': 'a'}")),
        Example(
            "a required argument that is missing",
            _files("b.launch.py", "{}"),
            "launch/a.launch.py:11:9: missing argument 'robot_name', which launch/b.launch.py "
            "requires: the launch stops",
        ),
        Example(
            "misspelled in a named dictionary, and in one that is modified",
            {
                **_files("b.launch.py", "given"),
                "launch/a.launch.py": _LAUNCH.format("b.launch.py", "given").replace(
                    "    return", "    given = {'robot_nam': 'a'}\n    return"
                ),
                "launch/c.launch.py": _LAUNCH.format("b.launch.py", "given").replace(
                    "    return",
                    "    given = {'robot_nam': 'a'}\n    given['robot_name'] = 'a'\n    return",
                ),
            },
            "launch/a.launch.py:10:14: launch/b.launch.py has no argument 'robot_nam': it is "
            "ignored; did you mean 'robot_name'?",
        ),
        Example(
            "misspelled",
            _files("b.launch.py", "{'robot_nam': 'a'}"),
            "launch/a.launch.py:13:31: launch/b.launch.py has no argument 'robot_nam': it is "
            "ignored; did you mean 'robot_name'?",
        ),
        Example(
            "a name that the including file declares itself, so that the included one sees it",
            {
                **_files("b.launch.py", "{'robot_nam': 'a'}"),
                "launch/a.launch.py": "from launch.actions import DeclareLaunchArgument\n"
                + _LAUNCH.format("b.launch.py", "{'robot_nam': 'a'}").replace(
                    "LaunchDescription([\n",
                    "LaunchDescription([\n        DeclareLaunchArgument('robot_name'),\n",
                ),
            },
        ),
        Example(
            "a file that includes itself",
            _files("a.launch.py", "{}"),
            "launch/a.launch.py:11:9: this file includes itself: the launch never starts",
        ),
        Example(
            "the beginning of the name, and another name",
            {
                **_files("b.launch.py", "{'robot_name': 'a', 'simulation': 'true', 'x': '1'}"),
                "launch/b.launch.py": "from launch import LaunchDescription\n"
                "from launch.actions import DeclareLaunchArgument\n\n\n"
                "def generate_launch_description():\n"
                "    return LaunchDescription([\n"
                "        DeclareLaunchArgument('robot_name'),\n"
                "        DeclareLaunchArgument('sim', default_value='false'),\n"
                "    ])\n",
            },
            "launch/a.launch.py:13:50: launch/b.launch.py has no argument 'simulation': it is "
            "ignored; did you mean 'sim'?",
        ),
    )

    def check_in(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find("IncludeLaunchDescription"):
            other = included(package, launch, call)
            if other is not None:
                yield from self._check_names(launch, call, other)

    def _check_names(
        self, launch: LaunchFile, call: LaunchCall, other: Included
    ) -> Iterator[Diagnostic]:
        if other.path == launch.path and "condition" not in call.given:
            yield self.report(call, "this file includes itself: the launch never starts")
            return
        given = given_arguments(launch, call)
        if given is None:
            return
        names = {name for name, _, _ in given}
        misspelled = False
        for name, node, _ in given:
            closest = _closest(name, sorted(other.names - names))
            if name not in other.names and closest and not other.is_open:
                misspelled = True
                if closest[0] in launch.declared:
                    continue  # which included files see as well
                message = (
                    f"{other.path} has no argument {name!r}: it is ignored; did you mean "
                    f"{closest[0]!r}?"
                )
                yield self.report(launch.location(node), message)
        missing = sorted(other.required - names)
        if missing and not misspelled and _is_understood(call):
            message = (
                f"missing argument {missing[0]!r}, which {other.path} requires: the launch stops"
            )
            yield self.report(call, message)


def _closest(name: str, names: Sequence[str]) -> Sequence[str]:
    """Return the name that is meant: a similar one, or the beginning of the other one."""
    starts = [
        other
        for other in names
        if min(len(name), len(other)) >= _SHORTEST
        and (name.startswith(other) or other.startswith(name))
    ]
    return get_close_matches(name, names, 1, 0.75) or starts[: len(starts) == 1]


def _is_understood(call: LaunchCall) -> bool:
    arguments = {"launch_description_source", "launch_arguments", "condition"}
    return arguments.issuperset(call.words)
