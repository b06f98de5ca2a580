"""Passes argument types from call sites to functions, for the type checker.

``self.say('hello')`` implies the type of ``text`` in ``say(self, text)``. A line before the call
stores the argument in a global name, and a line at the start of the function assigns it to the
parameter: the type checker infers both. The argument is stored in a list, so that ``'hello'`` is
any str. The annotation of the parameter is removed, because nothing enforces it.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import lru_cache

from scaffold import lazy_re
from scaffold.record import NamedTuple
from scaffold.types.rewriting import containers, fixtures, node_parameters, returns
from scaffold.types.rewriting.added_lines import Extended, with_lines
from scaffold.types.rewriting.callbacks import arguments_of, function_body
from scaffold.types.rewriting.lambdas import place_of
from scaffold.types.rewriting.passed import (
    GIVEN,
    Passed,
    calls_of_object,
    own_names,
    places,
    registered_callbacks,
)
from scaffold.types.rewriting.statements import class_starts, definitions, lines_like
from scaffold.types.stubs import makers

_EITHER = "_ros2_either"
"""A condition of unknown value."""
_MAX_CALLS = 12
"""The maximum number of calls of one function; one with more accepts ``Any``."""
_FUNCTION = lazy_re.compile(
    r"^(?P<indent> *)(?:async )?def (?P<name>[^\W\d]\w*)"
    r"\((?P<parameters>(?:[^()]|\([^()]*\)){1,800}\)) *(?:->[^\n]{0,200})?: *"
    r"(?:#[^\n]*)?\n(?=\n*(?P<inner> +)\S)",
    re.MULTILINE,
)
_MADE = lazy_re.compile(
    r"^[ ]*(?P<name>self\.\w+|\w+)[ ]*(?::[^=\n]*)?=[ ]*(?P<class>[A-Z]\w*)\(", re.MULTILINE
)
"""Matches a variable or an attribute that is set to a new object."""
_SET_TO_OBJECT = lazy_re.compile(r"=[ ]*[A-Z]\w*\(")
_NAME = lazy_re.compile(r"\w+")
_DERIVED = lazy_re.compile(r"class \w+\(([^()\n]*)")
"""Matches a derived class."""
_PARAMETER = lazy_re.compile(r"(\*{0,2}\w*|/)[ ]*(:[^=\"'\n#]*?)?[ ]*(?:=\s*(.*))?", re.DOTALL)
"""Matches a parameter; not one with a quoted annotation, as callbacks get."""
_CONSTANT = lazy_re.compile(r"-?\d[\w.]*|'[^'\\\n]*'|\"[^\"\\\n]*\"|True|False|None")
_OTHER_SCOPE = lazy_re.compile(r"\b(?:lambda|yield)\b|:=|#|\bself\s*(?:$|[,)\]])")
"""Matches names that differ on another line, and objects that may be of a subclass."""


class _Function(NamedTuple):
    name: str
    """The name for other modules: ``to_pose``, ``Arm.move``, or ``Arm`` for its constructor."""
    called: str
    """The start of its calls: ``self.name(`` or ``name(``."""
    place: int
    """The start of its parameters."""
    parameters: str
    is_method: bool
    start: int
    inner: str
    """The indentation of its body."""
    segment: tuple[int, int]
    """The range in which it is called: its class, or the whole file."""


def with_arguments(
    data: bytes,
    module: str = "",
    received: Sequence[Passed] = (),
    others: Collection[str] = (),
) -> Extended:
    """Return a file with the argument types of its functions.

    Args:
        data: The content of the file.
        module: Its dotted name, for the calls of other modules.
        received: The arguments from other modules.
        others: The other importable packages of the workspace that it may import.
    """
    try:
        text = data.decode()
    except UnicodeDecodeError:
        return Extended(data, ())
    if "\r" in text:
        return Extended(data, ())
    lines: dict[int, list[str]] = {}
    annotations: list[tuple[int, int]] = []
    nodes: list[str] = []
    taken: dict[int, Collection[str]] = {}
    calls: dict[str, list[Passed]] = {}
    for call in received:
        calls.setdefault(call.function.removeprefix(f"{module}."), []).append(call)
    for function in _functions(text):
        followed = _add_lines_of(text, function, calls.get(function.name, ()), lines)
        taken[function.start] = followed
        annotations += filter(None, followed.values())
        nodes += _add_nodes_of(text, function, followed, lines)
    passed = [*_passed(text, own_names(data, module, others), module, lines)]
    stretches = [(start, end, " " * (end - start)) for start, end in annotations]
    for kept in containers.kept_values(text):
        stretches += kept.stretches
        _add(lines, kept.lines)
    is_kept = len(stretches) > len(annotations)
    heads = makers.generic_heads(text)
    _add(lines, heads)
    results = returns.results(text, taken, heads)
    _add(lines, results.lines)
    stretches += results.heads
    for place, line in fixtures.lines(text):
        if line not in lines.setdefault(place, []):
            lines[place].append(line)
    if not (lines or stretches):
        return Extended(data, (), passed)
    extended = with_lines(text, lines, stretches)
    end = containers.definitions() * is_kept + makers.definitions() * bool(heads)
    end += results.definitions + node_parameters.definition() * bool(nodes)
    return extended._replace(data=extended.data + end.encode(), passed=passed)


def _add(lines: dict[int, list[str]], more: Mapping[int, Sequence[str]]) -> None:
    for place, added in more.items():
        lines.setdefault(place, []).extend(added)


def _passed(
    text: str, names: Mapping[str, str], module: str, lines: dict[int, list[str]]
) -> Iterator[Passed]:
    """Add the lines before calls of functions of other modules; yield the stored values."""
    for call in places(text, names):
        given, end = call.given, call.arguments
        if not given:
            given, end = _arguments(text, call.arguments)
        place, words = place_of(text, call.start, end, given) if given else (-1, given)
        if place < 0 or len(words) < len(given):
            continue
        if any(value.startswith("*") for value in words.values()):
            continue
        prefix = f"{GIVEN}_{module.replace('.', '_')}_{call.start}"
        kept = {
            key: f"{prefix}_{key}"
            for key, value in words.items()
            if value and not _CONSTANT.fullmatch(value) and not _OTHER_SCOPE.search(value)
        }
        if kept:
            _store_values(text, place, {name: words[key] for key, name in kept.items()}, lines)
        yield Passed(call.function, module, {**words, **kept})


def _store_values(
    text: str, place: int, values: Mapping[str, str], lines: dict[int, list[str]]
) -> None:
    """Add a line before a statement that stores values in global names."""
    indent = text[place : place + len(text[place:]) - len(text[place:].lstrip(" "))]
    kept = "; ".join(f"{name} = [{value}]" for name, value in values.items())
    lines.setdefault(place, []).append(f"{indent}global {', '.join(values)}; {kept}")


def _add_lines_of(
    text: str, function: _Function, received: Sequence[Passed], lines: dict[int, list[str]]
) -> Mapping[str, tuple[int, int] | None]:
    """Add the lines before the calls of a function, and the one at its start.

    Returns:
        The parameters with inferred types, and the positions of their annotations.
    """
    sources: dict[str, list[str]] = {}
    calls = [*_calls(text, function)]
    if not (calls or received):
        return {}
    parameters = _Parameters(function, text)
    for number, (place, words, is_partial) in enumerate(calls):
        kept: dict[str, str] = {}
        for parameter, value in parameters.given(words, is_partial=is_partial).items():
            source = parameters.stored(parameter, value)
            if not _CONSTANT.fullmatch(value):
                kept[f"{GIVEN}_{function.start}_{number}_{parameter}"] = value
                source = [*kept][-1]
            sources.setdefault(parameter, []).append(source)
        if kept:
            _store_values(text, place, kept, lines)
    imports: list[str] = []
    for call in received:
        for parameter, value in parameters.given(call.given).items():
            is_constant = _CONSTANT.fullmatch(value) is not None
            source = parameters.stored(parameter, value) if is_constant else value
            sources.setdefault(parameter, []).append(source)
            imports += [] if is_constant else [f"from {call.module} import {value}"]
    taken = {
        name: f"{name} = ({f' if {_EITHER} else '.join(dict.fromkeys(values))})[0]"
        for name, values in sources.items()
        if len(values) <= _MAX_CALLS
    }
    if taken:
        taking = "; ".join([*imports, *taken.values()])
        lines.setdefault(function.start, []).insert(0, function.inner + taking)
    return {name: parameters.annotations.get(name) for name in taken}


def _add_nodes_of(
    text: str, function: _Function, known: Collection[str], lines: dict[int, list[str]]
) -> Sequence[str]:
    """Add lines that tell which parameters of a function are nodes; return them."""
    if "node" not in function.parameters:
        return ()
    body = function_body(text, function.start - 1, function.start - 1)
    class_ = _class_around(text, function.place) if function.is_method else ""
    found = [*node_parameters.statements(text, function.parameters, body, class_, known)]
    if found:
        _add(lines, {function.start: [f"{function.inner}{line}" for line in found]})
    return found


def _class_around(text: str, place: int) -> str:
    """Return the text of the class around a place."""
    starts = [*class_starts(text), len(text)]
    at = bisect_right(starts, place)
    return text[starts[at - 1] : starts[at]] if 0 < at < len(starts) else ""


def _functions(text: str) -> Iterator[_Function]:
    """Yield the functions of a file that have no decorator."""
    classes = [*class_starts(text), len(text)]
    derived = [match for match in (_DERIVED.match(text, start) for start in classes) if match]
    bases = {base for match in derived for base in _NAME.findall(match[1])}
    at = 0
    for match in definitions(_FUNCTION, text):
        while classes[at] <= match.start():
            at += 1
        decorator = _decorator(text, match.start())
        if decorator not in {"", "staticmethod"} or "#" in match["parameters"]:
            continue
        called, segment = match["name"], (classes[at - 1] if at else 0, classes[at])
        is_method = match["parameters"].lstrip().startswith("self")
        class_ = _NAME.match(text, segment[0] + len("class ")) if at else None
        name = "" if match["indent"] else called
        if called == "__init__" and is_method and class_:
            is_only_one = text.count("def __init__(", *segment) == 1
            called, segment = class_[0] if is_only_one else "", (0, len(text))
            name = called
        elif decorator or (is_method and match["indent"]):
            name = f"{class_[0]}.{called}" if class_ else ""
            called = f"self.{called}"
            if class_ and class_[0] in bases:
                segment = (0, len(text))  # derived classes call it as well
        else:
            segment = (0, len(text))
        if called:
            yield _Function(
                *(name, f"{called}(", match.start("parameters"), match["parameters"], is_method),
                *(match.end(), match["inner"], segment),
            )


def _is_unique(text: str, function: _Function) -> bool:
    """Return whether the name of a function is unique."""
    name = function.called.removeprefix("self.")
    class_ = name.removesuffix("(")
    return sum(map(text.count, (f"def {name}", f"class {name}", f"class {class_}:"))) == 1


def _decorator(text: str, start: int) -> str:
    """Return the line before a definition if it is, or may be, a decorator."""
    line = text[text.rfind("\n", 0, max(start - 1, 0)) + 1 : max(start - 1, 0)].strip()
    return line[1:] if line.startswith("@") else line if line == ")" else ""


def _calls(text: str, function: _Function) -> Iterator[tuple[int, Mapping[str, str], bool]]:
    """Yield the calls of a function: the start of the statement, and the arguments.

    The third value tells whether more arguments follow later: ``partial(self.on_pose, name)``.
    """
    yield from _calls_as(text, function, function.called, is_partial=False)
    class_, _, method = function.name.partition(".")
    for local in _objects(text).get(class_, ()) if method else ():
        for call in calls_of_object(text, local, class_):
            if call.function == function.name:
                called = f"{local}.{method}("
                segment = call.start, call.arguments
                yield from _calls_as(
                    text, function._replace(segment=segment), called, is_partial=False
                )
        for registered in registered_callbacks(text, {local: class_}):
            if registered.function == function.name:
                at = registered.start, registered.arguments
                place, words = place_of(text, *at, registered.given)
                if place >= 0:
                    yield place, words, False
    if "partial(" in text:
        called = f"partial({function.called.removesuffix('(')},"
        yield from _calls_as(text, function, called, is_partial=True)


@lru_cache(maxsize=1)
def _objects(text: str) -> Mapping[str, Sequence[str]]:
    """Return the variables and attributes that a text sets to new objects, by class."""
    result: dict[str, list[str]] = {}
    for match in lines_like(_MADE, _SET_TO_OBJECT, text):
        result.setdefault(match["class"], []).append(match["name"])
    return result


def _calls_as(
    text: str, function: _Function, called: str, *, is_partial: bool
) -> Iterator[tuple[int, Mapping[str, str], bool]]:
    body: tuple[int, int] | None = None
    at = text.find(called, *function.segment)
    while at >= 0:
        start, at = at, text.find(called, at + 1, function.segment[1])
        if is_partial and text[start - 1 : start] == ".":
            start -= len("functools.") if text.endswith("functools.", 0, start) else 0
        elif text[start - 1 : start].isalnum() or text[start - 1 : start] in {"_", "."}:
            continue
        if text.endswith(("def ", "class "), 0, start):
            continue
        given, end = _arguments(text, text.find(called, start) + len(called))
        place, words = place_of(text, start, end, given) if given else (-1, given)
        if place < 0:
            continue
        if body is None:
            if not _is_unique(text, function):
                return
            head = function.start - 1
            body = head, head + len(function_body(text, head, head))
        if not body[0] <= start < body[1]:
            yield place, words, is_partial or len(words) < len(given)


def _arguments(text: str, start: int) -> tuple[Mapping[str, str], int]:
    """Return the arguments of a call, and its end; ``self`` as an instance of its class."""
    words, end = arguments_of(text, start)
    if any("#" in word for word in words.values()):
        return {}, end  # commas in a comment do not count
    if "self" not in words.values():
        return words, end
    return {
        key: _object(text, start) if annotation == "self" else annotation
        for key, annotation in words.items()
    }, end


def _object(text: str, at: int) -> str:
    """Return an instance of the class around a place; ``self`` if the file creates none."""
    start = text.rfind("\nclass ", 0, at) + 1
    class_ = _NAME.match(text, start + len("class ")) if text.startswith("class ", start) else None
    if class_ is None or re.search(r"\n[^\s#)]", text[start:at]):
        return "self"
    is_made = re.search(rf"(?<!class )(?<![\w.]){class_[0]}\(", text)
    return f"{class_[0]}.__new__({class_[0]})" if is_made else "self"


class _Parameters:
    """The parameters of a function.

    Args:
        function: The function.
        text: Its file.
    """

    def __init__(self, function: _Function, text: str) -> None:
        self._defaults: dict[str, str] = {}
        """Empty where there is none."""
        self.annotations: dict[str, tuple[int, int]] = {}
        """The positions of the annotations, by parameter."""
        self._positional: list[str] = []
        is_by_keyword = False
        at = 0
        for key, word in arguments_of(function.parameters, 0)[0].items():
            match = _PARAMETER.fullmatch(word if key.isdigit() else f"{key}={word}")
            name = match[1] if match else (_NAME.match(word) or [""])[0]
            is_by_keyword = is_by_keyword or name.startswith("*")
            if not is_by_keyword and name != "/":
                self._positional.append(name)
            start = function.place + function.parameters.find(word, at)
            at = start + len(word) - function.place
            if match and name.isidentifier():
                self._defaults[name] = match[3] or ""
                if match[2]:
                    self.annotations[name] = start + match.start(2), start + match.end(2)
        if function.is_method:
            del self._positional[:1]
        nothing = [name for name, default in self._defaults.items() if default == "None"]
        body = function_body(text, function.start - 1, function.start - 1) if nothing else ""
        self._replaced = {name for name in nothing if _is_replaced(name, body)}
        """The parameters for which the function creates a value if there is none."""

    def stored(self, parameter: str, constant: str) -> str:
        """Return a sequence with a constant argument, from which it is taken."""
        is_certain = constant == "None" and parameter in self._replaced
        return "(None,)" if is_certain else f"[{constant}]"  # a list has elements of any value

    def given(self, words: Mapping[str, str], *, is_partial: bool = False) -> Mapping[str, str]:
        """Return the arguments of a call by parameter; empty if uncertain, or if some are missing.

        A partial call leaves the other parameters to a later call.
        """
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
        if not is_partial and any(
            self._defaults.get(name) == "" and name not in result for name in self._positional
        ):
            return {}
        defaults = {
            name: default
            for name, default in self._defaults.items()
            if name not in result and _CONSTANT.fullmatch(default)
        }
        kept = {
            name: value
            for name, value in result.items()
            if name in self._defaults and not _OTHER_SCOPE.search(value)
        }
        if is_partial:
            return kept
        if kept or (not result and {*defaults.values()} != {"None"}):
            return kept | defaults
        return {name: "None" for name in defaults if name in self._replaced}


def _is_replaced(name: str, body: str) -> bool:
    """Return whether a function replaces ``None``: ``limits or Limits()``."""
    if_none = rf"if (?:{name} is None|not {name}):\n[ ]+{name} = "
    return re.search(rf"(?<![\w.]){name} or [A-Z]\w*\(|\b{if_none}", body) is not None
