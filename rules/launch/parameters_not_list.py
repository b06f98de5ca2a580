"""LF007: parameters of a node are a list."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, LaunchRule, Report
from scaffold.api.launch import NODES, LaunchFile

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='talker', executable='talk', parameters={}),\n    ])\n"
)


class ParametersNotList(LaunchRule):
    """``parameters=`` of a node is not a list.

    **Why.** ``ros2 launch`` stops: ``'Node' expected 'parameters' to be one of [<class 'list'>]``;
    a tuple is refused as well.

    **Fix.** Put brackets around: ``parameters=[{...}]``.

    **Source.** ``launch_ros/actions/node.py``.
    """

    code = "LF007"
    name = "parameters-not-list"
    examples = (
        Example("a list", {"launch/a.launch.py": _LAUNCH.format("[{'rate': 2.0}]")}),
        Example(
            "a dictionary",
            {"launch/a.launch.py": _LAUNCH.format("{'rate': 2.0}")},
            Report("7:62", "parameters is a dictionary; Node takes a list", fix="make it a list"),
            fixed={"launch/a.launch.py": _LAUNCH.format("[{'rate': 2.0}]")},
        ),
        Example(
            "a path, a tuple",
            {
                "launch/a.launch.py": _LAUNCH.format("'talker.yaml'"),
                "launch/b.launch.py": _LAUNCH.format("({'rate': 2.0},)"),
            },
            Report(
                "launch/a.launch.py:7:62",
                "parameters is a single value; Node takes a list",
                fix="make it a list",
            ),
            Report(
                "launch/b.launch.py:7:62",
                "parameters is a tuple; Node takes a list",
                fix="make it a list",
            ),
            fixed={
                "launch/a.launch.py": _LAUNCH.format("['talker.yaml']"),
                "launch/b.launch.py": _LAUNCH.format("[*({'rate': 2.0},)]"),
            },
        ),
        Example(
            "a path that is put together",
            {"launch/a.launch.py": _LAUNCH.format("'talker' + '.yaml'")},
            Report("7:62", "parameters is a path; Node takes a list", fix="make it a list"),
            fixed={"launch/a.launch.py": _LAUNCH.format("['talker' + '.yaml']")},
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find(*NODES):
            node = call.given.get("parameters")
            what = self._what(launch, node) if node is not None else None
            if node is None or what is None:
                continue
            start, end = launch.module.span(node)
            star = "*" if what == "a tuple" else ""
            edits = (Edit(launch.path, start, start, f"[{star}"), Edit(launch.path, end, end, "]"))
            message = f"parameters is {what}; {call.kind} takes a list"
            yield self.report(launch.location(node), message, Fix("make it a list", edits))

    def _what(self, launch: LaunchFile, node: ast.expr) -> str | None:
        if isinstance(node, ast.Name):
            lookup = launch.module.index.lookup(node.id, node)
            values = [binding.value for binding in lookup[1]] if lookup else []
            node = values[0] if len(values) == 1 and values[0] is not None else node
        if isinstance(node, ast.Dict | ast.DictComp):
            return "a dictionary"
        if isinstance(node, ast.Tuple):
            return "a tuple"
        if isinstance(node, ast.Constant | ast.JoinedStr) and not _is_none(node):
            return "a single value"
        call = launch.call_of(node)
        if call is not None and call.kind in {"LaunchConfiguration", "ParameterFile"}:
            return f"a {call.kind}"
        if isinstance(launch.evaluator.evaluate(node), str):
            return "a path"
        return None


def _is_none(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and node.value is None
