"""LF063: remappings are a list of pairs."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import NODES, LaunchFile

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='talker', executable='node', remappings={}),\n    ])\n"
)


def _launch(remappings: str) -> dict[str, str]:
    return {"launch/a.launch.py": _LAUNCH.format(remappings)}


class RemappingsNotPairs(LaunchRule):
    """``remappings=`` of a node is not a list of pairs.

    **Why.** ``ros2 launch`` stops with ``ValueError: not enough values to unpack``; a dictionary of
    remappings is read letter by letter.

    **Fix.** ``remappings=[('from', 'to')]``.

    **Source.** ``launch_ros/utilities/normalize_remap_rule.py``.
    """

    code = "LF063"
    name = "remappings-not-pairs"
    examples = (
        Example("pairs", _launch("[('a', 'b')]")),
        Example(
            "a dictionary",
            _launch("{'a': 'b'}"),
            Report("7:62", "remappings are a list of pairs, [('from', 'to')], not a dictionary"),
        ),
        Example(
            "one pair",
            _launch("('a', 'b')"),
            Report("7:62", "this is one pair: remappings are a list of pairs, [('from', 'to')]"),
        ),
        Example(
            "texts", _launch("['a:=b']"), Report("7:62", "'a:=b' is not a pair ('from', 'to')")
        ),
        Example(
            "three parts",
            _launch("[('a', 'b', 'c')]"),
            Report("7:62", "a remapping is a pair, and this has 3 parts"),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find(*NODES):
            node = call.given.get("remappings")
            problem = _problem(node) if node is not None else ""
            if problem and node is not None:
                yield self.report(launch.location(node), problem)


def _problem(node: ast.expr) -> str:
    if isinstance(node, ast.Dict):
        return "remappings are a list of pairs, [('from', 'to')], not a dictionary"
    if isinstance(node, ast.Tuple) and node.elts and not isinstance(node.elts[0], ast.Tuple):
        is_pair = not isinstance(node.elts[0], ast.List | ast.Name | ast.Starred)
        return (
            "this is one pair: remappings are a list of pairs, [('from', 'to')]" if is_pair else ""
        )
    if isinstance(node, ast.List):
        for elt in node.elts:
            if isinstance(elt, ast.Constant) and isinstance(elt.value, str):
                return f"{elt.value!r} is not a pair ('from', 'to')"
            if isinstance(elt, ast.Tuple) and len(elt.elts) != 2:  # noqa: PLR2004  from and to
                return f"a remapping is a pair, and this has {len(elt.elts)} parts"
    return ""
