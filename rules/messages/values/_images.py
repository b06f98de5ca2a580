"""Encodings of images, and how many bytes their rows have."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api.messages import MessageTypes

Flaw = tuple[ast.expr, str]
"""The place and the problem."""
_COLORS = ("rgb", "rgba", "bgr", "bgra")
_BAYER = ("rggb", "bggr", "gbrg", "grbg")
_ENCODINGS = frozenset(
    {f"{name}{bits}" for name in (*_COLORS, "mono") for bits in (8, 16)}
    | {f"bayer_{name}{bits}" for name in _BAYER for bits in (8, 16)}
    | {f"{kind}C{count}" for kind in ("8U", "8S", "16U", "16S", "32S") for count in (1, 2, 3, 4)}
    | {f"{kind}C{count}" for kind in ("32F", "64F") for count in (1, 2, 3, 4)}
    | {"yuv422", "uyvy", "yuv422_yuy2", "yuyv", "nv21", "nv24", "passthrough"}
)
_SHORT = {"bgr": "bgr8", "rgb": "rgb8", "rgba": "rgba8", "bgra": "bgra8"} | dict.fromkeys(
    ("mono", "gray", "grey", "gray8", "grayscale", "greyscale"), "mono8"
)
_OF_CV_BRIDGE = frozenset({"imgmsg_to_cv2", "compressed_imgmsg_to_cv2", "cv2_to_imgmsg"})


def flaws(types: MessageTypes) -> Iterator[Flaw]:
    """Yield encodings that cv_bridge does not know, and rows that are too short."""
    for item in types.assigned:
        key = (item.owner.name, item.field.name)
        problem = ""
        if key == ("sensor_msgs/msg/Image", "encoding"):
            problem = _encoding_problem(types, item.value, "cv_bridge raises an error")
        elif key == ("sensor_msgs/msg/Image", "step"):
            problem = _step_problem(types, item.holder, item.value)
        if problem:
            yield item.value, problem
    yield from _stamped_apart(types)
    if "cv_bridge" in types.module.imports_by_root:
        for call in types.module.walk(ast.Call):
            yield from _call_flaws(types, call)


_PAIR = ("sensor_msgs/msg/Image", "sensor_msgs/msg/CameraInfo")


def _stamped_apart(types: MessageTypes) -> Iterator[Flaw]:
    """Yield the stamp of a camera info created separately from that of its image."""
    stamps: dict[tuple[ast.AST | None, str], list[ast.expr]] = {}
    for item in types.assigned:
        if (item.owner.name, item.field.name) != ("std_msgs/msg/Header", "stamp"):
            continue
        owner = types.type_of(item.holder.value) if isinstance(item.holder, ast.Attribute) else None
        if owner is not None and owner.name in _PAIR:
            key = (types.module.enclosing_function(item.holder), owner.name)
            stamps.setdefault(key, []).append(item.value)
    for (function, name), values in stamps.items():
        images = stamps.get((function, _PAIR[0]), [])
        is_pair = name != _PAIR[0] and len(values) == len(images) == 1
        if is_pair and _is_now(values[0]) and _is_now(images[0]):
            message = "camera info needs the stamp of its image: otherwise synchronizers find no "
            yield values[0], message + "pair; copy it"


def _is_now(node: ast.expr) -> bool:
    """Return whether an expression is ``clock.now().to_msg()``, which creates a new stamp."""
    match node:
        case ast.Call(
            func=ast.Attribute(attr="to_msg", value=ast.Call(func=ast.Attribute(attr="now")))
        ):
            return True
    return False


def _call_flaws(types: MessageTypes, call: ast.Call) -> Iterator[Flaw]:
    """Yield encodings in a call of cv_bridge that it does not know."""
    name = call.func.attr if isinstance(call.func, ast.Attribute) else ""
    if name not in _OF_CV_BRIDGE:
        return
    words = (word.value for word in call.keywords if word.arg in {"desired_encoding", "encoding"})
    for node in (*call.args[1:2], *words):
        problem = _encoding_problem(types, node, "CvBridgeError")
        if problem:
            yield node, problem


def _encoding_problem(types: MessageTypes, node: ast.expr, what_happens: str) -> str:
    value = types.file.evaluator.evaluate(node)
    meant = _intended_encoding(value) if isinstance(value, str) else ""
    return f"unknown encoding {value!r}: {what_happens}; write {meant!r}" if meant else ""


def _step_problem(types: MessageTypes, holder: ast.expr, step: ast.expr) -> str:
    """Return the right step of a row that has one byte per pixel instead of several."""
    module = types.module
    name = module.text(holder)
    function = module.enclosing_function(holder)
    given = {
        item.field.name: item.value
        for item in types.assigned
        if module.text(item.holder) == name and module.enclosing_function(item.holder) is function
    }
    encoding = types.file.evaluator.evaluate(given["encoding"]) if "encoding" in given else ""
    if not isinstance(encoding, str) or "width" not in given:
        return ""
    encoding = encoding.lower()
    width = module.text(given["width"])
    count = len(encoding.rstrip("168")) if encoding.rstrip("168") in _COLORS else 1
    count *= 2 if encoding.endswith("16") else 1
    if count > 1 and module.text(step) in {width, f"{name}.width"}:
        return f"step is in bytes: a row of {encoding!r} has {count} * {width}"
    return ""


def _intended_encoding(encoding: str) -> str:
    """Return the encoding meant by an unknown one; empty if it may be custom."""
    if encoding in _ENCODINGS or re.fullmatch(r"(8|16|32|64)[USF]C\d+", encoding):
        return ""
    by_lower_case = {name.lower(): name for name in _ENCODINGS}
    lower = encoding.lower().replace("-", "").replace(" ", "")
    letters = sorted(lower)
    anagrams = (name for name in sorted(by_lower_case) if sorted(name) == letters)
    return _SHORT.get(lower) or by_lower_case.get(lower) or next(anagrams, "")
