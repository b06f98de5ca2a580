"""Annotates callback parameters with message types, for the type checker.

``create_subscription(String, 'chatter', self.on_chatter, 10)`` implies the parameter type of
``on_chatter(self, msg)``. Annotations are added on the line of the ``def`` only.
"""

from __future__ import annotations

import ast
import re
from bisect import bisect_right
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import accumulate

from scaffold import lazy_re
from scaffold.types.rewriting.registrations import registrations, targets

_WORDS = (
    b"create_subscription(",
    b"create_service(",
    b"ActionServer(",
    b"add_done_callback(",
    b"registerCallback(",
    b"_set_parameters_callback(",
    b"diagnostic_updater",
)
_CALL = lazy_re.compile(
    r"\b(create_subscription|create_service|ActionServer|add_done_callback"
    r"|add_(?:on|post|pre)_set_parameters_callback)\("
)
_FILTER = lazy_re.compile(
    r"((?:self\.)?\b[^\W\d]\w{0,80})[ ]{0,9}=[ ]{0,9}(?:message_filters\.)?"
    r"(Subscriber|TimeSynchronizer|ApproximateTimeSynchronizer)\("
)
_OTHER_FUTURES = lazy_re.compile(r"\b(?:asyncio|concurrent|submit)\b")
# linear: a line is searched from each call of these
_OF_EVENT = lazy_re.compile(
    r"(?:\+=[ \t]{0,9}|\.(?:connect|register(?!Callback)\w{0,40}|add_(?:listener|handler|observer))"
    r"\([^()\n]{0,200})\bself\.(\w+)\b(?!\()"
)
"""Matches a callback that an event of another library gets, which may pass other objects."""
_TYPE = lazy_re.compile(r"(?:\w+\.)*[A-Z]\w*")
_CALLBACK = lazy_re.compile(r"(?:self\.)?([^\W\d]\w*)")
_SEGMENT = lazy_re.compile(r"^(?=class )", re.MULTILINE)
_PARAMETER = r"\w+(?:\s*:\s*[\w.\[\]\"']+)?"
_SELF = r"self(?:\s*:\s*[\w.\"']+)?"
_DEFINITION = lazy_re.compile(
    rf"(\bdef (\w+)\(\s*(?:{_SELF}\s*,\s*)?)(?!self\b)({_PARAMETER}"
    rf"(?:\s*,\s*{_PARAMETER}){{0,8}})(\s*(?:,\s*)?\)\s*(?:->[^\n]*)?:)"
)
_REBOUND = (
    r"(?:^|[;:])[ \t]*{0}[ \t]*(?::[^=\n]*)?=(?!=)[^\n]*(?<!,)$"
    r"|\b(?:for|as)[ \t]+{0}\b|\b{0}[ \t]*:="
)
"""Matches code that rebinds a name; not a keyword argument on a line of its own."""
_Registered = tuple[str, tuple[str, ...]]
_GOAL_HANDLE = "_Ros2ServerGoalHandle"
_FUTURE = "_Ros2Future"
STATUS = "_Ros2DiagnosticStatus"
"""The name of the class of the argument of diagnostic tasks."""
# linear: a line has 20 kB at most
_TASK = lazy_re.compile(
    r"\.add\([^()\n]*,\s*(?:self\.)?(?P<added>\w+)\)"
    r"|^class \w+\((?:\w+\.)?DiagnosticTask\):",
    re.MULTILINE,
)
"""Matches a function used as a diagnostic task, or a class of tasks, which has ``run``."""
_ACCEPTED = "_Ros2ClientGoalHandle"
_PARAMETER_OBJECT = "_Ros2Parameter"
_IMPORTS = {
    _ACCEPTED: f"\nfrom rclpy.action.client import ClientGoalHandle as {_ACCEPTED}\n",
    _GOAL_HANDLE: f"\nfrom rclpy.action.server import ServerGoalHandle as {_GOAL_HANDLE}\n",
    _FUTURE: f"\nfrom rclpy.task import Future as {_FUTURE}\n",
    STATUS: f"\nfrom diagnostic_updater import DiagnosticStatusWrapper as {STATUS}\n",
    _PARAMETER_OBJECT: f"\nfrom rclpy.parameter import Parameter as {_PARAMETER_OBJECT}\n",
}
"""The imports to append to a file, by the name that is used."""
# linear: up to 2 kB are searched
_FUTURE_NAME = lazy_re.compile(r"(?:self\.)?\b\w+$")
# linear: as above
_SENT_HERE = lazy_re.compile(r"\.send_goal_async\([^()]*(?:\([^()]*\)[^()]*)*\)$")
_SIGN = lazy_re.compile(r"[()\[\]{},'\"]|\\.", re.DOTALL)
"""Matches a character that may end an argument or a string; escaped ones as a whole."""
_MAX_LENGTH = 2_000
"""The maximum length of a call in characters; the rest is not inspected."""
_CALLBACKS = {
    "create_subscription": (0, {"callback": 2}),
    "create_service": (0, {"callback": 2}),
    "ActionServer": (
        1,
        {
            "execute_callback": 3,
            "goal_callback": -1,
            "handle_accepted_callback": -1,
            "cancel_callback": -1,
        },
    ),
}
"""The argument positions of the type and of the callbacks, by function."""
_FUNCTIONS = frozenset({*_CALLBACKS, "add_done_callback"})
_LINES_BACK = 40


