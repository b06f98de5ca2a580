"""ND113: static transforms are sent with a static broadcaster."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, RclpyRule
from scaffold.api.programs import phases_of
from scaffold.api.python import returned
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
_TWO_FRAMES = (
    "from geometry_msgs.msg import TransformStamped\nfrom rclpy.node import Node\n"
    "from tf2_ros import TransformBroadcaster\n\n\n"
    "class Base(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('base')\n"
    "        self.broadcaster = TransformBroadcaster(self)\n"
    "        self.create_timer(0.1, self.send)\n"
    "        mount = TransformStamped()\n"
    "        mount.child_frame_id = 'laser'\n"
    "        self.broadcaster.sendTransform(mount)\n\n"
    "    def send(self):\n"
    "        frame = TransformStamped()\n"
    "        frame.child_frame_id = {}\n"
    "        self.broadcaster.sendTransform(frame)\n"
)


class TransformSentOnce(RclpyRule):
    """A ``TransformBroadcaster`` sends the transform of a frame only in the constructor.

    **Why.** Later subscribers of ``/tf`` never get it, and buffers drop it after ten seconds.

    **Fix.** Use ``StaticTransformBroadcaster`` for fixed frames; send other transforms repeatedly,
    in a callback.

    **Source.** ROS 2 documentation, "Writing a static broadcaster (Python)".
    """

    code = "ND113"
    name = "transform-sent-once"
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("static", {"mount.py": _NODE.format("Static")}),
        Example(
            "sent once",
            {"mount.py": _NODE.format("")},
            "10:9: the transform is sent once, by the constructor: later subscribers never get "
            "it; use StaticTransformBroadcaster",
        ),
        Example(
            "sent by a timer",
            {
                "mount.py": _NODE.format("") + "        self.create_timer(0.1, self.send)\n\n"
                "    def send(self):\n"
                "        self.broadcaster.sendTransform(TransformStamped())\n"
            },
        ),
        Example(
            "sent by a method that others call",
            {
                "mount.py": _NODE.format("").replace(
                    "        self.broadcaster.send",
                    "        MOVED.subscribe(self.send)\n        self.send()\n\n"
                    "    def send(self):\n        self.broadcaster.send",
                )
            },
        ),
        Example(
            "one frame sent once, another by a timer",
            {"base.py": _TWO_FRAMES.format("'base_link'")},
            "13:9: the transform of 'laser' is sent once, by the constructor: later subscribers "
            "never get it; use StaticTransformBroadcaster",
        ),
        Example(
            "one that a method creates, another by a timer",
            {
                "base.py": _TWO_FRAMES.format("'base_link'")
                .replace(
                    "        self.broadcaster.sendTransform(mount)\n", "        return mount\n"
                )
                .replace(
                    "        mount = Tr",
                    "        self.broadcaster.sendTransform(self.mount())\n\n"
                    "    def mount(self):\n        mount = Tr",
                )
            },
            "11:9: the transform of 'laser' is sent once, by the constructor: later subscribers "
            "never get it; use StaticTransformBroadcaster",
        ),
        Example("the same frame once more", {"base.py": _TWO_FRAMES.format("'laser'")}),
        Example("an unknown frame", {"base.py": _TWO_FRAMES.format("self.get_name()")}),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        calls = [
            call
            for func in file.module.index.attributes("sendTransform")
            if isinstance(call := file.module.parent(func), ast.Call)
            and file.module.call_with(func)
            and _is_broadcaster(file, func.value)
        ]
        if not calls or file.module.in_tests:
            return
        phases = phases_of(file)
        alone = phases.constructing - phases.running - _given_away(file, phases.constructing)
        sent_once = [call for call in calls if file.function_of(call) in alone]
        again = [call for call in calls if call not in sent_once]
        for call in sent_once:
            frame = _frame(file, call) if again else None
            if again and (frame is None or any(_frame(file, x) in {None, frame} for x in again)):
                continue
            loops = any(isinstance(x, ast.While | ast.For) for x in file.module.parents(call))
            if not loops:
                message = (
                    f"the transform{f' of {frame!r}' if frame else ''} is sent once, by the "
                    "constructor: later subscribers never get it; use StaticTransformBroadcaster"
                )
                yield self.report(file.module.location(call), message)


def _given_away(file: RclpyFile, functions: frozenset[ast.AST]) -> set[ast.AST]:
    """Return those of some functions that others may call later, and what these call."""
    result: set[ast.AST] = set()
    for function in functions:
        name = function.name if isinstance(function, ast.FunctionDef) else ""
        uses: list[ast.Attribute | ast.Name] = [*file.module.index.attributes(name)]
        uses += file.module.index.names(name)
        is_kept = any(isinstance(x.ctx, ast.Load) and not file.module.call_with(x) for x in uses)
        if isinstance(function, ast.FunctionDef) and is_kept:
            result.update(file.reached(function))
    return result


def _frame(file: RclpyFile, call: ast.Call) -> str | None:
    """Return the child frame of the transform that a call sends; ``None`` if unknown."""
    sent, function = _sent(file, call)
    match sent:
        case ast.Name(id=name):
            stores = [
                store.value
                for store in file.evaluator.stores("child_frame_id")
                if isinstance(store.node.value, ast.Name)
                and store.node.value.id == name
                and file.function_of(store.node) is function
            ]
            value, notes = file.evaluator.trace(stores[0]) if len(stores) == 1 else (None, ())
            return value if isinstance(value, str) and not notes else None
    return None


def _sent(file: RclpyFile, call: ast.Call) -> tuple[ast.expr | None, ast.AST | None]:
    """Return the sent value of a call, and the function that creates it."""
    match call:
        case ast.Call(args=[ast.Call() as inner], keywords=[]):
            function = file.callback(inner.func).function
            values = returned(function) if isinstance(function, ast.FunctionDef) else []
            return (values[0].value, function) if len(values) == 1 else (None, None)
        case ast.Call(args=[sent], keywords=[]):
            return sent, file.function_of(call)
    return None, None


def _is_broadcaster(file: RclpyFile, node: ast.expr) -> bool:
    made = file.evaluator.single_value(node)
    return isinstance(made, ast.Call) and not _BROADCASTERS.isdisjoint(
        file.module.qualified_names(made.func)
    )
