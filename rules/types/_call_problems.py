"""What is wrong with the arguments of a call, and its fix: the messages of TY004."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence

from scaffold.api import Edit, Fix, closest_name
from scaffold.api.distributions import target
from scaffold.api.rclpy import LOG_METHODS, is_of_rclpy, rclpy_file
from scaffold.api.types import (
    MARKED,
    TypeFinding,
    full_name,
    keywords,
    overload_problem,
    parameters,
    short_name,
)

from ._kept_callbacks import kept_callback_problem

_CALLEE = rf"(?:[a-z]+ )*`(?P<callee>(?:{MARKED}|[^\W\d]\w*)(?:\.\w+)?)`"
_OF_ROS1 = "queue_size"
"""The names of the depth argument of publishers and subscriptions in ROS 1."""
_UNBOUND = re.compile(r" of function `[^`.]+\.")
"""Matches a method called on its class."""


def call_problem(finding: TypeFinding) -> str:
    """Return the problem with the arguments of a call; empty if uncertain."""
    if _UNBOUND.search(finding.message) and not _is_of_class(finding):
        return ""
    return (
        _missing(finding)
        or _too_many(finding)
        or _too_many_to_log(finding)
        or _unknown(finding)
        or _repeated(finding)
        or _of_no_overload(finding)
        or kept_callback_problem(finding)
    )


def _missing(finding: TypeFinding) -> str:
    matched = finding.match(
        rf"No arguments? provided for required parameters? (?P<names>.+) of {_CALLEE}"
    )
    if matched is None:
        return ""
    if any(
        overload_problem(finding.package, matched["callee"], call).startswith("takes")
        for call in _calls(finding)
    ):
        return ""  # they may be among the surplus arguments, which are reported
    if _OF_ROS1 not in parameters(finding.package, matched["callee"]) and any(
        word.arg == _OF_ROS1 for call in _calls(finding) for word in call.keywords
    ):
        return ""  # the misnamed depth is passed, which is reported
    names = [repr(name) for name in re.findall(r"`(\w+)`", matched["names"])]
    return f"{_call_text(matched['callee'])} lacks {' and '.join(names)}"


def _too_many(finding: TypeFinding) -> str:
    matched = finding.match(
        rf"Too many positional arguments to {_CALLEE}: expected (?P<most>\d+), got (?P<count>\d+)"
    )
    if matched is None:
        return ""
    is_method = "." in matched["callee"]
    most, count = (int(matched[key]) - is_method for key in ("most", "count"))
    arguments = "argument" if most == 1 else "arguments"
    takes = f"{most} positional {arguments} at most" if most else "no positional argument"
    names = keywords(finding.package, matched["callee"])
    hint = f" (as keywords: {', '.join(names)})" if names else ""
    return f"{_call_text(matched['callee'])} takes {takes}, not {count}{hint}"


def _too_many_to_log(finding: TypeFinding) -> str:
    """Return the problem with a logger method that is called with format arguments."""
    matched = finding.match(r"Too many positional arguments: expected 1, got (?P<count>\d+)")
    call = finding.enclosing_call
    if matched is None or call is None:
        return ""
    file = rclpy_file(finding.package, finding.path)
    match file.evaluator.single_value(call.func):
        case ast.Attribute(attr=method, value=logger) if method in LOG_METHODS:
            match file.evaluator.single_value(logger):
                case ast.Call(func=ast.Attribute(attr="get_logger") as made) if is_of_rclpy(
                    file, made
                ):
                    return (
                        f"{method}() of a logger takes 1 positional argument, "
                        f"not {matched['count']}"
                    )
    return ""


def _unknown(finding: TypeFinding) -> str:
    matched = finding.match(
        rf"Argument `(?P<name>\w+)` does not match any known parameter of {_CALLEE}"
    )
    if matched is None:
        return ""
    callee = matched["callee"]
    names = [*parameters(finding.package, callee), *keywords(finding.package, callee)]
    if _depth(finding) is not None:
        return f"{_call_text(callee)} has no argument {_OF_ROS1!r}, which is qos_profile= in ROS 2"
    closest = closest_name(finding.package, matched["name"], names, 0.6)
    hint = f" (did you mean {closest!r}?)" if closest else ""
    return f"{_call_text(callee)} has no argument {matched['name']!r}{hint}"


def outcome(finding: TypeFinding) -> str:
    """Return the consequence of a call with wrong arguments."""
    matched = finding.match(rf"Argument `\w+` does not match any known parameter of {_CALLEE}")
    if matched is not None and re.match(
        r"(?!rclpy\.)\w+\.(?:msg|srv|action)\.", full_name(matched["callee"])
    ):
        return str(target().fact("messages.unknown_keyword"))
    return "TypeError"


def _repeated(finding: TypeFinding) -> str:
    matched = finding.match(rf"Multiple values provided for parameter `(?P<name>\w+)` of {_CALLEE}")
    if matched is None:
        return ""
    return f"{_call_text(matched['callee'])} gets {matched['name']!r} twice"


def _of_no_overload(finding: TypeFinding) -> str:
    matched = finding.match(rf"No overload of {_CALLEE} matches arguments")
    call = finding.node(ast.Call)
    if matched is None or call is None:
        return ""
    problem = overload_problem(finding.package, matched["callee"], call)
    return f"{_call_text(matched['callee'])} {problem}" if problem else ""


def _call_text(callee: str) -> str:
    """Return a call as text: ``create_timer()``, ``TransformListener()``."""
    owner, _, method = callee.rpartition(".")
    name = owner if method in {"__init__", "__new__"} else method
    return f"{short_name(name)}()"


def _calls(finding: TypeFinding) -> Iterator[ast.Call]:
    """Yield the calls of a finding: the reported one, or those that start at its place."""
    module, at = finding.module, finding.location
    calls = [call for call in module.walk(ast.Call) if module.location(call)[1:3] == at[1:3]]
    whole = [call for call in calls if module.exact_location(call) == at]
    yield from whole or calls


def _is_of_class(finding: TypeFinding) -> bool:
    """Return whether a method is called on a class by its name.

    A variable may also be an instance, for example if only its default is a class.
    """
    return any(
        isinstance(call.func, ast.Attribute) and finding.module.qualified_name(call.func.value)
        for call in _calls(finding)
    )


def call_fix(finding: TypeFinding) -> Fix | None:
    """Return the fix that passes an argument under the right keyword, if it is certain."""
    matched = finding.match(rf"Too many positional arguments to {_CALLEE}: .*")
    if matched is not None:
        names = keywords(finding.package, matched["callee"])
        return _as_keyword(finding, names, int("." in matched["callee"]))
    depth = _depth(finding)
    if depth is None or not isinstance(depth.value, ast.Constant):
        return None
    start, _ = finding.module.span(depth)
    edit = Edit(finding.path, start, start + len(_OF_ROS1), "qos_profile")
    return Fix("Replace the keyword with qos_profile=", (edit,))


def _as_keyword(finding: TypeFinding, names: Sequence[str], bound: int) -> Fix | None:
    """Return the fix that makes the last positional argument of a call a keyword argument."""
    matched = finding.match(r".*: expected (?P<most>\d+), got .*")
    call = finding.enclosing_call
    if call is None or matched is None or len(call.args) != int(matched["most"]) - bound + 1:
        return None
    name = _intended_parameter(finding, call.args[-1], names)
    if not name or any(word.arg in {name, None} for word in call.keywords):
        return None
    start, _ = finding.module.span(call.args[-1])
    return Fix(f"Pass the argument as {name}=", (Edit(finding.path, start, start, f"{name}="),))


def _intended_parameter(finding: TypeFinding, node: ast.expr, names: Sequence[str]) -> str:
    """Return the name of the parameter that a value belongs to; empty if uncertain."""
    match node:
        case ast.Name(id=name) if name in names:
            return name
        case ast.Constant(value=int() | float()):
            periods = [name for name in names if name.endswith("_sec")]
            return periods[0] if len(periods) == 1 else ""
    is_command_line = finding.module.qualified_name(node) == "sys.argv"
    return "args" if is_command_line and "args" in names else ""


def _depth(finding: TypeFinding) -> ast.keyword | None:
    """Return the keyword with the ROS 1 name of the depth, in a call without a depth."""
    matched = finding.match(rf"Argument `{_OF_ROS1}` does not match any .* of {_CALLEE}")
    call = finding.enclosing_call
    if matched is None or call is None:
        return None
    names = parameters(finding.package, matched["callee"])
    given = {*names[: len(call.args)], *(word.arg for word in call.keywords)}
    if "qos_profile" not in names or "qos_profile" in given:
        return None
    return next((word for word in call.keywords if word.arg == _OF_ROS1), None)
