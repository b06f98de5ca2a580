"""Converts values of facts to and from types that marshal can write."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from enum import Enum
from importlib import import_module
from typing import Any

_PLAIN = (str, int, bytes, type(None))


def encode(value: object) -> object:
    """Encode a value for marshal, to be read by ``decode``.

    Values of different types are distinguished, also 1 and 1.0.
    """
    kind = type(value)
    if kind in _PLAIN:
        return value
    if kind in _ENCODERS:
        return _ENCODERS[kind](value)
    if isinstance(value, tuple | Enum):
        values = value if isinstance(value, tuple) else (value.value,)
        if kind not in _names:
            _names[kind] = f"{kind.__module__}:{kind.__qualname__}"
        return (_names[kind], *map(encode, values))
    raise TypeError(f"a fact cannot hold {kind.__name__}")


_names: dict[type, str] = {}
"""Interned names, as marshal writes an object only once."""
_ENCODERS: Mapping[type, Callable[[Any], object]] = {
    tuple: lambda value: ("", *map(encode, value)),
    list: lambda value: ("[", *map(encode, value)),
    dict: lambda value: ("{", *((encode(key), encode(item)) for key, item in value.items())),
    set: lambda value: ("(", frozenset(map(encode, value))),
    frozenset: lambda value: ("(", frozenset(map(encode, value))),
    bool: lambda value: ("bool", repr(value)),
    float: lambda value: ("float", repr(value)),
}


def decode(stored: Any) -> Any:  # noqa: ANN401  of any type
    """Decode a value."""
    if not isinstance(stored, tuple):
        return stored
    kind, *items = stored
    if kind in _DECODERS:
        return _DECODERS[kind](items)
    return _record(kind)(*map(decode, items))


_DECODERS: Mapping[str, Callable[[list[Any]], object]] = {
    "": lambda items: (*map(decode, items),),
    "[": lambda items: [*map(decode, items)],
    "{": lambda items: {decode(key): decode(item) for key, item in items},
    "(": lambda items: frozenset(map(decode, items[0])),
    "bool": lambda items: items[0] == "True",
    "float": lambda items: float(items[0]),
}
_records: dict[str, Callable[..., object]] = {}


def _record(name: str) -> Callable[..., object]:
    if name not in _records:
        module, _, qualified = name.partition(":")
        _records[name] = getattr(sys.modules.get(module) or import_module(module), qualified)
    return _records[name]
