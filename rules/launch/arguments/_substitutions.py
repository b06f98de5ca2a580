"""Substitutions that a Python launch file uses as if they were already text."""

from __future__ import annotations

import ast
import builtins
import math
import warnings
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

from scaffold.api.python import UNKNOWN, Unknown

if TYPE_CHECKING:
    from scaffold.api.launch import LaunchCall, LaunchFile
    from scaffold.api.python import PythonModule


_KINDS = frozenset(
    {"Command", "EnvironmentVariable", "FindPackageShare", "LaunchConfiguration"}
    | {"PathJoinSubstitution", "PythonExpression", "TextSubstitution", "ThisLaunchFileDir"}
)
_TEXT_FUNCTIONS = frozenset(
    {"os.path.join", "os.path.exists", "open", "int", "float", "os.path.isfile", "pathlib.Path"}
    | {"bool", "len", "range"}
)
_METHODS = frozenset({"lower", "upper", "replace", "split", "strip", "format", "startswith"})
CONDITION = "in a condition"
_CONDITIONS = ("IfCondition", "UnlessCondition")


class TextUse(NamedTuple):
    """A place where a substitution is used as text."""

    node: ast.expr
    kind: str
    """The class of the substitution."""
    what: str
    """A description of the use, for messages."""


def text_uses(launch: LaunchFile) -> Iterator[TextUse]:
    """Yield the places where a substitution is used as a string or a truth value."""
    module = launch.module
    for sum_ in module.walk(ast.BinOp):
        yield from _in_sum(launch, sum_)
    for call in module.walk(ast.Call):
        yield from _in_call(launch, call)
    for part in module.walk(ast.FormattedValue):
        yield from _single(launch, part.value, "in an f-string")
    for comparison in module.walk(ast.Compare):
        yield from _in_comparison(launch, comparison)
    for item in module.walk(ast.Subscript):
        holder = item.value
        if isinstance(module.index.only_value(holder) or holder, ast.Dict):
            yield from _single(launch, item.slice, "as a key")
    for test in truth_tests(module):
        if not _is_reported_as_condition(launch, test):
            yield from _single(launch, test, CONDITION)


def truth_tests(module: PythonModule) -> Iterator[ast.expr]:
    """Yield the expressions tested for truth, without ``not``, ``and``, ``or``."""
    pending: list[ast.expr] = [item.test for item in module.walk(ast.If)]
    pending += [item.test for item in module.walk(ast.IfExp)]
    pending += [item.operand for item in module.walk(ast.UnaryOp) if isinstance(item.op, ast.Not)]
    pending += [value for item in module.walk(ast.BoolOp) for value in item.values[:-1]]
    pending += [test for item in module.walk(ast.comprehension) for test in item.ifs]
    seen: set[ast.expr] = set()
    while pending:
        node = pending.pop()
        if isinstance(node, ast.BoolOp):
            pending += node.values
        elif isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.Not):
            pending.append(node.operand)
        elif node not in seen:
            seen.add(node)
            yield node


def _in_sum(launch: LaunchFile, sum_: ast.BinOp) -> Iterator[TextUse]:
    if isinstance(sum_.op, ast.Mod) and isinstance(sum_.left, ast.Constant | ast.JoinedStr):
        values = sum_.right.elts if isinstance(sum_.right, ast.Tuple) else [sum_.right]
        if isinstance(sum_.left, ast.JoinedStr) or isinstance(sum_.left.value, str):
            for value in values:
                yield from _single(launch, value, "in a % format")
    for node, other in ((sum_.left, sum_.right), (sum_.right, sum_.left)):
        kind = _kind(launch, node) if isinstance(sum_.op, ast.Add) else ""
        if kind and isinstance(launch.evaluator.evaluate(other), str):
            yield TextUse(sum_, kind, "in a sum")
            return


def _in_call(launch: LaunchFile, call: ast.Call) -> Iterator[TextUse]:
    name = launch.module.qualified_name(call.func)
    if name in _TEXT_FUNCTIONS or (name == "str" and len(call.args) == 1):
        for node in call.args:
            yield from _single(launch, node, f"in {launch.module.text(call.func)}()")
    match call.func:
        case ast.Attribute(value=ast.Constant(value=str()), attr="format"):
            for node in [*call.args, *(word.value for word in call.keywords)]:
                yield from _single(launch, node, "in format()")
        case ast.Attribute(value=ast.Constant(value=str()), attr="join"):
            for node in _parts_of(call):
                yield from _single(launch, node, "in join()")
        case ast.Attribute(value=holder, attr=method):
            kind = _kind(launch, holder)
            if kind and method in _METHODS:
                yield TextUse(holder, kind, f"in {method}()")
            elif kind and method == "perform" and not call.args and not call.keywords:
                yield TextUse(call, kind, "without a context")


def _parts_of(call: ast.Call) -> list[ast.expr]:
    match call.args:
        case [ast.List(elts=items) | ast.Tuple(elts=items)]:
            return items
    return []


def _in_comparison(launch: LaunchFile, comparison: ast.Compare) -> Iterator[TextUse]:
    operator = comparison.ops[0]
    sides = [comparison.left]
    if isinstance(operator, ast.Eq | ast.NotEq):
        sides.append(comparison.comparators[0])
    elif not isinstance(operator, ast.In | ast.NotIn) or not isinstance(
        comparison.comparators[0], ast.List | ast.Tuple | ast.Set | ast.Constant
    ):
        return
    for side in sides:
        yield from _single(launch, side, "in a comparison")


def _is_reported_as_condition(launch: LaunchFile, node: ast.expr) -> bool:
    """Return whether an expression is in an IfCondition, which has its own rule."""
    for parent in launch.module.parents(node):
        if isinstance(parent, ast.stmt):
            return False
        if isinstance(parent, ast.Call):
            call = launch.call_of(parent)
            return call is not None and call.kind in _CONDITIONS
    return False


