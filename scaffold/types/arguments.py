"""What functions are given by the calls in their file, for a type checker that looks at no calls.

``self.say('hello')`` tells what ``say(self, text)`` gets. A line before the call keeps the argument
under a global name, and a line at the start of the function takes it from there: the type checker
infers both by itself. An argument is kept in a list, so that ``'hello'`` counts as any str.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from scaffold.record import NamedTuple
from scaffold.types.added_lines import Extended, with_lines
from scaffold.types.callbacks import arguments_of, function_body
from scaffold.types.statements import statement_around

_GIVEN = "_ros2_given"
_EITHER = "_ros2_either"
"""A condition that nothing is known about."""
_MOST_CALLS = 12
"""Of one function; what is called more often is used for anything."""
_FUNCTION = re.compile(
    r"^(?P<indent> *)(?:async )?def (?P<name>[^\W\d]\w*)"
    r"\((?P<parameters>(?:[^()]|\([^()]*\)){1,800}\)) *(?:->[^\n]{0,200})?: *"
    r"(?:#[^\n]*)?\n(?=\n*(?P<inner> +)\S)",
    re.MULTILINE,
)
_NAME = re.compile(r"\w+")
_CONSTANT = re.compile(r"-?\d[\w.]*|'[^'\\\n]*'|\"[^\"\\\n]*\"|True|False|None")
_OTHER_SCOPE = re.compile(r"\b(?:lambda|yield)\b|:=|#|\bself\s*(?:$|[,)\]])")
"""Matches what is something else on another line, and an object whose class may be a subclass."""


class _Function(NamedTuple):
    called: str
    """What its calls begin with: ``self.name(`` or ``name(``."""
    parameters: str
    is_method: bool
    start: int
    inner: str
    """What its body is indented by."""
    segment: tuple[int, int]
    """Where it is called: in its class, or in the whole file."""


def with_arguments(data: bytes) -> Extended:
    """Return a file with what its functions are given."""
    try:
        text = data.decode()
    except UnicodeDecodeError:
        return Extended(data, ())
    if "\r" in text or "\t" in text or "def " not in text:
        return Extended(data, ())
    lines: dict[int, list[str]] = {}
    for function in _functions(text):
        _follow(text, function, lines)
    return with_lines(text, lines) if lines else Extended(data, ())


def _follow(text: str, function: _Function, lines: dict[int, list[str]]) -> None:
    """Add the lines before the calls of a function, and the one at its start."""
    sources: dict[str, list[str]] = {}
    for number, (place, given) in enumerate(_calls(text, function)):
        kept: dict[str, str] = {}
        for parameter, value in given.items():
            source = f"[{value}]"
            if not _CONSTANT.fullmatch(value):
                kept[f"{_GIVEN}_{function.start}_{number}_{parameter}"] = value
                source = [*kept][-1]
            sources.setdefault(parameter, []).append(source)
        if kept:
            indent = text[place : place + len(text[place:]) - len(text[place:].lstrip(" "))]
            values = "; ".join(f"{name} = [{value}]" for name, value in kept.items())
            lines.setdefault(place, []).append(f"{indent}global {', '.join(kept)}; {values}")
    taken = [
        f"{name} = ({f' if {_EITHER} else '.join(dict.fromkeys(values))})[0]"
        for name, values in sources.items()
        if len(values) <= _MOST_CALLS
    ]
    if taken:
        lines.setdefault(function.start, []).insert(0, function.inner + "; ".join(taken))


def _functions(text: str) -> Iterator[_Function]:
    """Yield the functions of a file that have no decorator."""
    classes = [*_class_starts(text), len(text)]
    at = 0
    for match in _FUNCTION.finditer(text):
        while classes[at] <= match.start():
            at += 1
        decorator = _decorator(text, match.start())
        if decorator not in {"", "staticmethod"}:
            continue
        called, segment = match["name"], (classes[at - 1] if at else 0, classes[at])
        is_method = text.startswith("self", match.start("parameters"))
        if called == "__init__" and is_method and at:
            class_ = _NAME.match(text, segment[0] + len("class "))
            is_only_one = text.count("def __init__(", *segment) == 1
            called, segment = class_[0] if class_ and is_only_one else "", (0, len(text))
        elif decorator or (is_method and match["indent"]):
            called = f"self.{called}"
        else:
            segment = (0, len(text))
        if called:
            yield _Function(
                *(f"{called}(", match["parameters"], is_method),
                *(match.end(), match["inner"], segment),
            )


def _is_unique(text: str, function: _Function) -> bool:
    """Tell whether no other function or class has the name of a function."""
    name = function.called.removeprefix("self.")
    class_ = name.removesuffix("(")
    return sum(map(text.count, (f"def {name}", f"class {name}", f"class {class_}:"))) == 1


def _class_starts(text: str) -> Iterator[int]:
    if text.startswith("class "):
        yield 0
    at = text.find("\nclass ")
    while at >= 0:
        yield at + 1
        at = text.find("\nclass ", at + 1)


def _decorator(text: str, start: int) -> str:
    """Return what is in the line before a definition if it is a decorator, or may be one."""
    line = text[text.rfind("\n", 0, max(start - 1, 0)) + 1 : max(start - 1, 0)].strip()
    return line[1:] if line.startswith("@") else line if line == ")" else ""


def _calls(text: str, function: _Function) -> Iterator[tuple[int, Mapping[str, str]]]:
    """Yield the calls of a function: where their statements begin, and what they give."""
    parameters: _Parameters | None = None
    body: tuple[int, int] | None = None
    at = text.find(function.called, *function.segment)
    while at >= 0:
        start, at = at, text.find(function.called, at + 1, function.segment[1])
        if text[start - 1 : start].isalnum() or text[start - 1 : start] in {"_", "."}:
            continue
        if text.endswith(("def ", "class "), 0, start):
            continue
        words, end = arguments_of(text, start + len(function.called))
        place = statement_around(text, start, end) if any(words.values()) else -1
        if place < 0:
            continue
        if parameters is None or body is None:
            if not _is_unique(text, function):
                return
            parameters = _Parameters(function)
            head = function.start - 1
            body = head, head + len(function_body(text, head, head))
        if not body[0] <= start < body[1] and (given := parameters.given(words)):
            yield place, given


class _Parameters:
    """The parameters of a function.

    Args:
        function: The function.
    """

    def __init__(self, function: _Function) -> None:
        self._defaults: dict[str, str] = {}
        """Of those without an annotation; empty where there is none."""
        self._positional: list[str] = []
        is_by_keyword = False
        for key, word in arguments_of(function.parameters, 0)[0].items():
            name, default = (word, "") if key.isdigit() else (key, word)
            is_by_keyword = is_by_keyword or name.startswith("*")
            if not is_by_keyword and name != "/":
                self._positional.append(name)
            if name.isidentifier():
                self._defaults[name] = default
        if function.is_method:
            del self._positional[:1]

    def given(self, words: Mapping[str, str]) -> Mapping[str, str]:
        """Return what a call gives the parameters without annotation; nothing if not sure."""
        result: dict[str, str] = {}
        for key, value in words.items():
            if value.startswith("*"):
                return {}
            if not key.isdigit():
                result[key] = value
            elif value and int(key) < len(self._positional):
                result[self._positional[int(key)]] = value
            elif value:
                return {}
        kept = {
            name: value
            for name, value in result.items()
            if name in self._defaults and not _OTHER_SCOPE.search(value)
        }
        defaults = {
            name: default
            for name, default in self._defaults.items()
            if name not in result and _CONSTANT.fullmatch(default)
        }
        return kept | defaults if kept else {}
