"""PF010: the controllers of ros2_control have a type, a rate, and joints of the robot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from scaffold.api import (
    Diagnostic,
    Example,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
    closest_name,
    listed_names,
)
from scaffold.api.distributions import target
from scaffold.api.formats import Scalar
from scaffold.api.formats import Sequence as YamlSequence
from scaffold.api.launch import (
    UNSAID,
    CommandLine,
    LaunchFile,
    StartedNode,
    Word,
    command_lines,
    processes,
    started_nodes,
)
from scaffold.api.parameters import (
    Entry,
    ParameterFile,
    Section,
    parameter_files,
    value_type,
)
from scaffold.api.robot import is_known, robot_file, robot_paths, robots

from ._controllers import replacement
from ._started_programs import is_named_in_code
from ._velocity_topics import ignored_settings, lost_topics

_MANAGER = "controller_manager"
_SPAWNER = "spawner"
_TYPE = ".type"
_JOINTS = frozenset(
    {"joint", "joints", "left_wheel_names", "right_wheel_names", "traction_joints_names"}
    | {"steering_joints_names", "front_wheels_names", "rear_wheels_names", "mimic_joints"}
)
"""The parameters of controllers that name joints."""
_LISTED = _JOINTS - {"joint"}
"""Those of them that are lists."""
_NEEDING = frozenset(
    {
        "diff_drive_controller/DiffDriveController",
        "forward_command_controller/ForwardCommandController",
    }
    | {"joint_trajectory_controller/JointTrajectoryController"}
)
"""The types of controllers that do not start without joints."""
_WITH_VALUE = frozenset(
    {"-c", "--controller-manager", "-n", "--namespace", "-p", "--param-file"}
    | {"--controller-manager-timeout", "--switch-timeout", "--service-call-timeout"}
    | {"--controller-ros-args", "--ros-args", "-t", "--controller-type"}
)
"""The options of the spawner that take a value."""
_OTHER_SOURCE = frozenset(
    {"-p", "--param-file", "-t", "--controller-type", "--controller-ros-args"}
)
"""The options of the spawner that may specify the type."""
_UNUSED = Severity.WARNING
"""The severity of a mistake in the configuration of a controller that nothing starts."""
_LOAD = ["ros2", "control", "load_controller"]
_FILE = (
    "controller_manager:\n  ros__parameters:\n    update_rate: {}\n"
    "    base_controller:\n      type: {}\n\n"
    "base_controller:\n  ros__parameters:\n"
    "    left_wheel_names: [left_joint]\n    right_wheel_names: [{}]\n"
)
_DRIVE = "diff_drive_controller/DiffDriveController"
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import ExecuteProcess\n"
    "from launch.substitutions import PathJoinSubstitution\n"
    "from launch_ros.actions import Node\nfrom launch_ros.substitutions import FindPackageShare\n"
    "\n\ndef generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='controller_manager', executable='ros2_control_node', parameters=[\n"
    "            PathJoinSubstitution([FindPackageShare('base'), 'config', '{}'])]),\n"
    "        Node(package='controller_manager', executable='spawner',\n"
    "             arguments=[{}]),\n"
    "        ExecuteProcess(cmd=['ros2', 'control', 'load_controller', '--set-state', 'active',\n"
    "                            '{}']),\n    ])\n"
)
_MUX = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='twist_mux', executable='twist_mux',\n"
    "             remappings=[('cmd_vel_out', '/base_controller/{}')]),\n    ])\n"
)
_ROBOT = (
    '<robot name="base">\n  <link name="base_link"/>\n'
    '  <link name="left"/>\n  <link name="right"/>\n'
    '  <joint name="left_joint" type="continuous">\n'
    '    <parent link="base_link"/>\n    <child link="left"/>\n  </joint>\n'
    '  <joint name="right_joint" type="continuous">\n'
    '    <parent link="base_link"/>\n    <child link="right"/>\n  </joint>\n</robot>\n'
)


def _files(
    rate: str = "50",
    type_: str = _DRIVE,
    joint: str = "right_joint",
    words: str = "'base_controller', '-c', '/controller_manager'",
    loaded: str = "base_controller",
    file: str = "controllers.yaml",
) -> dict[str, str]:
    return {
        "config/controllers.yaml": _FILE.format(rate, type_, joint),
        "launch/robot.launch.py": _LAUNCH.format(file, words, loaded),
        "package.xml": "<package><name>base</name></package>\n",
        "urdf/base.urdf": _ROBOT,
    }


class ControllerUnfit(Rule):
    """A controller of ros2_control has no type, a ROS 1 type, unknown joints or a former topic.

    **Why.** The robot does not move: ``The 'type' param was not defined for 'base_controller'``,
    ``Failed loading controller``, ``Not existing command interface``. The controller manager exits
    with ``parameter 'update_rate' has invalid type: expected [integer] got [double]``. Since Jazzy,
    ``diff_drive_controller`` has no topic ``~/cmd_vel_unstamped``.

    **Fix.** Use the names in the parameter file, with the ``type`` under ``controller_manager``,
    and the joints of the URDF; write ``update_rate: 50``. Publish a ``TwistStamped`` on
    ``~/cmd_vel``; ``twist_stamper`` converts.

    **Source.** https://github.com/ros-controls/ros2_control/issues/850;
    https://github.com/ros-controls/roscon2022_workshop/issues/16; ros2_controllers documentation.
    """

    code = "PF010"
    name = "controller-unfit"
    other_severities = {
        Severity.WARNING: "no other file names the controller with the joint, or the setting is "
        "ignored"
    }
    examples = (
        Example("matching controllers and joints", _files()),
        Example(
            "a rate with a decimal point, and a type of ROS 1",
            _files("50.0", "position_controllers/JointTrajectoryController"),
            "config/controllers.yaml:3:18: update_rate must be an integer: the controller manager "
            "exits at a double",
            "config/controllers.yaml:5:13: Jazzy has no controller "
            "'position_controllers/JointTrajectoryController': loading fails; use "
            "'joint_trajectory_controller/JointTrajectoryController'",
        ),
        Example(
            "an unknown joint",
            _files(joint="right_wheel_joint"),
            "config/controllers.yaml:10:25: the robot has no joint 'right_wheel_joint': the "
            "controller fails; did you mean 'right_joint'?",
        ),
        Example(
            "an unknown joint of a controller that nothing starts",
            _files(joint="right_wheel_joint", words="'--help'", loaded="other"),
            Report(
                "config/controllers.yaml:10:25",
                "the robot has no joint 'right_wheel_joint': the controller fails; did "
                "you mean 'right_joint'?",
                severity=Severity.WARNING,
            ),
            "launch/robot.launch.py:15:29: no file sets the type of 'other' for the controller "
            "manager: it is not loaded; known: base_controller",
        ),
        Example(
            "a misspelled type, and a name for a list of joints",
            {
                **_files(type_="diff_drive_controller/DiffDriveControler"),
                "config/controllers.yaml": _FILE.format(
                    "50", "diff_drive_controller/DiffDriveControler", "right_joint"
                ).replace("[right_joint]", "right_joint"),
            },
            "config/controllers.yaml:5:13: Jazzy has no controller "
            "'diff_drive_controller/DiffDriveControler': loading fails; use "
            "'diff_drive_controller/DiffDriveController'",
            "config/controllers.yaml:10:24: 'right_wheel_names' must be a list of names: the "
            "controller fails; write [right_joint]",
        ),
        Example(
            "a section of a controller under another name",
            {
                "config/controllers.yaml": _FILE.format("50", _DRIVE, "right_joint").replace(
                    "\nbase_controller", "\ndrive_controller"
                )
            },
            "7:1: the controller manager has no 'drive_controller', so this section is ignored, "
            "and 'base_controller' has no parameters",
        ),
        Example(
            "an interface that another controller exports to a chained one",
            _files(joint="base_controller/right_joint/velocity"),
        ),
        Example(
            "parameters of a controller in the section of the manager",
            {
                "config/controllers.yaml": "controller_manager:\n  ros__parameters:\n"
                f"    base_controller:\n      type: {_DRIVE}\n      left_wheel_names: [left]\n"
                "      right_wheel_names: [right]\n"
            },
            "5:7: 'base_controller' does not read 'left_wheel_names' here, because it is a "
            "separate node; write 'base_controller': and ros__parameters: at the top level",
        ),
        Example(
            "spawned under other names",
            _files(words="'joint_broadcaster', 'base_controller'", loaded="diff_controller"),
            "launch/robot.launch.py:13:25: no file sets the type of 'joint_broadcaster' for the "
            "controller manager: it is not loaded; known: base_controller",
            "launch/robot.launch.py:15:29: no file sets the type of 'diff_controller' for the "
            "controller manager: it is not loaded; known: base_controller",
        ),
        Example(
            "a manager with a parameter file of another package",
            {
                "launch/robot.launch.py": _LAUNCH.format(
                    "arm.yaml", "'arm_controller', 'joint_broadcaster'", "base_controler"
                ).replace("FindPackageShare('base')", "FindPackageShare('arm')"),
                "config/controllers.yaml": _FILE.format("50", _DRIVE, "right_joint"),
                "package.xml": "<package><name>base</name></package>\n",
            },
            "launch/robot.launch.py:15:29: no file sets the type of 'base_controler' for the "
            "controller manager: it is not loaded; known: base_controller",
        ),
        Example(
            "the controller of joint states of ROS 1, which nothing starts any more",
            {
                **_files(type_="joint_state_controller/JointStateController\n    other: 1"),
                "launch/robot.launch.py": _LAUNCH.format("controllers.yaml", "'arm'", "arm")
                + "    # Node(executable='spawner', arguments=['base_controller'])\n",
            },
            Report(
                "config/controllers.yaml:5:13",
                "Jazzy has no controller "
                "'joint_state_controller/JointStateController': loading fails; use "
                "'joint_state_broadcaster/JointStateBroadcaster'",
                severity=Severity.WARNING,
            ),
            "launch/robot.launch.py:13:25: no file sets the type of 'arm' for the controller "
            "manager: it is not loaded; known: base_controller",
            "launch/robot.launch.py:15:29: no file sets the type of 'arm' for the controller "
            "manager: it is not loaded; known: base_controller",
        ),
        Example(
            "types given in another way, and unknown names",
            {
                **_files(words="'arm', '-p', '/etc/arm.yaml'"),
                "launch/other.launch.py": _LAUNCH.format(
                    "controllers.yaml", "NAME, '--inactive'", "base_controller"
                ),
            },
        ),
        Example(
            "commands with stamps, and a node that converts those without",
            {
                **_files(),
                "launch/mux.launch.py": _MUX.format("cmd_vel"),
                "launch/other.launch.py": _MUX.format("cmd_vel_unstamped"),
                "scripts/stamp.py": "TOPIC = '/base_controller/cmd_vel_unstamped'\n",
            },
        ),
        Example(
            "commands without stamps",
            {
                **_files(),
                "config/controllers.yaml": _FILE.format("50", _DRIVE, "right_joint")
                + "    use_stamped_vel: false\n",
                "launch/mux.launch.py": _MUX.format("cmd_vel_unstamped"),
            },
            Report(
                "config/controllers.yaml:11:22",
                "this is ignored: since Jazzy, the controller only takes TwistStamped, "
                "on '~/cmd_vel'",
                severity=Severity.WARNING,
            ),
            "launch/mux.launch.py:8:27: no controller subscribes to "
            "'/base_controller/cmd_vel_unstamped': since Jazzy, diff_drive_controller only takes "
            "TwistStamped, on '~/cmd_vel'",
        ),
        Example(
            "commands without stamps, which Humble accepts",
            {**_files(), "launch/mux.launch.py": _MUX.format("cmd_vel_unstamped")},
            distro="humble",
        ),
        Example(
            "joints of another robot",
            {
                **_files(joint="rear"),
                "config/controllers.yaml": _FILE.format("50", _DRIVE, "rear").replace("left_", "a"),
            },
        ),
        Example(
            "another robot that cannot be parsed",
            {**_files(joint="rear"), "urdf/arm.xacro": "<!DOCTYPE robot>\n<robot/>\n"},
        ),
        Example(
            "spawners in a loop",
            {
                **_files(),
                "launch/robot.launch.py": _LAUNCH.format(
                    "controllers.yaml", "name", "base_controller"
                )
                .replace(
                    "        Node(package='controller_manager', executable='spaw",
                    "        *[\n            Node(package='controller_manager', executable='spaw",
                )
                .replace("[name]),", "[name]) for name in ['base_controller', 'arm']],"),
            },
            "launch/robot.launch.py:14:64: no file sets the type of 'arm' for the controller "
            "manager: it is not loaded; known: base_controller",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for location, topic in lost_topics(package):
            message = (
                f"no controller subscribes to {topic!r}: since Jazzy, diff_drive_controller only "
                f"takes TwistStamped, on '~/cmd_vel'"
            )
            yield self.report(location, message)
        parsed = [*parameter_files(package)]
        managers = [
            section for file in parsed for section in file.sections if section.name == _MANAGER
        ]
        if not managers:
            return
        types = {
            entry.name.removesuffix(_TYPE): entry
            for section in managers
            for entry in section.entries
            if entry.name.endswith(_TYPE)
        }
        for section in managers:
            yield from self._check_manager(package, section)
            yield from self._check_nested(parsed, section, types)
        yield from self._check_sections(parsed, types)
        yield from self._check_settings(parsed, types)
        yield from self._check_joints(package, parsed, types)
        yield from self._check_spawned(package, types)

    def _check_manager(self, package: Package, section: Section) -> Iterator[Diagnostic]:
        for entry in section.entries:
            if entry.name == "update_rate" and value_type(entry.value) == "double":
                message = "update_rate must be an integer: the controller manager exits at a double"
                yield self.report(entry.value.location, message)
            if entry.name.endswith(_TYPE) and isinstance(entry.value, Scalar):
                instead = replacement(package, entry.value.text)
                if instead:
                    message = (
                        f"{target().title} has no controller {entry.value.text!r}: loading fails; "
                        f"use {instead!r}"
                    )
                    controller = entry.name.removesuffix(_TYPE)
                    severity = None if _is_started(package, controller) else _UNUSED
                    yield self.report(entry.value.location, message, severity=severity)

    def _check_settings(
        self, files: Sequence[ParameterFile], types: Mapping[str, Entry]
    ) -> Iterator[Diagnostic]:
        for file in files:
            for section in file.sections:
                if section.name in types and _text_of(types[section.name]) == _DRIVE:
                    for location in ignored_settings(section):
                        message = (
                            "this is ignored: since Jazzy, the controller only takes TwistStamped, "
                            "on '~/cmd_vel'"
                        )
                        yield self.report(location, message, severity=Severity.WARNING)

    def _check_nested(
        self, files: Sequence[ParameterFile], manager: Section, types: Mapping[str, Entry]
    ) -> Iterator[Diagnostic]:
        own = {section.name for file in files for section in file.sections}
        seen: set[str] = set()
        for entry in manager.entries:
            controller, _, name = entry.name.partition(".")
            if controller in types and name in _JOINTS and controller not in own | seen:
                seen.add(controller)
                message = (
                    f"{controller!r} does not read {name!r} here, because it is a separate node; "
                    f"write {controller!r}: and ros__parameters: at the top level"
                )
                yield self.report(entry.location, message)

    def _check_sections(
        self, files: Sequence[ParameterFile], types: Mapping[str, Entry]
    ) -> Iterator[Diagnostic]:
        sections = [section for file in files for section in file.sections]
        left = types.keys() - {section.name for section in sections}
        needing = [name for name in left if _text_of(types[name]) in _NEEDING]
        for section in sections:
            joints = [entry for entry in section.entries if entry.name in _JOINTS]
            if section.name in types:
                for entry in joints:
                    if entry.name in _LISTED and value_type(entry.value) == "string":
                        message = (
                            f"{entry.name!r} must be a list of names: the controller fails; "
                            f"write [{_text_of(entry)}]"
                        )
                        yield self.report(entry.value.location, message)
            elif joints and len(needing) == 1 and not section.is_pattern:
                message = (
                    f"the controller manager has no {section.name!r}, so this section is ignored, "
                    f"and {needing[0]!r} has no parameters"
                )
                yield self.report(section.key, message)

    def _check_joints(
        self, package: Package, files: Sequence[ParameterFile], types: Mapping[str, Entry]
    ) -> Iterator[Diagnostic]:
        joints = _joints(package)
        for file in files:
            named = [
                (section.name, item)
                for section in file.sections
                if section.name in types
                for entry in section.entries
                if entry.name in _JOINTS
                for item in _texts(entry)
            ]
            # For another robot, unless at least one is of this robot.
            if not any(item.text in joints for _, item in named):
                continue
            for controller, item in named:
                exporter = item.text.partition("/")[0]
                if exporter in types and exporter != item.text:
                    continue  # a reference interface of a controller, for a chained one
                if item.text not in joints and "$(" not in item.text:
                    closest = closest_name(package, item.text, joints, 0.6)
                    hint = f"; did you mean {closest!r}?" if closest else ""
                    message = f"the robot has no joint {item.text!r}: the controller fails{hint}"
                    severity = None if is_named_in_code(package, controller) else _UNUSED
                    yield self.report(item.location, message, severity=severity)

    def _check_spawned(self, package: Package, types: Mapping[str, Entry]) -> Iterator[Diagnostic]:
        spawned = list(_spawned(package)) if types else []
        names = {word.text for _, word in spawned}
        left = [name for name in types if name not in names]
        for launch, word in spawned:
            if word.text in types:
                continue
            closest = closest_name(package, word.text, left, 0.9)
            if closest or _is_manager_here(package, launch):
                message = (
                    f"no file sets the type of {word.text!r} for the controller manager: it is "
                    f"not loaded; known: {listed_names(types, word.text)}"
                )
                yield self.report(word.location, message)


def _is_started(package: Package, controller: str) -> bool:
    """Return whether a controller may be started, perhaps under a name that is not known."""
    spawned = [word.text for _, word in _words(package)]
    is_known = bool(spawned) and not any(UNSAID in word for word in spawned)
    return not is_known or is_named_in_code(package, controller)


def _text_of(entry: Entry) -> str:
    return entry.value.text if isinstance(entry.value, Scalar) else ""


def _spawned(package: Package) -> Iterator[tuple[str, Word]]:
    """Yield the controllers that launch files load, with the launch file."""
    return ((path, word) for path, word in _words(package) if UNSAID not in word.text)


def _words(package: Package) -> Iterator[tuple[str, Word]]:
    """Yield the names of controllers, or what they are put together from."""
    for line in (*command_lines(package, _SPAWNER), *_loaded(package)):
        words = [word.text for word in line.words]
        if not _OTHER_SOURCE.isdisjoint(words):
            continue
        for before, word in zip(["", *words], line.words, strict=False):
            if not word.text.startswith("-") and before not in _WITH_VALUE:
                yield line.location.path, word


def _is_manager_here(package: Package, launch: str) -> bool:
    """Return whether a launch file starts the controller manager only with files of the package."""
    managers = [
        node
        for node in started_nodes(package)
        if node.launch == launch and node.executable == "ros2_control_node"
    ]
    return bool(managers) and all(
        node.parameter_files and not _takes_more(package, node) for node in managers
    )


def _takes_more(package: Package, node: StartedNode) -> bool:
    """Return whether a node may get parameters from other sources or several files."""
    launch = LaunchFile.of(package, node.launch)
    for call in launch.find("Node"):
        if call.location == node.location:
            given = call.given.get("parameters")
            elements = launch.evaluator.elements(given) if given is not None else None
            count = len(elements.items) if elements is not None and elements.complete else 0
            return count != len(node.parameter_files)
    return True


def _texts(entry: Entry) -> Iterator[Scalar]:
    items = entry.value.items if isinstance(entry.value, YamlSequence) else [entry.value]
    yield from (item for item in items if isinstance(item, Scalar) and item.text)


def _joints(package: Package) -> set[str]:
    """Return the joints of the robots of a package; empty if any are unknown."""
    names: set[str] = set()
    try:
        if any(robot_file(package, path) is None for path in robot_paths(package)):
            return names
    except ViewError:
        return names
    for robot in robots(package).whole:
        if not robot.is_complete:
            return set()
        for joint in robot.root.all("joint"):
            name = joint.get("name") or ""
            if not is_known(name):
                return set()
            names.add(name)
    return names


def _loaded(package: Package) -> Iterator[CommandLine]:
    """Yield the arguments of ``ros2 control load_controller`` commands."""
    for line in processes(package):
        if [word.text for word in line.words[:3]] == _LOAD:
            words = [word for word in line.words[3:] if word.text not in {"active", "inactive"}]
            yield line._replace(words=words)
