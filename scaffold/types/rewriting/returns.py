"""Infers return types of functions, for the type checker.

For ``return self.frames[0]``, a line before it stores the value in a global name, and the return
annotation of the function is the type of that name. The same is done with the values of generators.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property, lru_cache

from scaffold import lazy_re
from scaffold.record import NamedTuple
from scaffold.types.rewriting.callbacks import function_body
from scaffold.types.rewriting.results import expression_at, imports, plain_result
from scaffold.types.rewriting.statements import definitions

_KEPT = "_ros2_returned"
_TYPE_OF = "_Ros2TypeOf"
_YIELDING = "_Ros2Generator"
_DEFINITIONS = f"""
from collections.abc import Generator as {_YIELDING}
from ty_extensions._internal import TypeOf as {_TYPE_OF}
"""
_FUNCTION = lazy_re.compile(
    r"^(?P<indent> *)(?P<async>async )?def (?P<name>[^\W\d]\w*)"
    r"(?P<parameters>\((?:[^()#]|\([^()#]*\)){0,800}\))(?P<end> *): *(?:#[^\n]*)?\n"
    r"(?=\n*(?P<inner> +)\S)",
    re.MULTILINE,
)
"""Matches the head of a function without a return annotation."""
_NAMED = lazy_re.compile(r"^[ ]*(?:async )?def (\w+)\(", re.MULTILINE)
_ANY_WORD = lazy_re.compile(r"(?<![\w.'\"#])(?:return|yield)\b(?![\w'\"])")
_OTHER_SCOPES = lazy_re.compile(r"^ *(?:(?:async )?def|class)\b", re.MULTILINE)
_DOCSTRING = lazy_re.compile(r"\s*[rRuU]?(\"\"\"|''').*?\1", re.DOTALL)
_KEEPING = frozenset(
    {"property", "staticmethod", "classmethod", "cached_property", "contextmanager"}
)
"""Decorators whose effect on the return type is known."""
_UNSUITED = lazy_re.compile(r"\b(?:lambda|await|yield)\b|:=|#|'''|\"\"\"|\\\n|^from\b")
_EITHER = lazy_re.compile(r"\b(?:else|or|and)\b")
"""Matches expressions with alternatives, such as conditions."""
_NUMERIC = lazy_re.compile(r"math\.\w+|_ros2_param_(?:float|int)\(\)|[-+*/() \d.]")
"""Matches a part of arithmetic with numbers."""
_ITSELF = lazy_re.compile(r"\bself\s*(?:$|[,)\]}])")
_CALL = lazy_re.compile(r"([^\W\d]\w*)(?:\.\w+)*\(")
_GENERIC = frozenset(
    {"abs", "dict", "enumerate", "filter", "frozenset", "getattr", "iter", "list", "map", "max"}
    | {"min", "next", "reversed", "round", "set", "sorted", "sum", "tuple", "vars", "zip", "type"}
    | {"copy", "deepcopy", "partial", "super"}
)
"""Functions whose return type depends on their arguments."""
_ELEMENT = lazy_re.compile(r"self\.(\w+)\[[^\W\d]\w*\]")
"""Matches an element of a container, under the key in a variable."""
_SET = lazy_re.compile(r"^([\w ,]+)(?::[^=\n]*)?[-+*/|&%]?=(?!=)([^\n]*)", re.MULTILINE)
"""Matches assignments to names, and statements that start like one."""
_BOUND = lazy_re.compile(r"\bfor ([\w, ()]{1,200}?) in\b([^\n]*)|\bas (\w+)")
_ATTRIBUTE = lazy_re.compile(r"(?<![\w.])self\.(\w+) *(?::[^=\n]*)?=(?!=)([^\n]*)")
_OF_SELF = lazy_re.compile(r"self\.(\w+)")
_WORD = lazy_re.compile(r"(?<![\w.])[^\W\d]\w*")
_MAX_VALUES = 8
"""The maximum number of returned values; a function with more has an unknown type."""


class Results(NamedTuple):
    """The return values of the functions of a file."""

    lines: Mapping[int, list[str]]
    """The lines to insert, by position."""
    heads: Sequence[tuple[int, int, str]]
    """The insertions into the heads of functions, by position."""
    definitions: str
    """The code to append to the file."""


def results(
    text: str, taken: Mapping[int, Collection[str]], others: Collection[int] = ()
) -> Results:
    """Return the insertions that tell a type checker the return types of the functions of a file.

    Args:
        text: The file.
        taken: The parameters whose types are inferred from the calls in this file,
            by the start of the function body. Other files may pass other types.
        others: Positions of functions whose head is rewritten already.
    """
    lines: dict[int, list[str]] = {}
    heads: list[tuple[int, int, str]] = []
    if "return " not in text and "yield " not in text:
        return Results(lines, heads, "")
    count = Counter(_NAMED.findall(text))
    attributes = _Attributes(text)
    for function in definitions(_FUNCTION, text):
        decorator = _decorator(text, function.start())
        if decorator is None or function.start() in others:
            continue
        if not _is_only_one(text, function, count):
            continue
        start = function.end() - 1
        body = function_body(text, function.start("name"), start)
        if "return " not in body and "yield " not in body:
            continue
        kept = [*_returned_values(body, start, taken.get(function.end(), ()))]
        shapes = {_common_creation(item.value, body, attributes) for item in kept}
        is_one = len(shapes) == 1 and "" not in shapes
        type_ = _type(kept, is_async=bool(function["async"])) if is_one else ""
        if type_:
            for item in kept:
                lines.setdefault(item.place, []).append(item.line)
        elif decorator not in {"property", "cached_property", "contextmanager"}:
            type_ = plain_result(function["parameters"], body)
        if type_:
            heads.append((function.end("end"), function.end("end"), f' -> "{type_}"'))
    written = "".join(head for _, _, head in heads)
    return Results(lines, heads, _DEFINITIONS * (_TYPE_OF in written) + imports(written))


def _type(kept: Sequence[_Kept], *, is_async: bool) -> str:
    """Return the return type of a function; empty if unknown."""
    words = {item.word for item in kept}
    if len(words) != 1 or len(kept) > _MAX_VALUES:
        return ""
    type_ = " | ".join(f"{_TYPE_OF}[{item.name}[0]]" for item in kept)
    if "return" in words:
        return type_
    return "" if is_async else f"{_YIELDING}[{type_}, None, None]"


class _Kept(NamedTuple):
    """A value that a function returns or yields."""

    word: str
    value: str
    place: int
    name: str
    line: str


def _decorator(text: str, start: int) -> str | None:
    """Return the decorator of a function, or empty; ``None`` if it may change the result."""
    end = max(start - 1, 0)
    line = text[text.rfind("\n", 0, end) + 1 : end].strip()
    if not line.startswith("@"):
        return None if line == ")" else ""
    name = line[1:].rpartition(".")[2]
    return name if name in _KEEPING else None


def _is_only_one(text: str, function: re.Match[str], count: Mapping[str, int]) -> bool:
    """Return whether no other class in the file has a method of this name."""
    name = function["name"]
    if not function["indent"] or count[name] == 1:
        return True
    setters = text.count(f"@{name}.setter\n") + text.count(f"@{name}.deleter\n")
    return count[name] - setters == 1


def _returned_values(body: str, start: int, taken: Collection[str]) -> Iterator[_Kept]:
    """Yield the values that a function returns or yields; none if one of them is not plain.

    Args:
        body: The body of the function.
        start: The offset of the body in the file.
        taken: See `results`.
    """
    inner = [*_inner_functions(body)]
    docstring = _DOCSTRING.match(body)
    if docstring is not None:
        inner.append(docstring.span())
    kept: list[_Kept] = []
    own = [word for word in _ANY_WORD.finditer(body) if not _is_within(word.start(), inner)]
    derived = _derived(body, taken) if taken and own else set[str]()
    for match in own:
        line = body.rfind("\n", 0, match.start()) + 1
        if "#" in body[line : match.start()]:
            continue
        value = expression_at(body, match.end())
        if match[0] == "return" and value in {"", "None"}:
            continue
        if body[line : match.start()].strip() or not _is_plain(value):
            return
        if derived and not _is_independent(value, derived):
            return
        place = start + line
        name = f"{_KEPT}_{place}"
        written = " ".join(map(str.strip, value.split("\n")))
        added = f"{body[line : match.start()]}global {name}; {name} = [({written})]"
        kept.append(_Kept(match[0], value, place, name, added))
    yield from kept


def stored_values(body: str, start: int) -> Sequence[tuple[int, str, str]]:
    """Return the lines that store what a function returns or yields, if that is plain.

    Args:
        body: The body of the function.
        start: The offset of the body in the file.

    Returns:
        Positions, lines, and the names in which they store lists with the values.
    """
    return [(kept.place, kept.line, kept.name) for kept in _returned_values(body, start, ())]


def _inner_functions(body: str) -> Iterator[tuple[int, int]]:
    """Yield the start and end of nested functions and classes."""
    for match in _OTHER_SCOPES.finditer(body):
        end = body.find("\n", match.end())
        if end >= 0:
            yield match.start(), end + len(function_body(body, match.end(), end))


def _is_within(place: int, stretches: Sequence[tuple[int, int]]) -> bool:
    return any(start <= place < end for start, end in stretches)


def _is_plain(value: str) -> bool:
    """Return whether an expression can be moved to another line, and has no type of its own."""
    if not value or _UNSUITED.search(value):
        return False
    return _ITSELF.search(value) is None or _CALL.match(value) is not None


def _derived(body: str, names: Collection[str]) -> set[str]:
    """Return the names and the local variables that may be derived from them."""
    result = {*names}
    for _ in range(2):
        for targets, value in _assignments(body):
            if not _is_independent(value, result):
                result.update(targets)
        for match in _BOUND.finditer(body):
            if match[3] or not _is_independent(match[2].strip(), result):
                result.update(_WORD.findall(match[1] or match[3]))
    return result


@lru_cache(maxsize=1)
def _assignments(body: str) -> Sequence[tuple[Sequence[str], str]]:
    """Return the assignments in some lines, as pairs of name and value."""
    result: list[tuple[Sequence[str], str]] = []
    for match in _SET.finditer(body):
        targets = [target.strip() for target in match[1].split(",")]
        if all(map(str.isidentifier, targets)):
            result.append((targets, match[2].strip()))
    return result


class _Attributes:
    """The values assigned to attributes of ``self`` in a file.

    Args:
        text: The file.
    """

    def __init__(self, text: str) -> None:
        self._text = text

    @cached_property
    def _values(self) -> Mapping[str, set[str]]:
        values: dict[str, set[str]] = {}
        for match in _ATTRIBUTE.finditer(self._text):
            values.setdefault(match[1], set()).add(_callee(match[2].strip()))
        return values

    def has_one_kind(self, name: str) -> bool:
        """Return whether one statement sets all elements of an attribute."""
        if self._values.get(name) != {"{}"}:
            return False
        lines = (line.strip() for line in self._text.splitlines())
        elements = (line for line in lines if line.startswith(f"self.{name}["))
        return sum(line.partition("]")[2].startswith(" = ") for line in elements) == 1

    def is_of_one(self, name: str) -> bool:
        """Return whether all values of an attribute are created in the same way."""
        values = self._values.get(name, set()) - {"None"}
        return len(values) <= 1 and "" not in values


def _common_creation(value: str, body: str, attributes: _Attributes) -> str:
    """Return how a value is created; empty if there are several ways, as with a factory."""
    form = _callee(value)
    element = _ELEMENT.fullmatch(value)
    if element is not None:
        return form if attributes.has_one_kind(element[1]) else ""
    of_self = _OF_SELF.match(value)
    if of_self is not None:
        return form if attributes.is_of_one(of_self[1]) else ""
    root = _WORD.match(value)
    if root is None or not form:
        return form
    given = [item for targets, item in _assignments(body) if root[0] in targets]
    forms = {_callee(item) for item in given} - {"None"}
    own = [match[1] for match in map(_OF_SELF.match, given) if match]
    return (
        form if len(forms) <= 1 and all(map(attributes.is_of_one, own)) and "" not in forms else ""
    )


def _callee(value: str) -> str:
    """Return the callee that creates a value, without arguments; empty for a conditional one."""
    if _EITHER.search(value):
        return ""
    is_float = "." in value or "_float(" in value
    if is_float and not _NUMERIC.sub("", value):
        return "a number"
    called = _CALL.match(value)
    return called[0] if called is not None else value


def _is_independent(value: str, names: set[str]) -> bool:
    """Return whether the type of an expression does not depend on some variables."""
    if names.isdisjoint(_WORD.findall(value)) or _ELEMENT.fullmatch(value):
        return True
    called = _CALL.match(value)
    return called is not None and called[1] not in _GENERIC and called[1] not in names
