"""ND113: static transforms are sent by a static broadcaster."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.programs import phases_of
from scaffold.api.rclpy import RclpyFile

_BROADCASTERS = frozenset(
    {"tf2_ros.TransformBroadcaster", "tf2_ros.transform_broadcaster.TransformBroadcaster"}
)
_NODE = (
    "from geometry_msgs.msg import TransformStamped\nfrom rclpy.node import Node\n"
    "from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster\n\n\n"
    "class Mount(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('mount')\n"
    "        self.broadcaster = {}TransformBroadcaster(self)\n"
    "        self.broadcaster.sendTransform(TransformStamped())\n"
)


class TransformSentOnce(RclpyRule):
    """A ``TransformBroadcaster`` sends its transforms in the constructor alone.

    **Why.** Whoever subscribes to ``/tf`` later never gets them, and buffers forget them after ten
    seconds.

    **Fix.** ``StaticTransformBroadcaster`` for what never moves; for the rest, send the
    transform in a callback, again and again.

    **Source.** ROS 2 documentation, "Writing a static broadcaster (Python)".
    """

    code = "ND113"
    name = "transform-sent-once"
    examples = (
        Example("static", {"mount.py": _NODE.format("Static")}),
        Example(
            "sent once",
            {"mount.py": _NODE.format("")},
            Report(
                "10:9",
                "the transform is sent once, by the constructor: later subscribers "
                "never get it; use StaticTransformBroadcaster",
            ),
        ),
        Example(
            "sent by a timer",
            {
                "mount.py": _NODE.format("") + "        self.create_timer(0.1, self.send)\n\n"
                "    def send(self):\n"
                "        self.broadcaster.sendTransform(TransformStamped())\n"
            },
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        calls = [
            call
            for func in file.module.index.attributes("sendTransform")
            if isinstance(call := file.module.parent(func), ast.Call)
            and call.func is func
            and _is_broadcaster(file, func.value)
        ]
        if not calls or file.module.in_tests:
            return
        phases = phases_of(file)
        alone = phases.constructing - phases.running
        if not {file.function_of(call) for call in calls} <= alone:
            return
        for call in calls:
            loops = any(isinstance(x, ast.While | ast.For) for x in file.module.parents(call))
            if not loops:
                message = (
                    "the transform is sent once, by the constructor: later subscribers never get "
                    "it; use StaticTransformBroadcaster"
                )
                yield self.report(file.module.location(call), message)


def _is_broadcaster(file: RclpyFile, node: ast.expr) -> bool:
    made = file.evaluator.single_value(node)
    return isinstance(made, ast.Call) and not _BROADCASTERS.isdisjoint(
        file.module.qualified_names(made.func)
    )
