"""The use of tf2 in code: buffers, listeners and lookups."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.rclpy.file import RclpyFile

_SIGNATURES: Mapping[str, tuple[str, ...]] = {
    "lookup_transform": ("target_frame", "source_frame", "time", "timeout"),
    "lookup_transform_async": ("target_frame", "source_frame", "time"),
    "can_transform": ("target_frame", "source_frame", "time", "timeout"),
    "transform": ("object_stamped", "target_frame", "timeout", "new_type"),
}
_BUFFERS = frozenset({"tf2_ros.Buffer", "tf2_ros.buffer.Buffer"})
CONVERSIONS = frozenset({"tf2_geometry_msgs", "tf2_sensor_msgs", "tf2_kdl", "tf2_bullet", "tf2_2d"})
"""The modules that register conversions of messages for tf2 buffers on import."""


class Lookup(NamedTuple):
    """A lookup in a tf2 buffer."""

    method: str
    call: ast.Call
    buffer: ast.expr
    arguments: Mapping[str, ast.expr]
    """The arguments by parameter."""


def lookups_in(file: RclpyFile) -> Iterator[Lookup]:
    """Yield the calls of lookup methods of tf2 buffers, by method."""
    if not file.module.mentions("tf2_ros"):
        return
    for method, names in _SIGNATURES.items():
        for call, func in file.module.method_calls(method):
            if file.callback(func).function is not None or any(
                isinstance(arg, ast.Starred) for arg in call.args
            ):
                continue
            if method == "transform" and buffer_made(file, func.value) is None:
                continue  # methods of many libraries
            arguments = dict(zip(names, call.args, strict=False))
            arguments |= {word.arg: word.value for word in call.keywords if word.arg}
            yield Lookup(method, call, func.value, arguments)


def buffer_made(file: RclpyFile, node: ast.expr) -> ast.Call | None:
    """Return the call that creates the tf2 buffer of an expression."""
    made = file.evaluator.single_value(node)
    if isinstance(made, ast.Call) and not _BUFFERS.isdisjoint(
        file.module.qualified_names(made.func)
    ):
        return made
    return None


def buffers_in(file: RclpyFile) -> Iterator[ast.Call]:
    """Yield the calls that create tf2 buffers."""
    for call in file.module.walk(ast.Call) if file.module.mentions("Buffer(") else ():
        if not _BUFFERS.isdisjoint(file.module.qualified_names(call.func)):
            yield call


def is_spun_by_listener(file: RclpyFile) -> bool:
    """Return whether a listener of the file has its own thread, or may have one."""
    return file.module.mentions("spin_thread")
