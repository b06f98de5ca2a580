"""LF017: actions get keywords that they have."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import LaunchFile, signature
from scaffold.api.rclpy import is_tried

_OLD = frozenset({"node_executable", "node_name", "node_namespace", "node_plugin"})
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import DeclareLaunchArgument\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        DeclareLaunchArgument('rate', {}='2.0'),\n    ])\n"
)


class KeywordUnknown(LaunchRule):
    """An action or a substitution gets a keyword argument that it does not have.

    **Why.** ``ros2 launch`` stops: ``TypeError: Action.__init__() got an unexpected keyword
    argument 'default'``.

    **Fix.** Write the name of the argument: ``default_value``.

    **Source.** The modules of ``launch.actions``, ``launch.substitutions``, ``launch_ros.actions``
    and ``launch_ros.descriptions``.
    """

    code = "LF017"
    name = "keyword-unknown"
    examples = (
        Example("known", {"launch/a.launch.py": _LAUNCH.format("default_value")}),
        Example(
            "of another class",
            {"launch/a.launch.py": _LAUNCH.format("default")},
            Report(
                "7:39", "DeclareLaunchArgument has no argument 'default'; closest: 'default_value'"
            ),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.calls:
            parameters = signature(call.kind)
            for name, word in call.words.items() if parameters is not None else ():
                if parameters is None or name in parameters.names or name in _OLD:
                    continue
                if is_tried(launch.module, call.call, name):
                    continue
                closest = get_close_matches(name, sorted(parameters.names), 1, 0.6)
                hint = f"; closest: {closest[0]!r}" if closest else ""
                start, _ = launch.module.span(word)
                at = launch.module.source.location(start, start + len(name))
                yield self.report(at, f"{call.kind} has no argument {name!r}{hint}")
