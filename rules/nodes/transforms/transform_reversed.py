"""ND138: transforms lead from the frame of what they are applied to."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, RclpyRule
from scaffold.api.rclpy import RclpyFile, lookups_in

_NODE = (
    "from geometry_msgs.msg import PointStamped\nfrom rclpy.node import Node\n"
    "from rclpy.time import Time\nfrom tf2_geometry_msgs import do_transform_point\n"
    "from tf2_ros import Buffer, TransformListener\n\n\n"
    "class Detections(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('detections')\n"
    "        self.buffer = Buffer()\n"
    "        self.listener = TransformListener(self.buffer, self)\n"
    "        self.create_subscription(PointStamped, 'detections', self.on_point, 10)\n\n"
    "    def on_point(self, point):\n"
    "        {}\n"
    "        moved = do_transform_point(point, transform)\n"
    "        self.get_logger().info(f'{{moved.point}}')\n"
)
_LOOKUP = "transform = self.buffer.lookup_transform({}, Time())"
_FRAME = ".header.frame_id"


class TransformReversed(RclpyRule):
    """A transform to the frame of a message is applied to this message.

    **Why.** ``lookup_transform(target, source, time)`` returns the transform of data in ``source``
    to ``target``. Applied to data that is in ``target`` already, it yields wrong coordinates,
    without an error.

    **Fix.** Swap the two frames: ``lookup_transform('map', point.header.frame_id, Time())``.

    **Source.** ``tf2_ros/buffer.py``, ``lookup_transform``; ``tf2_geometry_msgs``.
    """

    code = "ND138"
    name = "transform-reversed"
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example(
            "to the map",
            {"detections.py": _NODE.format(_LOOKUP.format("'map', point.header.frame_id"))},
        ),
        Example(
            "from the map",
            {"detections.py": _NODE.format(_LOOKUP.format("point.header.frame_id, 'map'"))},
            "16:50: the target is the frame of point, which line 17 transforms: wrong "
            "coordinates; swap target and source",
        ),
        Example(
            "from the map, with a variable and keywords",
            {
                "detections.py": _NODE.format(
                    "frame = point.header.frame_id\n        "
                    + _LOOKUP.format("source_frame='map', target_frame=frame, time=Time()").replace(
                        ", Time())", ")"
                    )
                )
            },
            "17:83: the target is the frame of point, which line 18 transforms: wrong "
            "coordinates; swap target and source",
        ),
        Example(
            "the frame is set to another one before",
            {
                "detections.py": _NODE.format(
                    "point.header.frame_id = 'map'\n        "
                    + _LOOKUP.format("point.header.frame_id, 'lidar'")
                )
            },
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.module.mentions("do_transform_"):
            return
        targets = {
            lookup.call: lookup.arguments.get("target_frame")
            for lookup in lookups_in(file)
            if lookup.method == "lookup_transform"
        }
        for call in file.module.walk(ast.Call):
            name = file.module.qualified_name(call.func) or ""
            match call.args:
                case [moved, transform] if name.rpartition(".")[2].startswith("do_transform_"):
                    made = file.evaluator.single_value(transform)
                    target = targets.get(made) if isinstance(made, ast.Call) else None
                    message = _owner_of_frame(file, target) if target is not None else ""
                    if target is not None and message and _is_of(file, call, moved, message):
                        yield self.report(
                            file.module.location(target),
                            f"the target is the frame of {message}, which line {call.lineno} "
                            "transforms: wrong coordinates; swap target and source",
                        )


def _owner_of_frame(file: RclpyFile, target: ast.expr) -> str:
    """Return the message whose frame an expression is; empty for others."""
    text = ast.unparse(file.evaluator.single_value(target) or target)
    return text.removesuffix(_FRAME) if text.endswith(_FRAME) else ""


def _is_of(file: RclpyFile, call: ast.Call, moved: ast.expr, message: str) -> bool:
    """Return whether a transformed value is part of a message whose frame is not changed."""
    function = file.module.enclosing_function(call)
    changed = {
        ast.unparse(node)
        for node in (file.module.below(function, ast.Attribute) if function else ())
        if isinstance(node.ctx, ast.Store)
    }
    text = ast.unparse(moved)
    is_changed = any(f"{message}{_FRAME}".startswith(f"{name}.") for name in changed)
    is_changed = is_changed or f"{message}{_FRAME}" in changed
    return (text == message or text.startswith(f"{message}.")) and not is_changed
