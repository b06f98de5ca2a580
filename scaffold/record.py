"""A cheaper ``NamedTuple``: to type checkers it is the one of typing.

``typing.NamedTuple`` compiles the annotations and a constructor for each class: 0.15 ms, and
`check` imports more than a hundred classes. Here, one constructor is compiled for each number of
fields, and each class gets a copy with its own field names.
"""

from __future__ import annotations

TYPE_CHECKING = False  # likewise: typing itself is slow to import
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from types import FunctionType
    from typing import Any, NamedTuple


class _Record(tuple):  # type: ignore[type-arg]  # what is in it, each class says
    """The common base class of all records."""

    __slots__ = ()
    _fields: tuple[str, ...]

    @classmethod
    def _make(cls, values: Iterable[Any]) -> _Record:
        return cls(*values)

    def _replace(self, **changes: Any) -> _Record:  # noqa: ANN401  the fields are of any type
        values = [*map(changes.pop, self._fields, self)]
        if changes:
            raise TypeError(f"no field is called {' or '.join(changes)}")
        return type(self)(*values)

    def _asdict(self) -> dict[str, Any]:
        return dict(zip(self._fields, self, strict=True))

    def __repr__(self) -> str:
        fields = ", ".join(f"{name}={value!r}" for name, value in self._asdict().items())
        return f"{type(self).__name__}({fields})"

    def __getnewargs__(self) -> tuple[Any, ...]:
        return tuple(self)


class _Definition(type):
    """Creates a plain class from the body of a class statement."""

    def __new__(cls, name: str, _: tuple[type, ...], namespace: dict[str, Any]) -> Any:  # noqa: ANN401  of another class
        from _collections import _tuplegetter  # type: ignore[import-not-found]  # as namedtuple does

        fields = tuple(namespace["__annotations__"])
        defaults = {field: namespace[field] for field in fields if field in namespace}
        made = {
            "__new__": _constructor(fields, tuple(defaults.values())),
            **namespace,
            **{field: _tuplegetter(at, None) for at, field in enumerate(fields)},
            "__slots__": (),
            "__match_args__": fields,
            "_fields": fields,
            "_field_defaults": defaults,
        }
        return type(name, (_Record,), made)


_constructors: dict[int, FunctionType] = {}
"""The constructors by number of fields."""


def _constructor(fields: tuple[str, ...], defaults: tuple[Any, ...]) -> Callable[..., Any]:
    count = len(fields)
    if count not in _constructors:
        names = ", ".join(f"_{at}" for at in range(count))
        source = f"lambda _cls, {names}: _new(_cls, ({names},))"
        _constructors[count] = eval(source, {"_new": tuple.__new__})  # noqa: S307  own text
    model = _constructors[count]
    code = model.__code__.replace(co_varnames=("_cls", *fields), co_name="__new__")
    return type(model)(code, model.__globals__, "__new__", defaults)


if not TYPE_CHECKING:
    NamedTuple = type.__new__(_Definition, "NamedTuple", (), {})

__all__ = ["NamedTuple"]
