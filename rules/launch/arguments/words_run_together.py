"""LF058: each argument of a program is a separate string."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from itertools import pairwise

from scaffold.api import Diagnostic, Example, LaunchRule
from scaffold.api.launch import NODES, LaunchCall, LaunchFile
from scaffold.api.python import joined_names

_PROGRAMS = frozenset({"bash", "cat", "echo", "gz", "python3", "ros2", "sh", "xacro"})
_PATHS = ("FindPackageShare", "PathJoinSubstitution", "ThisLaunchFileDir", "LaunchConfiguration")
_LISTS = ("arguments", "ros_arguments", "cmd")
_TWO_TEXTS = r"""(['"])((?:(?!\1)[^\\])*)\1\s+(['"])-"""
_OPTION_WITH_VALUE = r"--?[A-Za-z][\w-]* +[^\s-]"
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([\n"
    "        Node(package='talker', executable='talk', arguments=[{}]),\n    ])\n"
)
_COMMAND = (
    "from launch import LaunchDescription\n"
    "from launch.substitutions import (\n"
    "    Command, FindExecutable, LaunchConfiguration, PathJoinSubstitution)\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    text = Command({})\n"
    "    node = Node(package='talker', executable='node', parameters=[{{'text': text}}])\n"
    "    return LaunchDescription([node])\n"
)


def _command(command: str) -> dict[str, str]:
    return {"launch/a.launch.py": _COMMAND.format(command)}


class WordsRunTogether(LaunchRule):
    """Two words of a command line are in one string, or a comma or space is missing between them.

    **Why.** Python joins adjacent string literals: ``'--ros-args' '-r'`` is ``--ros-args-r``.
    ``'--ros-args -r a:=b'`` is one argument with spaces in it. Most programs ignore both without an
    error. ``Command(['xacro', path])`` searches for a program ``xacro/opt/...``. It splits what it
    joined at spaces: ``xyz:=0 0 0`` are three words.

    **Fix.** Write ``['--ros-args', '-r', 'a:=b']``; add a space at the end of ``'xacro '``, or ``'
    '`` after ``FindExecutable(...)``, and quotes around values: ``' xyz:="', xyz, '"'``.

    **Source.** Python documentation, "String literal concatenation";
    ``launch/descriptions/executable.py``; ``launch/substitutions/command.py``.
    """

    code = "LF058"
    name = "words-run-together"
    examples = (
        Example(
            "separate strings",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "'--ros-args', '-r', 'a:=b', 'one long ' 'text'"
                )
            },
        ),
        Example(
            "a missing comma",
            {"launch/a.launch.py": _LAUNCH.format("'--ros-args' '-r', 'a:=b'")},
            "7:62: Python joins this to '--ros-args-r': missing comma between the strings",
        ),
        Example(
            "names in a parameter",
            {
                "launch/a.launch.py": _LAUNCH.format(
                    "], parameters=[\n            {'names': ['arm' 'gripper'],\n"
                    "             'text': ['one long ' 'text']}"
                )
            },
            "8:24: Python joins this to 'armgripper': missing comma between the strings",
        ),
        Example(
            "a prefix",
            {"launch/a.launch.py": _LAUNCH.format("'a'], prefix=['xterm', '-e'")},
            "7:85: launch concatenates the parts of a prefix: missing space before this part",
        ),
        Example(
            "three words in one string",
            {"launch/a.launch.py": _LAUNCH.format("'--ros-args -r a:=b'")},
            "7:62: this is one argument with spaces in it; write a separate string for each word",
        ),
        Example(
            "an option with its value in one string",
            {"launch/a.launch.py": _LAUNCH.format("'-d /opt/a.rviz', '--name=a b', '-x', '- a'")},
            "7:62: this is one argument with spaces in it; write a separate string for each word",
        ),
        Example(
            "the value of an option, which its program splits",
            {"launch/a.launch.py": _LAUNCH.format("'--controller-ros-args', '--ros-args -r a:=b'")},
        ),
        Example("a command with a space", _command("['xacro ', 'a.urdf']")),
        Example(
            "a command without a space",
            _command("['xacro', 'a']"),
            "8:12: launch concatenates the parts of a command without a space; write 'xacro '",
        ),
        Example(
            "values with spaces, in quotes and without them",
            _command(
                "['xacro ', 'a.xacro', ' a:=\"', LaunchConfiguration('a', default='0 0'), '\"',\n"
                "                    ' b:=', LaunchConfiguration('b', default='0 0')]"
            ),
            "9:29: the spaces in '0 0' split it into words: xacro expects exactly one file and "
            "stops; put double quotes around the value",
        ),
        Example(
            "a program that is searched for",
            _command("[PathJoinSubstitution([FindExecutable(name='xacro')]), 'a']"),
            "8:12: launch concatenates the parts of a command without a space; write ' ' after it",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find("Command"):
            problem = _joined_command(launch, call.call.args[0]) if call.call.args else ""
            if problem:
                yield self.report(call, problem)
            for item, text in _split_values(launch, call.call):
                message = (
                    f"the spaces in {text!r} split it into words: xacro expects exactly one file "
                    "and stops; put double quotes around the value"
                )
                cause = f"values with spaces in {launch.path}"
                yield self.report(launch.location(item), message, cause=cause)
        for call in launch.find(*NODES, "ExecuteProcess"):
            if "shell" in call.given:
                continue
            for item in _joined_parts(call.given.get("prefix")):
                message = (
                    "launch concatenates the parts of a prefix: missing space before this part"
                )
                yield self.report(launch.location(item), message)
            for item, problem in _problems(launch, call):
                yield self.report(launch.location(item), problem)


def _problems(launch: LaunchFile, call: LaunchCall) -> Iterator[tuple[ast.expr, str]]:
    for item in _items_of_parameters(call.given.get("parameters")):
        problem = _joined_names(launch, item)
        if problem:
            yield item, problem
    for name in _LISTS:
        node = call.given.get(name)
        items = node.elts if isinstance(node, ast.List) else []
        for before, item in zip([None, *items], items, strict=False):
            problem = "" if _takes_words(before) else _problem(launch, item)
            if problem:
                yield item, problem


def _takes_words(option: ast.expr | None) -> bool:
    """Return whether the program splits the next word, as for ``--controller-ros-args``."""
    text = option.value if isinstance(option, ast.Constant) else None
    return isinstance(text, str) and text.endswith("-ros-args") and text != "--ros-args"


def _joined_parts(node: ast.expr | None) -> Iterator[ast.expr]:
    """Yield the options of a prefix without a space before them."""
    listed = node.elts if isinstance(node, ast.List) else []
    for left, right in pairwise(listed):
        match left, right:
            case ast.Constant(value=str(first)), ast.Constant(value=str(second)) if (
                second.startswith("-") and not first.endswith((" ", "-", "="))
            ):
                yield right


def _items_of_parameters(node: ast.expr | None) -> Iterator[ast.expr]:
    """Yield the items of lists used as parameter values."""
    for given in ast.walk(node) if node is not None else ():
        for value in given.values if isinstance(given, ast.Dict) else ():
            if isinstance(value, ast.List | ast.Tuple):
                yield from value.elts


def _joined_names(launch: LaunchFile, item: ast.expr) -> str:
    if isinstance(item, ast.Constant) and joined_names(launch.module, item):
        return f"Python joins this to {item.value!r}: missing comma between the strings"
    return ""


def _problem(launch: LaunchFile, item: ast.expr) -> str:
    if not isinstance(item, ast.Constant) or not isinstance(item.value, str):
        return ""
    if item.value.startswith("--ros-args ") or re.match(_OPTION_WITH_VALUE, item.value):
        return "this is one argument with spaces in it; write a separate string for each word"
    # linear: the first text cannot contain its closing quote
    written = re.match(_TWO_TEXTS, launch.module.text(item))
    if written is not None and not written[2].endswith((" ", "=", ":", ",")):
        return f"Python joins this to {item.value!r}: missing comma between the strings"
    return _joined_names(launch, item)


def _joined_command(launch: LaunchFile, node: ast.expr) -> str:
    """Return the problem with a command without a space after the first word."""
    if not isinstance(node, ast.List) or len(node.elts) < 2:  # noqa: PLR2004  word and argument
        return ""
    first, second = node.elts[0], node.elts[1]
    view = launch.call_of(first)
    if view is not None and view.kind == "PathJoinSubstitution":
        parts = view.given.get("substitutions")
        if isinstance(parts, ast.List) and len(parts.elts) == 1:
            view = launch.call_of(parts.elts[0])
    word = first.value if isinstance(first, ast.Constant) else ""
    if view is not None and view.kind == "FindExecutable":
        word = str(launch.text(view, "name"))
    if word not in _PROGRAMS or _begins_with_space(launch, second):
        return ""
    missing = f"'{word} '" if isinstance(first, ast.Constant) else "' ' after it"
    return f"launch concatenates the parts of a command without a space; write {missing}"


def _split_values(launch: LaunchFile, command: ast.Call) -> Iterator[tuple[ast.expr, str]]:
    """Yield the values of ``name:=`` for xacro with spaces that are not in quotes."""
    match command.args:
        case [ast.List(elts=[first, *_] as parts)]:
            call = launch.call_of(first)
            is_found = call is not None and launch.text(call, "name") == "xacro"
            word = first.value if isinstance(first, ast.Constant) else ""
            if not is_found and str(word).split()[:1] != ["xacro"]:
                return
        case _:
            return
    for before, item in pairwise(parts):
        start = before.value if isinstance(before, ast.Constant) else ""
        value = launch.default_of(item)
        if isinstance(value, str) and " " in value.strip() and str(start).endswith(":="):
            yield item, value


def _begins_with_space(launch: LaunchFile, node: ast.expr) -> bool:
    """Return whether a part of a command starts, or may start, with a space."""
    value = launch.evaluator.joined_text(node)
    if isinstance(value, str):
        return value[:1].isspace()
    call = launch.call_of(node)
    return call is None or call.kind not in _PATHS
