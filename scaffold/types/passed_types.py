"""The types of arguments passed between modules, as the type checker names them.

A module about which nothing was reported need not be checked again when another one that calls its
functions is edited, as long as that passes values of the same types. Types are compared by their
names, where these tell all: those of Python's own types and of the stubs.
"""

from __future__ import annotations

import builtins
from collections.abc import Iterable, Mapping, Sequence

from scaffold import lazy_re
from scaffold.types.rewriting.passed import GIVEN, Passed
from scaffold.types.sources import Source
from scaffold.types.stubs.marks import MARK
from scaffold.types.ty import TyDiagnostic

Types = Sequence[tuple[str, str]]
"""The functions that a module calls, each with its argument types; empty if not known."""

_REVEALED = lazy_re.compile(r"Revealed type: `(.*)`")
_TEXT = lazy_re.compile(r'"[^"\\]*"')
_NAME = lazy_re.compile(rf"[^\W\d][\w{MARK}]*")
_PLAIN = frozenset(
    {name for name, value in vars(builtins).items() if isinstance(value, type)}
    | {"Any", "Literal", "None", "False", "True", "Unknown"}
)
"""Names in types that have the same meaning everywhere."""


def revealing(passed: Sequence[Passed]) -> bytes:
    """Return a file with ``reveal_type`` calls for the values that a module passes."""
    return "".join(
        f"from {module} import {name}; reveal_type({name})\n"
        for module, name in _passed_names(passed)
    ).encode()


def types(
    passed: Sequence[Passed],
    reported: Iterable[TyDiagnostic],
    reached: Mapping[str, Source],
) -> Types:
    """Return the types of the values that a module passes.

    Args:
        passed: The values that it passes.
        reported: The reports about the file from `revealing`.
        reached: The module and all that it imports, by place.
    """
    revealed: dict[int, str] = {}
    for item in reported:
        match = _REVEALED.fullmatch(item.message)
        if match is not None:
            revealed[item.line] = match[1] if _tells_all(match[1], reached) else ""
    by_name = {
        name: revealed.get(line, "") for line, (_, name) in enumerate(_passed_names(passed), 1)
    }
    return [(call.function, _argument_types(call.given, by_name)) for call in passed]


def signature(source: Source, callers: Iterable[Types]) -> str:
    """Return a signature of the argument types of a module; empty if they are not known."""
    calls = [call for passed in callers for call in passed]
    received = [call for call in calls if call[0].startswith(f"{source.dotted}.")]
    return repr(received) if all(given for _, given in received) else ""


def _passed_names(passed: Sequence[Passed]) -> list[tuple[str, str]]:
    """Return the modules and names of the passed values, except constants."""
    names = {
        (call.module, value): None
        for call in passed
        for value in call.given.values()
        if value.startswith(GIVEN)
    }
    return [*names]


def _argument_types(given: Mapping[str, str], by_name: Mapping[str, str]) -> str:
    """Return the argument types of a call by parameter; empty if any of them is not known."""
    result: list[str] = []
    for key, value in given.items():
        type_ = by_name.get(value, value)
        if value in by_name and not type_:
            return ""
        result.append(f"{key}{':' if value in by_name else '='}{type_}")
    return f"({', '.join(result)})"


def _tells_all(type_: str, reached: Mapping[str, Source]) -> bool:
    """Return whether the name of a type identifies it, whatever is edited."""
    own = {place.split("/")[1] for place, item in reached.items() if not item.path}
    names = {*_NAME.findall(_TEXT.sub("", type_))}
    plain = {name for name in names if MARK not in name}
    if not plain <= _PLAIN or any(name.split(MARK)[1] in own for name in names - plain):
        return False
    return all(plain.isdisjoint(item.classes) for item in reached.values())
