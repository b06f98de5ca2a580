"""Arguments of calls that the type checker reports: what they are for, and who else judges them."""

from __future__ import annotations

import ast
import re

from scaffold.api import Package
from scaffold.api.rclpy import names_of_bases, rclpy_file
from scaffold.api.types import (
    MARK,
    TypeFinding,
    class_in,
    class_itself,
    full_name,
    has_call,
    is_kind_of,
    name_of,
    overload_problem,
    parameters,
    short_name,
)

TIMEOUTS = {"can_transform": 3, "can_transform_full": 5, "transform": 2, "transform_full": 4}
"""The position of the timeout of tf2 functions with several signatures."""
_SENT = {"bool": "False is sent", "float": "another number is sent"}
"""The conversions of unchecked values in message fields."""


def when_sent(expected: str) -> str:
    """Return the effect of a message with a value that is not of the field's type."""
    return _SENT.get(name_of(expected), "it cannot be published")


def is_miscounted(finding: TypeFinding, callee: str) -> bool:
    """Return whether the call lacks an argument, or has one too many, which shifts the others."""
    call = finding.enclosing_call
    return call is not None and overload_problem(finding.package, callee, call) != ""


def is_one_of_publishers(finding: TypeFinding) -> bool:
    """Return whether the called publisher may be for another type, depending on a condition."""
    call = finding.enclosing_call
    if call is None or not isinstance(call.func, ast.Attribute):
        return False
    receiver = call.func.value
    if not isinstance(receiver, ast.Attribute):
        return False
    file = rclpy_file(finding.package, finding.path)
    values = file.evaluator.attribute_values(receiver) or ()
    made = [value for value in values if isinstance(value, ast.Call) and value.args]
    return len({ast.dump(value.args[0]) for value in made}) > 1


def is_int_as_well(finding: TypeFinding) -> bool:
    """Return whether a number may also be an int: from a table, or a parameter for both."""
    place = finding.innermost
    node = place.value if isinstance(place, ast.keyword) else place
    if isinstance(node, ast.Subscript):
        return True
    if not isinstance(node, ast.Name):
        return False
    function = finding.module.enclosing_function(node)
    if not isinstance(function, ast.FunctionDef | ast.AsyncFunctionDef):
        return False
    arguments = (*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs)
    notes = [item.annotation for item in arguments if item.arg == node.id and item.annotation]
    names = {part.id for note in notes for part in ast.walk(note) if isinstance(part, ast.Name)}
    return "int" in names


def of_plain_class(finding: TypeFinding, given: str) -> str:
    """Return the marked class of ``self``, if it has no bases and no subclasses; or empty."""
    module = finding.module
    class_ = module.enclosing_class(finding.innermost) if finding.innermost else None
    if not given.startswith("Self@") or class_ is None or class_.bases or class_.keywords:
        return ""
    made = [*finding.package.modules(mentioning=[f"{class_.name}("])]
    if not made or class_.name in names_of_bases(finding.package):
        return ""  # it may be a part of other classes
    return MARK.join([class_.name, finding.path.removesuffix(".py").rpartition("/")[2]])


def is_uncallable(finding: TypeFinding, expected: str, given: str) -> bool:
    """Return whether a ROS object that is not callable is passed instead of a function."""
    class_ = class_in(given)
    return expected.startswith("(") and bool(class_) and not has_call(finding.package, class_)


def wrong_callback(finding: TypeFinding, expected: str, given: str) -> str:
    """Return the argument count of an unsuitable callback that a loop registers; or empty.

    Args:
        finding: The report, whose place is the variable of the loop.
        expected: The type of the function that is needed.
        given: The types of those that the loop runs over.
    """
    needed = re.match(r"\(([^()]*)\) -> ", expected)
    taken = re.findall(r"\(\(([^()]*)\) -> [^()]*\)", given)
    if needed is None or len(taken) != len(re.findall(r"\(\(", given)) or not _is_each(finding):
        return ""
    count = _count(needed[1])
    counts = [_count(item) for item in taken if not re.search(r"[*=]", item)]
    wrong = [item for item in counts if item != count]
    return f"{count}; one of these functions takes {wrong[0]}" if wrong else ""


