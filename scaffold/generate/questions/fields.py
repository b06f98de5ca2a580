"""Parses field definitions of new interfaces, such as ``float64 distance``."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import NamedTuple

from scaffold.errors import InputError
from scaffold.model.interfaces.reserved_names import reserved
from scaffold.model.interfaces.syntax import parse
from scaffold.model.interfaces.types import FieldType
from scaffold.source import Source

_OWN = "own_package"
"""Placeholder for the name of the package, which does not matter here."""
_MAX_BOUND = 2**32 - 1
"""Maximum length of arrays and strings, which generated code can count on every platform."""
_TURNING = "\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069"
"""Bidirectional control characters, of which compilers warn."""


class Fields(NamedTuple):
    """Some lines of a definition."""

    lines: tuple[str, ...]
    packages: tuple[str, ...]
    """The packages of the types that are not primitive ones, in alphabetical order."""
    own_types: tuple[str, ...]
    """The types that the package itself must define."""


def fields(given: object, where: str = ".") -> Fields:
    """Parse fields and constants.

    Args:
        given: A line, or several: a type, a name, perhaps a default or ``=`` and a constant,
            perhaps ``#`` and a comment.
        where: A directory of the workspace with the messages that they use.

    Raises:
        InputError: ROS would reject a line, or does not know a type.
    """
    lines = tuple(
        line for text in _texts(given) for line in map(str.strip, text.splitlines()) if line
    )
    refuse_turning("".join(lines))
    _refuse_garbled(lines)
    definition = parse(Source("fields", "\n".join(lines)), _OWN, "msg", "Fields")
    for problem in definition.problems:
        line = lines[problem.location.line - 1]
        several = re.search(r"\w\s*[,;]\s*[\w/]+ +\w", line.partition("#")[0])
        hint = "; quote each field separately" if several else ""
        raise InputError(f"{line!r}: {problem.message}{hint}")
    for field in definition.all_fields:
        if reserved(field.name):
            line = lines[field.location.line - 1]
            raise InputError(f"{line!r}: {reserved(field.name)}; choose another name")
        _refuse_large(field.type, lines[field.location.line - 1])
    types = [field.type.element for field in definition.all_fields]
    used = {item.full_name for item in types if not item.is_primitive}
    own = {name for name in used if name.startswith(f"{_OWN}/")}
    _refuse_unknown(used - own, where)
    return Fields(
        lines=lines,
        packages=tuple(sorted({name.partition("/")[0] for name in used - own})),
        own_types=tuple(sorted(name.rpartition("/")[2] for name in own)),
    )


def refuse_turning(text: str) -> None:
    """Raise if a text has bidirectional control characters, which can disguise code.

    Raises:
        InputError: with the character.
    """
    character = next((item for item in text if item in _TURNING), None)
    if character is not None:
        raise InputError(
            f"contains the character U+{ord(character):04X}, which changes the direction of text"
        )


def _refuse_garbled(lines: Iterable[str]) -> None:
    """Raise if the generated code would differ from the line, or be broken."""
    for line in lines:
        code = line.partition("#")[0]
        value = re.sub(r"^\s*\S+\s+\w+[\s=]*", "", code).strip()
        if "\\" in line:
            raise InputError(
                f"{line!r}: rosidl reads a backslash as the start of an escape sequence"
            )
        if value[:1] in {'"', "'"} and (len(value) == 1 or value[-1] != value[0]):
            raise InputError(f"{line!r}: the string is not closed; a '#' inside starts a comment")
        if trigraph := re.search(r"\?\?[=/'()!<>-]", line):
            raise InputError(f"{line!r}: {trigraph[0]!r} is a trigraph in C")


def _refuse_large(type_: FieldType, line: str) -> None:
    for number in (type_.array_size, type_.text_bound):
        if number is not None and number > _MAX_BOUND:
            raise InputError(f"{line!r}: {number} is too large; the limit is {_MAX_BOUND}")


def refuse_missing(wanted: Fields, messages: Iterable[str]) -> None:
    """Raise if the package does not define a type that it uses.

    Args:
        wanted: The fields of one of its interfaces.
        messages: The names of its messages.

    Raises:
        InputError: with similar messages of other packages.
    """
    from scaffold.generate import payload

    defined = set(messages)
    for name in wanted.own_types:
        if name not in defined:
            others = [item for item in payload.definitions().matches(name) if "/msg/" in item]
            hint = f"; did you mean {' or '.join(others[:3])}?" if others else ""
            raise InputError(f"the package has no message {name!r}{hint}")


def _texts(given: object) -> list[str]:
    texts: list[str] = []
    for text in given if isinstance(given, list | tuple) else [given]:
        if not isinstance(text, str):
            raise InputError(f"{text!r} is not a field such as 'float64 distance'")
        texts.append(text)
    return texts


def _refuse_unknown(used: Iterable[str], where: str) -> None:
    """Raise if a known package has no such message; unknown packages may have any."""
    from scaffold.generate import payload

    if not used:
        return
    definitions = payload.definitions(where)
    for full_name in sorted(used):
        names = definitions.names(full_name.partition("/")[0], "msg")
        if names is not None and full_name.rpartition("/")[2] not in names:
            definitions.resolve(full_name)
