"""LF017: actions and substitutions get all required arguments, and no unknown ones."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Edit, Example, Fix, LaunchRule, Report
from scaffold.api.launch import NODES, LaunchCall, LaunchFile, signature
from scaffold.api.rclpy import is_tried

_RENAMED = {
    "node_executable": "executable",
    "node_name": "name",
    "node_namespace": "namespace",
    "node_plugin": "plugin",
}
"""The keywords of nodes that were renamed in Foxy and removed in Galactic."""
_IMPORTS = (
    "from launch import LaunchDescription\n"
    "from launch.actions import DeclareLaunchArgument, TimerAction\n"
    "from launch.substitutions import PathJoinSubstitution\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
)
_LAUNCH = (
    f"{_IMPORTS}"
    "    path = PathJoinSubstitution({})\n"
    "    node = Node(package='talker', executable='node', parameters=[path])\n"
    "    return LaunchDescription([TimerAction({}=1.0, actions=[node])])\n"
)
_ARGUMENT = (
    f"{_IMPORTS}    return LaunchDescription([\n"
    "        DeclareLaunchArgument('rate', {}='2.0'),\n    ])\n"
)
_NODE = (
    f"{_IMPORTS}    return LaunchDescription([\n"
    "        Node(package='talker', {}='talk', {}='talker'),\n    ])\n"
)


class ArgumentsDoNotFit(LaunchRule):
    """An action or substitution lacks a required argument, or gets an unknown one.

    **Why.** ``ros2 launch`` stops: ``TypeError: TimerAction.__init__() missing 1 required
    keyword-only argument: 'period'``, ``Action.__init__() got an unexpected keyword argument
    'default'``, ``LogInfo.__init__() takes 1 positional argument but 2 were given``.

    **Fix.** Pass the missing argument, use the current keyword, and pass the parts of a path as one
    list. ``node_executable``, ``node_name``, ``node_namespace`` and ``node_plugin`` were renamed to
    ``executable``, ``name``, ``namespace`` and ``plugin`` in Foxy.

    **Source.** The modules of ``launch.actions``, ``launch.substitutions``,
    ``launch.event_handlers``, ``launch.conditions``, ``launch_ros.actions`` and
    ``launch_ros.descriptions``; ROS 2 documentation, release notes of Foxy Fitzroy, "launch_ros".
    """

    code = "LF017"
    name = "arguments-do-not-fit"
    examples = (
        Example("valid arguments", {"launch/a.launch.py": _LAUNCH.format("['a', 'b']", "period")}),
        Example(
            "two parts instead of a list",
            {"launch/a.launch.py": _LAUNCH.format("'a', 'b'", "period")},
            "8:12: PathJoinSubstitution takes one list of parts; put them in [...]",
        ),
        Example(
            "no period",
            {"launch/a.launch.py": _LAUNCH.format("['a', 'b']", "cancel_on_shutdown")},
            "10:31: TimerAction needs period=...: TypeError",
        ),
        Example(
            "positional arguments",
            {
                "launch/a.launch.py": _LAUNCH.format("['a']", "period").replace("period=", ""),
                "launch/b.launch.py": "from launch.substitutions import LaunchConfiguration\n\n\n"
                "def generate_launch_description():\n"
                "    return LaunchConfiguration('a', 'b')\n",
            },
            "launch/a.launch.py:10:31: TimerAction takes keyword arguments only",
            "launch/b.launch.py:5:12: LaunchConfiguration takes 1 positional argument: "
            "variable_name",
        ),
        Example("a known keyword", {"launch/a.launch.py": _ARGUMENT.format("default_value")}),
        Example(
            "a keyword of another class",
            {"launch/a.launch.py": _ARGUMENT.format("default")},
            "9:39: DeclareLaunchArgument has no argument 'default': TypeError; did you mean "
            "'default_value'?",
        ),
        Example(
            "keywords in a dictionary, one of them misspelled; and in one that is changed",
            {
                "launch/a.launch.py": f"{_IMPORTS}"
                "    common = {'package': 'talker', 'params': ['a.yaml']}\n"
                "    more = {'package': 'talker', 'params': ['a.yaml']}\n"
                "    more['parameters'] = more.pop('params')\n"
                "    return LaunchDescription([\n"
                "        Node(executable='a', **common), Node(executable='b', **common),\n"
                "        Node(executable='c', **more),\n    ])\n"
            },
            "8:37: Node has no argument 'params': TypeError; did you mean 'parameters'?",
        ),
        Example(
            "keywords of Eloquent, for Eloquent",
            {
                "launch/a.launch.py": _NODE.format("node_executable", "node_name").replace(
                    "    return", "    if os.environ['ROS_DISTRO'] == 'eloquent':\n        return"
                )
            },
        ),
        Example(
            "keywords of Eloquent",
            {"launch/a.launch.py": _NODE.format("node_executable", "node_name")},
            Report(
                "9:32",
                "Node has no argument node_executable: TypeError; it was renamed to executable",
                fix="Replace with executable",
            ),
            Report(
                "9:56",
                "Node has no argument node_name: TypeError; it was renamed to name",
                fix="Replace with name",
            ),
            fixed={"launch/a.launch.py": _NODE.format("executable", "name")},
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        reported: set[ast.expr] = set()  # a dictionary may be unpacked in several calls
        for call in launch.calls:
            for name, word in call.words.items():
                message = _renamed(call, name) or _unknown(call, name)
                if (
                    message
                    and word.value not in reported
                    and not is_tried(launch.module, call.call, name)
                ):
                    reported.add(word.value)
                    yield self._of_keyword(launch, call, word, message)
            message = _misfit(call)
            if message and not is_tried(launch.module, call.call, ""):
                yield self.report(call, message)

    def _of_keyword(
        self, launch: LaunchFile, call: LaunchCall, word: ast.keyword, message: str
    ) -> Diagnostic:
        """Report a keyword, with a fix if it was renamed."""
        name = str(word.arg)
        start, _ = launch.module.span(word)
        end = start + len(name)
        at = launch.module.source.location(start, end)
        new = _RENAMED.get(name)
        if new is None:
            return self.report(at, message)
        fix = None
        if new not in call.words:
            fix = Fix(f"Replace with {new}", (Edit(launch.path, start, end, new),))
        return self.report(at, message, fix, cause="keywords of an old release")


def _renamed(call: LaunchCall, keyword: str) -> str:
    """Return the message about a renamed keyword; empty for other keywords."""
    if keyword not in _RENAMED or call.kind not in {*NODES, "ComposableNode"}:
        return ""
    return (
        f"{call.kind} has no argument {keyword}: TypeError; it was renamed to {_RENAMED[keyword]}"
    )


def _unknown(call: LaunchCall, keyword: str) -> str:
    """Return the message that a keyword never existed; empty if it did."""
    parameters = signature(call.kind)
    if parameters is None or keyword in parameters.names or keyword in _RENAMED:
        return ""
    closest = get_close_matches(keyword, sorted(parameters.names), 1, 0.6)
    hint = f"; did you mean {closest[0]!r}?" if closest else ""
    return f"{call.kind} has no argument {keyword!r}: TypeError{hint}"


def _misfit(call: LaunchCall) -> str:
    """Return the problem with the number of arguments; empty if there is none."""
    parameters = signature(call.kind)
    if parameters is None or call.is_open:
        return ""
    if len(call.call.args) > len(parameters.positional) and call.kind != "LaunchDescription":
        return _too_many(call.kind, parameters.positional)
    missing = [name for name in parameters.required if name not in call.given]
    if missing and parameters.names.issuperset(call.words):
        names = " and ".join(f"{name}=..." for name in missing)
        return f"{call.kind} needs {names}: TypeError"
    return ""


def _too_many(kind: str, positional: tuple[str, ...]) -> str:
    if kind == "PathJoinSubstitution":
        return "PathJoinSubstitution takes one list of parts; put them in [...]"
    if not positional:
        return f"{kind} takes keyword arguments only"
    count = f"{len(positional)} positional argument" + "s" * (len(positional) > 1)
    return f"{kind} takes {count}: {', '.join(positional)}"
