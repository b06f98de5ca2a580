"""The types of answers: each parses user input, or raises a one-line error."""

from __future__ import annotations

import re
import shlex
import unicodedata
from collections.abc import Callable, Mapping
from typing import Any

from scaffold import distributions
from scaffold.errors import InputError
from scaffold.generate.payload import (
    ActionPayload,
    Payload,
    ServicePayload,
    action,
    definitions,
    payload,
    service,
)
from scaffold.generate.questions import names
from scaffold.generate.questions.fields import fields, refuse_turning
from scaffold.generate.questions.qos import Qos, qos
from scaffold.model.manifest.placeholders import is_placeholder, is_placeholder_address

MAX_RATE = 10_000.0
"""Hertz; no Python node publishes faster."""
MIN_RATE = 0.001
MAX_TEXT = 3000
"""Limit on any other text, which is on one line of package.xml."""
MAX_PERSON = 60
"""Limit on a name or an email address, which is on one line with its key."""

_ENCODING = r"coding[:=]\s*[-\w.]"
"""A comment on the first two lines that Python reads as the encoding of the file."""

_ADDRESS = r"[-\w%+]+(\.[-\w%+]+)*@[-a-zA-Z0-9%]+(\.[-a-zA-Z0-9%]+)*\.[a-zA-Z]{2,}"
"""Addresses that catkin_pkg accepts; colcon ignores packages with other ones."""


def text(given: object) -> str:
    """Return a text on one line; line breaks and runs of spaces become one space.

    Raises:
        InputError: nothing is left, or it holds what XML cannot.
    """
    folded = " ".join(_string(given).split())
    if not folded:
        raise InputError("must not be empty")
    if len(folded) > MAX_TEXT:
        raise InputError(f"has {len(folded)} characters; the limit is {MAX_TEXT}")
    for character in folded:
        if unicodedata.category(character) in {"Cc", "Cs"} or character in "\ufffe\uffff":
            raise InputError(f"contains the character U+{ord(character):04X}, which XML forbids")
    refuse_turning(folded)
    if is_placeholder(folded):
        raise InputError(f"{_short(folded)!r} is a placeholder; replace or omit it")
    return folded


def person(given: object) -> str:
    """Return the name of a person or an organization.

    Raises:
        InputError: it cannot be written in comments, XML and Python.
    """
    name = text(given)
    if len(name) > MAX_PERSON:
        raise InputError(f"{_short(name)!r} has more than {MAX_PERSON} characters")
    if set(name) & set('"\\'):
        raise InputError(f"{name!r} contains a double quote or a backslash")
    if re.search(_ENCODING, name):
        raise InputError(f"{name!r} would be read as an encoding declaration by Python")
    return name


def address(given: object) -> str:
    """Return an email address that colcon and bloom accept.

    Raises:
        InputError: they would not.
    """
    result = text(given)
    if len(result) > MAX_PERSON:
        raise InputError(f"{_short(result)!r} has more than {MAX_PERSON} characters")
    if not re.fullmatch(_ADDRESS, result, re.ASCII):
        raise InputError(f"{result!r} is not an email address such as ada@example.com")
    if is_placeholder_address(result):
        raise InputError(f"{result!r} is a placeholder")
    return result


def rate(given: object) -> float:
    """Return a rate in hertz.

    Raises:
        InputError: it is not a number, or not one that a timer can keep.
    """
    try:
        number = float(_string(given))
    except ValueError:
        raise InputError(f"{given!r} is not a rate in hertz") from None
    if not MIN_RATE <= number <= MAX_RATE:
        raise InputError(f"{given} Hz is not between {MIN_RATE:g} and {MAX_RATE:g} Hz")
    return number


def flag(given: object) -> bool:
    """Return yes or no.

    Raises:
        InputError: it is neither.
    """
    word = str(given).lower()
    if word in {"true", "yes", "on", "1"}:
        return True
    if word in {"false", "no", "off", "0"}:
        return False
    raise InputError(f"{given!r} is not yes or no")


def dependencies(given: object) -> tuple[str, ...]:
    """Return names of packages, each once, in alphabetical order.

    Raises:
        InputError: one cannot be a name.
    """
    given = given if isinstance(given, list | tuple) else [given]
    words = [word for item in given for word in _string(item).replace(",", " ").split()]
    return tuple(sorted({names.dependency(word) for word in words}))


