"""Results that are computed once for a package, or a file with rclpy code, until files change."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import wraps
from typing import Concatenate, ParamSpec, TypeVar

from scaffold.suggestions import Memory

Words = ParamSpec("Words")
Value = TypeVar("Value")
Store = TypeVar("Store", bound=Memory)


def remembered(
    function: Callable[Concatenate[Store, Words], Value],
) -> Callable[Concatenate[Store, Words], Value]:
    """Decorate a function of a store and hashable arguments to call it once; see ``remember``."""

    @wraps(function)
    def ask(store: Store, /, *words: Words.args, **named: Words.kwargs) -> Value:
        key = (function, *words, *named.items())
        return store.remember(key, lambda: function(store, *words, **named))

    return ask


def remembered_list(
    function: Callable[Concatenate[Store, Words], Iterator[Value]],
) -> Callable[Concatenate[Store, Words], list[Value]]:
    """Decorate a generator in the same way; the result must not be changed."""

    @remembered
    @wraps(function)
    def items(store: Store, /, *words: Words.args, **named: Words.kwargs) -> list[Value]:
        return [*function(store, *words, **named)]

    return items
