"""Types, names and values as written in .msg files."""

from __future__ import annotations

import re
from functools import lru_cache

from scaffold.record import NamedTuple

Scalar = bool | int | float | str
Value = Scalar | tuple[Scalar, ...]

INTEGER_RANGES = {
    "byte": (0, 255),
    "char": (0, 255),
    "int8": (-(2**7), 2**7 - 1),
    "uint8": (0, 2**8 - 1),
    "int16": (-(2**15), 2**15 - 1),
    "uint16": (0, 2**16 - 1),
    "int32": (-(2**31), 2**31 - 1),
    "uint32": (0, 2**32 - 1),
    "int64": (-(2**63), 2**63 - 1),
    "uint64": (0, 2**64 - 1),
}
"""The smallest and the largest value of each integer type."""
FLOATS = frozenset({"float32", "float64"})
TEXTS = frozenset({"string", "wstring"})
PRIMITIVES = frozenset({"bool", *INTEGER_RANGES, *FLOATS, *TEXTS})
_ROS1_PRIMITIVES = {
    "time": "builtin_interfaces/Time",
    "duration": "builtin_interfaces/Duration",
}
_SUFFIXES = ("_Request", "_Response", "_Goal", "_Result", "_Feedback")
_SHOWN = 40


class TypeSpellingError(ValueError):
    """A type is spelled wrong; the text says how it should be."""


class ValueSpellingError(ValueError):
    """A value does not fit its type; the text says why."""


class FieldType(NamedTuple):
    """The type of a field or a constant."""

    name: str
    """A primitive type, or the name of an interface."""
    package: str | None = None
    """Of an interface; ``None`` for a primitive type."""
    text_bound: int | None = None
    """The largest length of a ``string`` or ``wstring``."""
    is_array: bool = False
    array_size: int | None = None
    """The number of elements, or the largest one if ``is_upper_bound``; ``None``: any."""
    is_upper_bound: bool = False

    @property
    def is_primitive(self) -> bool:
        """Whether it is not an interface (nor an array of one)."""
        return self.package is None

    @property
    def full_name(self) -> str:
        """The interface, ``package/msg/Name``; the bare name of a primitive type."""
        return self.name if self.package is None else f"{self.package}/msg/{self.name}"

    @property
    def element(self) -> FieldType:
        """The type of the elements of an array; itself if it is none."""
        return self._replace(is_array=False, array_size=None, is_upper_bound=False)

    def __str__(self) -> str:
        text = self.name if self.package is None else f"{self.package}/{self.name}"
        if self.text_bound is not None:
            text += f"<={self.text_bound}"
        if self.is_array:
            size = "" if self.array_size is None else str(self.array_size)
            text += f"[{'<=' if self.is_upper_bound else ''}{size}]"
        return text


# -- names


def is_field_name(name: str) -> bool:
    """Return whether a name is a valid field or package name for rosidl."""
    return re.fullmatch("[a-z](_?[a-z0-9])*", name) is not None


def is_constant_name(name: str) -> bool:
    """Return whether a name is a valid constant name for rosidl."""
    return re.fullmatch("[A-Z](_?[A-Z0-9])*", name) is not None


def is_type_name(name: str) -> bool:
    """Return whether a name is a valid type name for rosidl."""
    name = name.removeprefix("Sample_")
    for suffix in _SUFFIXES:
        name = name.removesuffix(suffix)
    return re.fullmatch("[A-Z][A-Za-z0-9]*", name) is not None


# -- types


@lru_cache(maxsize=512)
def parse_type(text: str, package: str) -> FieldType:
    """Read a type; one without a package belongs to ``package``.

    Raises:
        TypeSpellingError: rosidl rejects it.
    """
    if not text.endswith("]"):
        return _element_type(text, package)
    base, bracket, size_text = text[:-1].rpartition("[")
    if not bracket:
        raise TypeSpellingError(f"{text!r} ends with ']' but has no '['")
    is_upper_bound = size_text.startswith("<=")
    size = _size(size_text.removeprefix("<=")) if size_text else None
    if size_text and not size:
        raise TypeSpellingError(
            f"invalid array size in {text!r}; write a positive integer, as in '[3]', or "
            "'[<=3]' for at most three elements"
        )
    element = _element_type(base, package)
    return element._replace(is_array=True, array_size=size, is_upper_bound=is_upper_bound)


def _element_type(text: str, package: str) -> FieldType:
    if text in PRIMITIVES:
        return FieldType(text)
    if text in _ROS1_PRIMITIVES:
        raise TypeSpellingError(f"{text!r} is a ROS 1 type; write {_ROS1_PRIMITIVES[text]!r}")
    name, bound_sign, bound_text = text.partition("<=")
    if bound_sign and name in TEXTS:
        bound = _size(bound_text)
        if not bound:
            raise TypeSpellingError(
                f"invalid bound in {text!r}; write a positive integer, as in '{name}<=10'"
            )
        return FieldType(name, text_bound=bound)
    if bound_sign:
        raise TypeSpellingError(f"only 'string' and 'wstring' can have a bound, not {name!r}")
    return _interface_type(text, package)


