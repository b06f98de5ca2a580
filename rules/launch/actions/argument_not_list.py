"""LF007: arguments that launch iterates over are lists of items or pairs."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, LaunchRule, Report
from scaffold.api.launch import NODES, LaunchCall, LaunchFile
from scaffold.api.python import is_none_literal

_PAIRS = "a list of pairs, [('from', 'to')]"
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import IncludeLaunchDescription\n"
    "from launch_ros.actions import Node\n\n\ndef generate_launch_description():\n"
    "    return LaunchDescription([\n        {},\n    ])\n"
)
_NODE = _LAUNCH.format("Node(package='talker', executable='talk', {})")
_INCLUDE = _LAUNCH.format("IncludeLaunchDescription('talk.launch.py', launch_arguments={})")


def _node(arguments: str) -> dict[str, str]:
    return {"launch/a.launch.py": _NODE.format(arguments)}


def _include(arguments: str) -> dict[str, str]:
    return {"launch/a.launch.py": _INCLUDE.format(arguments)}


class ArgumentNotList(LaunchRule):
    """An argument that must be a list, such as ``parameters=`` of a node, is not a list.

    **Why.** ``parameters``: ``ros2 launch`` stops, ``'Node' expected 'parameters' to be one of
    [<class 'list'>]``; a tuple fails as well. A string in ``arguments`` is split into characters:
    the program gets ``-``, ``-``, ``r``, ``o`` ..., and usually ignores them. ``remappings`` and
    ``launch_arguments`` are unpacked as pairs: ``ValueError: not enough values to unpack``; names
    with two letters set wrong arguments, without an error.

    **Fix.** Pass a list: of dictionaries and files for ``parameters``, of strings for
    ``arguments``, of pairs for ``remappings``. For ``launch_arguments``, pass the ``.items()`` of a
    dictionary.

    **Source.** ``launch_ros/actions/node.py``, ``launch_ros/utilities/normalize_remap_rule.py``,
    ``launch/actions/include_launch_description.py``.
    """

    code = "LF007"
    name = "argument-not-list"
    examples = (
        Example("parameters: a list", _node("parameters=[{'rate': 2.0}]")),
        Example(
            "parameters: a dictionary",
            _node("parameters={'rate': 2.0}"),
            Report(
                "8:62",
                "expected a list of parameters, not a dictionary: Node raises TypeError",
                fix="Convert to a list",
            ),
            fixed=_node("parameters=[{'rate': 2.0}]"),
        ),
        Example(
            "parameters: a tuple",
            _node("parameters=({'rate': 2.0},)"),
            Report(
                "8:62",
                "expected a list of parameters, not a tuple: Node raises TypeError",
                fix="Convert to a list",
            ),
            fixed=_node("parameters=[*({'rate': 2.0},)]"),
        ),
        Example(
            "parameters: a path",
            _node("parameters='talker.yaml'"),
            Report(
                "8:62",
                "expected a list of parameters, not a single value: Node raises TypeError",
                fix="Convert to a list",
            ),
            fixed=_node("parameters=['talker.yaml']"),
        ),
        Example(
            "parameters: a path that is concatenated",
            _node("parameters='talker' + '.yaml'"),
            Report(
                "8:62",
                "expected a list of parameters, not a path: Node raises TypeError",
                fix="Convert to a list",
            ),
            fixed=_node("parameters=['talker' + '.yaml']"),
        ),
        Example("arguments: a list", _node("arguments=['-v', '3']")),
        Example(
            "arguments: a string",
            _node("arguments='--rate 3'"),
            Report(
                "8:61",
                "arguments is a string, which launch splits into single characters; pass a list",
                fix="Append .split()",
            ),
            fixed=_node("arguments='--rate 3'.split()"),
        ),
        Example(
            "ros_arguments: a string",
            _node("ros_arguments='-p rate:=2.0'"),
            Report(
                "8:65",
                "ros_arguments is a string, which launch splits into single "
                "characters; pass a list",
                fix="Append .split()",
            ),
            fixed=_node("ros_arguments='-p rate:=2.0'.split()"),
        ),
        Example("remappings: pairs", _node("remappings=[('a', 'b')]")),
        Example(
            "remappings: a dictionary",
            _node("remappings={'a': 'b'}"),
            "8:62: remappings must be a list of pairs, [('from', 'to')], not a dictionary",
        ),
        Example(
            "remappings: one pair",
            _node("remappings=('a', 'b')"),
            "8:62: this is a single pair; remappings must be a list of pairs, [('from', 'to')]",
        ),
        Example(
            "remappings: strings",
            _node("remappings=['a:=b']"),
            "8:62: 'a:=b' is not a pair ('from', 'to')",
        ),
        Example(
            "remappings: three parts",
            _node("remappings=[('a', 'b', 'c')]"),
            "8:62: a remapping must be a pair, but this has 3 items",
        ),
        Example("launch_arguments: items", _include("{'rate': '2'}.items()")),
        Example(
            "launch_arguments: a dictionary",
            _include("{'rate': '2'}"),
            Report(
                "8:69",
                "launch_arguments must be pairs, not a dictionary; add .items()",
                fix="Append .items()",
            ),
            fixed=_include("{'rate': '2'}.items()"),
        ),
        Example(
            "keyword arguments of a function",
            {
                "a.launch.py": "from launch import LaunchDescription\n"
                "from launch.actions import IncludeLaunchDescription\n\n\n"
                "def part(path, **arguments):\n"
                "    return IncludeLaunchDescription(path, launch_arguments=arguments)\n\n\n"
                "def generate_launch_description():\n"
                "    return LaunchDescription([part('talk.launch.py', rate='2')])\n"
            },
            Report(
                "6:60",
                "launch_arguments must be pairs, not a dictionary; add .items()",
                fix="Append .items()",
            ),
            fixed={
                "a.launch.py": "from launch import LaunchDescription\n"
                "from launch.actions import IncludeLaunchDescription\n\n\n"
                "def part(path, **arguments):\n"
                "    return IncludeLaunchDescription(path, launch_arguments=arguments.items())\n"
                "\n\ndef generate_launch_description():\n"
                "    return LaunchDescription([part('talk.launch.py', rate='2')])\n"
            },
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find(*NODES, "IncludeLaunchDescription"):
            for argument, judge in _ARGUMENTS.items():
                node = call.given.get(argument)
                is_of_node = call.kind != "IncludeLaunchDescription"
                if node is None or is_of_node is (argument == "launch_arguments"):
                    continue
                message, fix = judge(launch, call, argument)
                if message:
                    yield self.report(launch.location(node), message, fix)


_Judgement = tuple[str, Fix | None]
_FITS: _Judgement = ("", None)


def _parameters(launch: LaunchFile, call: LaunchCall, argument: str) -> _Judgement:
    node = call.given[argument]
    kind = _kind_of_parameters(launch, node)
    if kind is None:
        return _FITS
    start, end = launch.module.span(node)
    star = "*" if kind == "a tuple" else ""
    edits = (Edit(launch.path, start, start, f"[{star}"), Edit(launch.path, end, end, "]"))
    return f"expected a list of parameters, not {kind}: {call.kind} raises TypeError", Fix(
        "Convert to a list", edits
    )


def _kind_of_parameters(launch: LaunchFile, node: ast.expr) -> str | None:
    node = launch.module.index.only_value(node) or node
    if isinstance(node, ast.Dict | ast.DictComp):
        return "a dictionary"
    if isinstance(node, ast.Tuple):
        return "a tuple"
    if isinstance(node, ast.Constant | ast.JoinedStr) and not is_none_literal(node):
        return "a single value"
    call = launch.call_of(node)
    if call is not None and call.kind in {"LaunchConfiguration", "ParameterFile"}:
        return f"a {call.kind}"
    return "a path" if isinstance(launch.evaluator.evaluate(node), str) else None


def _words(launch: LaunchFile, call: LaunchCall, argument: str) -> _Judgement:
    node = call.given[argument]
    if not isinstance(launch.evaluator.evaluate(node), str):
        return _FITS
    _, end = launch.module.span(node)
    fix = Fix("Append .split()", (Edit(launch.path, end, end, ".split()"),))
    return f"{argument} is a string, which launch splits into single characters; pass a list", fix


def _remappings(_: LaunchFile, call: LaunchCall, argument: str) -> _Judgement:
    return _flaw_of_remappings(call.given[argument]), None


def _flaw_of_remappings(node: ast.expr) -> str:
    if isinstance(node, ast.Dict):
        return f"remappings must be {_PAIRS}, not a dictionary"
    if isinstance(node, ast.Tuple) and node.elts and not isinstance(node.elts[0], ast.Tuple):
        is_pair = not isinstance(node.elts[0], ast.List | ast.Name | ast.Starred)
        return f"this is a single pair; remappings must be {_PAIRS}" if is_pair else ""
    if isinstance(node, ast.List):
        for elt in node.elts:
            if isinstance(elt, ast.Constant) and isinstance(elt.value, str):
                return f"{elt.value!r} is not a pair ('from', 'to')"
            if isinstance(elt, ast.Tuple) and len(elt.elts) != 2:  # noqa: PLR2004  from and to
                return f"a remapping must be a pair, but this has {len(elt.elts)} items"
    return ""


def _of_include(launch: LaunchFile, call: LaunchCall, argument: str) -> _Judgement:
    node = call.given[argument]
    values: list[ast.expr | None] = [node]
    if isinstance(node, ast.Name):
        bindings = launch.module.index.bindings_of(node)
        values = [binding.value for binding in bindings] or [None]
        if len(bindings) == 1 and _takes_keywords(launch, bindings[0].node):
            values = [ast.Dict(keys=[], values=[])]
    if not all(map(_makes_dictionary, values)):
        return _FITS
    _, end = launch.module.span(node)
    fix = Fix("Append .items()", (Edit(launch.path, end, end, ".items()"),))
    return "launch_arguments must be pairs, not a dictionary; add .items()", fix


def _takes_keywords(launch: LaunchFile, parameter: ast.AST) -> bool:
    """Return whether a parameter is a dictionary of keyword arguments: ``**arguments``."""
    arguments = launch.module.parent(parameter)
    return isinstance(arguments, ast.arguments) and arguments.kwarg is parameter


def _makes_dictionary(node: ast.expr | None) -> bool:
    if isinstance(node, ast.Call):
        return isinstance(node.func, ast.Name) and node.func.id == "dict"
    return isinstance(node, ast.Dict | ast.DictComp)


_ARGUMENTS: dict[str, Callable[[LaunchFile, LaunchCall, str], _Judgement]] = {
    "parameters": _parameters,
    "arguments": _words,
    "ros_arguments": _words,
    "remappings": _remappings,
    "launch_arguments": _of_include,
}
"""The arguments that launch iterates over, each with its check."""
