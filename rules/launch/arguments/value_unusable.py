"""LF040: arguments in launch files have supported types."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report, Severity
from scaffold.api.launch import LaunchFile

from ._argument_checks import LOOSE, flaws

_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch.actions import DeclareLaunchArgument\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        DeclareLaunchArgument('rate', default_value={}),\n"
    "        Node(package='talker', executable='node', arguments={}),\n"
    "    ])\n"
)
_RIGHT = _LAUNCH.format("'2.0'", "['--rate', '3']")
_CHOICE = (
    "from launch.substitutions import IfElseSubstitution, LaunchConfiguration\n\n\n"
    "def generate_launch_description():\n"
    "    return IfElseSubstitution(LaunchConfiguration('a', default=''), 'b', 'c')\n"
)
_TEXTS = (
    "from launch import LaunchDescription\n"
    "from launch.actions import DeclareLaunchArgument, LogInfo\n"
    "from launch_ros.actions import Node\n\n\ndef generate_launch_description():\n"
    "    name = DeclareLaunchArgument('name', default_value='a')\n"
    "    return LaunchDescription([\n        name,\n        LogInfo(msg={}),\n"
    "        Node(package='a', executable='b', name={}, additional_env={{'RATE': {}}}),\n    ])\n"
)
_PROCESS = (
    "from launch import LaunchDescription\n"
    "from launch.actions import DeclareLaunchArgument, ExecuteProcess, TimerAction\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    node = Node(package='a', executable='b')\n"
    "    return LaunchDescription([\n"
    "        DeclareLaunchArgument('mode', default_value='{}', choices=['fast', 'slow']),\n"
    "        ExecuteProcess(cmd={}),\n        TimerAction(period={}, actions=[node]),\n    ])\n"
)
_INCLUDE = (
    "from launch import LaunchDescription\nfrom launch.actions import IncludeLaunchDescription\n"
    "from launch.launch_description_sources import AnyLaunchDescriptionSource\n"
    "from launch.substitutions import PathJoinSubstitution\n"
    "from launch_ros.substitutions import FindPackageShare\n\n\n"
    "def generate_launch_description():\n"
    "    path = PathJoinSubstitution([FindPackageShare('talker'), 'launch', 'b.launch.py'])\n"
    "    return LaunchDescription([\n        IncludeLaunchDescription(\n"
    "            AnyLaunchDescriptionSource(path),\n"
    "            launch_arguments={},\n        ),\n    ])\n"
)
_NODE = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='a', executable='b', parameters=[{{'a': {}}}])\n    ])\n"
)


class ValueUnusable(LaunchRule):
    """An argument in a launch file has a type that launch does not support.

    **Why.** ``ros2 launch`` stops with ``TypeError`` or ``ValueError``: ``'int' object is not
    iterable``, ``'TimerAction' expected 'period' to be one of ... float``, ``Provided default_value
    "fst" is not in provided choices``, ``Expected a non-empty sequence, with items of uniform
    type``. A command in one string is taken as the name of a program: ``No such file or directory:
    'ls -l'``.

    **Fix.** Put strings in quotes; write ``LaunchConfiguration('name')`` for the value of an
    argument, ``IfCondition(...)`` for conditions, ``period=1.0``, ``cmd=['ls', '-l']``,
    ``launch_arguments={'use_sim_time': 'true'}.items()``; do not mix types in a parameter.

    **Source.** ``launch/actions``, ``launch_ros/actions/node.py``,
    ``launch/utilities/normalize_to_list_of_substitutions_impl.py``,
    ``launch_ros/utilities/normalize_parameters.py``.
    """

    code = "LF040"
    name = "value-unusable"
    other_severities = {Severity.WARNING: "it works, but accepts wrong values"}
    examples = (
        Example("valid values", {"launch/a.launch.py": _RIGHT, "launch/b.launch.py": _CHOICE}),
        Example(
            "a number, a number in a list",
            {"launch/a.launch.py": _LAUNCH.format("2.0", "['--rate', 3]")},
            "8:53: not a string; write '2.0'",
            "9:72: not a string; write '3'",
        ),
        Example(
            "other arguments of a node",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "'2.0'",
                    "[],\n"
                    "             output='console', respawn_delay='1', additional_env=['A=b'],\n"
                    "             condition='true', parameters=[('rate', 2.0)]",
                )
            },
            "10:21: unknown output 'console'; choose from both, full, log, own_log, screen",
            "10:66: the environment must be a dictionary, not a list",
            "11:24: a condition must be an object such as IfCondition(...), not a value",
            "11:43: parameters must be files or dictionaries {'name': value}, not lists or pairs",
        ),
        Example("strings", {"launch/a.launch.py": _TEXTS.format("['a', 'b']", "'n'", "'3'")}),
        Example(
            "a number, an action, a number in the environment",
            {"launch/a.launch.py": _TEXTS.format("3", "name", "3")},
            "10:21: not a string; write '3'",
            "11:48: expected a value, not the action DeclareLaunchArgument; write "
            "LaunchConfiguration('name')",
            "11:78: not a string; write '3'",
        ),
        Example(
            "a number among strings",
            {"launch/a.launch.py": _TEXTS.format("['a', 3]", "'n'", "'3'")},
            "10:27: not a string; write '3'",
        ),
        Example(
            "a command, a period and a choice",
            {"launch/a.launch.py": _PROCESS.format("fast", "['ls', '-l']", "1.0")},
        ),
        Example(
            "a default that is not a choice, a command in one string, an int as a period",
            {"launch/a.launch.py": _PROCESS.format("fst", "'ls -l'", "1")},
            "9:68: the default 'fst' is not among the choices",
            "10:28: launch splits this string into single characters; write a list of strings",
            "11:28: a period must be a float; write 1.0",
        ),
        Example(
            "two words of a command in one string",
            {"launch/a.launch.py": _PROCESS.format("fast", "['ls -l']", "1.0")},
            "10:28: launch searches for an executable named 'ls -l'; write a list of strings",
        ),
        Example(
            "the name of a type",
            {
                "launch/a.launch.py": "from launch.substitutions import LaunchConfiguration\n"
                "from launch_ros.parameter_descriptions import ParameterValue\n\n\n"
                "def generate_launch_description():\n"
                "    rate = LaunchConfiguration('rate', default='1')\n"
                "    return [ParameterValue(rate, value_type=int),\n"
                "            ParameterValue(rate, value_type='int')]\n"
            },
            "8:45: value_type must be a type, not a string; write int",
        ),
        Example(
            "other kinds of respawn, periods and choices",
            {
                "launch/a.launch.py": _PROCESS.format("fast", "['ls'], respawn='true'", "True"),
                "launch/b.launch.py": _PROCESS.format("fast", "['ls']", "'soon'").replace(
                    "['fast', 'slow']", "'fast'"
                ),
                "launch/c.launch.py": _PROCESS.format("1", "['ls']", "'1.0'").replace(
                    "['fast', 'slow']", "[1, 2]"
                ),
            },
            "launch/a.launch.py:10:44: respawn must be a bool, not a string; write True or False",
            "launch/a.launch.py:11:28: a period must be a number of seconds, such as 1.0",
            Report(
                "launch/b.launch.py:9:69",
                "choices must be a list of strings: launch accepts any substring; write a list",
                severity=Severity.WARNING,
            ),
            "launch/b.launch.py:11:28: a period must be a number of seconds, not 'soon'",
            "launch/c.launch.py:9:66: choices must be strings: values from the command line never "
            "equal a number",
        ),
        Example(
            "arguments of an include: pairs",
            {"launch/a.launch.py": _INCLUDE.format("{'a': 'b'}.items()")},
        ),
        Example(
            "arguments of an include: a number",
            {"launch/a.launch.py": _INCLUDE.format("{'a': 3}.items()")},
            "13:36: 'a' gets 3, which is not a string: write '3'",
        ),
        Example(
            "arguments of an include: a number in a list",
            {"launch/a.launch.py": _INCLUDE.format("[('a', ['b', 1])]")},
            "13:37: 'a' gets a list with a number, which launch cannot concatenate",
        ),
        Example(
            "arguments of an include: a set",
            {"launch/a.launch.py": _INCLUDE.format("{'a', 'b'}")},
            "13:30: expected pairs, not a set: launch takes pairs, {...}.items() or [('name', "
            "'value')]",
        ),
        Example(
            "arguments of an include: a set of pairs",
            {"launch/a.launch.py": _INCLUDE.format("{('a', 'b')}")},
        ),
        Example(
            "arguments of an include: items, not called",
            {"launch/a.launch.py": _INCLUDE.format("{'a': 'b'}.items")},
            "13:30: items is not called; write .items()",
        ),
        Example(
            "arguments of an include: a list of strings",
            {"launch/a.launch.py": _INCLUDE.format("['a', 'b']")},
            "13:30: not pairs: launch takes pairs, {...}.items() or [('name', 'value')]",
        ),
        Example(
            "arguments of an include: a number that is computed",
            {"launch/a.launch.py": _INCLUDE.format("{'a': 1 + 2}.items()")},
            "13:36: 'a' gets 3, which is not a string",
        ),
        Example("a parameter: values of one type", {"launch/a.launch.py": _NODE.format("[1, 2]")}),
        Example(
            "parameters: an argument that is None by default, and one that is replaced",
            {
                "launch/a.launch.py": "from launch import LaunchDescription\n"
                "from launch_ros.actions import Node\n\n\n"
                "def made(name, more=None):\n"
                "    return Node(package='a', executable=name, parameters=[{'b': 1}, more])\n\n\n"
                "def other(name, more=None):\n"
                "    more = more or {}\n"
                "    return Node(package='a', executable=name, parameters=[{'b': 1}, more])\n\n\n"
                "def generate_launch_description():\n"
                "    return LaunchDescription([made('b', {'c': 1}), made('d'), other('e')])\n"
            },
            "6:69: a call passes None as 'more', which is not a file or a dictionary",
        ),
        Example(
            "a parameter: None",
            {"launch/a.launch.py": _NODE.format("None")},
            "7:61: the parameter 'a' is None, which is not a parameter value",
        ),
        Example(
            "a parameter: an empty list",
            {"launch/a.launch.py": _NODE.format("[]")},
            "7:61: the parameter 'a' is an empty list, which has no type",
        ),
        Example(
            "a parameter: a mixed list",
            {"launch/a.launch.py": _NODE.format("[1, 'a']")},
            "7:61: the parameter 'a' is a list of mixed types",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.calls:
            for node, problem in flaws(launch, call):
                severity = Severity.WARNING if problem.startswith(LOOSE) else None
                yield self.report(launch.location(node), problem, severity=severity)
