"""Infers the element types of initially empty containers, for the type checker.

``self.latest = {}`` has no element type; ``self.latest[name] = msg`` implies it. A line before that
assignment stores the value in a global name, and the empty dictionary becomes one of such values.
If other code may add elements, it is not changed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from scaffold import lazy_re
from scaffold.record import NamedTuple
from scaffold.types.rewriting.callbacks import arguments_of, function_body
from scaffold.types.rewriting.results import expression_at
from scaffold.types.rewriting.statements import class_starts, lines_like, mentions, statement_around

_MADE = lazy_re.compile(
    r"^(?P<indent>[ ]+)(?P<name>(?:self\.)?[^\W\d]\w*)[ ]*=[ ]*(?P<value>"
    r"\{\}|\[\]|dict\(\)|list\(\)|(?:collections\.)?deque\([^()\n]{0,80}\)"
    r"|\{(?![^\n]*[ ]for[ ])[^{}:\n#]{1,80}:[^{}\n#]{1,400}\})[ ]*(?:#[^\n]*)?$",
    re.MULTILINE,
)
_SET_TO_CONTAINER = lazy_re.compile(r"=[ ]*(?:[\[{]|dict|list|(?:collections\.)?deque)")
_HELPERS = {"{": "_ros2_dict", "d": "_ros2_dict", "[": "_ros2_list", "l": "_ros2_list"}
_DEFINITIONS = """
from collections import deque as _Ros2Deque
from collections.abc import Sequence as _Ros2Sequence
from typing import Any as _Ros2Any, TypeVar as _Ros2TypeVar
_Ros2Element = _Ros2TypeVar("_Ros2Element")
def _ros2_dict(*_: _Ros2Sequence[_Ros2Element]) -> dict[_Ros2Any, _Ros2Element]: ...
def _ros2_list(*_: _Ros2Sequence[_Ros2Element]) -> list[_Ros2Element]: ...
def _ros2_deque(*_: _Ros2Sequence[_Ros2Element]) -> _Ros2Deque[_Ros2Element]: ...
"""
_ADDING = {"append": "0", "appendleft": "0", "setdefault": "1", "insert": "1"}
"""Methods that add an element to a container, with the index of its argument."""
_METHOD = lazy_re.compile(r"\.(\w+)\(")
_READING = frozenset(
    {"get", "items", "values", "keys", "pop", "popitem", "popleft", "clear", "copy", "remove"}
    | {"index", "count", "sort", "reverse", "rotate"}
)
_SET = lazy_re.compile(r"[ ]*=(?!=)[ ]*")
_CHANGED = lazy_re.compile(r"[ ]*(?:[-+*/|&%^@]|//|\*\*|<<|>>)=|[ ]*,[^\n=]*=(?!=)")
_READ = lazy_re.compile(
    r"(?:\b(?:in|not|if|elif|while|and|or|return)[ ]+"
    r"|\b(?:len|sorted|sum|min|max|any|all|list|tuple|set|enumerate|reversed|zip|str|iter|next)\("
    r"|\{)$"
)
_OF_MESSAGE = lazy_re.compile(r"(?!self\.\w{1,80}[ ]?=)(?:\w{1,80}\.){1,9}\w{1,80}[ ]?=[ ]?")
"""Matches the text before a value that is assigned to a field of an object."""
_LINE_END = lazy_re.compile(r"[ ]{0,40}(?:#|\n|\Z)")
"""Matches the end of a line, with an optional comment."""
# linear: names and defaults, without brackets
_SIGNATURE = lazy_re.compile(r"^[ ]*(?:async[ ]+)?def[ ]+\w+\(([^()]*)\)", re.MULTILINE)
_MAX_ADDED = 12
_KEPT = "_ros2_kept"
_OTHER_SCOPE = lazy_re.compile(r"\b(?:lambda|yield|for)\b|:=|#|\bself\s*(?:$|[,)\]])")


class Kept(NamedTuple):
    """A container and the values that are added to it."""

    stretches: Sequence[tuple[int, int, str]]
    """Where it is created, and the replacement."""
    lines: Mapping[int, Sequence[str]]
    """The lines to insert, by position."""


def kept_values(text: str) -> Iterator[Kept]:
    """Yield the containers of a file that are created empty."""
    matches = [*lines_like(_MADE, _SET_TO_CONTAINER, text)]
    if not matches:
        return
    made: dict[tuple[str, int, int], list[re.Match[str]]] = {}
    starts = [*class_starts(text), len(text)]
    at = 0
    for match in matches:
        while starts[at] <= match.start():
            at += 1
        name = match["name"]
        stretch = (starts[at - 1] if at else 0, starts[at])
        if not name.startswith("self."):
            stretch = _function_around(text, match.start("name"), len(match["indent"]))
        if stretch[1]:
            made.setdefault((name, *stretch), []).append(match)
    for number, ((name, start, end), matches) in enumerate(made.items()):
        if len({_helper(match) for match in matches}) > 1:
            continue
        added = _added(text, name, start, end)
        if added and len(added) <= _MAX_ADDED:
            yield _kept_container(text, number, matches, added)


def definitions() -> str:
    """Return the definitions to append to a file with such containers."""
    return _DEFINITIONS


def _helper(match: re.Match[str]) -> str:
    value = match["value"]
    return "_ros2_deque" if "deque" in value else _HELPERS[value[0]]


def _kept_container(
    text: str,
    number: int,
    matches: Sequence[re.Match[str]],
    added: Sequence[tuple[int, str]],
) -> Kept:
    lines: dict[int, list[str]] = {}
    sources: list[str] = []
    for at, (place, value) in enumerate(added):
        name = f"{_KEPT}_{number}_{at}"
        indent = re.compile("[ ]*").match(text, place)
        lines.setdefault(place, []).append(
            f"{indent[0] if indent else ''}global {name}; {name} = [{value}]"
        )
        sources.append(name)
    stretches = []
    for match in matches:
        call = f"{_helper(match)}({', '.join(sources)})"
        value = match["value"]
        if value[0] == "{" and value != "{}":
            call = f"{value[:-1].rstrip().rstrip(',')}, **{call}}}"
        stretches.append((*match.span("value"), call))
    return Kept(stretches, lines)


def _added(text: str, name: str, start: int, end: int) -> list[tuple[int, str]]:
    """Return the values added to a container, and the starts of the statements.

    Empty if that is uncertain, or if a value has no name of its own.
    """
    result: list[tuple[int, str]] = []
    for at in mentions(text, name, start, end):
        after = at + len(name)
        addition = _addition(text, at, after)
        if addition is None:
            return []
        if not addition[1]:
            continue
        place = statement_around(text, at, after)
        if place < 0 or _OTHER_SCOPE.search(addition[1]):
            return []
        result.append((place, addition[1]))
    if any(re.search(rf"\b{re.escape(name)}\b", value) for _, value in result):
        return []
    return result


def _addition(text: str, start: int, end: int) -> tuple[int, str] | None:
    """Return the end of a value added to a container, and the value; empty for a mere access.

    ``None`` if it may be anything.

    Args:
        text: The file.
        start: The start of the name of the container.
        end: The end of its name.
    """
    method = _METHOD.match(text, end)
    if method is not None:
        if method[1] in _ADDING:
            arguments, stop = arguments_of(text, method.end())
            value = arguments.get(_ADDING[method[1]], "")
            return (stop, value) if value and not value.startswith("*") else None
        return (end, "") if method[1] in _READING else None
    after = text[end : end + 1]
    if after == "[":
        opened, end = end, _closed(text, end)
        if not end or _CHANGED.match(text, end):
            return None
        set_ = _SET.match(text, end)
        value = expression_at(text, set_.end()) if set_ else ""
        key = text[opened + 1 : end - 1]
        return None if _are_parameters(text, start, key, value) else (end, value)
    line = text.rfind("\n", 0, start) + 1
    before = text[line:start]
    if not before.strip() and _SET.match(text, end):
        return end, ""
    is_read = after in {"}", "!"} or _READ.search(before) is not None
    is_read = is_read or (
        _LINE_END.match(text, end) is not None
        and _OF_MESSAGE.fullmatch(before.lstrip()) is not None
    )
    return (end, "") if is_read and after != "." else None


def _are_parameters(text: str, place: int, key: str, value: str) -> bool:
    """Return whether key and value are parameters of the function, so that any type is possible."""
    if not (key.isidentifier() and value.isidentifier()):
        return False
    signatures = _SIGNATURE.findall(text, 0, place)
    return {key, value} <= {*re.findall(r"\w+", signatures[-1])} if signatures else False


def _closed(text: str, start: int) -> int:
    """Return the position of a closing bracket; 0 if it is not on the same line."""
    depth = 0
    for at in range(start, min(len(text), start + 200)):
        character = text[at]
        if character in "([{":
            depth += 1
        elif character in ")]}":
            depth -= 1
            if not depth:
                return at + 1
        elif character in "\n'\"#" and character in "\n#":
            return 0
    return 0


def _function_around(text: str, place: int, indent: int) -> tuple[int, int]:
    """Return the start and end of the function around a statement; ``(0, 0)`` if there is none."""
    heads = re.compile(r"^([ ]*)(?:async )?def \w+\(", re.MULTILINE)
    best: re.Match[str] | None = None
    line = text.rfind("\n", 0, place)
    while line > 0:
        previous = text.rfind("\n", 0, line) + 1
        head = heads.match(text, previous)
        if head is not None and len(head[1]) < indent:
            best = head
            break
        first = re.compile(r"[ ]*[^\s#]").match(text, previous, line)
        if first is not None and first.end() - previous == 1 and text[previous] not in ")]}":
            break
        line = previous - 1
    if best is None:
        return 0, 0
    start = best.start()
    return start, best.end() + len(function_body(text, best.end(1), best.end()))
