"""LF064: the parts of commands have spaces between them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Report
from scaffold.api.launch import LaunchFile

_PROGRAMS = frozenset({"bash", "cat", "echo", "gz", "python3", "ros2", "sh", "xacro"})
_PATHS = ("FindPackageShare", "PathJoinSubstitution", "ThisLaunchFileDir", "LaunchConfiguration")
_LAUNCH = (
    "from launch import LaunchDescription\n"
    "from launch.substitutions import Command, FindExecutable, PathJoinSubstitution\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    text = Command({})\n"
    "    node = Node(package='talker', executable='node', parameters=[{{'text': text}}])\n"
    "    return LaunchDescription([node])\n"
)


def _launch(command: str) -> dict[str, str]:
    return {"launch/a.launch.py": _LAUNCH.format(command)}


class CommandWordsJoined(LaunchRule):
    """There is no space between a program and its first argument in a ``Command``.

    **Why.** The parts of a command are joined as they are, so that ``xacro`` and its file become
    one word: ``ros2 launch`` stops with ``No such file or directory: 'xacro/opt/...'``.

    **Fix.** A space at the end of ``'xacro '``, or ``' '`` after ``FindExecutable(...)``.

    **Source.** ``launch/substitutions/command.py``.
    """

    code = "LF064"
    name = "command-words-joined"
    examples = (
        Example("a space", _launch("['xacro ', 'a.urdf']")),
        Example(
            "no space",
            _launch("['xacro', 'a']"),
            Report(
                "launch/a.launch.py:7:12",
                "parts of a command are joined without spaces: write 'xacro '",
            ),
        ),
        Example(
            "a program that is looked for",
            _launch("[PathJoinSubstitution([FindExecutable(name='xacro')]), 'a']"),
            Report(
                "launch/a.launch.py:7:12",
                "parts of a command are joined without spaces: write ' ' after it",
            ),
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find("Command"):
            problem = _joined(launch, call.call.args[0]) if call.call.args else ""
            if problem:
                yield self.report(call, problem)


def _joined(launch: LaunchFile, node: ast.expr) -> str:
    """Return what is wrong about a command whose first word runs into the next part."""
    if not isinstance(node, ast.List) or len(node.elts) < 2:  # noqa: PLR2004  word and argument
        return ""
    first, second = node.elts[0], node.elts[1]
    found = launch.call_of(first)
    if found is not None and found.kind == "PathJoinSubstitution":
        parts = found.given.get("substitutions")
        if isinstance(parts, ast.List) and len(parts.elts) == 1:
            found = launch.call_of(parts.elts[0])
    word = first.value if isinstance(first, ast.Constant) else ""
    if found is not None and found.kind == "FindExecutable":
        word = str(launch.text(found, "name"))
    if word not in _PROGRAMS or _begins_with_space(launch, second):
        return ""
    what = f"'{word} '" if isinstance(first, ast.Constant) else "' ' after it"
    return f"parts of a command are joined without spaces: write {what}"


def _begins_with_space(launch: LaunchFile, node: ast.expr) -> bool:
    """Tell whether a part of a command begins with a space, or may do so."""
    value = launch.evaluator.joined_text(node)
    if isinstance(value, str):
        return value[:1].isspace()
    call = launch.call_of(node)
    return call is None or call.kind not in _PATHS
