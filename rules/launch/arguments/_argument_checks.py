"""Checks of launch arguments: one function for each kind, which yields the problems."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping

from scaffold.api.launch import (
    ACTIONS,
    NODES,
    LaunchCall,
    LaunchFile,
    given_arguments,
    parameters_given,
)
from scaffold.api.python import arguments_for, is_known, is_none_literal

Flaw = tuple[ast.expr, str]
LOOSE = "choices must be a list of strings"
"""The start of the message about values that work, but are not checked."""
"""The place, and what is wrong there."""
Judge = Callable[[LaunchFile, LaunchCall, ast.expr], Iterator[Flaw]]

_OUTPUTS = frozenset({"screen", "log", "both", "own_log", "full"})
_NUMBERS = frozenset({int, float, bool})
_PAIRS = "launch takes pairs, {...}.items() or [('name', 'value')]"


def flaws(launch: LaunchFile, call: LaunchCall) -> Iterator[Flaw]:
    """Yield the arguments of a call, and their parts, that launch cannot use."""
    judges = _ARGUMENTS.get(call.kind, {})
    for name, node in call.given.items():
        judge = _condition if name == "condition" else judges.get(name)
        if judge is not None:
            yield from judge(launch, call, node)


def _texts(launch: LaunchFile, _: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    """Judge a list that launch joins to a text."""
    for part in node.elts if isinstance(node, ast.List | ast.Tuple) else [node]:
        yield from _text(launch, part)


def _text(launch: LaunchFile, node: ast.expr, *, is_number_read: bool = False) -> Iterator[Flaw]:
    view = launch.call_of(node)
    if _is_number(node) and not is_number_read:
        yield node, f"not a string; write {ast.unparse(node)!r}"
    elif view is not None and view.kind in ACTIONS:
        name = launch.text(view, "name") if view.kind == "DeclareLaunchArgument" else None
        hint = f"; write LaunchConfiguration({name!r})" if isinstance(name, str) else ""
        yield node, f"expected a value, not the action {view.kind}{hint}"


def _is_number(node: ast.AST) -> bool:
    return isinstance(node, ast.Constant) and type(node.value) in _NUMBERS


def _judge_condition(launch: LaunchFile, _: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    """Judge the value of a condition; another rule judges numbers."""
    yield from _text(launch, node, is_number_read=True)


def _judge_words(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    """Judge a list of command-line words; another rule reports other types."""
    if isinstance(node, ast.List | ast.Tuple):
        yield from _texts(launch, call, node)


def _command(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    value = launch.evaluator.evaluate(node)
    if isinstance(value, str) or isinstance(node, ast.JoinedStr):
        yield node, "launch splits this string into single characters; write a list of strings"
    if not isinstance(node, ast.List) or not node.elts:
        return
    yield from _judge_words(launch, call, node)
    first = node.elts[0]
    if isinstance(first, ast.Constant) and isinstance(first.value, str):
        text = first.value.strip()
        is_path = "\\ " in text or text.startswith(("/", "'", '"'))
        if " " in text and not is_path and "shell" not in call.given and not call.is_open:
            problem = f"launch searches for an executable named {text!r}; "
            yield node, f"{problem}write a list of strings"


def _environment(launch: LaunchFile, _: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    if isinstance(launch.evaluator.evaluate(node), list):
        yield node, "the environment must be a dictionary, not a list"
    for value in node.values if isinstance(node, ast.Dict) else ():
        yield from _text(launch, value)


def _remappings(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    for pair in node.elts if isinstance(node, ast.List) else ():
        if isinstance(pair, ast.Tuple):
            yield from _texts(launch, call, pair)


def _output(launch: LaunchFile, _: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    value = launch.evaluator.evaluate(node)
    if isinstance(value, str) and value not in _OUTPUTS:
        yield node, f"unknown output {value!r}; choose from {', '.join(sorted(_OUTPUTS))}"


def _respawn(_: LaunchFile, __: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node, "respawn must be a bool, not a string; write True or False"


def _period(_: LaunchFile, __: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    match node:
        case ast.Constant(value=bool() | None):
            yield node, "a period must be a number of seconds, such as 1.0"
        case ast.Constant(value=int(number)):
            yield node, f"a period must be a float; write {number}.0"
        case ast.Constant(value=str(text)):
            try:
                float(text)
            except ValueError:
                yield node, f"a period must be a number of seconds, not {text!r}"


def _type(_: LaunchFile, __: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node, f"value_type must be a type, not a string; write {node.value}"


def _default(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    value = launch.evaluator.evaluate(node)
    if type(value) in _NUMBERS:
        yield node, f"not a string; write {str(value)!r}"
    else:
        yield from _texts(launch, call, node)


def _choices(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    choices = launch.evaluator.evaluate(node)
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node, f"{LOOSE}: launch accepts any substring; write a list"
    if not isinstance(choices, list | tuple) or not all(map(is_known, choices)):
        return
    default = launch.text(call, "default_value")
    if any(type(choice) in _NUMBERS for choice in choices):
        yield node, "choices must be strings: values from the command line never equal a number"
    elif isinstance(default, str) and default not in choices:
        yield node, f"the default {default!r} is not among the choices"


def _condition(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    view = launch.call_of(node)
    is_text = isinstance(launch.evaluator.evaluate(node), str | bool)
    is_text = is_text or (view is not None and view.kind == "LaunchConfiguration")
    if is_text and call.kind != "IfElseSubstitution":
        yield node, "a condition must be an object such as IfCondition(...), not a value"


def _parameters(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    for item in node.elts if isinstance(node, ast.List) else ():
        if isinstance(item, ast.Tuple | ast.List):
            needed = "parameters must be files or dictionaries {'name': value}"
            yield node, f"{needed}, not lists or pairs"
            break
        if isinstance(item, ast.Name) and _may_be_none(launch, item):
            yield item, f"a call passes None as {item.id!r}, which is not a file or a dictionary"
    for name, _, value in parameters_given(launch, call):
        problem = _parameter_problem(value)
        if problem:
            yield value, f"the parameter {name!r} {problem}"


def _may_be_none(launch: LaunchFile, name: ast.Name) -> bool:
    """Return whether a name is the parameter of a function that some call passes None for."""
    module = launch.module
    if len(module.index.bindings_of(name)) != 1:
        return False
    if any(isinstance(parent, ast.If | ast.IfExp) for parent in module.parents(name)):
        return False
    return any(map(is_none_literal, arguments_for(module, name)))


def _parameter_problem(node: ast.expr) -> str:
    match node:
        case ast.Constant(value=None):
            return "is None, which is not a parameter value"
        case ast.List(elts=[]) | ast.Tuple(elts=[]):
            return "is an empty list, which has no type"
        case ast.List(elts=items) | ast.Tuple(elts=items):
            kinds = {
                type(item.value) if isinstance(item, ast.Constant) else object for item in items
            }
            if object not in kinds and len(kinds) > 1 and kinds != {int, float}:
                return "is a list of mixed types"
    return ""


def _arguments_of_include(launch: LaunchFile, call: LaunchCall, node: ast.expr) -> Iterator[Flaw]:
    cases = launch.cases(call.call) or (None,)
    given = (item for case in cases for item in given_arguments(launch, call, case) or ())
    for name, _, value in dict.fromkeys(given):
        problem = _include_problem(launch, value)
        if problem:
            yield value, f"{name!r} gets {problem}"
    match node:
        case ast.Set(elts=items) if not all(map(_may_be_pair, items)):
            yield node, f"expected pairs, not a set: {_PAIRS}"
        case ast.Attribute(value=ast.Dict(), attr="items"):
            yield node, "items is not called; write .items()"
        case ast.List(elts=items) | ast.Tuple(elts=items):
            if any(isinstance(item, ast.Constant | ast.JoinedStr) for item in items):
                yield node, f"not pairs: {_PAIRS}"


def _may_be_pair(node: ast.expr) -> bool:
    match node:
        case ast.Tuple(elts=[_, _]) | ast.Name() | ast.Starred():
            return True
    return False


def _include_problem(launch: LaunchFile, node: ast.expr) -> str:
    value = launch.evaluator.evaluate(node)
    if isinstance(node, ast.Constant) and not isinstance(node.value, str):
        return f"{node.value!r}, which is not a string: write {str(node.value).lower()!r}"
    if type(value) in _NUMBERS:
        return f"{value!r}, which is not a string"
    if isinstance(node, ast.List) and any(map(_is_number, node.elts)):
        return "a list with a number, which launch cannot concatenate"
    return ""


def _of_texts(*names: str) -> Mapping[str, Judge]:
    return dict.fromkeys(names, _texts)


_PROCESS: Mapping[str, Judge] = {
    "additional_env": _environment,
    "env": _environment,
    "respawn": _respawn,
}
_NODE: Mapping[str, Judge] = {
    **_PROCESS,
    **_of_texts("executable", "package", "name", "namespace", "exec_name"),
    "arguments": _judge_words,
    "output": _output,
    "parameters": _parameters,
    "remappings": _remappings,
    "ros_arguments": _judge_words,
}
_ARGUMENTS: Mapping[str, Mapping[str, Judge]] = {
    **dict.fromkeys(NODES, _NODE),
    "AppendEnvironmentVariable": _of_texts("name", "value"),
    "ComposableNode": {
        **_of_texts("package", "plugin", "name", "namespace"),
        "parameters": _parameters,
    },
    "DeclareLaunchArgument": {"choices": _choices, "default_value": _default},
    "EnvironmentVariable": _of_texts("name", "default_value"),
    "ExecuteProcess": {**_PROCESS, "cmd": _command},
    "FindExecutable": _of_texts("name"),
    "FindPackageShare": _of_texts("package"),
    "IfCondition": {"predicate_expression": _judge_condition},
    "IncludeLaunchDescription": {
        **_of_texts("launch_description_source"),
        "launch_arguments": _arguments_of_include,
    },
    "LaunchConfiguration": _of_texts("variable_name"),
    "LogInfo": _of_texts("msg"),
    "ParameterValue": {"value_type": _type},
    "PathJoinSubstitution": _of_texts("substitutions"),
    "PushRosNamespace": _of_texts("namespace"),
    "PythonExpression": _of_texts("expression"),
    "SetEnvironmentVariable": _of_texts("name", "value"),
    "SetLaunchConfiguration": _of_texts("name", "value"),
    "SetRemap": _of_texts("src", "dst"),
    "TextSubstitution": _of_texts("text"),
    "TimerAction": {"period": _period},
    "UnlessCondition": {"predicate_expression": _judge_condition},
}
"""The check of an argument, by class and argument name."""
