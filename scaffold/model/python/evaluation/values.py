"""The results of Python operations on known values."""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from enum import Enum
from itertools import islice
from typing import Any, Final


class Unknown(Enum):
    """The type of UNKNOWN."""

    UNKNOWN = "unknown"

    def __bool__(self) -> bool:
        return False

    def __repr__(self) -> str:
        return "UNKNOWN"

    __str__ = __repr__


UNKNOWN: Final = Unknown.UNKNOWN
"""An unknown value. Compare with ``is``; it is falsy."""


class Glob:
    """A placeholder in a list for the paths that match a pattern."""

    __slots__ = ("filtered", "is_path", "pattern", "recursive")

    def __init__(
        self,
        pattern: str,
        *,
        recursive: bool = False,
        filtered: bool = False,
        is_path: bool = False,
    ) -> None:
        self.pattern = pattern
        self.recursive = recursive
        """Whether ``**`` matches any directories."""
        self.filtered = filtered
        """Whether a condition selects some of the paths."""
        self.is_path = is_path
        """Whether they are objects of pathlib."""

    def as_text(self) -> Glob:
        """Return a placeholder for the same paths as strings."""
        return Glob(self.pattern, recursive=self.recursive, filtered=self.filtered)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Glob) and repr(self) == repr(other)

    def __hash__(self) -> int:
        return hash(repr(self))

    def __repr__(self) -> str:
        return f"Glob({self.pattern!r}, recursive={self.recursive}, filtered={self.filtered})"


class PathValue:
    """A ``pathlib.Path``."""

    __slots__ = ("text",)

    def __init__(self, text: str) -> None:
        self.text = text

    def __eq__(self, other: object) -> bool:
        return isinstance(other, PathValue) and self.text == other.text

    def __hash__(self) -> int:
        return hash(self.text)

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        return f"PathValue({self.text!r})"


class Lazy:
    """Items that are made while a loop runs, which may change what follows: ``os.walk``."""

    __slots__ = ("_make",)

    def __init__(self, make: Callable[[], Iterator[object]]) -> None:
        self._make = make

    def __iter__(self) -> Iterator[object]:
        return self._make()


MAX_LENGTH = 20_000
"""The maximum number of characters or items; longer values are unknown."""
MAX_NUMBER = 10**18

_SIMPLE_PERCENT = r"(?:[^%]|%[sdifrg%]|%0?\d{0,2}d|%\.\d{1,2}f|%\(\w+\)[sdifr])*"
_SIMPLE_FORMAT = (
    r"(?:[^{}]|\{\{|\}\}|\{\w*(?:![rsa])?(?::[<>^+ ]?0?\d{0,2}(?:\.\d{1,2})?[sdfg]?)?\})*"
)

_ARITHMETIC: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
}
COMPARISONS: Mapping[type[ast.cmpop], Callable[[Any, Any], bool]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
    ast.In: lambda left, right: left in right,
    ast.NotIn: lambda left, right: left not in right,
}
"""They may raise TypeError."""
_TEXT_METHODS: Mapping[str, Callable[..., object]] = {
    "startswith": str.startswith,
    "endswith": str.endswith,
    "lower": str.lower,
    "upper": str.upper,
    "title": str.title,
    "capitalize": str.capitalize,
    "strip": str.strip,
    "lstrip": str.lstrip,
    "rstrip": str.rstrip,
    "replace": str.replace,
    "removeprefix": str.removeprefix,
    "removesuffix": str.removesuffix,
}
NAMED_VALUES: Mapping[str, object] = {
    "math.pi": math.pi,
    "math.tau": math.tau,
    "math.inf": math.inf,
    "os.sep": "/",
    "os.path.sep": "/",
    "os.pardir": "..",
    "os.curdir": ".",
}


def is_none_literal(node: ast.AST | None) -> bool:
    """Return whether an expression is ``None``, as written."""
    return isinstance(node, ast.Constant) and node.value is None


def is_known(value: object) -> bool:
    """Return whether a value and everything in it is known."""
    if value is UNKNOWN or isinstance(value, Glob):
        return False
    if isinstance(value, list | tuple | set):
        return all(map(is_known, value))
    if isinstance(value, dict):
        return all(is_known(item) for item in value.values())
    return True


def is_hashable(value: object) -> bool:
    """Return whether a value is a known key of a dictionary."""
    return isinstance(value, str | int | float | PathValue)


def copied(value: object) -> object:
    """Return a copy of a value, whose lists and dictionaries can be changed."""
    if isinstance(value, list):
        return [copied(item) for item in value]
    if isinstance(value, tuple):
        return tuple(copied(item) for item in value)
    if isinstance(value, dict):
        return {key: copied(item) for key, item in value.items()}
    return value


def kind_of(value: object) -> str:
    """Describe the type of a value: ``a str``, ``an int``, ``None``."""
    name = type(value).__name__
    return "None" if value is None else f"{'an' if name[0] in 'aeiou' else 'a'} {name}"


def same(first: object, second: object) -> bool:
    """Return whether two values are equal and of the same type: 1 and True are not."""
    return type(first) is type(second) and first == second


