"""Vectors and quaternions that are copied part by part, one part from a wrong place or not."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api.catalog import ROS_PACKAGES
from scaffold.api.messages import MessageTypes

Flaw = tuple[ast.expr, str]
"""The place and the problem."""
_QUATERNION = "geometry_msgs/msg/Quaternion"
_PARTS: Mapping[str, str] = {
    **{f"geometry_msgs/msg/{name}": "xyz" for name in ("Point", "Point32", "Vector3")},
    _QUATERNION: "xyzw",
}
_SHOWN = "visualization_msgs"
_UNIFORM = frozenset({"scale", "dimensions", "size"})
"""Fields that may use one component of another vector for several components."""
_DIRECTIONS = 3
_Parts = dict[str, ast.expr]
"""The values of the parts of a vector, by their letters."""


def flaws(types: MessageTypes) -> Iterator[Flaw]:
    """Yield components copied from one of another letter, and quaternions without w."""
    for holder, owner, parts in _vectors(types):
        if types.module.text(holder).rpartition(".")[2] not in _UNIFORM:
            yield from _taken_twice(types, parts, _PARTS[owner])
        if owner == _QUATERNION:
            yield from _without_w(types, parts)


def zero_quaternions(types: MessageTypes) -> Iterator[tuple[ast.expr, bool]]:
    """Yield the w of quaternions of zeros, and whether they are certainly used as rotations.

    Not in markers, which RViz shows anyway, nor in messages of packages outside of ROS.
    """
    for holder, owner, parts in _vectors(types):
        if owner == _QUATERNION and _is_zero(types, parts):
            message = types.type_of(_message_of(holder))
            name = message.name if message is not None else ""
            package = name.partition("/")[0]
            yield parts["w"], package != _SHOWN and (not name or package in ROS_PACKAGES)


def _vectors(types: MessageTypes) -> Iterator[tuple[ast.expr, str, _Parts]]:
    """Yield vectors that are set part by part, each part once, with their types."""
    groups: dict[tuple[ast.AST | None, str, str], _Parts] = {}
    holders: dict[tuple[ast.AST | None, str, str], ast.expr] = {}
    written: set[tuple[ast.AST | None, str, str]] = set()
    for item in types.assigned:
        letters = _PARTS.get(item.owner.name, "")
        if item.field.name in letters:
            at = item.holder if isinstance(item.holder, ast.Call) else None
            function = types.module.enclosing_function(item.holder)
            place: ast.AST | None = at or function
            key = (place, types.module.text(item.holder), item.owner.name)
            if item.field.name in groups.get(key, {}):
                written.add(key)
            groups.setdefault(key, {})[item.field.name] = item.value
            holders.setdefault(key, item.holder)
    for key, parts in groups.items():
        if key not in written:
            yield holders[key], key[2], parts


def _message_of(field: ast.expr) -> ast.expr:
    """Return the message that a nested field is in: ``pose`` of ``pose.position.x``."""
    while isinstance(field, ast.Attribute) and not _is_attribute_of_self(field):
        field = field.value
    return field


def _is_attribute_of_self(node: ast.Attribute) -> bool:
    return isinstance(node.value, ast.Name) and node.value.id == "self"


def _source(types: MessageTypes, value: ast.expr, letters: str) -> tuple[str, str]:
    """Return the vector, as text, and the letter of the component that a value is."""
    match value:
        case ast.Call(func=ast.Name(id="float"), args=[inner]):
            return _source(types, inner, letters)
        case ast.Attribute(attr=letter, value=vector) if letter in letters:
            return types.module.text(vector), letter
        case ast.Subscript(value=vector, slice=ast.Constant(value=int(index))) if 0 <= index < len(
            letters
        ) and not isinstance(index, bool):
            return types.module.text(vector), letters[index]
    return "", ""


def _taken_twice(types: MessageTypes, parts: _Parts, letters: str) -> Iterator[Flaw]:
    """Find ``a.x = b.x; a.y = b.y; a.z = b.y``."""
    sources = {letter: _source(types, value, letters) for letter, value in parts.items()}
    taken = [letter for _, letter in sources.values()]
    if len(parts) != len(letters) or len({vector for vector, _ in sources.values()}) != 1:
        return
    if not all(taken) or len(set(taken)) == len(letters):
        return
    wrong = [letter for letter, (_, other) in sources.items() if letter != other]
    if len(wrong) == 1 or (letters == "xyzw" and len(set(taken)) == 1):
        _, other = sources[wrong[0]]
        text = types.module.text(parts[wrong[0]])
        yield parts[wrong[0]], f"{wrong[0]} is copied from {text}, which is for {other}"


def _without_w(types: MessageTypes, parts: _Parts) -> Iterator[Flaw]:
    """Find ``q.z = math.sin(yaw / 2)`` without ``q.w``, which is 1.0 then."""
    place = types.module.enclosing_function(next(iter(parts.values())))
    if "w" in parts or place is None:
        return
    if any(isinstance(node.ctx, ast.Store) for node in types.module.index.attributes("w")):
        return  # possibly of this one, under another name
    for letter, value in parts.items():
        is_sine = isinstance(value, ast.Call) and (
            types.module.qualified_name(value.func) in {"math.sin", "numpy.sin"}
        )
        is_copied = _source(types, value, "xyzw")[1] == letter and len(parts) == _DIRECTIONS
        if is_sine or is_copied:
            yield (
                value,
                ("w of this quaternion is still 1.0, which is another rotation; set it as well"),
            )
            return


def _is_zero(types: MessageTypes, parts: _Parts) -> bool:
    """Find ``q.w = 0.0`` where the other parts are zero as well; an IMU may have no orientation."""
    values = [types.file.evaluator.evaluate(value) for value in parts.values()]
    is_zero = all(value == 0 and isinstance(value, int | float) for value in values)
    return "w" in parts and is_zero and not types.module.mentions("orientation_covariance")
