"""What is wrong with an argument that the type checker rejects: the messages of TY005."""

from __future__ import annotations

import ast
import re
import sys

from scaffold.api.rclpy import rclpy_file
from scaffold.api.types import (
    MARK,
    MARKED,
    TypeFinding,
    elements_misfit,
    full_name,
    in_words,
    is_certain_misfit,
    is_function,
    members,
    name_of,
    short_name,
    unlike,
    with_article,
)

from ._arguments import (
    instead,
    is_int_as_well,
    is_miscounted,
    is_one_of_publishers,
    is_uncallable,
    is_unpacked,
    of_plain_class,
    parameter_name,
    takes_instead,
    when_sent,
    wrong_callback,
)

_ANY_VALUE = {
    ("DeclareLaunchArgument()", "description"),
    *((name, "emulate_tty") for name in ("ExecuteLocal()", "ExecuteProcess()", "Node()")),
}
"""Arguments that `ros2 launch --show-args` only prints, or that are only tested for truth."""
_UNNOTICED = {
    ("DeclareLaunchArgument()", "name"): "no argument of this name is declared",
    ("add_action()", "action"): "the launch stops when it comes to it",
    ("add_entity()", "entity"): "the launch stops when it comes to it",
}
"""Arguments that the function only keeps, with the consequence of a wrong one."""
_ENTITY = "LaunchDescriptionEntity"
"""What the callbacks of event handlers return."""
_COUNTED_ELSEWHERE = frozenset(
    {"create_subscription", "create_service", "create_timer", "registerCallback"}
    | {"add_done_callback", "__init__", "__new__"}
    | {f"add_{when}_set_parameters_callback" for when in ("pre", "on", "post")}
)
"""Functions whose callbacks other rules judge if the same file defines them."""
_CONVERTING = frozenset({"rclpy.duration.Duration", "rclpy.time.Time"})
"""Constructors that call ``int()`` on their nanoseconds, which are annotated as an int."""
_VALUES_OF = {
    "rclpy.duration.Duration": ".nanoseconds / 1e9",
    "rclpy.time.Time": ".nanoseconds / 1e9",
    "rclpy.parameter.Parameter": ".value",
}
"""The numbers in objects that Python functions cannot use."""
_WHOLE = r"int\b|Literal\[-?[0-9]"
"""An integer, which Python accepts as a bool; QoS profiles check their arguments."""
_COMPUTED = r"^(int|float)\*? \| (?:Any|Unknown)$"
"""A number computed with a value of unknown type."""
_OF_MESSAGE = r"(?!rclpy\.)\w+\.(?:msg|srv|action)\.[\w.]+"
"""The class of a message, or of a part of a service or an action."""


def argument_problem(finding: TypeFinding) -> str:
    """Return the problem with the type of an argument; empty if uncertain."""
    matched = finding.match(
        rf"Argument to (?:[a-z]+ )*`(?P<callee>{MARKED}(?:\.\w+)?)`"
        r" is incorrect: Expected `(?P<expected>.+)`, found `(?P<given>.+)`"
    )
    if matched is None:
        return (
            _appended_element(finding) or _object_for_its_value(finding) or _text_for_bytes(finding)
        )
    called, expected, given = matched["callee"], matched["expected"], matched["given"]
    if given.startswith("(("):
        wrong = wrong_callback(finding, expected, given)
        problem = f"the callback of {called.rpartition('.')[2]}() gets {wrong}"
        return f"{problem}: TypeError when it is called" if wrong else ""
    return _listed_elements(finding) or _argument(finding, called, expected, given)


def _argument(finding: TypeFinding, callee: str, expected: str, given: str) -> str:
    """Judge an argument of a function or class of ROS."""
    if callee.endswith(".publish_feedback"):
        given = re.sub(_COMPUTED, r"\1", given)
    if is_function(given) and (expected.startswith("(") or _ENTITY in expected):
        return _function(finding, callee, expected, given)
    given = of_plain_class(finding, given) or given
    is_misfit = is_certain_misfit(expected, given) or is_uncallable(finding, expected, given)
    if not is_misfit or is_unpacked(finding):
        return ""
    is_set_elsewhere = given == "None" and isinstance(finding.expression(), ast.Attribute)
    is_for_others = is_set_elsewhere or is_miscounted(finding, callee)  # which TY004 reports
    is_for_others = is_for_others or is_one_of_publishers(finding)
    is_for_others = is_for_others or (given == "float" and is_int_as_well(finding))
    if is_for_others:
        return ""
    owner, _, method = callee.rpartition(".")
    called = owner if method in {"__init__", "__new__"} else method
    shown_call = f"{short_name(called)}()"
    hint = instead(finding.package, expected, given)
    parameter = parameter_name(finding, callee)
    if re.fullmatch(_OF_MESSAGE, full_name(owner or called)):
        return (
            f"{parameter!r} of {full_name(owner)} is {with_article(name_of(expected))}, not "
            f"{in_words(given)}: {when_sent(expected)}{hint}"
        )
    is_made_int = full_name(called) in _CONVERTING and parameter == "nanoseconds"
    is_made_int = is_made_int and given.rstrip("*") == "float"
    is_truth = expected == "bool" and re.match(_WHOLE, given) and "QoS" not in shown_call
    if is_made_int or is_truth or (shown_call, parameter) in _ANY_VALUE:
        return ""
    if expected.startswith("("):
        expected = "function"
    elif expected.startswith("type["):
        expected = "class"
    subject = f"{parameter!r} of {shown_call}" if parameter else f"an argument of {shown_call}"
    is_long = "... omitted" in expected
    needed = f"cannot be {in_words(given)}" if is_long else f"must be {unlike(expected, given)}"
    consequence = _UNNOTICED.get((shown_call, parameter), f"{shown_call} fails")
    return f"{subject} {needed}: {consequence}{hint}"