def parts(given: object) -> tuple[dict[str, object], ...]:
    """Return the answers for each part: its ``kind``, and others such as its ``name``.

    A part is a mapping, or a text such as ``publisher:talker`` or, with answers of its own,
    ``publisher:talker topic=chatter rate=5``, quoted as in a shell.

    Raises:
        InputError: one is neither.
    """
    items = given if isinstance(given, list | tuple) else [given]
    return tuple(_part_entry(item) for item in items)


def _part_entry(item: object) -> dict[str, object]:
    if isinstance(item, Mapping):
        if "kind" not in item:
            raise InputError(f"{dict(item)!r} has no key 'kind'")
        return {str(key): value for key, value in item.items()}
    try:
        first, *rest = shlex.split(_string(item)) or [""]
    except ValueError as error:
        raise InputError(f"{item!r}: {str(error).lower()}") from None
    kind, colon, name = first.partition(":")
    if colon and not name:
        raise InputError(f"{item!r} is not KIND:NAME, such as publisher:talker")
    entry: dict[str, Any] = {"kind": kind, "name": name} if name else {"kind": kind}
    for word in rest:
        key, equals, value = word.partition("=")
        if not equals:
            raise InputError(f"{word!r} in {item!r} is not QUESTION=ANSWER, such as rate=5")
        entry[key] = [*_as_list(entry[key]), value] if key in entry else value
    return entry


def _as_list(value: object) -> list[object]:
    return value if isinstance(value, list) else [value]


def distros(given: object) -> tuple[str, ...]:
    """Return the names of distributions, each once, oldest first.

    Raises:
        InputError: a name is unknown, or there is none.
    """
    words = given if isinstance(given, list | tuple) else [given]
    chosen = distributions.several(",".join(map(_string, words)))
    return tuple(distribution.name for distribution in chosen)


def nothing(given: object) -> tuple[str, ...]:
    """Return no choices, for a question without any.

    Raises:
        InputError: one is wanted.
    """
    if given:
        raise InputError(f"{given!r}: there are no choices")
    return ()


def message(given: object, where: str) -> Payload:
    """Return how to fill messages of a type, as the workspace around a directory defines it."""
    return payload(_string(given), definitions(where))


def service_type(given: object, where: str) -> ServicePayload:
    """Return how to call and serve services of a type."""
    return service(_string(given), definitions(where))


def action_type(given: object, where: str) -> ActionPayload:
    """Return how to request and how to execute actions of a type."""
    return action(_string(given), definitions(where))


def quality(given: object) -> Qos:
    """Return a quality of service; a file may map settings to values."""
    if isinstance(given, Mapping):
        given = ",".join(f"{key}={_string(value)}" for key, value in given.items())
    return qos(_string(given))


def _ignoring_directory(parse: Callable[[Any], object]) -> Callable[[object, str], object]:
    """Give a parser that does not depend on a directory the signature of the others."""
    return lambda given, _: parse(given)


TYPES: Mapping[str, Callable[[object, str], object]] = {
    "text": _ignoring_directory(text),
    "person": _ignoring_directory(person),
    "address": _ignoring_directory(address),
    "license": _ignoring_directory(text),
    "package": _ignoring_directory(lambda given: names.package_name(_string(given))),
    "node": _ignoring_directory(lambda given: names.node_name(_string(given))),
    "topic": _ignoring_directory(lambda given: names.topic(_string(given))),
    "service_name": _ignoring_directory(lambda given: names.topic(_string(given), "service")),
    "frame": _ignoring_directory(lambda given: names.frame(_string(given))),
    "action_name": _ignoring_directory(lambda given: names.topic(_string(given), "action")),
    "interface": _ignoring_directory(lambda given: names.interface_name(_string(given))),
    "program": _ignoring_directory(lambda given: names.program_name(_string(given))),
    "message": message,
    "service": service_type,
    "action": action_type,
    "qos": _ignoring_directory(quality),
    "rate": _ignoring_directory(rate),
    "flag": _ignoring_directory(flag),
    "dependencies": _ignoring_directory(dependencies),
    "fields": fields,
    "parts": _ignoring_directory(parts),
    "distributions": _ignoring_directory(distros),
    "several": _ignoring_directory(nothing),
}
"""The types of questions: parsers of answers, for packages in a directory."""


def _string(given: object) -> str:
    if isinstance(given, bool) or not isinstance(given, str | int | float):
        raise InputError(f"{_short(repr(given))} is not text")
    return str(given)


def _short(value: str) -> str:
    return value if len(value) <= MAX_PERSON else value[: MAX_PERSON - 3] + "..."