def with_callback_types(data: bytes) -> bytes:
    """Return a file with annotated callbacks."""
    if not any(word in data for word in _WORDS):
        return data
    try:
        text = data.decode()
    except UnicodeDecodeError:
        return data
    segments = _SEGMENT.split(text)
    is_of_ros = _OTHER_FUTURES.search(text) is None
    registered = [[*_registered(segment)] for segment in segments]
    if "diagnostic_updater" in text:
        for items, segment in zip(registered, segments, strict=True):
            items += [(task["added"] or "run", (STATUS,)) for task in _TASK.finditer(segment)]
    if any(item is None for items in registered for item in items):
        _add_indirect(text, segments, registered)
    result = "".join(map(partial(_annotated, has_ros_futures=is_of_ros), segments, registered))
    imports = [line for name, line in _IMPORTS.items() if name in result]
    return "".join([result, *imports]).encode()


def _add_indirect(
    text: str, segments: Sequence[str], registered: Sequence[list[_Registered | None]]
) -> None:
    """Add the callbacks that are registered indirectly, class by class."""
    starts = [*accumulate((segment.count("\n") for segment in segments), initial=1)]
    lines = text.split("\n")
    for item in registrations(text, _FUNCTIONS):
        at = bisect_right(starts, item.line) - 1
        before = "\n".join([*lines[max(item.line - _LINES_BACK, 0) : item.line - 1], ""])
        before += lines[item.line - 1].encode()[: item.column].decode(errors="ignore")
        for keyword, given in _types_given(item.function, item.arguments, before):
            for target in targets(item.arguments[keyword], len(given)):
                registered[min(at, len(segments) - 1)].append(
                    (target.name, tuple(given[n] if n >= 0 else "" for n in target.order))
                )


def _types_given(
    function: str, arguments: Mapping[str, ast.expr], before: str
) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the arguments that are callbacks, with their argument types."""
    if function == "add_done_callback":
        text, dot, _ = before.rpartition(".")
        brings = f"[{_ACCEPTED}]" if _is_of_goal(text + dot, len(text + dot)) else ""
        if isinstance(arguments.get("0"), ast.Lambda | ast.Call):
            yield "0", (_FUTURE + brings,)
        return
    place, callbacks = _CALLBACKS[function]
    type_ = arguments.get(str(place))
    written = ast.unparse(type_) if isinstance(type_, ast.Name | ast.Attribute) else ""
    if not _TYPE.fullmatch(written):
        return
    for keyword, position in callbacks.items():
        for key in (keyword, str(position)):
            if key in arguments:
                yield key, _parameter_types(function, keyword, written)


def _annotated(
    segment: str, registered: Sequence[_Registered | None], *, has_ros_futures: bool
) -> str:
    """Return the code of a class, or outside of classes, with annotated callbacks."""
    types: dict[str, tuple[str, ...]] = {}
    for name, given in filter(None, registered):
        if any(item.startswith(_FUTURE) for item in given) and not has_ros_futures:
            continue
        types[name] = () if types.get(name, given) != given else given
    if types:
        types.update((match[1], ()) for match in _OF_EVENT.finditer(segment))
    for definition in reversed(_defined_once(segment)) if any(types.values()) else ():
        if given := types.get(definition[2], ()):
            start, end = definition.span()
            typed = _typed(definition, given, function_body(segment, start, end))
            segment = f"{segment[:start]}{typed}{segment[end:]}"
    return segment


def _defined_once(segment: str) -> list[re.Match[str]]:
    """Return the definitions with unique names, in order."""
    definitions = [*_DEFINITION.finditer(segment)]
    times = Counter(definition[2] for definition in definitions)
    return [definition for definition in definitions if times[definition[2]] == 1]


def _typed(definition: re.Match[str], given: tuple[str, ...], body: str) -> str:
    head, _, parameters, tail = definition.groups()
    result: list[str] = []
    for at, part in enumerate(parameters.split(",")):
        bare = part.strip()
        typed = _parameter(bare, given[at] if at < len(given) else "", body)
        result.append(part.replace(bare, typed, 1))
    return f"{head}{','.join(result)}{tail}"


def _parameter(parameter: str, type_: str, body: str) -> str:
    """Return a parameter with its type, or bare if the function rebinds it."""
    name = _name(parameter)
    is_rebound = re.search(_REBOUND.format(name), body, re.MULTILINE)
    return f'{name}: "{type_}"' if type_ and not is_rebound else name


def function_body(segment: str, start: int, end: int) -> str:
    """Return the lines of a function that are indented further than its ``def``."""
    line = segment.rfind("\n", 0, start) + 1
    indent = re.match(r"[ \t]*", segment[line:start])
    after = re.compile(rf"\n(?!{indent[0] if indent else ''}[ \t]|[ \t]*(?:#|$))", re.MULTILINE)
    first = segment.find("\n", end)
    last = after.search(segment, first) if first >= 0 else None
    if last is None:
        return segment[end:] if first >= 0 else ""
    return segment[end : last.start() + 1]


def _name(parameter: str) -> str:
    return parameter.partition(":")[0].rstrip()


def _registered(segment: str) -> Iterator[_Registered | None]:
    """Yield the registered callbacks with their argument types.

    ``None`` stands for a callback without a name.
    """
    if "registerCallback(" in segment:
        yield from _synchronized(segment)
    for call in _CALL.finditer(segment):
        function = call[1]
        arguments = arguments_of(segment, call.end())[0]
        if function in _CALLBACKS:
            yield from _of_typed(segment, function, arguments)
            continue
        if function == "add_done_callback":
            brings = f"[{_ACCEPTED}]" if _is_of_goal(segment, call.start()) else ""
            given = _FUTURE + brings
        else:
            given = f"list[{_PARAMETER_OBJECT}]"
        argument = arguments.get("0", arguments.get("callback", ""))
        callback = _CALLBACK.fullmatch(argument)
        if callback is not None:
            yield callback[1], (given,)
        elif argument:
            yield None


def _of_typed(
    segment: str, function: str, arguments: Mapping[str, str]
) -> Iterator[_Registered | None]:
    """Yield the callbacks of a call with a type; ``None`` for one without a name."""
    place, callbacks = _CALLBACKS[function]
    type_ = arguments.get(str(place), "")
    if not _TYPE.fullmatch(type_):
        if type_.partition("[")[0].isidentifier():
            yield None
        return
    for keyword, position in callbacks.items():
        argument = arguments.get(keyword, arguments.get(str(position), ""))
        callback = _CALLBACK.fullmatch(argument)
        if callback is not None:
            yield callback[1], _parameter_types(function, keyword, type_)
        if argument and (callback is None or f"def {callback[1]}(" not in segment):
            yield None


def _synchronized(segment: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the callbacks of message_filters synchronizers, with the types of their topics."""
    topics: dict[str, str] = {}
    inputs: dict[str, str] = {}
    for made in _FILTER.finditer(segment):
        arguments = arguments_of(segment, made.end())[0]
        if made[2] == "Subscriber":
            type_ = arguments.get("msg_type", arguments.get("1", ""))
            topics[made[1]] = "" if made[1] in topics or not _TYPE.fullmatch(type_) else type_
        else:
            inputs[made[1]] = "" if made[1] in inputs else arguments.get("0", "")
    for name, listed in inputs.items():
        names = [item.strip() for item in listed.strip("[]()").split(",") if item.strip()]
        types = tuple(topics.get(item, "") for item in names)
        register = rf"(?<![\w.]){re.escape(name)}\.registerCallback\(\s*(?:self\.)?(\w+)\s*\)"
        for call in re.finditer(register, segment):
            if any(types):
                yield call[1], types


