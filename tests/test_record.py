"""Our light ``NamedTuple`` behaves like that of typing."""

from __future__ import annotations

import copy
import pickle
import typing
from typing import Any

import pytest

from scaffold import record


class Cheap(record.NamedTuple):
    """A point."""

    x: int
    y: float = 0.5
    """How high."""
    names: tuple[str, ...] = ()

    @property
    def total(self) -> float:
        return self.x + self.y

    @classmethod
    def of(cls, x: int) -> Cheap:
        return cls(x, names=("made",))


class Real(typing.NamedTuple):
    """A point."""

    x: int
    y: float = 0.5
    """How high."""
    names: tuple[str, ...] = ()

    @property
    def total(self) -> float:
        return self.x + self.y

    @classmethod
    def of(cls, x: int) -> Real:
        return cls(x, names=("made",))


Kind = Any
"""Either class; what it has is what the tests are about."""
BOTH = pytest.mark.parametrize("kind", [Cheap, Real])


@BOTH
def test_construction_and_fields(kind: Kind) -> None:
    item = kind(1, y=2.5)
    assert (item.x, item.y, item.names, item.total) == (1, 2.5, (), 3.5)
    assert item == (1, 2.5, ())
    assert kind.of(4) == (4, 0.5, ("made",))
    assert kind(*item) == kind._make(item) == item
    assert kind._fields == kind.__match_args__ == ("x", "y", "names")
    assert kind._field_defaults == {"y": 0.5, "names": ()}
    assert kind.__doc__ == "A point."


@BOTH
def test_invalid_arguments_and_assignments_are_rejected(kind: Kind) -> None:
    for arguments, words in (((), {}), ((1, 2, (), 4), {}), ((1,), {"z": 1}), ((1,), {"x": 1})):
        with pytest.raises(TypeError):
            kind(*arguments, **words)
    with pytest.raises(AttributeError):
        kind(1).x = 2
    with pytest.raises(AttributeError):
        kind(1).z = 2


@BOTH
def test_replace_pickle_copy_and_repr(kind: Kind) -> None:
    item = kind(1, 2.0, ("a",))
    assert item._replace(x=5) == (5, 2.0, ("a",))
    assert item._asdict() == {"x": 1, "y": 2.0, "names": ("a",)}
    for twin in (pickle.loads(pickle.dumps(item)), copy.copy(item), copy.deepcopy(item)):  # noqa: S301
        assert twin == item
        assert type(twin) is kind
    assert repr(item) == f"{kind.__name__}(x=1, y=2.0, names=('a',))"
    assert hash(item) == hash((1, 2.0, ("a",)))


@BOTH
def test_match_patterns(kind: Kind) -> None:
    match kind(1, 2.0):
        case (x, y, _) if isinstance(x, str):
            pytest.fail(f"{y}")
        case kind(x, y):
            assert (x, y) == (1, 2.0)
