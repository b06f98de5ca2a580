"""LF058: each argument of a program is a text of its own."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from itertools import pairwise

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import NODES, LaunchFile

_LISTS = ("arguments", "ros_arguments", "cmd")
_TWO_TEXTS = r"""(['"])((?:(?!\1)[^\\])*)\1\s+(['"])-"""
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='talker', executable='talk', arguments=[{}]),\n    ])\n"
)


class WordsRunTogether(LaunchRule):
    """Two arguments of a program are one text: a comma is missing, or a space is no border.

    **Why.** Python joins texts that stand side by side: ``'--ros-args' '-r'`` is ``--ros-args-r``.
    ``'--ros-args -r a:=b'`` is one argument with spaces in it. The program ignores both, most often
    without a word.

    **Fix.** ``['--ros-args', '-r', 'a:=b']``.

    **Source.** Python documentation, "String literal concatenation";
    ``launch/descriptions/executable.py``.
    """

    code = "LF058"
    name = "words-run-together"
    examples = (
        Example(
            "one by one",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "'--ros-args', '-r', 'a:=b', 'one long ' 'text'"
                )
            },
        ),
        Example(
            "a missing comma",
            {"launch/a.launch.py": _LAUNCH.format("'--ros-args' '-r', 'a:=b'")},
            Report(
                "launch/a.launch.py:7:62",
                "Python joins this to '--ros-args-r': a comma is missing between the texts",
            ),
        ),
        Example(
            "a prefix",
            {"launch/a.launch.py": _LAUNCH.format("'a'], prefix=['xterm', '-e'")},
            Report(
                "launch/a.launch.py:7:85",
                "launch joins the parts of a prefix as they are: a space is missing",
            ),
        ),
        Example(
            "three in one",
            {"launch/a.launch.py": _LAUNCH.format("'--ros-args -r a:=b'")},
            Report(
                "launch/a.launch.py:7:62",
                "this is one argument with spaces in it: write one text for each word",
            ),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find(*NODES, "ExecuteProcess"):
            if "shell" in call.given:
                continue
            for item in _joined_parts(call.given.get("prefix")):
                message = "launch joins the parts of a prefix as they are: a space is missing"
                yield self.report(launch.location(item), message)
            for name in _LISTS:
                node = call.given.get(name)
                for item in node.elts if isinstance(node, ast.List) else ():
                    problem = _problem(launch, item)
                    if problem:
                        yield self.report(launch.location(item), problem)


def _joined_parts(node: ast.expr | None) -> Iterator[ast.expr]:
    """Yield the options of a prefix that run into the word in front of them."""
    listed = node.elts if isinstance(node, ast.List) else []
    for left, right in pairwise(listed):
        match left, right:
            case ast.Constant(value=str(first)), ast.Constant(value=str(second)) if (
                second.startswith("-") and not first.endswith((" ", "-", "="))
            ):
                yield right


def _problem(launch: LaunchFile, item: ast.expr) -> str:
    if not isinstance(item, ast.Constant) or not isinstance(item.value, str):
        return ""
    if item.value.startswith("--ros-args "):
        return "this is one argument with spaces in it: write one text for each word"
    # linear: the quote that ends the first text is not among its characters
    written = re.match(_TWO_TEXTS, launch.module.text(item))
    if written is not None and not written[2].endswith((" ", "=", ":", ",")):
        return f"Python joins this to {item.value!r}: a comma is missing between the texts"
    return ""
