"""LF080: a static transform is described with names."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, LaunchRule, Report
from scaffold.api.distributions import of_kind, target
from scaffold.api.launch import NODES, LaunchFile

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='tf2_ros', executable='static_transform_publisher',\n"
    "             arguments=[{}]),\n    ])\n"
)
_OLD = "'1', '0', '0', '0', '0', '0', 'base', 'laser'"
_NEW = (
    "'--x', '1', '--y', '0', '--z', '0', '--yaw', '0', '--pitch', '0', '--roll', '0', "
    "'--frame-id', 'base', '--child-frame-id', 'laser'"
)
_FRAMES = ("--frame-id", "--child-frame-id")
_FLAGS = {
    8: ("--x", "--y", "--z", "--yaw", "--pitch", "--roll", *_FRAMES),
    9: ("--x", "--y", "--z", "--qx", "--qy", "--qz", "--qw", *_FRAMES),
}
"""By the number of arguments without names."""


class StaticTransformArguments(LaunchRule):
    """A launch file gives ``static_transform_publisher`` arguments without names.

    **Why.** The program ends at once: Lyrical does not understand them any more.

    **Fix.** Put the name before each value; all distributions know the names.

    **Source.** geometry2, ``static_transform_broadcaster_program.cpp``.
    """

    code = "LF080"
    name = "static-transform-arguments"
    examples = (
        Example("still known", {"launch/a.launch.py": _LAUNCH.format(_OLD)}),
        Example("names", {"launch/a.launch.py": _LAUNCH.format(_NEW)}, distro="lyrical"),
        Example(
            "no names",
            {"launch/a.launch.py": _LAUNCH.format(_OLD)},
            Report(
                "8:24",
                "static_transform_publisher of Lyrical takes no arguments "
                "without names; write --x, --y and so on",
                fix="write the names",
            ),
            fixed={"launch/a.launch.py": _LAUNCH.format(_NEW)},
            distro="lyrical",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        (change,) = of_kind("launch")
        if not change.is_removed or not launch.module.mentions(change.names[0]):
            return
        for call in launch.find(*NODES):
            executable, given = call.given.get("executable"), call.given.get("arguments")
            match executable, given:
                case ast.Constant(value=name), ast.List(elts=values) if name in change.names:
                    flags = _FLAGS.get(len(values))
                    if flags is None or any(map(_is_flag, values)):
                        continue
                    message = (
                        f"{name} of {target().title} takes no arguments without names; "
                        f"{change.advice}"
                    )
                    fix = Fix("write the names", tuple(_edits(launch, values, flags)))
                    yield self.report(launch.location(given), message, fix)


def _is_flag(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and str(node.value).startswith("--")


def _edits(launch: LaunchFile, values: list[ast.expr], flags: tuple[str, ...]) -> Iterator[Edit]:
    for value, flag in zip(values, flags, strict=True):
        start, _ = launch.module.span(value)
        yield Edit(launch.path, start, start, f"'{flag}', ")
