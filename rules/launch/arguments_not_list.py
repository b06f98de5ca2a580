"""LF008: arguments of a node are a list."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, LaunchRule, Report
from scaffold.api.launch import NODES, LaunchFile

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='talker', executable='talk', {}={}),\n    ])\n"
)


class ArgumentsNotList(LaunchRule):
    """``arguments=`` of a node is one string.

    **Why.** launch goes through it letter by letter: the program gets ``-``, ``-``, ``r``, ``o``
    ... and, most often, ignores them without a word.

    **Fix.** Write a list with one string for each argument.

    **Source.** ``launch_ros/actions/node.py``: ``cmd += arguments``.
    """

    code = "LF008"
    name = "arguments-not-list"
    examples = (
        Example("a list", {"launch/a.launch.py": _LAUNCH.format("arguments", "['-v', '3']")}),
        Example(
            "a string",
            {"launch/a.launch.py": _LAUNCH.format("arguments", "'--rate 3'")},
            Report(
                "7:61", "arguments is one string, which launch splits into letters", fix="split it"
            ),
            fixed={"launch/a.launch.py": _LAUNCH.format("arguments", "'--rate 3'.split()")},
        ),
        Example(
            "for ROS",
            {"launch/a.launch.py": _LAUNCH.format("ros_arguments", "'-p rate:=2.0'")},
            Report(
                "7:65",
                "ros_arguments is one string, which launch splits into letters",
                fix="split it",
            ),
            fixed={"launch/a.launch.py": _LAUNCH.format("ros_arguments", "'-p rate:=2.0'.split()")},
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find(*NODES):
            for name in ("arguments", "ros_arguments"):
                node = call.given.get(name)
                if node is None or not isinstance(launch.evaluator.evaluate(node), str):
                    continue
                _, end = launch.module.span(node)
                fix = Fix("split it", (Edit(launch.path, end, end, ".split()"),))
                message = f"{name} is one string, which launch splits into letters"
                yield self.report(launch.location(node), message, fix)
