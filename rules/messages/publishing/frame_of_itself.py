"""MS013: a transform connects two frames, the parent and its child."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.rclpy import RclpyFile, lookups_in

_NODE = (
    "from geometry_msgs.msg import TransformStamped\nfrom rclpy.node import Node\n"
    "from tf2_ros import TransformBroadcaster\n\n\n"
    "class Odometry(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('odometry')\n"
    "        self.frame = 'odom'\n"
    "        self.broadcaster = TransformBroadcaster(self)\n\n"
    "    def send(self, odom):\n"
    "        transform = TransformStamped()\n"
    "        transform.header = odom.header\n"
    "        transform.header.frame_id = {}\n"
    "        transform.child_frame_id = {}\n"
    "        self.broadcaster.sendTransform(transform)\n"
)


class FrameOfItself(RclpyRule):
    """A transform connects a frame to itself, or has parent and child in the wrong order.

    **Why.** tf2 ignores it: ``TF_SELF_TRANSFORM: Ignoring transform ... with frame_id and
    child_frame_id "odom" because they are the same``. A lookup from a frame to itself always
    returns the identity. A frame has only one parent, and REP 105 defines the order map,
    odom, base_link: in the reverse order, the tree is disconnected or the robot appears to move
    backwards.

    **Fix.** Use the moving frame as the child: ``child_frame_id = 'base_link'``.

    **Source.** ``tf2/src/buffer_core.cpp``, ``setTransformImpl``; REP 105, "Relationship between
    Frames".
    """

    code = "MS013"
    name = "frame-of-itself"
    other_severities = {Severity.WARNING: "REP 105 defines the reverse order"}
    examples = (
        Example(
            "transform between two frames", {"odometry.py": _NODE.format("'odom'", "'base_link'")}
        ),
        Example(
            "child frame equal to the parent frame",
            {"odometry.py": _NODE.format("self.frame", "'odom'")},
            "16:36: the child frame is the parent frame: tf2 ignores the transform",
        ),
        Example(
            "child frame equal to the parent frame, both given to the constructor",
            {
                "beacon.py": "from geometry_msgs.msg import TransformStamped\n"
                "from std_msgs.msg import Header\nfrom tf2_ros import TransformBroadcaster\n\n"
                "import rclpy\n\n"
                "BEACON = TransformStamped(\n"
                "    header=Header(frame_id='map'), child_frame_id='map')\n\n\n"
                "def main():\n    rclpy.init()\n    node = rclpy.create_node('beacon')\n"
                "    TransformBroadcaster(node).sendTransform(BEACON)\n"
            },
            "8:51: the child frame is the parent frame: tf2 ignores the transform",
        ),
        Example(
            "base_footprint as the parent of odom",
            {"odometry.py": _NODE.format("'base_footprint'", "'odom'")},
            Report(
                "16:36",
                "'odom' is above 'base_link' in the tree of frames, not its child: "
                "exchange frame_id and child_frame_id, and invert the transform if "
                "it needs it",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "child frame copied from header.frame_id of the same odometry",
            {
                "odometry.py": _NODE.format("'odom'", "odom.header.frame_id").replace(
                    "        transform.header.frame_id = 'odom'\n", ""
                )
            },
            "15:36: the child frame is the parent frame: tf2 ignores the transform",
        ),
        Example(
            "child frame copied from child_frame_id of the odometry",
            {
                "odometry.py": _NODE.format("'odom'", "odom.child_frame_id").replace(
                    "        transform.header.frame_id = 'odom'\n", ""
                )
            },
        ),
        Example(
            "odometry with one frame for both, which is not a transform",
            {
                "odometer.py": "import rclpy\nfrom nav_msgs.msg import Odometry\n\n\n"
                "def odometry(frame):\n"
                "    message = Odometry()\n"
                "    message.header.frame_id = frame\n"
                "    message.child_frame_id = frame\n"
                "    return message\n"
            },
        ),
        Example(
            "lookup of a transform from a frame to itself",
            {
                "follower.py": "from rclpy.time import Time\nimport rclpy\nimport tf2_ros\n\n\n"
                "def place(buffer):\n"
                "    return buffer.lookup_transform('map', 'map', Time())\n"
            },
            "7:43: both frames are the same: the transform is always the identity",
        ),
        Example(
            "two parents of a frame, two children of one, and a choice",
            {
                "frames.py": "from geometry_msgs.msg import TransformStamped\n"
                "from rclpy.node import Node\nfrom tf2_ros import TransformBroadcaster\n\n\n"
                "class Frames(Node):\n"
                "    def send(self, is_mapping):\n"
                "        base = TransformStamped()\n"
                "        base.header.frame_id = 'map'\n"
                "        base.child_frame_id = 'base_link'\n"
                "        gps = TransformStamped()\n"
                "        gps.header.frame_id = 'gps'\n"
                "        gps.child_frame_id = 'base_link'\n"
                "        camera = TransformStamped()\n"
                "        camera.header.frame_id = 'gps'\n"
                "        camera.child_frame_id = 'camera'\n"
                "        if is_mapping:\n"
                "            camera.header.frame_id = 'map'\n"
                "            camera.child_frame_id = 'camera'\n"
                "        TransformBroadcaster(self).sendTransform([base, gps, camera])\n",
            },
            Report(
                "13:30",
                "'base_link' has two parents, 'map' (line 10) and 'gps': tf2 uses the "
                "last one that was sent, so the tree jumps",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if file.module.in_tests:
            return
        for child, parent in (*_stored_frames(file), *_given_frames(file)):
            if _are_same(file, child, parent):
                message = "the child frame is the parent frame: tf2 ignores the transform"
                yield self.report(file.module.location(child), message)
            else:
                yield from self._check_order(file, child, parent)
        yield from self._check_parents(file)
        for lookup in lookups_in(file):
            target, source = map(lookup.arguments.get, ("target_frame", "source_frame"))
            if target is not None and source is not None and _are_same(file, source, target):
                message = "both frames are the same: the transform is always the identity"
                yield self.report(file.module.location(source), message)

    def _check_parents(self, file: RclpyFile) -> Iterator[Diagnostic]:
        """Report a frame that a node gives two parents, whatever happens."""
        parents: dict[tuple[object, str], tuple[str, ast.expr]] = {}
        for child, parent in (*_stored_frames(file), *_given_frames(file)):
            stored = _last_stored(file, child, ast.unparse(parent))
            above = _constant(file, stored or parent, is_default=True)
            frames = [_constant(file, child), above]
            if not all(frames) or file.module.enclosing(child, ast.If) is not None:
                continue
            key = (file.module.enclosing_class(child), frames[0])
            other, first = parents.setdefault(key, (frames[1], child))
            if other != frames[1]:
                line = file.module.location(first).line
                message = (
                    f"{frames[0]!r} has two parents, {other!r} (line {line}) and {frames[1]!r}: "
                    "tf2 uses the last one that was sent, so the tree jumps"
                )
                yield self.report(file.module.location(child), message, severity=Severity.WARNING)

    def _check_order(
        self, file: RclpyFile, child: ast.expr, parent: ast.expr
    ) -> Iterator[Diagnostic]:
        below, above = _rank(file, child), _rank(file, parent)
        if below is None or above is None or below >= above:
            return
        message = (
            f"{_ORDER[below]!r} is above {_ORDER[above]!r} in the tree of frames, not its child: "
            "exchange frame_id and child_frame_id, and invert the transform if it needs it"
        )
        yield self.report(file.module.location(child), message, severity=Severity.WARNING)


_ORDER = ("earth", "map", "odom", "base_link")
"""The frames of REP 105, parents first."""


def _constant(file: RclpyFile, frame: ast.expr, *, is_default: bool = False) -> str:
    """Return the name of a frame, that of no parameter or its default; empty if unknown."""
    text, notes = file.evaluator.trace(frame) if hasattr(frame, "lineno") else ("", None)
    return text.lstrip("/") if isinstance(text, str) and (is_default or not notes) else ""


def _rank(file: RclpyFile, frame: ast.expr) -> int | None:
    text, notes = file.evaluator.trace(frame) if hasattr(frame, "lineno") else (None, None)
    name = text.lstrip("/") if isinstance(text, str) and not notes else ""
    name = "base_link" if name == "base_footprint" else name
    return _ORDER.index(name) if name in _ORDER else None


def _stored_frames(file: RclpyFile) -> Iterator[tuple[ast.expr, ast.expr]]:
    """Yield the values of ``child_frame_id``, with the frame of the header."""
    for store in file.evaluator.stores("child_frame_id"):
        parent = _parent_frame(file, store.node)
        if _is_odometry(file, store.node.value):
            continue  # not a transform, but an object moving in a frame
        if store.value is not None and parent is not None:
            yield store.value, parent


def _given_frames(file: RclpyFile) -> Iterator[tuple[ast.expr, ast.expr]]:
    """Yield child and parent frames in calls such as ``TransformStamped(header=Header(...))``."""
    for call in file.module.walk(ast.Call) if file.module.mentions("child_frame_id=") else ():
        words = {word.arg: word.value for word in call.keywords}
        child, header = words.get("child_frame_id"), words.get("header")
        for word in header.keywords if isinstance(header, ast.Call) else ():
            if word.arg == "frame_id" and child is not None:
                yield child, word.value


def _parent_frame(file: RclpyFile, child: ast.Attribute) -> ast.expr | None:
    """Return the frame in the header of a message that has a child frame as well."""
    holder = file.module.text(child.value)
    frame = _last_stored(file, child, f"{holder}.header.frame_id")
    if frame is not None:
        return frame
    header = _last_stored(file, child, f"{holder}.header")
    if isinstance(header, ast.Name | ast.Attribute):
        return ast.parse(f"{ast.unparse(header)}.frame_id", mode="eval").body
    return None


def _last_stored(file: RclpyFile, at: ast.AST, path: str) -> ast.expr | None:
    """Return the only value assigned to an attribute in the same block."""
    values: list[ast.expr] = []
    block = file.module.parent(file.module.parent(at) or at)
    for store in file.evaluator.stores(path.rpartition(".")[2]):
        if file.function_of(store.node) is not file.function_of(at):
            continue
        if file.module.text(store.node) != path:
            continue
        if store.value is None or file.module.parent(file.module.parent(store.node) or at) != block:
            return None
        values.append(store.value)
    return values[0] if len(values) == 1 else None


def _are_same(file: RclpyFile, child: ast.expr, parent: ast.expr) -> bool:
    return _value(file, child, child) == _value(file, child, parent)


def _value(file: RclpyFile, at: ast.AST, node: ast.expr) -> str:
    """Return a key that is equal for equal values: the constant, or the expression as text."""
    text, notes = file.evaluator.trace(node) if hasattr(node, "lineno") else (None, None)
    if isinstance(text, str) and not notes:
        return repr(text.lstrip("/"))
    words = ast.unparse(node)
    if isinstance(node, ast.Attribute) and words.endswith((".frame_id", ".child_frame_id")):
        stored = _last_stored(file, at, words)
        if stored is not None and ast.unparse(stored) != words:
            return _value(file, at, stored)
    if isinstance(node, ast.Name | ast.Attribute) and hasattr(node, "lineno"):
        return _origin(file, node)
    return words


def _origin(file: RclpyFile, node: ast.Name | ast.Attribute) -> str:
    """Return the origin of the value of a name; for one that changes, its place."""
    if isinstance(node, ast.Name):
        bound = file.module.index.lookup(node.id, node)
        if bound is not None and len(bound[1]) > 1:
            return f"{node.id}@{node.lineno}:{node.col_offset}"
    return ast.unparse(file.evaluator.single_value(node))


def _is_odometry(file: RclpyFile, message: ast.expr) -> bool:
    """Return whether a message is created as Odometry of nav_msgs."""
    made = file.evaluator.single_value(message)
    return isinstance(made, ast.Call) and ast.unparse(made.func).endswith("Odometry")