def _function(finding: TypeFinding, callee: str, expected: str, given: str) -> str:
    """Judge the number of arguments of a function that is passed; annotations may differ."""
    called = callee.rpartition(".")[2]
    if _ENTITY in expected:
        subject = (
            f"{parameter_name(finding, callee)!r} of {short_name(callee.rpartition('.')[0])}()"
        )
        return _handler(subject, expected, given)
    if called in _COUNTED_ELSEWHERE:
        node = finding.expression()
        file = rclpy_file(finding.package, finding.path)
        if node is None or file.callback(node).function is not None:
            return ""
    takes = takes_instead(expected, given)
    return f"{called}() calls {in_words(given)} with {takes}: TypeError" if takes else ""


def _handler(subject: str, expected: str, given: str) -> str:
    """Judge a function that launch calls, for an event or at once: its arguments and its result."""
    takes = takes_instead(expected, given)
    if takes:
        return f"{subject} is called with {takes}: TypeError"
    returned = given.rpartition("-> ")[2]
    if returned == "None" or re.search(rf"{MARK}|\b(?:Any|Unknown)\b", returned):
        return ""
    return (
        f"{subject} returns {in_words(returned)}, not actions or None: launch fails when it calls "
        "the function"
    )


def _listed_elements(finding: TypeFinding) -> str:
    """Judge a list that is passed to the constructor of a message."""
    matched = finding.match(
        rf"Argument to `(?P<owner>{MARKED})\.__init__` is incorrect: "
        r"Expected `(?P<expected>.+)`, found `(?P<given>.+)`"
    )
    if matched is None or not re.fullmatch(_OF_MESSAGE, full_name(matched["owner"])):
        return ""
    elements = elements_misfit(matched["expected"], matched["given"])
    if not elements:
        return ""
    field = parameter_name(finding, f"{matched['owner']}.__init__")
    return f"elements of {field!r} must be {elements}: it cannot be published"


def _appended_element(finding: TypeFinding) -> str:
    """Judge an element appended to a list of messages, which is only checked when it is sent."""
    matched = finding.match(
        r"Argument to bound method `list\.(?:append|insert)` is incorrect: "
        rf"Expected `(?P<expected>{MARKED})`, found `(?P<given>.+)`"
    )
    if matched is None or not is_certain_misfit(matched["expected"], matched["given"]):
        return ""
    match finding.enclosing_call:
        case ast.Call(func=ast.Attribute(value=ast.Attribute(attr=field, value=holder))) if (
            not isinstance(holder, ast.Name) or holder.id != "self"
        ):
            needed = with_article(full_name(matched["expected"]))
            return (
                f"elements of {field!r} must be {needed}, not {in_words(matched['given'])}: "
                "it cannot be published"
            )
    return ""


def _object_for_its_value(finding: TypeFinding) -> str:
    """Judge an object passed to a Python function instead of the text or number in it."""
    matched = finding.match(
        r"Argument to (?:[a-z]+ )*`[\w.]+` is incorrect: Expected `.+`, "
        rf"found `(?P<given>{MARKED})`"
    )
    call = finding.enclosing_call
    if matched is None or call is None:
        return ""
    given = full_name(matched["given"])
    called = finding.module.qualified_name(call.func) or ""
    if called.partition(".")[0] not in sys.stdlib_module_names:
        return ""
    if given in _VALUES_OF:
        return f"{called}() cannot use {with_article(given)}: TypeError; use {_VALUES_OF[given]}"
    if ".msg." not in given:
        return ""
    names = members(finding.package, matched["given"])
    fields = [name for name in names if name.islower() and not name.startswith("get_")]
    hint = f"; pass its field {fields[0]!r}" if len(fields) == 1 else ""
    return f"{called}() cannot use a {given}: TypeError{hint}"


def _text_for_bytes(finding: TypeFinding) -> str:
    """Judge a string passed to a method that needs bytes, as of a serial port."""
    matched = finding.match(
        r"Argument to bound method `bytes\.(?P<method>\w+)` is incorrect: .*, found `(?P<given>.+)`"
    )
    if matched is None or in_words(matched["given"]) != "a str" or finding.may_be_text():
        return ""
    return f"{matched['method']}() of bytes cannot use a str: TypeError; decode() the bytes first"