def held_small(value: object) -> object:
    """Return a value unless it is too large to keep."""
    if isinstance(value, str | bytes | list | tuple | dict) and len(value) > MAX_LENGTH:
        return UNKNOWN
    if type(value) is int and abs(value) > MAX_NUMBER:
        return UNKNOWN
    return value


def binary(kind: type[ast.operator], left: object, right: object) -> object:
    """Return the value of a binary operation, if certain."""
    if isinstance(left, int | float) and isinstance(right, int | float):
        return _arithmetic(kind, left, right)
    if kind is ast.Mod and isinstance(left, str):
        return _percent(left, right)
    if kind is ast.Div and (isinstance(left, PathValue) or isinstance(right, PathValue)):
        return _path((left, right), {})
    if kind is ast.Add:
        return _concatenated(left, right)
    if kind is ast.Mult and isinstance(left, str | list) and type(right) is int:
        return left * right if len(left) * max(right, 0) <= MAX_LENGTH else UNKNOWN
    return UNKNOWN


def _concatenated(left: object, right: object) -> object:
    if isinstance(left, str) and isinstance(right, str):
        return left + right
    if isinstance(left, list) and isinstance(right, list):
        return left + right
    if isinstance(left, tuple) and isinstance(right, tuple):
        return left + right
    return UNKNOWN


def _arithmetic(kind: type[ast.operator], left: float, right: float) -> object:
    function = _ARITHMETIC.get(kind)
    if function is None:
        return UNKNOWN
    try:
        return function(left, right)
    except (ZeroDivisionError, OverflowError):
        return UNKNOWN


def _percent(form: str, values: object) -> object:
    if not is_known(values) or not re.fullmatch(_SIMPLE_PERCENT, form):
        return UNKNOWN
    try:
        return form % values
    except (TypeError, ValueError, KeyError, OverflowError):
        return UNKNOWN


def format_text(form: str, args: Sequence[object], keywords: Mapping[str, object]) -> str | None:
    """Return ``form.format(...)`` if it has only plain fields and printable values."""
    if not re.fullmatch(_SIMPLE_FORMAT, form) or not all(
        map(_is_printable, (*args, *keywords.values()))
    ):
        return None
    try:
        return form.format(*args, **keywords)
    except (LookupError, ValueError, TypeError, OverflowError):
        return None


def _is_printable(value: object) -> bool:
    return isinstance(value, str | int | float | PathValue)


def join_paths(parts: Sequence[str]) -> str:
    """Join paths like os.path.join on POSIX."""
    path = parts[0]
    for part in parts[1:]:
        if part.startswith("/"):
            path = part
        else:
            path = path + part if not path or path.endswith("/") else f"{path}/{part}"
    return path


def text_method(
    text: str, method: str, args: Sequence[object], keywords: Mapping[str, object]
) -> object:
    """Return the result of a string method."""
    if method == "format":
        formatted = format_text(text, args, keywords)
        return UNKNOWN if formatted is None else formatted
    if method == "join" and len(args) == 1 and isinstance(args[0], list | tuple):
        parts = [part for part in args[0] if isinstance(part, str)]
        return text.join(parts) if len(parts) == len(args[0]) else UNKNOWN
    if method == "split" and all(isinstance(arg, str) for arg in args) and not keywords:
        separator = str(args[0]) if args else None
        return UNKNOWN if separator == "" or args[1:] else text.split(separator)
    function = _TEXT_METHODS.get(method)
    if function is None or keywords or not all(isinstance(arg, str | tuple) for arg in args):
        return UNKNOWN
    try:
        return function(text, *args)
    except TypeError:
        return UNKNOWN


def path_method(
    path: PathValue | Glob, method: str, args: Sequence[object], keywords: Mapping[str, object]
) -> object:
    """Return the result of a path method; globs pass through."""
    if method in {"as_posix", "__str__"} and not args:
        return path.as_text() if isinstance(path, Glob) else path.text
    if isinstance(path, PathValue) and not keywords and all(isinstance(arg, str) for arg in args):
        texts = [str(arg) for arg in args]
        if method == "joinpath":
            return PathValue(join_paths([path.text, *texts]))
        if method == "glob" and len(texts) == 1:
            return [Glob(join_paths([path.text, texts[0]]), recursive=True, is_path=True)]
        if method == "rglob" and len(texts) == 1:
            pattern = join_paths([path.text, "**", texts[0]])
            return [Glob(pattern, recursive=True, is_path=True)]
    return UNKNOWN


def _glob(args: Sequence[object], keywords: Mapping[str, object]) -> object:
    recursive = keywords.get("recursive", False)
    pattern = args[0] if args else keywords.get("pathname")
    if isinstance(pattern, PathValue):
        pattern = pattern.text
    if not isinstance(pattern, str) or not set(keywords) <= {"recursive", "pathname"}:
        return UNKNOWN
    return UNKNOWN if recursive is UNKNOWN else [Glob(pattern, recursive=bool(recursive))]


def _path(args: Sequence[object], keywords: Mapping[str, object]) -> object:
    texts = [arg.text if isinstance(arg, PathValue) else arg for arg in args]
    strings = [text for text in texts if isinstance(text, str)]
    if keywords or len(strings) != len(texts):
        return UNKNOWN
    return PathValue(join_paths(strings) if strings else ".")