def takes_instead(expected: str, given: str) -> str:
    """Return the needed and actual argument counts of an unsuitable function; or empty."""
    needed = re.findall(r"\(([^()]*)\) -> ", expected)
    taken = re.match(r"(?:(?:bound method|def) [^(]*)?\(([^()]*)\) -> ", given)
    if taken is None or re.search(r"[*=]|\.\.\.", " ".join([taken[1], *needed])):
        return ""
    counts, has = sorted({*map(_count, needed)}), _count(taken[1])
    if has in counts or not counts:
        return ""
    noun = "argument" if counts == [1] else "arguments"
    return f"{' or '.join(str(count or 'no') for count in counts)} {noun}, but it takes {has}"


def _count(listed: str) -> int:
    parts = re.sub(r"\[[^\[\]]*\]", "", listed).split(",")
    return len([part for part in parts if part.strip() not in {"", "/"}])


def _is_each(finding: TypeFinding) -> bool:
    """Return whether the place is a loop variable that is used for all values."""
    name = finding.expression()
    if not isinstance(name, ast.Name):
        return False
    for node in finding.parents():
        match node:
            case ast.For(target=target):
                return name.id in {it.id for it in ast.walk(target) if isinstance(it, ast.Name)}
            case ast.ListComp(generators=[loop]) | ast.DictComp(generators=[loop]):
                names = {it.id for it in ast.walk(loop.target) if isinstance(it, ast.Name)}
                return name.id in names and not loop.ifs
            case ast.If() | ast.IfExp() | ast.Try() | ast.FunctionDef():
                return False
    return False


def instead(package: Package, expected: str, given: str) -> str:
    """Return the replacement, if it is clear."""
    wanted, class_ = class_in(expected.partition(" | ")[0]), class_itself(given)
    if wanted and class_:
        is_whole = short_name(wanted).startswith(f"{short_name(class_)}.")  # a service, an action
        needed = wanted if is_whole else class_
        is_right = is_kind_of(package, needed, wanted)
        return f"; write {short_name(needed)}()" if is_right else ""
    name = full_name(wanted) if wanted else ""
    is_number = re.match(r"(?:int|float)\b|Literal\[-?[0-9]", given) is not None
    if name == "rclpy.duration.Duration" and is_number:
        return "; write Duration(seconds=...)"
    if name == "rclpy.time.Time" and class_in(given).startswith("Time"):
        return "; write rclpy.time.Time.from_msg(...)"
    if name == "builtin_interfaces.msg.Time" and class_in(given).startswith("Time"):
        return "; write .to_msg()"
    return ""


def is_unpacked(finding: TypeFinding) -> bool:
    """Return whether the argument is ``**values``: each value may fit its parameter."""
    return any(
        keyword.arg is None
        and finding.location in {finding.module.location(item) for item in (keyword, keyword.value)}
        for call in finding.module.walk(ast.Call)
        for keyword in call.keywords
    )


def parameter_name(finding: TypeFinding, callee: str) -> str:
    """Return the name of the parameter of the reported argument."""
    for call in finding.module.walk(ast.Call):
        if not call.lineno <= finding.location.line <= (call.end_lineno or call.lineno):
            continue
        for keyword in call.keywords:
            places = (keyword, keyword.value)
            if any(finding.module.location(item) == finding.location for item in places):
                return keyword.arg or ""
        for number, argument in enumerate(call.args):
            if isinstance(argument, ast.Starred):
                break
            if finding.module.location(argument) == finding.location:
                names = parameters(finding.package, callee)
                return names[number] if number < len(names) else ""
    return ""