def _is_of_goal(segment: str, end: int) -> bool:
    """Return whether the future before a place is that of ``send_goal_async``."""
    if "def send_goal_async" in segment:
        return False
    before = segment[max(0, end - _MAX_LENGTH) : end].removesuffix(".").rstrip()
    name = _FUTURE_NAME.search(before)
    if name is None:
        return _SENT_HERE.search(before) is not None
    assigned = re.findall(rf"(?<![\w.]){re.escape(name[0])}[ \t]*=(?!=)([^\n]*)", before)
    return bool(assigned) and ".send_goal_async(" in assigned[-1]


def _parameter_types(function: str, keyword: str, type_: str) -> tuple[str, ...]:
    if function == "create_subscription":
        return (type_,)
    if function == "create_service":
        return f"{type_}.Request", f"{type_}.Response"
    if keyword == "goal_callback":
        return (f"{type_}.Goal",)
    return (f"{_GOAL_HANDLE}[{type_}.Goal, {type_}.Result, {type_}.Feedback]",)


def arguments_of(text: str, start: int) -> tuple[dict[str, str], int]:
    """Return the arguments of a call by keyword or position, and the end of the call.

    Empty if the end is not found; a call without arguments has an empty one.
    """
    parts: list[str] = []
    depth, quote = 0, ""
    begin = start
    for match in _SIGN.finditer(text, start, min(len(text), start + _MAX_LENGTH)):
        character = match[0]
        if quote:
            quote = "" if character == quote else quote
        elif character in "'\"":
            quote = character
        elif character in "([{":
            depth += 1
        elif character in ")]}" and depth:
            depth -= 1
        elif character in ",)" and not depth:
            parts.append(text[begin : match.start()].strip())
            begin = match.end()
            if character == ")":
                return _by_name(parts), begin
    return {}, start


def _by_name(parts: list[str]) -> dict[str, str]:
    result: dict[str, str] = {}
    for number, part in enumerate(parts):
        keyword = re.match(r"(\w+)\s*=(?!=)\s*", part)
        if keyword is not None:
            result[keyword[1]] = part[keyword.end() :]
        else:
            result[str(number)] = part
    return result
