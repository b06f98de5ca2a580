"""Removes annotations that may be wrong, for the type checker.

Nothing enforces annotations: ``topic: String`` may be wrong if a str is passed. The replacement has
the same length, so that locations do not change. Parameters of callbacks keep their annotations
unless they are called with other values, because the subscription determines their type.
"""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterator

from scaffold import lazy_re
from scaffold.model.python.conditions.handlers import last_name
from scaffold.model.python.scopes import ScopeIndex
from scaffold.model.python.syntax_tree import MAX_DEPTH
from scaffold.types.rewriting.callbacks import STATUS

_UNKNOWN = "_"
"""A name of unknown type for the type checker."""
_REGISTERING = frozenset(
    {"create_subscription", "create_service", "create_timer", "ActionServer", "partial"}
    | {"add_done_callback", "registerCallback"}
    | {f"add_{when}_set_parameters_callback" for when in ("pre", "on", "post")}
)
"""Functions that take callbacks."""
_ACCEPTING = {bool: {"bool", "int", "float"}, int: {"int", "float"}}
"""The annotations that fit a constant besides its own class."""
_AROUND = {
    # linear: a line has 20 kB at most
    "variable": (lazy_re.compile(r"[ \t]*:[ \t]*$"), lazy_re.compile(r"[ \t]*=")),
    # linear: a line has 20 kB at most here too
    "result": (lazy_re.compile(r"[ \t]*->[ \t]*$"), lazy_re.compile(r"[ \t]*:")),
}
"""The text around an annotation that can be removed as a whole."""


def without_annotations(data: bytes) -> bytes | None:
    """Return a file without annotations; ``None`` if it does not parse."""
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(data).readline)
        text = data.decode(encoding)
        index = ScopeIndex(ast.parse(text))
    except (SyntaxError, ValueError, LookupError, RecursionError, MemoryError):
        return None
    if not index.build(MAX_DEPTH):
        return None
    edits = _Edits(text)
    for kind, annotation in _annotations(index):
        edits.replace(kind, annotation)
    return edits.text().encode(encoding)


def _annotations(index: ScopeIndex) -> Iterator[tuple[str, ast.expr]]:
    """Yield the annotations to replace, each with its owner."""
    handed_over, referred_to = _handed_over(index), _referred_to(index)
    functions: list[ast.FunctionDef | ast.AsyncFunctionDef] = [
        *index.all_of(ast.FunctionDef),
        *index.all_of(ast.AsyncFunctionDef),
    ]
    for function in functions:
        if function.returns is not None:
            yield "result", function.returns
        kept = _never_rebound(function) if function.name in handed_over else set()
        written = _never_rebound(function) if function.name in referred_to else set()
        for argument in _arguments(function.args):
            if argument.annotation is None or argument.arg in kept:
                continue
            is_text = _is_text(argument.annotation)
            if not is_text or (argument.arg not in written and not _is_of_base(argument)):
                yield "parameter", argument.annotation
    for variable in index.all_of(ast.AnnAssign):
        if _has_matching_factory(variable) or _is_set_by_constructor(index, variable):
            continue
        yield "declaration" if variable.value is None else "variable", variable.annotation


def _handed_over(index: ScopeIndex) -> set[str]:
    """Return the names of functions that are passed as arguments: callbacks.

    Those that the file itself calls, or passes to functions such as ``map``, are only included
    if they are passed to rclpy: other arguments may contradict their annotations.
    """
    registered: set[str] = set()
    others: set[str] = set()
    called: set[str] = set()
    for call in index.all_of(ast.Call):
        taker = last_name(call.func)
        called.add(taker)
        is_plain = isinstance(call.func, ast.Name) and taker.islower()
        given = {
            last_name(value) for value in (*call.args, *(word.value for word in call.keywords))
        }
        if taker in _REGISTERING:
            registered |= given
        elif not is_plain:
            others |= given
    return registered | (others - called)


def _referred_to(index: ScopeIndex) -> set[str]:
    """Return the names of functions in tables, lambdas and the like, also as strings.

    These keep annotations in quotes, which is how this tool annotates callbacks.
    """
    callees = {
        id(call.func)
        for call in index.all_of(ast.Call)
        if not isinstance(index.parent(call), ast.Lambda)
    }
    names = {
        node.attr
        for node in index.all_of(ast.Attribute)
        if isinstance(node.ctx, ast.Load) and id(node) not in callees
    }
    plain = {node.id for node in index.all_of(ast.Name)}
    by_name = index.all_of(ast.Constant) if "getattr" in plain else ()
    names |= {node.value for node in by_name if isinstance(node.value, str)}
    return names | {node.id for node in index.all_of(ast.Name) if id(node) not in callees}


