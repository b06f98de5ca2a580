"""LF011: launch_arguments are pairs."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, LaunchRule, Report
from scaffold.api.launch import LaunchFile

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import IncludeLaunchDescription\n"
    "\n\ndef generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        IncludeLaunchDescription('talk.launch.py', launch_arguments={}),\n    ])\n"
)


class LaunchArgumentsNotPairs(LaunchRule):
    """``launch_arguments=`` of an include is a dictionary, not its items.

    **Why.** launch goes through it in pairs: ``ValueError: too many values to unpack (expected
    2)``; with names of two letters it sets wrong arguments without a word.

    **Fix.** Add ``.items()``.

    **Source.** ``launch/actions/include_launch_description.py``.
    """

    code = "LF011"
    name = "launch-arguments-not-pairs"
    examples = (
        Example("items", {"launch/a.launch.py": _LAUNCH.format("{'rate': '2'}.items()")}),
        Example(
            "a dictionary",
            {"launch/a.launch.py": _LAUNCH.format("{'rate': '2'}")},
            Report(
                "7:69",
                "launch_arguments is a dictionary; launch takes pairs: add .items()",
                fix="add .items()",
            ),
            fixed={"launch/a.launch.py": _LAUNCH.format("{'rate': '2'}.items()")},
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find("IncludeLaunchDescription"):
            node = call.given.get("launch_arguments")
            if node is None or not self._is_dictionary(launch, node):
                continue
            _, end = launch.module.span(node)
            fix = Fix("add .items()", (Edit(launch.path, end, end, ".items()"),))
            message = "launch_arguments is a dictionary; launch takes pairs: add .items()"
            yield self.report(launch.location(node), message, fix)

    def _is_dictionary(self, launch: LaunchFile, node: ast.expr) -> bool:
        if isinstance(node, ast.Name):
            lookup = launch.module.index.lookup(node.id, node)
            values = [binding.value for binding in lookup[1]] if lookup else [None]
            return all(_makes_dictionary(value) for value in values)
        return _makes_dictionary(node)


def _makes_dictionary(node: ast.expr | None) -> bool:
    if isinstance(node, ast.Call):
        return isinstance(node.func, ast.Name) and node.func.id == "dict"
    return isinstance(node, ast.Dict | ast.DictComp)