def _converted(args: Sequence[object], keywords: Mapping[str, object], kind: type) -> object:
    if keywords or len(args) > 1 or not all(map(is_known, args)):
        pattern = args[0] if kind is str and args else UNKNOWN
        return pattern.as_text() if isinstance(pattern, Glob) else UNKNOWN
    value = args[0] if args else kind()
    if kind is str and isinstance(value, PathValue):
        return value.text
    if not isinstance(value, str | int | float):
        return UNKNOWN
    try:
        return kind(value)
    except (ValueError, OverflowError):
        return UNKNOWN


def _list_result(args: Sequence[object], keywords: Mapping[str, object]) -> object:
    """``list``, ``tuple``, ``sorted`` and ``set`` are treated alike."""
    del keywords
    values = args[0] if args else []
    if not isinstance(values, list | tuple | dict | Lazy):
        return UNKNOWN
    return list(islice(values, MAX_LENGTH))


def _set(args: Sequence[object], keywords: Mapping[str, object]) -> object:
    values = _list_result(args, keywords)
    if not isinstance(values, list) or not all(map(is_hashable, values)):
        return UNKNOWN
    return [*dict.fromkeys(values)]


def _pairs(args: Sequence[object], keywords: Mapping[str, object]) -> object:
    """``zip``, if the number of items is known."""
    if keywords or not all(isinstance(arg, list | tuple) and is_countable(arg) for arg in args):
        return UNKNOWN
    return list(zip(*args, strict=False))


def _numbered(args: Sequence[object], keywords: Mapping[str, object]) -> object:
    values, start = args[0] if args else UNKNOWN, [*args[1:], *keywords.values()]
    if not isinstance(values, list | tuple) or not is_countable(values) or start:
        return UNKNOWN
    return [*enumerate(values)]


def _range(args: Sequence[object], keywords: Mapping[str, object]) -> object:
    numbers = [arg for arg in args if type(arg) is int]
    if keywords or not 0 < len(numbers) == len(args) <= len(("start", "stop", "step")):
        return UNKNOWN
    if len(numbers) > len(("start", "stop")) and numbers[-1] == 0:
        return UNKNOWN
    return [*islice(range(*numbers), MAX_LENGTH + 1)]


def _sum(args: Sequence[object], keywords: Mapping[str, object]) -> object:
    """``sum(lists, [])``."""
    values = args[0] if args else UNKNOWN
    if keywords or list(args[1:]) != [[]] or not isinstance(values, list | tuple):
        return UNKNOWN
    lists = [item for item in values if isinstance(item, list)]
    return [item for part in lists for item in part] if len(lists) == len(values) else UNKNOWN


def _chained(args: Sequence[object], keywords: Mapping[str, object]) -> object:
    """``itertools.chain(...)``."""
    lists = [item for item in args if isinstance(item, list | tuple)]
    if keywords or len(lists) < len(args):
        return UNKNOWN
    return [item for part in lists for item in part]


def is_countable(values: Sequence[object]) -> bool:
    """Return whether the number of items is known: none stands for several paths."""
    return not any(isinstance(item, Glob) for item in values)


def _length(args: Sequence[object], keywords: Mapping[str, object]) -> object:
    del keywords
    values = args[0] if args else UNKNOWN
    if isinstance(values, str | list | tuple | dict) and is_known(values):
        return len(values)
    return UNKNOWN


def _numeric(args: Sequence[object], function: Callable[..., object]) -> object:
    numbers = [arg for arg in args if isinstance(arg, int | float)]
    if not numbers or len(numbers) != len(args):
        return UNKNOWN
    try:
        return function(*numbers)
    except (TypeError, ValueError, OverflowError):
        return UNKNOWN


_Function = Callable[[Sequence[object], Mapping[str, object]], object]
FUNCTIONS: Mapping[str, _Function] = {
    "glob.glob": _glob,
    "glob.iglob": _glob,
    "pathlib.Path": _path,
    "pathlib.PurePath": _path,
    "str": lambda args, keywords: _converted(args, keywords, str),
    "int": lambda args, keywords: _converted(args, keywords, int),
    "float": lambda args, keywords: _converted(args, keywords, float),
    "bool": lambda args, keywords: _converted(args, keywords, bool),
    "list": _list_result,
    "tuple": _list_result,
    "sorted": _list_result,
    "set": _set,
    "zip": _pairs,
    "enumerate": _numbered,
    "range": _range,
    "sum": _sum,
    "itertools.chain": _chained,
    "itertools.chain.from_iterable": lambda args, keywords: _sum((*args, []), keywords),
    "len": _length,
    "abs": lambda args, _: _numeric(args, abs),
    "round": lambda args, _: _numeric(args, round),
    "max": lambda args, _: _numeric(args, max) if len(args) > 1 else UNKNOWN,
    "min": lambda args, _: _numeric(args, min) if len(args) > 1 else UNKNOWN,
    "math.radians": lambda args, _: _numeric(args, math.radians),
}