def _has_matching_factory(variable: ast.AnnAssign) -> bool:
    """Return whether the default of a dataclass field is created by the annotated class."""
    match variable.value:
        case ast.Call(keywords=[ast.keyword(arg="default_factory", value=factory)]):
            return ast.unparse(factory) == ast.unparse(variable.annotation)
    return False


def _is_set_by_constructor(index: ScopeIndex, variable: ast.AnnAssign) -> bool:
    """Return whether a variable is a field that the constructor of a dataclass or tuple sets."""
    class_ = index.parent(variable)
    if variable.value is not None or not isinstance(class_, ast.ClassDef):
        return False
    decorators = [it.func if isinstance(it, ast.Call) else it for it in class_.decorator_list]
    names = {*map(last_name, decorators), *map(last_name, class_.bases)}
    if names.isdisjoint({"dataclass", "NamedTuple"}):
        return False
    return not any(
        _is_other(value, variable.annotation)
        for value in _constructor_arguments(index, class_, variable)
    )


def _constructor_arguments(
    index: ScopeIndex, class_: ast.ClassDef, field: ast.AnnAssign
) -> Iterator[ast.expr]:
    """Yield the constructor arguments for a field of a class."""
    fields = [line.target for line in class_.body if isinstance(line, ast.AnnAssign)]
    name, position = ast.unparse(field.target), fields.index(field.target)
    for call in index.all_of(ast.Call):
        if last_name(call.func) == class_.name:
            yield from call.args[position : position + 1]
            yield from (keyword.value for keyword in call.keywords if keyword.arg == name)


def _is_other(value: ast.expr, annotation: ast.expr) -> bool:
    """Return whether a constant is not of the annotated class."""
    match value, annotation:
        case ast.Constant(value=constant), ast.Name(id=name) if constant is not None:
            return name not in _ACCEPTING.get(type(constant), {type(constant).__name__})
    return False


def _is_of_base(argument: ast.arg) -> bool:
    """Return whether the base class calls a method with an argument whose type this tool added.

    No code in the file refers to such a method.
    """
    return ast.unparse(argument.annotation or argument).startswith(f"'{STATUS}")


def _is_text(annotation: ast.expr) -> bool:
    return isinstance(annotation, ast.Constant) and isinstance(annotation.value, str)


def _never_rebound(function: ast.FunctionDef | ast.AsyncFunctionDef) -> set[str]:
    """Return the parameters that are never rebound."""
    rebound = {
        node.id
        for node in ast.walk(function)
        if isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store)
    }
    return {argument.arg for argument in _arguments(function.args)} - rebound


def _arguments(arguments: ast.arguments) -> Iterator[ast.arg]:
    yield from (*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs)
    yield from (argument for argument in (arguments.vararg, arguments.kwarg) if argument)


class _Edits:
    """A text with ranges replaced by others of the same length."""

    def __init__(self, text: str) -> None:
        self._text = text
        self._starts = [0, *(match.end() for match in re.finditer(r"\r\n|\r|\n", text))]
        self._parts: list[tuple[int, int, str]] = []

    def replace(self, kind: str, annotation: ast.expr) -> None:
        """Replace an annotation."""
        start = self._offset(annotation.lineno, annotation.col_offset)
        end = self._offset(
            annotation.end_lineno or annotation.lineno, annotation.end_col_offset or 0
        )
        old = self._text[start:end]
        if kind in _AROUND:
            before, after = _AROUND[kind]
            line = self._text[self._starts[annotation.lineno - 1] : start]
            prefix = before.search(line)
            if prefix is not None and after.match(self._text, end) and "\n" not in old:
                self._parts.append((start - len(prefix[0]), end, " " * (len(prefix[0]) + len(old))))
                return
        spaces = re.sub(r"[^\r\n]", " ", old)
        is_long = "\n" in old or "\r" in old
        self._parts.append(
            (start, end, f"({_UNKNOWN}{spaces[2:-1]})" if is_long else f"{_UNKNOWN}{spaces[1:]}")
        )

    def text(self) -> str:
        """Return the text."""
        result: list[str] = []
        at = 0
        for start, end, new in sorted(self._parts):
            if start >= at:  # otherwise nested in another one
                result += self._text[at:start], new
                at = end
        return "".join([*result, self._text[at:]])

    def _offset(self, line: int, column: int) -> int:
        start = self._starts[line - 1]
        stop = self._starts[line] if line < len(self._starts) else len(self._text)
        return start + len(self._text[start:stop].encode()[:column].decode(errors="ignore"))
