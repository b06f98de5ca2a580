"""LF013: launch files use no paths of the author's machine."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Example,
    Location,
    Package,
    Rule,
    Severity,
    ViewError,
    fact,
)
from scaffold.api.launch import NODES, LaunchFile, launch_paths, markup_files, parameter_items

_HOME = (
    r"(?:file://)?(?:/(?:home|Users)/[^/\s]+/|/root/|~?/[\w/]*(?:_ws|workspaces?)/(?:src|install)/)"
)
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='talker', executable='talk', parameters=['{}']),\n    ])\n"
)


class PathOfAuthor(Rule):
    """A launch file uses a path in a home directory or workspace, or in the current directory.

    **Why.** It does not exist on any other machine: ``[WARNING] Parameter file path is not a
    file: /home/me/ros2_ws/...``, and the node runs with its defaults.

    **Fix.** ``PathJoinSubstitution([FindPackageShare('talker'), 'config', 'talker.yaml'])``, or a
    launch argument.

    **Source.** ROS 2 documentation, "Using substitutions".
    """

    code = "LF013"
    name = "path-of-author"
    severity = Severity.WARNING
    release_refused = "the file is not in the package"
    examples = (
        Example("a system path", {"launch/a.launch.py": _LAUNCH.format("/etc/talker.yaml")}),
        Example(
            "a path in the description of an argument",
            {
                "launch/a.launch.py": _LAUNCH.format("/etc/talker.yaml").replace(
                    "Node(package",
                    "Arg('map', description='/home/me/map.yaml'),\n        Node(package",
                )
            },
        ),
        Example(
            "paths in a home directory, a workspace and the current directory",
            {
                "launch/a.launch.py": _LAUNCH.format("/home/me/ros2_ws/src/talker/talker.yaml"),
                "launch/b.launch.py": _LAUNCH.format("/ros2_ws/src/talker/talker.yaml"),
                "config/talker.yaml": "",
                "launch/d.launch.py": _LAUNCH.format("config/talker.yaml"),
                "launch/c.launch.xml": "<launch>\n"
                '  <arg name="map" default="/home/me/map.yaml"/>\n</launch>\n',
            },
            "launch/a.launch.py:7:63: '/home/me/ros2_ws/src/talker/talker.yaml' exists only on "
            "the author's machine; build the path from the share directory",
            "launch/b.launch.py:7:63: '/ros2_ws/src/talker/talker.yaml' exists only on the "
            "author's machine; build the path from the share directory",
            "launch/c.launch.xml:2:28: '/home/me/map.yaml' exists only on the author's machine; "
            "build the path from the share directory",
            "launch/d.launch.py:7:63: 'config/talker.yaml' is relative to the current directory "
            "of `ros2 launch`, not to this file; build the path from the share directory",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for at, text in _texts(package):
            matched = re.match(_HOME, text)
            if matched:
                message = (
                    f"{text!r} exists only on the author's machine; build the path from the "
                    f"share directory"
                )
                yield self.report(at, message)
        for at, text in _parameters(package):
            if package.has(text) or text.startswith("src/"):
                message = (
                    f"{text!r} is relative to the current directory of `ros2 launch`, not to this "
                    f"file; build the path from the share directory"
                )
                yield self.report(at, message)


def _texts(package: Package) -> Iterator[tuple[Location, str]]:
    """Yield the strings of launch files that may be paths."""
    for path in launch_paths(package):
        try:
            yield from _texts_in(package, path)
        except ViewError:
            continue
    for file in markup_files(package):
        for attribute in file.attributes:
            yield attribute.location, attribute.value


@fact
def _texts_in(package: Package, path: str) -> tuple[tuple[Location, str], ...]:
    launch = LaunchFile.of(package, path)
    if launch.function is None:
        return ()
    return tuple(
        (launch.location(node), node.value)
        for node in launch.module.walk(ast.Constant)
        if isinstance(node.value, str) and "/" in node.value and "\n" not in node.value
        if not _is_description(launch, node)
    )


def _is_description(launch: LaunchFile, node: ast.Constant) -> bool:
    """Return whether a text is a description, as printed by `--show-args`."""
    return any(
        isinstance(parent, ast.keyword) and parent.arg == "description"
        for parent in launch.module.parents(node)
    )


def _parameters(package: Package) -> Iterator[tuple[Location, str]]:
    """Yield the relative paths that launch files pass as parameters."""
    for path in launch_paths(package):
        try:
            yield from _parameters_in(package, path)
        except ViewError:
            continue


@fact
def _parameters_in(package: Package, path: str) -> tuple[tuple[Location, str], ...]:
    launch = LaunchFile.of(package, path)
    values = [
        (launch.location(item), launch.evaluator.evaluate(item))
        for call in launch.find(*NODES, "ComposableNode")
        for item in parameter_items(launch, call)
    ]
    return tuple(
        (at, value)
        for at, value in values
        if isinstance(value, str) and not value.startswith(("/", "~"))
    )
