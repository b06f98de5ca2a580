"""Facts: small cached values computed from files, so that dependents need not reparse.

Results that depend on a fact are valid until its value changes, whatever else changes in the files.
Facts about unchanged files come from the cache without parsing.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Hashable, Iterable, Mapping
from enum import Enum
from functools import wraps
from importlib import import_module
from typing import TYPE_CHECKING, Any, Concatenate, ParamSpec, TypeVar

from scaffold.model import reads
from scaffold.model.reads import Reads
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

Words = ParamSpec("Words")
Value = TypeVar("Value")

Key = tuple[Hashable, ...]
"""The provider of a fact and its arguments besides the package."""
FactId = tuple[str, Key]
"""The directory of the package, and the key."""

_PLAIN = (str, int, bytes, type(None))
_UNSET = object()
_FAILED = "!"


class Fact:
    """A value, and what it was made of.

    Args:
        directory: The package.
        key: The provider and its arguments.
        known: The same as an earlier run stored it.
    """

    __slots__ = ("_encoded", "_known", "_value", "directory", "error", "key", "reads")

    def __init__(self, directory: str, key: Key, known: StoredFact | None = None) -> None:
        self.directory = directory
        self.key = key
        self.error: ViewError | None = None
        """Why there is no value."""
        self.reads = Reads()
        self._value: object = _UNSET
        self._known = known
        self._encoded = _UNSET if known is None else known.encoded

    @property
    def id(self) -> FactId:
        """What it is called among the facts of all packages."""
        return self.directory, self.key

    @property
    def value(self) -> object:
        """What the provider returned."""
        if self._value is _UNSET:
            self._value = decode(self._encoded)
        return self._value

    @property
    def encoded(self) -> object:
        """Its value, or why there is none, as ``encode`` returns it: equal for equal values."""
        if self.error is not None:
            return _FAILED, str(self.error)
        if self._encoded is _UNSET:
            self._encoded = encode(self._value)
        return self._encoded

    def stored(self) -> tuple[StoredFact, Iterable[Fact]]:
        """Return what a later run may know of it, and the facts that it was made of."""
        if self._known is not None:
            return self._known, self.reads.facts
        files, facts = self.reads.all()
        return StoredFact(files, tuple(fact.id for fact in facts), self.encoded), facts

    @property
    def is_of_files(self) -> bool:
        """Whether it was made in this run, of nothing but files."""
        return self._known is None and not self.reads.all()[1]

    def make(self, provide: Callable[[], object]) -> None:
        """Ask its provider; what that looks at counts as the fact's own."""
        with reads.recorded(self.reads):
            try:
                self._value = provide()
            except ViewError as error:
                self.error = error


class StoredFact(NamedTuple):
    """A fact as a run remembers it."""

    files: frozenset[str]
    """The files that it was made of, by ``Package.full_path``."""
    facts: tuple[FactId, ...]
    """The facts that it was made of."""
    encoded: Any

    @property
    def has_failed(self) -> bool:
        """Whether there was no value."""
        return isinstance(self.encoded, tuple) and self.encoded[0] == _FAILED


def fact(
    function: Callable[Concatenate[Package, Words], Value],
) -> Callable[Concatenate[Package, Words], Value]:
    """Let a function of a package and words return a fact.

    Its value is made of texts, numbers, enumerations, and collections and records of these;
    it must not be changed. The function may raise ViewError.
    """
    name = f"{function.__module__}:{function.__qualname__}"

    @wraps(function)
    def ask(package: Package, /, *words: Words.args, **named: Words.kwargs) -> Value:
        return package.fact((name, *words), lambda: function(package, *words, **named))

    return ask


def ask_again(package: Package, key: Key) -> None:
    """Ask for a fact by its key; raises ViewError as its provider, LookupError without one."""
    module, _, name = str(key[0]).partition(":")
    provider: Any = sys.modules.get(module) or import_module(module)
    for part in name.split("."):
        provider = getattr(provider, part, None)
    if provider is None:
        raise LookupError(name)
    provider(package, *key[1:])


def encode(value: object) -> object:
    """Return a value as something that marshal can write and ``decode`` reads.

    Values of different types are different here, also 1 and 1.0.
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
"""Each once: marshal writes what is the same object once."""
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
    """Return the value that was encoded."""
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
