"""LF083: launch files start executables, and pass options, that the distribution has."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress

from scaffold.api import (
    Diagnostic,
    Edit,
    Effect,
    Example,
    Fix,
    Location,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
)
from scaffold.api.distributions import of_kind
from scaffold.api.launch import (
    CommandLine,
    Word,
    command_lines,
    markup_files,
    package_uses,
    processes,
)

_LAUNCH = (
    "from launch.actions import ExecuteProcess\n\n"
    "RECORDER = ExecuteProcess(cmd=['ros2', 'bag', 'record', '-a', {}])\n"
)
_XML = "<launch>\n  <executable cmd='ros2 bag record -a {}'/>\n</launch>\n"
_CREATE = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='ros_gz_sim', executable='create',\n"
    "             arguments=['-topic', 'robot_description', '{}', 'rover']),\n    ])\n"
)
_OF_SPAWN_ENTITY = {
    "-b": "omit it",
    "-entity": "use -name",
    "-robot_namespace": "set the namespace in the description",
    "-spawn_service_timeout": "omit it",
    "-timeout": "omit it",
    "-unpause": "omit it",
}
"""Options of gazebo_ros, with their replacements."""
_ROBOT = rb"<(?:robot|model)\b[^>]*\bname=[\"']%b[\"']"
_DESCRIPTIONS = (".urdf", ".xacro", ".sdf")
_LAUNCH_DEPRECATED = (
    "from launch import LaunchDescription\n"
    "from launch_ros.actions import ComposableNodeContainer\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        ComposableNodeContainer(\n"
    "            name='container', namespace='', package='rclcpp_components',\n"
    "            executable='{}'),\n    ])\n"
)
_XML_DEPRECATED = (
    "<launch>\n  <node_container pkg='rclcpp_components' exec='{}' name='a'/>\n</launch>\n"
)


class ExecutableOrOptionRemoved(Rule):
    """A launch file starts a removed or deprecated executable, or passes a removed option.

    **Why.** The executable exits at once with ``ambiguous option`` or ``unrecognized arguments``,
    or ignores the option: a robot gets another name in the simulation. A deprecated one warns at
    each start; later distributions do not have it, and the launch stops.

    **Fix.** Use the replacement in the message.

    **Source.** rosbag2, ``ros2bag/verb/record.py``; ros_gz_sim, ``create.cpp``; the pull requests
    that ``scaffold/data/changes.toml`` lists.
    """

    code = "LF083"
    name = "executable-or-option-removed"
    is_fixed_for_all = True
    since = "0.2"
    is_deprecation = True
    other_severities = {
        Severity.INFO: "the executable is only removed in a later distribution",
        Severity.WARNING: "the robot has the name that an ignored option gives it",
    }
    examples = (
        Example("a robot with a name", {"launch/a.launch.py": _CREATE.format("-name")}),
        Example(
            "the name of the robot, which it has anyway",
            {
                "launch/a.launch.py": _CREATE.format("-entity"),
                "urdf/rover.urdf": '<robot name="rover">\n  <link name="base"/>\n</robot>\n',
            },
            Report(
                "launch/a.launch.py:8:56",
                "-entity is an option of spawn_entity.py: ros_gz_sim create ignores it; use -name",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "an option of spawn_entity.py",
            {"launch/a.launch.py": _CREATE.format("-entity")},
            "8:56: -entity is an option of spawn_entity.py: ros_gz_sim create ignores it; use "
            "-name",
        ),
        Example(
            "all options of spawn_entity.py",
            {
                "launch/a.launch.py": _CREATE.format(
                    "-robot_namespace', 'a', '-spawn_service_timeout', '5', '-timeout', '9',"
                    "\n                        '-unpause', '-b', '-entity"
                )
            },
            "8:56: -robot_namespace is an option of spawn_entity.py: ros_gz_sim create ignores "
            "it; set the namespace in the description",
            "8:81: -spawn_service_timeout is an option of spawn_entity.py: ros_gz_sim create "
            "ignores it; omit it",
            "8:112: -timeout is an option of spawn_entity.py: ros_gz_sim create ignores it; omit "
            "it",
            "9:25: -unpause is an option of spawn_entity.py: ros_gz_sim create ignores it; omit it",
            "9:37: -b is an option of spawn_entity.py: ros_gz_sim create ignores it; omit it",
            "9:43: -entity is an option of spawn_entity.py: ros_gz_sim create ignores it; use "
            "-name",
        ),
        Example(
            "an option that still exists",
            {"launch/a.launch.py": _LAUNCH.format("'--exclude', '/tf'")},
            distro="humble",
        ),
        Example(
            "the new option",
            {"launch/a.launch.py": _LAUNCH.format("'--exclude-regex', '/tf'")},
        ),
        Example(
            "a removed option",
            {
                "launch/a.launch.py": _LAUNCH.format("'--exclude', '/tf'"),
                "launch/b.launch.py": _LAUNCH.format('"-x", "/tf"'),
                "launch/c.launch.xml": _XML.format("--exclude=/tf"),
            },
            Report(
                "launch/a.launch.py:3:63",
                "--exclude of ros2 bag record was removed in Jazzy: it exits at once; "
                "use --exclude-regex (rosbag2 1480)",
                fix="Replace with --exclude-regex",
            ),
            Report(
                "launch/b.launch.py:3:63",
                "-x of ros2 bag record was removed in Jazzy: it exits at once; use "
                "--exclude-regex (rosbag2 1480)",
                fix="Replace with --exclude-regex",
            ),
            Report(
                "launch/c.launch.xml:2:20",
                "--exclude of ros2 bag record was removed in Jazzy: it exits at once; "
                "use --exclude-regex (rosbag2 1480)",
                fix="Replace with --exclude-regex",
            ),
            fixed={
                "launch/a.launch.py": _LAUNCH.format("'--exclude-regex', '/tf'"),
                "launch/b.launch.py": _LAUNCH.format('"--exclude-regex", "/tf"'),
                "launch/c.launch.xml": _XML.format("--exclude-regex=/tf"),
            },
        ),
        Example(
            "the old name of an executable",
            {
                "launch/a.launch.py": _CREATE.replace("ros_gz_sim", "controller_manager")
                .replace("create", "spawner.py")
                .format("-c")
            },
            "7:55: spawner.py was removed in Humble: the launch stops; use spawner (ros2_control "
            "453)",
        ),
        Example(
            "an executable that is not deprecated yet",
            {"launch/a.launch.py": _LAUNCH_DEPRECATED.format("component_container_mt")},
        ),
        Example(
            "executables that are not deprecated",
            {"launch/a.launch.py": _LAUNCH_DEPRECATED.format("component_container")},
            distro="lyrical",
        ),
        Example(
            "containers with isolated executors",
            {
                "launch/a.launch.py": _LAUNCH_DEPRECATED.format("component_container_mt"),
                "launch/b.launch.xml": _XML_DEPRECATED.format("component_container_isolated"),
            },
            Report(
                "launch/a.launch.py:9:24",
                "component_container_mt is deprecated since Lyrical: it warns at each "
                "start; use component_container with the arguments --executor-type "
                "multi-threaded (rclcpp 3134)",
                severity=Severity.INFO,
            ),
            Report(
                "launch/b.launch.xml:2:49",
                "component_container_isolated is deprecated since Lyrical: it warns at "
                "each start; use component_container with the arguments --isolated "
                "--executor-type single-threaded (rclcpp 3134)",
                severity=Severity.INFO,
            ),
            distro="lyrical",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_programs(package)
        yield from self._check_options(package)
        for line in command_lines(package, "create"):
            for word, value in zip(line.words, [*line.words[1:], None], strict=True):
                replacement = _OF_SPAWN_ENTITY.get(word.text)
                if replacement is None:
                    continue
                is_same = (
                    word.text == "-entity" and value is not None and _is_robot(package, value.text)
                )
                message = f"{word.text} is an option of spawn_entity.py: ros_gz_sim create "
                severity = Severity.WARNING if is_same else Severity.ERROR
                yield self.report(
                    word.location,
                    f"{message}ignores it; {replacement}",
                    severity=severity,
                    effect=Effect.WRONG_BEHAVIOR,
                )

    def _check_options(self, package: Package) -> Iterator[Diagnostic]:
        removed = {
            name: change
            for change in of_kind("option")
            for name in change.names
            if change.is_removed
        }
        for line in processes(package) if removed else ():
            program = " ".join(word.text for word in line.words[:3])
            for word in line.words[3:]:
                option = word.text.partition("=")[0]
                change = removed.get(f"{program} {option}")
                if change is not None:
                    message = f"{option} of {program} {change.state}: it exits at once; "
                    message += f"{change.instead(change.use)} ({change.source})"
                    edit = _edit(package, line, word, option, change.use)
                    is_fixed = edit is not None and change.has_replacement
                    fix = Fix(f"Replace with {change.use}", (edit,)) if edit and is_fixed else None
                    yield self.report(word.location, message, fix)

    def _check_programs(self, package: Package) -> Iterator[Diagnostic]:
        changes = {name: change for change in of_kind("executable") for name in change.names}
        for name, location in _started(package):
            change = changes.get(name)
            if change is None or not (change.is_removed or change.is_deprecated):
                continue
            severity = Severity.ERROR if change.is_removed else Severity.INFO
            effect = "the launch stops" if change.is_removed else "it warns at each start"
            message = (
                f"{name.rpartition('/')[2]} {change.state}: {effect}; "
                f"{change.instead(change.use)} ({change.source})"
            )
            yield self.report(location, message, severity=severity)


def _is_robot(package: Package, name: str) -> bool:
    """Return whether a description of the workspace has a name, which Gazebo uses by default."""
    named = re.compile(_ROBOT % re.escape(name).encode())
    for other in package.workspace:
        for path in other.files:
            if path.endswith(_DESCRIPTIONS):
                with suppress(ViewError):
                    if named.search(other.data(path)):
                        return True
    return False


def _edit(package: Package, line: CommandLine, word: Word, old: str, new: str) -> Edit | None:
    """Return the edit of the option, if it is a literal without references."""
    if line.launch is not None and word.node is not None:
        module = line.launch.module
        start = module.span(word.node)[0] + 1  # after the quote
        path, text = line.launch.path, package.source(line.launch.path).text
    elif line.attribute is not None and word.span is not None:
        at, path = line.attribute.location, line.attribute.location.path
        start = package.source(path).offset(at.line, at.column) + word.span[0]
        text = package.source(path).text
    else:
        return None
    return Edit(path, start, start + len(old), new) if text.startswith(old, start) else None


def _started(package: Package) -> Iterator[tuple[str, Location]]:
    """Yield the executables started by launch files, as ``package/executable``, with the place."""
    for use in package_uses(package):
        yield f"{use.name}/{use.executable}", use.executable_location
    for file in markup_files(package):
        for node in file.containers:
            if node.package is not None and node.executable is not None:
                yield f"{node.package.value}/{node.executable.value}", node.executable.location
