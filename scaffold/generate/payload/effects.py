"""The fields that statements set, for the assertions of generated tests."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator

from scaffold.record import NamedTuple

_CHANGING = frozenset({"count", "get_clock", "uuid4"})
"""Expressions with a new value each time: attributes of the node, and a function."""
_FRAME = "frame_id"
_FILLED_BY = {"create_cloud_xyz32": ("data",)}
"""Fields that library functions fill in the message that they return, by argument."""


class Effects(NamedTuple):
    """The fields that statements fill, each once, by path such as ``header.stamp``."""

    constant: tuple[tuple[str, str], ...] = ()
    """Fields with a constant value, with that value as code."""
    changing: tuple[str, ...] = ()
    """Fields that differ from one message to the next."""
    filled: tuple[str, ...] = ()
    """Other fields with a value other than the default."""
    frames: tuple[str, ...] = ()
    """Fields with the frame of the node's parameter."""


def of_statements(statements: Iterable[str], target: str) -> Effects:
    """Return the effects of statements on the fields of a variable."""
    walk = _Walk(target)
    walk.body(ast.parse("\n".join(statements)).body)
    paths = dict.fromkeys(walk.order)
    others = {*walk.constant, *walk.changing, *walk.frames}
    return Effects(
        tuple((path, walk.constant[path]) for path in paths if path in walk.constant),
        tuple(path for path in paths if path in walk.changing),
        tuple(path for path in paths if path in walk.filled - others),
        tuple(path for path in paths if path in walk.frames),
    )


class _Walk:
    """Tracks the effects of statements."""

    def __init__(self, target: str) -> None:
        self._target = target
        self._changing_names: set[str] = set()
        self.order: list[str] = []
        self.constant: dict[str, str] = {}
        self.changing: set[str] = set()
        self.filled: set[str] = set()
        self.frames: set[str] = set()

    def body(self, statements: Iterable[ast.stmt], *, inside: bool = False) -> None:
        """Track statements; those in a loop or a condition have no constant effect."""
        for statement in statements:
            match statement:
                case ast.Assign(targets=[target], value=value):
                    self._assign(target, value, inside=inside)
                case ast.AugAssign(target=target, value=value):
                    self._assign(target, value, inside=True)
                case ast.Expr(value=ast.Call(func=ast.Attribute(value=owner), args=[value, *_])):
                    self._assign(owner, value, inside=True)
                case ast.For(iter=values, body=body, target=target):
                    if self._is_changing(values):
                        self._changing_names |= set(_names(target))
                    self.body(body, inside=True)
                case ast.If(test=test, body=body, orelse=orelse):
                    if self._is_changing(test):
                        self._mark_changing([*body, *orelse])
                    self.body([*body, *orelse], inside=True)

    def _mark_changing(self, statements: Iterable[ast.stmt]) -> None:
        """Mark the fields assigned by statements as changing."""
        for statement in statements:
            if isinstance(statement, ast.Assign):
                path = self._path(statement.targets[0])
                if path:
                    self.order.append(path)
                    self.changing.add(path)

    def _assign(self, target: ast.expr, value: ast.expr, *, inside: bool) -> None:
        is_changing = self._is_changing(value)
        path = self._path(target)
        if isinstance(target, ast.Name) and target.id == self._target:
            self._replace(value)
            return
        if not path:
            if is_changing:
                self._changing_names |= set(_names(target))
            return
        self.order.append(path)
        is_whole = isinstance(target, ast.Attribute) and not inside
        if is_changing:
            self.changing.add(path)
            self.constant.pop(path, None)
        elif _is_frame(value) and is_whole:
            self.frames.add(path)
        elif is_whole and path not in self.changing and _is_literal(value):
            self.constant[path] = ast.unparse(value)
        else:
            self.constant.pop(path, None)
            if _differs(value):
                self.filled.add(path)

    def _replace(self, value: ast.expr) -> None:
        """Record the fields that a library function fills in the message that it returns."""
        match value:
            case ast.Call(func=ast.Name(id=name)):
                fields = _FILLED_BY.get(name, ())
                self.order.extend(fields)
                (self.changing if self._is_changing(value) else self.filled).update(fields)

    def _path(self, node: ast.expr) -> str:
        """Return the path of a field of the target; empty for other expressions."""
        names: list[str] = []
        while not isinstance(node, ast.Name):
            if isinstance(node, ast.Attribute):
                names.append(node.attr)
                node = node.value
            elif isinstance(node, ast.Subscript):
                names.clear()
                node = node.value
            else:
                return ""
        return ".".join(reversed(names)) if node.id == self._target else ""

    def _is_changing(self, node: ast.expr) -> bool:
        for inner in ast.walk(node):
            if isinstance(inner, ast.Attribute):
                path = self._path(inner)
                if inner.attr in _CHANGING or any(
                    path == field or path.startswith(f"{field}.") for field in self.changing
                ):
                    return True
            if isinstance(inner, ast.Name) and inner.id in self._changing_names | _CHANGING:
                return True
        return False


def _names(target: ast.expr) -> Iterator[str]:
    """Yield the names that an assignment binds or whose objects it changes."""
    for node in ast.walk(target):
        if isinstance(node, ast.Name):
            yield node.id


def _is_frame(value: ast.expr) -> bool:
    return isinstance(value, ast.Attribute) and value.attr == _FRAME


def _differs(value: ast.expr) -> bool:
    """Return whether a value is certainly no default of its field; that of a constant may be."""
    return not isinstance(value, ast.Attribute) and any(
        bool(node.value) if isinstance(node, ast.Constant) else isinstance(node, ast.Name)
        for node in ast.walk(value)
    )


def _is_literal(value: ast.expr) -> bool:
    """Return whether a value is a number, a text or a flag that is not the default of its field."""
    try:
        literal = ast.literal_eval(value)
    except ValueError:
        return False
    return isinstance(literal, bool | int | float | str) and bool(literal)