def _interface_type(text: str, package: str) -> FieldType:
    match text.split("/"):
        case [name]:
            own = package
        case [own, name]:
            if not is_field_name(own):
                raise TypeSpellingError(f"{own!r} in {text!r} is not a package name")
        case [own, "msg", name]:
            raise TypeSpellingError(
                f"definitions name this type without 'msg'; write '{own}/{name}'"
            )
        case _:
            raise TypeSpellingError(f"{text!r} is not a type; write 'package/Name'")
    if not is_type_name(name):
        raise TypeSpellingError(
            f"{text!r} is neither a primitive type nor an interface name (a capital letter, "
            "then letters and digits)"
        )
    return FieldType(name, own)


def _size(text: str) -> int:
    """Parse a positive integer; 0 if it is none."""
    try:
        return max(int(text), 0)
    except ValueError:
        return 0


# -- values


def parse_value(type_: FieldType, text: str) -> Value:
    """Read a default or the value of a constant.

    Raises:
        ValueSpellingError: it does not fit the type.
    """
    if not type_.is_primitive:
        raise ValueSpellingError(f"a field of type {str(type_)!r} cannot have a default")
    if not type_.is_array:
        return _scalar(type_, text)
    if not (text.startswith("[") and text.endswith("]")):
        raise ValueSpellingError(f"the array default {_short(text)} is not enclosed in '[ ]'")
    inside = text[1:-1]
    split = _split_texts if type_.name in TEXTS else _split_numbers
    parts = split(inside)
    size = type_.array_size
    if size and (len(parts) > size or (len(parts) < size and not type_.is_upper_bound)):
        most = "at most " if type_.is_upper_bound else ""
        raise ValueSpellingError(
            f"the default has {len(parts)} elements, but {str(type_)!r} has {most}{size}"
        )
    return tuple(_scalar(type_.element, part.strip()) for part in parts)


def _scalar(type_: FieldType, text: str) -> Scalar:
    if type_.name == "bool":
        if text.lower() not in {"true", "false", "1", "0"}:
            raise ValueSpellingError(
                f"{_short(text)} is not a bool; write 'true', 'false', '1' or '0'"
            )
        return text.lower() in {"true", "1"}
    if type_.name in FLOATS:
        try:
            return float(text)
        except ValueError:
            message = f"{_short(text)} is not a number, as {type_.name!r} needs"
            raise ValueSpellingError(message) from None
    if type_.name in INTEGER_RANGES:
        return _integer(type_.name, text)
    return _text(type_, text)


def _integer(type_name: str, text: str) -> int:
    value = None
    for base in (10, 0):
        try:
            value = int(text, base)
            break
        except ValueError:
            continue
    lowest, highest = INTEGER_RANGES[type_name]
    if value is None:
        raise ValueSpellingError(f"{_short(text)} is not an integer, as {type_name!r} needs")
    if not lowest <= value <= highest:
        raise ValueSpellingError(
            f"{_short(text)} is out of range for {type_name!r}: {lowest} to {highest}"
        )
    return value


def _text(type_: FieldType, text: str) -> str:
    for quote in ('"', "'"):
        if text.startswith(quote) and text.endswith(quote):
            text = text[1:-1]
            if re.search(rf"(?<!\\){quote}", text):
                raise ValueSpellingError(
                    f"a {quote} inside of {_short(text)} has no '\\' before it"
                )
            text = text.replace("\\" + quote, quote)
            break
    if type_.text_bound is not None and len(text) > type_.text_bound:
        raise ValueSpellingError(
            f"{_short(text)} has {len(text)} characters, but {str(type_)!r} holds "
            f"{type_.text_bound}"
        )
    return text


def _split_numbers(text: str) -> list[str]:
    return text.split(",") if text else []


def _split_texts(text: str) -> list[str]:
    """Split the elements of a string array like rosidl_adapter."""
    parts: list[str] = []
    while text:
        text = text.lstrip(" ")
        if not text or text[0] == ",":
            raise ValueSpellingError("an element of the default is missing before or after a ','")
        if text[0] in "\"'":
            end = _closing_quote(text)
            parts.append(text[1 : end + 1].replace("\\" + text[0], text[0]))
            text = text[end + 2 :]
        else:
            part, comma, behind = text.partition(",")
            parts.append(part)
            text = comma + behind
        text = text.lstrip(" ").removeprefix(",")
    return parts


def _closing_quote(text: str) -> int:
    """Return the end of a quoted string for rosidl_adapter, as an offset from its opening quote.

    It restarts after an escaped quote and forgets the text before: a string with
    two of them ends too early.
    """
    quote, skipped, rest = text[0], 0, text
    while rest:
        at = rest.find(quote, 1) - 1
        if at < 0:
            break
        if rest[at : at + 2] != "\\" + quote:
            return skipped + at
        rest = rest[at + 2 :]
        skipped = at + 2
    raise ValueSpellingError(f"the quote that {_short(text)} starts with is not closed")


def _short(text: str) -> str:
    return repr(text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "...")
