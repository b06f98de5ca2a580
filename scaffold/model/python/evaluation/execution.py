"""Execution of statements on known values, such as those of a function that builds a list."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import islice
from typing import TYPE_CHECKING, Protocol

from scaffold.model.python.evaluation.values import (
    MAX_LENGTH,
    UNKNOWN,
    Glob,
    binary,
    is_hashable,
    is_known,
)

if TYPE_CHECKING:
    from scaffold.model.python.syntax_tree import SyntaxTree


_UNSUPPORTED = (
    ast.Raise,
    ast.While,
    ast.Try,
    ast.Match,
    ast.Delete,
    ast.AsyncFor,
    ast.AsyncWith,
)
"""Statements after which it is not known what runs; other ones change nothing."""


class LostError(Exception):
    """It is not known which statements run, or what they change."""


class ExhaustedError(Exception):
    """Too many statements were executed for one value."""


class Machine(Protocol):
    """Evaluates expressions, and holds the values of names."""

    module: SyntaxTree

    def evaluate(self, node: ast.expr | None) -> object:
        """Return the value of an expression."""

    def items_of(self, value: object) -> Iterable[object] | None:
        """Return what a loop over a value runs through; ``None`` if unknown."""

    def truth_of(self, value: object) -> bool | None:
        """Return whether a value is true; ``None`` if unknown."""

    def assign(self, name: ast.Name, value: object) -> None:
        """Set the value of a name."""

    def held(self, name: ast.Name) -> object:
        """Return the value that was assigned to a name."""

    def forget(self, value: object) -> None:
        """Make the content of a list or dictionary unknown."""

    def count_step(self) -> None:
        """Count a statement; raises ExhaustedError."""


class Execution:
    """An execution of the statements of one function, or of the module."""

    def __init__(self, machine: Machine) -> None:
        self._machine = machine
        self._yielded: list[object] = []
        self._returned: object = None

    def result_of(self, function: ast.FunctionDef) -> object:
        """Return the value of a call, for a generator a list; raises LostError."""
        self.run(function.body)
        is_generator = any(self._machine.module.below(function, ast.Yield, ast.YieldFrom))
        return self._yielded if is_generator else self._returned

    def run(self, body: Sequence[ast.stmt]) -> ast.stmt | None:
        """Execute a block, and return the statement that left it early."""
        for statement in body:
            self._machine.count_step()
            try:
                left = self._run_one(statement)
            except LostError:
                if self._may_leave(statement):
                    raise
                self.forget_changes(statement)
                continue
            if left is not None:
                return left
        return None

    def _run_one(self, statement: ast.stmt) -> ast.stmt | None:
        match statement:
            case ast.Return(value=value):
                self._returned = self._machine.evaluate(value) if value else None
                return statement
            case ast.Break() | ast.Continue():
                return statement
            case ast.If(test=test, body=body, orelse=orelse):
                truth = self._machine.truth_of(self._machine.evaluate(test))
                if truth is None:
                    raise LostError
                return self.run(body if truth else orelse)
            case ast.For():
                return self._loop(statement)
            case ast.With(items=items, body=body):
                for item in items:
                    if item.optional_vars is not None:
                        self._assign(item.optional_vars, UNKNOWN)
                return self.run(body)
        if isinstance(statement, _UNSUPPORTED):
            raise LostError
        self._run_simple(statement)
        return None

    def _run_simple(self, statement: ast.stmt) -> None:
        machine = self._machine
        match statement:
            case ast.Assign(targets=targets, value=value):
                result = machine.evaluate(value)
                for target in targets:
                    self._assign(target, result)
            case ast.AnnAssign(target=target, value=ast.expr() as value):
                self._assign(target, machine.evaluate(value))
            case ast.AugAssign():
                self._augment(statement)
            case ast.Expr(value=ast.Yield(value=yielded)):
                self._yielded.append(machine.evaluate(yielded) if yielded else None)
            case ast.Expr(value=ast.YieldFrom(value=value)):
                self._yielded.extend(self._items(value))
            case ast.Expr(value=value):
                machine.evaluate(value)

    def _loop(self, loop: ast.For) -> ast.stmt | None:
        for item in self._items(loop.iter):
            self._machine.count_step()
            self._assign(loop.target, item)
            left = self.run(loop.body)
            if isinstance(left, ast.Break):
                return None
            if isinstance(left, ast.Return):
                return left
        return self.run(loop.orelse)

    def _items(self, node: ast.expr) -> Iterable[object]:
        items = self._machine.items_of(self._machine.evaluate(node))
        if items is None:
            raise LostError
        return items

    # -- changes

    def _assign(self, target: ast.expr, value: object) -> None:
        for part, item in unpacked(target, value):
            match part:
                case ast.Name():
                    self._machine.assign(part, item)
                case ast.Subscript():
                    self._set_item(part, item)

    def _set_item(self, target: ast.Subscript, value: object) -> None:
        holder = self._machine.evaluate(target.value)
        key = self._machine.evaluate(target.slice)
        match holder, target.slice:
            case list(), ast.Slice(lower=None, upper=None, step=None):
                holder[:] = value if isinstance(value, list | tuple) else [UNKNOWN]
            case dict(), _ if is_hashable(key) and len(holder) < MAX_LENGTH:
                holder[key] = value
            case list(), _ if isinstance(key, int) and 0 <= key < len(holder):
                holder[key] = value
            case _:
                self._machine.forget(holder)

    def _augment(self, statement: ast.AugAssign) -> None:
        machine, target = self._machine, statement.target
        current, value = machine.evaluate(target), machine.evaluate(statement.value)
        if isinstance(current, list):
            changed(machine, current, "extend", [value])
        else:
            self._assign(target, binary(type(statement.op), current, value))

    def _may_leave(self, statement: ast.stmt) -> bool:
        """Return whether a statement may end the function, or the loop around it."""
        below = self._machine.module.below
        is_loop = isinstance(statement, ast.For | ast.While)
        return any(below(statement, ast.Return, ast.Yield, ast.YieldFrom)) or (
            not is_loop and any(below(statement, ast.Break, ast.Continue))
        )

    def forget_changes(self, node: ast.AST) -> None:
        """Make everything unknown that code may change."""
        for name in self._machine.module.below(node, ast.Name):
            if isinstance(name.ctx, ast.Load):
                self._machine.forget(self._machine.held(name))
            else:
                self._machine.assign(name, UNKNOWN)


def unpacked(target: ast.expr, value: object) -> Iterator[tuple[ast.expr, object]]:
    """Yield the parts of the target of an assignment, with their values."""
    if not isinstance(target, ast.Tuple | ast.List):
        yield target, value
        return
    count = len(target.elts)
    is_paired = isinstance(value, list | tuple) and len(value) == count
    is_paired = is_paired and not any(isinstance(part, ast.Starred) for part in target.elts)
    values: Sequence[object] = [UNKNOWN] * count
    if is_paired and isinstance(value, list | tuple) and Glob not in map(type, value):
        values = value
    for part, item in zip(target.elts, values, strict=True):
        yield from unpacked(part.value if isinstance(part, ast.Starred) else part, item)


def changed(
    machine: Machine,
    holder: list[object] | dict[object, object],
    method: str,
    args: Sequence[object],
) -> object:
    """Call a method that changes a list or dictionary, and return its result."""
    compares = isinstance(holder, list) and method in _COMPARING
    if len(holder) < MAX_LENGTH and (not compares or is_known([*holder, *args])):
        with suppress(ValueError, LookupError, TypeError):
            if not isinstance(holder, list):
                return _OF_DICTIONARIES[method](holder, *args)
            if method not in _ADDING:
                return _OF_LISTS[method](holder, *args)
            items = machine.items_of(*args)
            holder.extend(islice((UNKNOWN,) if items is None else items, MAX_LENGTH))
            return None
    machine.forget(holder)
    return UNKNOWN


def _update(holder: dict[object, object], other: object) -> None:
    if not isinstance(other, dict):
        raise TypeError
    holder.update(other)


def _set_default(holder: dict[object, object], key: object, default: object = None) -> object:
    if not is_hashable(key):
        raise TypeError
    return holder.setdefault(key, default)


_ADDING = frozenset({"extend", "update"})
_COMPARING = frozenset({"add", "discard", "remove", "pop"})
_OF_LISTS: Mapping[str, Callable[..., object]] = {
    "append": list.append,
    "insert": list.insert,
    "remove": list.remove,
    "pop": list.pop,
    "clear": list.clear,
    # The order is of no interest, as with `sorted`.
    "sort": lambda _: None,
    "reverse": lambda _: None,
    # A set is a list here.
    "add": lambda holder, value: None if value in holder else holder.append(value),
    "discard": lambda holder, value: holder.remove(value) if value in holder else None,
}
"""The methods that change a list."""
_OF_DICTIONARIES: Mapping[str, Callable[..., object]] = {
    "setdefault": _set_default,
    "update": _update,
    "clear": dict.clear,
}
