"""The regular expressions of this repository, and which may take quadratic time.

A pattern is in danger where a repeat without a bound can be followed by another one over the same
characters, where one is inside of another, and where a search may start anywhere in what the first
repeat runs over. Sets of characters are compared over ASCII and some letters beyond.
"""

from __future__ import annotations

import ast
import re
import sys
import warnings
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeGuard

if sys.version_info >= (3, 11):
    from re import _constants as constants
    from re import _parser as parser
else:
    import sre_constants as constants
    import sre_parse as parser

ROOT = Path(__file__).resolve().parent.parent
METHODS = ("compile", "match", "fullmatch", "search", "sub", "subn", "split", "findall", "finditer")
ANCHORED = frozenset({"match", "fullmatch"})
MANY = 1000
"""A repeat of so many is as good as one without a bound."""
EXCUSE = "# linear: "
"""A comment beside a pattern that says why its input is bounded."""
_EVERYTHING = frozenset(map(chr, [*range(128), 0xE9, 0x3B1, 0x2003]))
_CATEGORIES = {"space": r"\s", "word": r"\w", "digit": r"\d"}


class Pattern(NamedTuple):
    """A pattern in a file of this repository."""

    path: str
    line: int
    text: str
    flags: int
    methods: frozenset[str]


class _Piece(NamedTuple):
    """A part of a pattern: its characters, and whether it is optional or unbounded."""

    characters: frozenset[str]
    is_optional: bool = False
    is_endless: bool = False
    guard: frozenset[str] | None = None
    """Of a look at what is before: where it succeeds, none of these characters is."""
    can_fail: bool = True
    opening: frozenset[str] | None = None
    """What the repeat of a group starts with; anything of it, without."""


# -- from the source to patterns


def patterns() -> Iterator[Pattern]:
    """Yield the patterns of the engine, the rules and the templates."""
    for top in ("scaffold", "rules", "templates"):
        for path in sorted((ROOT / top).rglob("*.py")):
            text = path.read_text()
            if "import re\n" in text or "lazy_re" in text:
                yield from _of_module(str(path.relative_to(ROOT)), text)


def _of_module(path: str, text: str) -> Iterator[Pattern]:
    tree = ast.parse(text)
    lines = text.splitlines()
    values = _constants(tree)
    nodes = list(ast.walk(tree))
    for node in nodes:
        match node:
            case ast.Call(func=ast.Attribute(ast.Name("re" | "lazy_re"), method), args=[first, *_]):
                pattern = _text(first, values, 0) if method in METHODS else None
            case _:
                continue
        places = [node, *([values[first.id]] if _names(first, values) else [])]
        if pattern is not None and not _is_excused(lines, places):
            methods = _uses(nodes, node) if method == "compile" else {method}
            yield Pattern(path, node.lineno, pattern, _flags(node), frozenset(methods))


def _names(node: ast.expr, values: Mapping[str, ast.expr]) -> TypeGuard[ast.Name]:
    return isinstance(node, ast.Name) and node.id in values


def _constants(tree: ast.Module) -> dict[str, ast.expr]:
    """Return the values of the module-level names of a module."""
    found: dict[str, ast.expr] = {}
    for node in tree.body:
        match node:
            case ast.Assign([ast.Name(name)], value):
                found[name] = value
            case ast.AugAssign(ast.Name(name), ast.Add() as plus, value) if name in found:
                found[name] = ast.copy_location(ast.BinOp(found[name], plus, value), node)
    return found


def _text(node: ast.expr, names: Mapping[str, ast.expr], depth: int) -> str | None:
    """Return the text of an expression, with a placeholder for unknown parts."""
    text: str | None = None
    match node:
        case ast.Constant(str() as text):
            pass
        case ast.Constant(bytes() as data):
            text = data.decode("latin-1")
        case ast.Name(name) if name in names and depth < len(names):
            text = _text(names[name], names, depth + 1)
        case ast.BinOp(left, ast.Add(), right):
            sides = _text(left, names, depth), _text(right, names, depth)
            text = None if None in sides else "".join(map(str, sides))
        case ast.JoinedStr(values):
            text = "".join(_text(value, names, depth) or "NAME" for value in values)
        case ast.FormattedValue(value):
            text = _text(value, names, depth)
    return text


