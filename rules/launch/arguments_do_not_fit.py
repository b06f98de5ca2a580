"""LF018: actions and substitutions get the arguments that they need, where they take them."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import LaunchFile, signature
from scaffold.api.rclpy import is_tried

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import TimerAction\n"
    "from launch.substitutions import PathJoinSubstitution\nfrom launch_ros.actions import Node\n"
    "\n\ndef generate_launch_description():\n"
    "    path = PathJoinSubstitution({})\n"
    "    node = Node(package='talker', executable='node', parameters=[path])\n"
    "    return LaunchDescription([TimerAction({}=1.0, actions=[node])])\n"
)


class ArgumentsDoNotFit(LaunchRule):
    """An action or a substitution lacks an argument, or gets one more than it takes.

    **Why.** ``ros2 launch`` stops: ``TypeError: TimerAction.__init__() missing 1 required
    keyword-only argument: 'period'``, ``LogInfo.__init__() takes 1 positional argument but 2 were
    given``.

    **Fix.** Give what is missing; give by name what is taken by name only; parts of a path are one
    list.

    **Source.** The modules of ``launch.actions``, ``launch.substitutions``,
    ``launch.event_handlers``, ``launch.conditions`` and ``launch_ros.actions``.
    """

    code = "LF018"
    name = "arguments-do-not-fit"
    examples = (
        Example("fitting", {"launch/a.launch.py": _LAUNCH.format("['a', 'b']", "period")}),
        Example(
            "two parts instead of a list",
            {"launch/a.launch.py": _LAUNCH.format("'a', 'b'", "period")},
            Report("8:12", "PathJoinSubstitution takes one list of parts: put them in [...]"),
        ),
        Example(
            "no period",
            {"launch/a.launch.py": _LAUNCH.format("['a', 'b']", "cancel_on_shutdown")},
            Report("10:31", "TimerAction needs period=...: TypeError"),
        ),
        Example(
            "arguments without names",
            {
                "launch/a.launch.py": _LAUNCH.format("['a']", "period").replace("period=", ""),
                "launch/b.launch.py": "from launch.substitutions import LaunchConfiguration\n\n\n"
                "def generate_launch_description():\n"
                "    return LaunchConfiguration('a', 'b')\n",
            },
            Report("launch/a.launch.py:10:31", "TimerAction takes keyword arguments only"),
            Report(
                "launch/b.launch.py:5:12",
                "LaunchConfiguration takes 1 positional argument: variable_name",
            ),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.calls:
            parameters = signature(call.kind)
            if parameters is None or call.is_open or is_tried(launch.module, call.call, ""):
                continue
            count, most = len(call.call.args), len(parameters.positional)
            if count > most and call.kind != "LaunchDescription":
                yield self.report(call, _too_many(call.kind, parameters.positional))
                continue
            missing = [name for name in parameters.required if name not in call.given]
            if missing and parameters.names.issuperset(call.words):
                names = " and ".join(f"{name}=..." for name in missing)
                yield self.report(call, f"{call.kind} needs {names}: TypeError")


def _too_many(kind: str, positional: tuple[str, ...]) -> str:
    if kind == "PathJoinSubstitution":
        return "PathJoinSubstitution takes one list of parts: put them in [...]"
    if not positional:
        return f"{kind} takes keyword arguments only"
    count = f"{len(positional)} positional argument" + "s" * (len(positional) > 1)
    return f"{kind} takes {count}: {', '.join(positional)}"
