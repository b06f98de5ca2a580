"""LF053: included launch files get all required arguments, and no unknown ones."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from typing import NamedTuple

from scaffold.api import (
    Diagnostic,
    Example,
    LaunchRule,
    Location,
    Package,
    Report,
    Severity,
    listed_names,
)
from scaffold.api.launch import Given, Included, LaunchCall, LaunchFile, given_arguments, included

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
_HELPER = (
    _LAUNCH.partition("def ")[0]
    + "def include(name, **arguments):\n    return IncludeLaunchDescription(\n"
    "        PythonLaunchDescriptionSource(\n"
    "            PathJoinSubstitution([FindPackageShare('talker'), 'launch', name])),\n"
    "        launch_arguments=arguments.items(),\n    )\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n        include('b.launch.py', {}),\n    ])\n"
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
    other_severities = {Severity.WARNING: "no argument of the included file has a similar name"}
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
            Report(
                "launch/a.launch.py:13:72",
                "launch/b.launch.py has no argument 'x': it is ignored; it has robot_name, sim",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "through a helper function",
            {
                "package.xml": _MANIFEST,
                "launch/a.launch.py": _HELPER.format("robot_name='a'"),
                "launch/b.launch.py": _INCLUDED,
            },
        ),
        Example(
            "arguments through a helper function that the file does not have or accept",
            {
                "package.xml": _MANIFEST,
                "launch/a.launch.py": _HELPER.format("robot_name='c', speed='1'"),
                "launch/b.launch.py": _INCLUDED.replace(
                    "'robot_name'),\n        L", "'robot_name', choices=['a', 'b']),\n        L"
                ),
            },
            "launch/a.launch.py:18:43: launch/b.launch.py accepts a, b for 'robot_name', not 'c': "
            "the launch stops",
            Report(
                "launch/a.launch.py:18:54",
                "launch/b.launch.py has no argument 'speed': it is ignored; it has robot_name",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check_in(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        reported: set[tuple[Location, str]] = set()
        includes = [*_includes(package, launch)]
        for include in includes:
            leaked = {
                name
                for other in includes
                if other is not include and other.file is not None
                for name in other.file.names - {given for given, _, _ in other.given or ()}
            }
            with launch.evaluator.bound(include.values):
                problems = [*self._check_names(package, launch, include, leaked)]
            for problem in problems:
                if (problem.location, problem.message) not in reported:
                    reported.add((problem.location, problem.message))
                    yield problem

    def _check_names(
        self, package: Package, launch: LaunchFile, include: _Include, leaked: set[str]
    ) -> Iterator[Diagnostic]:
        call, other, given = include.call, include.file, include.given
        if other is None:
            return
        if (other.package, other.path) == (package.name, launch.path):
            if "condition" not in call.given:
                yield self.report(call, "this file includes itself: the launch never starts")
            return
        if given is None:
            return
        names = {name for name, _, _ in given}
        misspelled = False
        for name, node, value in given:
            closest = _closest(name, sorted(other.names - names))
            if name not in other.names and not other.is_open:
                misspelled = misspelled or bool(closest)
                if name in launch.declared or (closest and closest[0] in launch.declared):
                    continue  # which included files see as well
                if not closest and name in leaked:
                    continue  # the argument stays set for files that are included later
                has = f"it has {listed_names(other.names, name, 'none')}"
                hint = f"did you mean {closest[0]!r}?" if closest else has
                message = f"{other.path} has no argument {name!r}: it is ignored; {hint}"
                severity = None if closest else Severity.WARNING
                yield self.report(launch.location(node), message, severity=severity)
            yield from self._check_value(launch, other, name, value)
        missing = sorted(other.required - names)
        if missing and not misspelled and _is_understood(call):
            message = (
                f"missing argument {missing[0]!r}, which {other.path} requires: the launch stops"
            )
            yield self.report(call, message)

    def _check_value(
        self, launch: LaunchFile, other: Included, name: str, node: ast.expr
    ) -> Iterator[Diagnostic]:
        """Report a value that is not among the choices of an argument."""
        text, allowed = launch.evaluator.joined_text(node), other.choices.get(name)
        if allowed is not None and isinstance(text, str) and text not in allowed:
            message = (
                f"{other.path} accepts {listed_names(allowed, text, 'nothing')} for {name!r}, "
                f"not {text!r}: the launch stops"
            )
            yield self.report(launch.location(node), message)


class _Include(NamedTuple):
    """An include, in one call of the function around it."""

    call: LaunchCall
    values: Mapping[tuple[ast.AST, str], object]
    file: Included | None
    given: Sequence[Given] | None


def _includes(package: Package, launch: LaunchFile) -> Iterator[_Include]:
    for call in launch.find("IncludeLaunchDescription"):
        for case in launch.cases(call.call) or (None,):
            values = case.values if case is not None else {}
            with launch.evaluator.bound(values):
                other = included(package, launch, call)
                yield _Include(call, values, other, given_arguments(launch, call, case))


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
