"""LF003: generate_launch_description returns a LaunchDescription."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, LaunchRule, Location, Report
from scaffold.api.launch import LaunchFile, returns

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    node = Node(package='talker', executable='talk')\n"
)


class LaunchDescriptionNotReturned(LaunchRule):
    """``generate_launch_description`` does not return a ``LaunchDescription``.

    **Why.** ``ros2 launch``: ``'NoneType' object has no attribute
    'get_launch_arguments_with_include_launch_description_actions'``.

    **Fix.** ``return LaunchDescription([...])`` on every way through the function.

    **Source.** ROS 2 documentation, "Creating a launch file".
    """

    code = "LF003"
    name = "launch-description-not-returned"
    examples = (
        Example(
            "returned", {"launch/a.launch.py": _LAUNCH + "    return LaunchDescription([node])\n"}
        ),
        Example(
            "made, but not returned",
            {"launch/a.launch.py": _LAUNCH + "    LaunchDescription([node])\n"},
            Report(
                "7:5",
                "the LaunchDescription is created, but generate_launch_description returns None",
                fix="return it",
            ),
            fixed={"launch/a.launch.py": _LAUNCH + "    return LaunchDescription([node])\n"},
        ),
        Example(
            "a list; on one way only",
            {
                "launch/a.launch.py": _LAUNCH + "    return [node]\n",
                "launch/b.launch.py": _LAUNCH
                + "    if node:\n        return LaunchDescription([node])\n",
            },
            Report(
                "launch/a.launch.py:7:5",
                "generate_launch_description returns a list, not a LaunchDescription",
            ),
            Report(
                "launch/b.launch.py:5:5",
                "generate_launch_description returns None on some paths, not a LaunchDescription",
            ),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        function = launch.function
        if function is None or not isinstance(function.node, ast.FunctionDef):
            return
        node = function.node
        if node.decorator_list or any(launch.module.below(node, ast.Yield, ast.YieldFrom)):
            return
        yield from self._check(launch, node, function.location)

    def _check(
        self, launch: LaunchFile, node: ast.FunctionDef, at: Location
    ) -> Iterator[Diagnostic]:
        statements, reaches_end = returns(node)
        for item in statements:
            what = _wrong(launch, item.value)
            if what:
                message = f"generate_launch_description returns {what}, not a LaunchDescription"
                yield self.report(launch.location(item), message)
        if not reaches_end:
            return
        last = node.body[-1]
        made = launch.call_of(last.value) if isinstance(last, ast.Expr) else None
        if made is not None and made.kind == "LaunchDescription" and not statements:
            start, _ = launch.module.span(last)
            fix = Fix("return it", (Edit(launch.path, start, start, "return "),))
            message = (
                "the LaunchDescription is created, but generate_launch_description returns None"
            )
            yield self.report(launch.location(last), message, fix)
        else:
            some = " on some paths" if statements else ""
            message = f"generate_launch_description returns None{some}, not a LaunchDescription"
            yield self.report(at, message)


def _wrong(launch: LaunchFile, value: ast.expr | None) -> str | None:
    """Return the returned expression, if it is certainly not a LaunchDescription."""
    if value is None or (isinstance(value, ast.Constant) and value.value is None):
        return "None"
    if isinstance(value, ast.List | ast.Tuple | ast.ListComp):
        return "a list" if not isinstance(value, ast.Tuple) else "a tuple"
    call = launch.call_of(value)
    if call is not None and call.kind in {"Node", "IncludeLaunchDescription", "ExecuteProcess"}:
        return f"a {call.kind}"
    names = launch.module.qualified_names(value)
    return "the class" if any(name.endswith(".LaunchDescription") for name in names) else None