def _flags(call: ast.Call) -> int:
    words = ast.unparse(call)
    names = ("MULTILINE", "DOTALL", "IGNORECASE", "ASCII", "VERBOSE")
    return sum(getattr(re, name) for name in names if f"re.{name}" in words)


def _uses(nodes: Sequence[ast.AST], compiled: ast.Call) -> set[str]:
    """Return how a compiled pattern is used; assume a search if that is unknown."""
    names: set[str] = set()
    found: set[str] = set()
    for node in nodes:
        match node:
            case ast.Assign([ast.Name(name)], value) if value is compiled:
                names.add(name)
            case ast.Attribute(value, method) if value is compiled:
                found.add(method)
    for node in nodes:
        match node:
            case ast.Attribute(ast.Name(name), method) if name in names and method in METHODS:
                found.add(method)
    return found or {"search"}


def _is_excused(lines: Sequence[str], nodes: Sequence[ast.expr]) -> bool:
    return any(
        EXCUSE in line
        for node in nodes
        for line in lines[max(node.lineno - 2, 0) : node.end_lineno]
    )


# -- from a pattern to its dangers


def dangers(text: str, flags: int = 0, *, is_search: bool = True) -> list[str]:
    """Describe where a pattern may take more than linear time."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        tree: Any = parser.parse(text, flags)
    flags |= tree.state.flags
    found: list[str] = []
    for pieces in _sequences(list(tree), flags, found):
        found += _adjacent(pieces)
        if is_search:
            found += _leading(pieces)
    return list(dict.fromkeys(found))


def _adjacent(pieces: Sequence[_Piece]) -> Iterator[str]:
    for at, first in enumerate(pieces):
        common = first.characters if first.is_endless else frozenset[str]()
        for number, piece in enumerate(pieces[at + 1 :], at + 1):
            both = common & piece.characters
            openings = (one.opening for one in (first, piece) if one.opening is not None)
            opens = all(both & opening for opening in openings)
            if piece.is_endless and both and opens and _can_fail(pieces[number + 1 :]):
                yield f"two repeats in a row over {min(both)!r}"
            if not piece.is_optional:
                if not both:
                    break
                common = both


def _leading(pieces: Sequence[_Piece]) -> Iterator[str]:
    guard: frozenset[str] = frozenset()
    before: list[_Piece] = []
    for at, piece in enumerate(pieces):
        if piece.guard is not None:
            guard |= piece.guard if not before else frozenset()
            continue
        if piece.is_endless and not piece.characters <= guard:
            inside = all(one.is_optional or one.characters & piece.characters for one in before)
            if inside and _can_fail(pieces[at + 1 :]):
                yield f"a search that may start anywhere in a repeat over {min(piece.characters)!r}"
        before.append(piece)


def _can_fail(pieces: Sequence[_Piece]) -> bool:
    return any(piece.can_fail and not piece.is_optional for piece in pieces)


def _sequences(items: list[Any], flags: int, found: list[str]) -> Iterator[list[_Piece]]:
    """Yield the paths through a pattern, up to a limit, each as a sequence of pieces."""
    ways: list[list[_Piece]] = [[]]
    for kind, value in items:
        parts = list(_pieces(kind, value, flags, found))
        ways = [[*way, *part] for way in ways for part in parts][:200]
    yield from ways


def _pieces(
    kind: Any,  # noqa: ANN401  of re
    value: Any,  # noqa: ANN401  of re
    flags: int,
    found: list[str],
) -> Iterator[list[_Piece]]:
    """Yield the paths through an item of a pattern."""
    if kind in (constants.MAX_REPEAT, constants.MIN_REPEAT):
        yield [_repeat(value, flags, found)]
    elif kind is constants.SUBPATTERN:
        yield from _sequences(list(value[3]), flags | value[1], found)
    elif kind is constants.BRANCH:
        for branch in value[1]:
            yield from _sequences(list(branch), flags, found)
    elif kind in (constants.ASSERT, constants.ASSERT_NOT):
        yield [_look(kind, value, flags, found)]
    elif kind is constants.AT:
        yield [_anchor(value, flags)] if value not in _ENDS else [_end(value, flags)]
    elif kind in (constants.GROUPREF, constants.GROUPREF_EXISTS):
        yield [_Piece(_EVERYTHING)]
    else:
        yield [_Piece(_characters(kind, value, flags))]


_ENDS = (constants.AT_END, constants.AT_END_STRING)


def _anchor(value: Any, flags: int) -> _Piece:  # noqa: ANN401  of re
    """Return the characters that an anchor allows before it."""
    if value is constants.AT_BEGINNING_STRING:
        return _Piece(frozenset(), guard=_EVERYTHING)
    if value is constants.AT_BEGINNING:
        line = _EVERYTHING - {"\n"} if flags & re.MULTILINE else _EVERYTHING
        return _Piece(frozenset(), guard=line)
    words = frozenset(one for one in _EVERYTHING if re.match(r"\w", one))
    return _Piece(frozenset(), guard=words, is_optional=True)


def _end(value: Any, flags: int) -> _Piece:  # noqa: ANN401  of re
    is_line = value is constants.AT_END and flags & re.MULTILINE
    return _Piece(frozenset(), can_fail=not is_line)


def _look(kind: Any, value: Any, flags: int, found: list[str]) -> _Piece:  # noqa: ANN401  of re
    direction, body = value
    ways = list(_sequences(list(body), flags, found))
    if direction < 0 and kind is constants.ASSERT_NOT and all(len(way) == 1 for way in ways):
        guard = frozenset[str]().union(*(way[0].characters for way in ways))
        return _Piece(frozenset(), guard=guard)
    for way in ways:
        found += _adjacent([*way, _Piece(frozenset(), can_fail=False)])
    return _Piece(frozenset(), guard=frozenset())


def _repeat(value: Any, flags: int, found: list[str]) -> _Piece:  # noqa: ANN401  of re
    least, most, body = value
    ways = list(_sequences(list(body), flags, found))
    characters = frozenset[str]().union(*(piece.characters for way in ways for piece in way))
    is_endless = most is constants.MAXREPEAT or most >= MANY
    for way in ways:
        if is_endless and len(way) > 1:
            found += [f"{danger}, inside of a repeat" for danger in _adjacent([*way, *way, _LAST])]
        elif is_endless and way and way[0].is_endless:
            found.append(f"a repeat of a repeat over {min(way[0].characters)!r}")
    is_simple = all(len(way) == 1 for way in ways)
    is_inner = not is_endless and any(piece.is_endless for way in ways for piece in way)
    if is_inner and not is_simple:
        # An optional group: its first piece decides whether it is entered.
        return _Piece(frozenset().union(*(_open(way) for way in ways)), is_optional=least == 0)
    opening = None if is_simple else frozenset[str]().union(*map(_open, ways))
    is_endless = is_endless or is_inner
    return _Piece(characters, is_optional=least == 0, is_endless=is_endless, opening=opening)


def _open(way: Sequence[_Piece]) -> frozenset[str]:
    """Return the characters that may come first."""
    found = frozenset[str]()
    for piece in way:
        found |= piece.characters if piece.opening is None else piece.opening
        if not piece.is_optional and piece.guard is None:
            break
    return found


_LAST = _Piece(frozenset())


def _characters(kind: Any, value: Any, flags: int) -> frozenset[str]:  # noqa: ANN401  of re
    if kind is constants.ANY:
        return _EVERYTHING if flags & re.DOTALL else _EVERYTHING - {"\n"}
    if kind is constants.LITERAL:
        both = {chr(value).lower(), chr(value).upper()} if flags & re.IGNORECASE else {chr(value)}
        return frozenset(both)
    if kind is constants.NOT_LITERAL:
        return _EVERYTHING - {chr(value)}
    if kind is not constants.IN:
        return _EVERYTHING
    is_negated = value[0][0] is constants.NEGATE
    inside = frozenset[str]().union(*(_members(*entry) for entry in value[is_negated:]))
    if flags & re.IGNORECASE:
        inside |= {one.swapcase() for one in inside if len(one.swapcase()) == 1}
    return _EVERYTHING - inside if is_negated else inside


def _members(kind: Any, value: Any) -> frozenset[str]:  # noqa: ANN401  of re
    if kind is constants.RANGE:
        return frozenset(one for one in _EVERYTHING if value[0] <= ord(one) <= value[1])
    if kind is constants.CATEGORY:
        *negation, name = str(value).lower().removeprefix("category_").split("_")
        members = frozenset(one for one in _EVERYTHING if re.match(_CATEGORIES[name], one))
        return _EVERYTHING - members if negation else members
    return frozenset({chr(value)})
