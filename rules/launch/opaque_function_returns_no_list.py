"""LF062: the function of an OpaqueFunction returns a list."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import ACTIONS, LaunchFile, function_of
from scaffold.api.python import returned

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import OpaqueFunction\n"
    "from launch_ros.actions import Node\n\n\n"
    "def set_up(context):\n    node = Node(package='a', executable='b')\n    return {}\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([OpaqueFunction(function=set_up)])\n"
)


class OpaqueFunctionReturnsNoList(LaunchRule):
    """The function of an OpaqueFunction returns one action, or a launch description.

    **Why.** ``ros2 launch`` stops: ``'Node' object is not iterable``, ``'LaunchDescription' object
    is not iterable``.

    **Fix.** ``return [node]``.

    **Source.** ``launch/actions/opaque_function.py``.
    """

    code = "LF062"
    name = "opaque-function-returns-no-list"
    examples = (
        Example("a list", {"launch/a.launch.py": _LAUNCH.format("[node]")}),
        Example(
            "one action",
            {"launch/a.launch.py": _LAUNCH.format("node")},
            Report("launch/a.launch.py:8:5", "set_up returns one Node, not a list: TypeError"),
        ),
        Example(
            "a description",
            {"launch/a.launch.py": _LAUNCH.format("LaunchDescription([node])")},
            Report(
                "launch/a.launch.py:8:5",
                "set_up returns one LaunchDescription, not a list: TypeError",
            ),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        given = [call.given.get("function") for call in launch.find("OpaqueFunction")]
        for function in dict.fromkeys(function_of(launch, one) for one in given):
            if function is None or function.decorator_list:
                continue
            for statement in returned(function):
                found = launch.call_of(statement.value)
                if found is not None and found.kind in {*ACTIONS, "LaunchDescription"}:
                    message = f"{function.name} returns one {found.kind}, not a list: TypeError"
                    yield self.report(launch.location(statement), message)