def _single(launch: LaunchFile, node: ast.expr, use: str) -> Iterator[TextUse]:
    kind = _kind(launch, node)
    if kind:
        yield TextUse(node, kind, use)


def _kind(launch: LaunchFile, node: ast.expr) -> str:
    call = launch.call_of(node)
    return call.kind if call is not None and call.kind in _KINDS else ""


_NAMES = frozenset({*dir(builtins), *dir(math), "math"})


def failure(launch: LaunchFile, node: ast.expr | None) -> str:
    """Return why an expression fails with the defaults of its arguments.

    Nothing is evaluated: only its syntax and its names are checked.
    """
    text = _text(launch, node)
    if not isinstance(text, str) or len(text) > 1000:  # noqa: PLR2004  not written by hand
        return ""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            tree = ast.parse(text.strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return f"with the defaults this is {text!r}, which is not a Python expression"
    own = {item.id for item in ast.walk(tree) if isinstance(item, ast.Name) and _is_set(item)}
    own |= {item.arg for item in ast.walk(tree) if isinstance(item, ast.arg)}
    for part in ast.walk(tree):
        if isinstance(part, ast.Name) and part.id not in _NAMES | own:
            return f"with the defaults this is {text!r}: the name {part.id!r} is not defined"
    return ""


def never_equal(launch: LaunchFile, node: ast.expr | None) -> tuple[str, bool]:
    """Return the problem with a comparison of a launch argument with an impossible value.

    Returns:
        The problem, empty if there is none, and whether it holds for all values.
    """
    parts = node.elts if isinstance(node, ast.List) else []
    calls = [launch.call_of(part) for part in parts]
    texts: list[str] = []
    for index, (part, call) in enumerate(zip(parts, calls, strict=True)):
        is_argument = call is not None and call.kind == "LaunchConfiguration"
        text = f"{_HOLE}{index}" if is_argument else launch.evaluator.joined_text(part)
        if not isinstance(text, str):
            return "", False
        texts.append(text)
    try:
        tree = ast.parse("".join(texts).strip(), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return "", False
    problems: dict[str, list[tuple[str, bool]]] = {}
    for compared in ast.walk(tree):
        match compared:
            case ast.Compare(
                left=ast.Constant(value=str(left)),
                ops=[ast.Eq() | ast.NotEq()],
                comparators=[ast.Constant(value=str(right))],
            ) if left.startswith(_HOLE) and left[len(_HOLE) :].isdigit():
                part = parts[int(left[len(_HOLE) :])]
                problem = _argument_never_is(launch, part, right)
                problems.setdefault(launch.module.text(part), []).append(problem)
    # Comparisons with several spellings are meant as alternatives.
    wrong = [uses[0] for uses in problems.values() if all(why for why, _ in uses)]
    return wrong[0] if wrong else ("", False)


_HOLE = "__argument"


def never_equals(launch: LaunchFile, call: LaunchCall) -> tuple[str, bool]:
    """Return the same for ``LaunchConfigurationEquals('use', 'True')``."""
    given = [launch.evaluator.joined_text(node) for node in call.given.values()]
    name = given[0] if given else None
    declared = launch.declared.get(name) if isinstance(name, str) else None
    if declared is None or len(given) != _PAIR or not isinstance(name, str):
        return "", False
    default = launch.text(declared, "default_value")
    text = given[1]
    return _never_is(launch, name, default, text) if isinstance(text, str) else ("", False)


_PAIR = 2


def _argument_never_is(launch: LaunchFile, argument: ast.expr, text: str) -> tuple[str, bool]:
    call = launch.call_of(argument)
    name = launch.text(call, "variable_name") if call is not None else None
    if not isinstance(name, str) or name not in launch.declared:
        return "", False
    return _never_is(launch, name, launch.default_of(argument), text)


def _never_is(launch: LaunchFile, name: str, default: object, text: str) -> tuple[str, bool]:
    """Return why a launch argument never has a value, by its choices or its default."""
    choices = launch.evaluator.evaluate(launch.declared[name].given.get("choices"))
    if isinstance(choices, list | tuple) and choices:
        is_known = all(isinstance(choice, str) for choice in choices) and text not in choices
        listed = ", ".join(map(repr, choices))
        return (f"{name!r} takes {listed}: it never equals {text!r}" if is_known else ""), is_known
    if not isinstance(default, str) or default == text:
        return "", False
    if default and default.lower() == text.lower():
        return f"{name!r} is {default!r} by default, which does not equal {text!r}", True
    if {default, text} in ({"true", "False"}, {"True", "false"}):
        usual = text.lower() if default.islower() else text.capitalize()
        why = f"{name!r} is {default!r} by default: setting it to {usual!r} does not give {text!r}"
        return why, False
    return "", False


def _is_set(name: ast.Name) -> bool:
    return not isinstance(name.ctx, ast.Load)


def _text(launch: LaunchFile, node: ast.expr | None) -> str | Unknown:
    """Return the text of an expression, with the defaults of the launch arguments in it."""
    if not isinstance(node, ast.List):
        return _part_text(launch, node)
    parts = [_part_text(launch, item) for item in node.elts]
    texts = [part for part in parts if isinstance(part, str)]
    return "".join(texts) if len(texts) == len(parts) else UNKNOWN


def _part_text(launch: LaunchFile, node: ast.expr | None) -> str | Unknown:
    call = launch.call_of(node)
    if call is not None and call.kind == "LaunchConfiguration":
        return launch.default_of(node)
    return launch.evaluator.joined_text(node)
