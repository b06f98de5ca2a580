"""ND104: message filters get messages with stamps, and have a callback."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, MessageRule, Package, Report, Severity
from scaffold.api.messages import MessageTypes
from scaffold.api.rclpy import Entity, RclpyFile, Synchronizer, is_used_elsewhere

_NODE = (
    "from message_filters import ApproximateTimeSynchronizer, Subscriber\n"
    "from rclpy.node import Node\nfrom sensor_msgs.msg import Image\n"
    "from std_msgs.msg import String\n\n\n"
    "class Viewer(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('viewer')\n"
    "        self.image = Subscriber(self, Image, 'image')\n"
    "        self.other = Subscriber(self, {0}, 'other')\n"
    "        self.sync = ApproximateTimeSynchronizer([self.image, self.other], {1})\n"
    "{2}"
    "    def view(self, image, other):\n"
    "        pass\n"
)
_REGISTER = "        self.sync.registerCallback(self.view)\n\n"
_LONG = 5
"""Seconds; a larger slop is implausible and may be in milliseconds."""
_LISTED = (
    "from message_filters import ApproximateTimeSynchronizer, Subscriber\n"
    "from rclpy.node import Node\nfrom sensor_msgs.msg import CameraInfo, Image\n"
    "from std_msgs.msg import String\n\nTOPICS = [(Image, 'image'), ({}, 'other')]\n\n\n"
    "class Viewer(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('viewer')\n"
    "        self.sync = ApproximateTimeSynchronizer(self.listen(), 10, 0.1)\n"
    "        self.sync.registerCallback(print)\n\n"
    "    def listen(self):\n"
    "        return [Subscriber(self, kind, topic) for kind, topic in TOPICS]\n"
)


class SynchronizerMisused(MessageRule):
    """A message filter has no callback, or can never match its messages.

    **Why.** Nothing happens, without an error: a synchronizer without ``registerCallback`` drops
    matched messages, and one with a ``slop`` or ``queue_size`` of 0 matches nothing. Messages
    without a header have no stamp to match: they are dropped with a warning.

    **Fix.** Call ``registerCallback(self.on_messages)``; pass ``allow_headerless=True``, or a type
    with a header.

    **Source.** ``message_filters/__init__.py``.
    """

    code = "ND104"
    name = "synchronizer-misused"
    other_severities = {
        Severity.WARNING: "the slop is too large, or the file uses other filters as well"
    }
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("matches", {"viewer.py": _NODE.format("Image", "10, 0.1", _REGISTER)}),
        Example(
            "no callback",
            {"viewer.py": _NODE.format("Image", "10, 0.1", "\n")},
            "12:21: no callback is registered: the matched messages are dropped; call "
            "registerCallback()",
        ),
        Example(
            "a filter without a callback",
            {
                "viewer.py": "from message_filters import Subscriber\n"
                "from rclpy.node import Node\nfrom sensor_msgs.msg import Image\n\n\n"
                "class Viewer(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('viewer')\n"
                "        self.image = Subscriber(self, Image, 'image')\n"
            },
            "9:22: no callback is registered, and no synchronizer gets this filter: its messages "
            "are dropped; call registerCallback()",
        ),
        Example(
            "a filter without a callback, next to others",
            {
                "viewer.py": _NODE.format("Image", "10, 0.1", _REGISTER).replace(
                    "        self.sync =",
                    "        self.old = Subscriber(self, Image, 'old')\n        self.sync =",
                )
            },
            Report(
                "12:20",
                "no callback is registered, and no synchronizer gets this filter: "
                "its messages are dropped; call registerCallback()",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "messages without a header",
            {"viewer.py": _NODE.format("String", "10, 0.1", _REGISTER)},
            "11:39: std_msgs/msg/String has no header, so no stamp: it is never matched; use a "
            "type with a header, or ApproximateTimeSynchronizer with allow_headerless=True",
        ),
        Example(
            "messages without a header, from a list that a method returns, and one by one",
            {"viewer.py": _LISTED.format("String"), "right.py": _LISTED.format("CameraInfo")},
            "viewer.py:6:30: std_msgs/msg/String has no header, so no stamp: it is never matched; "
            "use a type with a header, or ApproximateTimeSynchronizer with allow_headerless=True",
        ),
        Example(
            "messages without a header, which are matched by the time they arrive",
            {"viewer.py": _NODE.format("String", "10, 0.1, allow_headerless=True", _REGISTER)},
        ),
        Example(
            "milliseconds",
            {"viewer.py": _NODE.format("Image", "10, 100", _REGISTER)},
            Report(
                "12:79",
                "a slop of 100 seconds matches messages that do not belong "
                "together; it is in seconds",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "no slop",
            {"viewer.py": _NODE.format("Image", "10, slop=0.0", _REGISTER)},
            "12:84: a slop of 0 matches nothing: the callback never runs",
        ),
        Example(
            "a type without a header, matched by equal stamps",
            {
                "viewer.py": _NODE.format("String", "10", _REGISTER).replace(
                    "ApproximateTimeSynchronizer", "TimeSynchronizer"
                )
            },
            "11:39: std_msgs/msg/String has no header, so no stamp: AttributeError at the first "
            "message; use a type with a header, or ApproximateTimeSynchronizer with "
            "allow_headerless=True",
        ),
    )

    def check_in(self, package: Package, types: MessageTypes) -> Iterator[Diagnostic]:
        file = types.file
        if not file.module.mentions("message_filters") or file.module.in_tests:
            return
        for synchronizer in file.synchronizers:
            if not synchronizer.callbacks and _is_unused(package, file, synchronizer):
                message = (
                    "no callback is registered: the matched messages are dropped; "
                    "call registerCallback()"
                )
                yield self.report(synchronizer, message)
            yield from self._check_arguments(synchronizer)
            yield from self._check_inputs(types, synchronizer)
        filters = [x for x in file.subscriptions if x.argument("node") is not None]
        unused = [x for x in filters if not x.callback and _is_unused(package, file, x)]
        severity = Severity.ERROR if len(unused) == len(filters) else Severity.WARNING
        for subscription in unused:
            message = (
                "no callback is registered, and no synchronizer gets this filter: "
                "its messages are dropped; call registerCallback()"
            )
            yield self.report(subscription, message, severity=severity)

    def _check_arguments(self, synchronizer: Synchronizer) -> Iterator[Diagnostic]:
        for name in ("slop", "queue_size"):
            given = synchronizer.argument(name)
            if given is not None and type(given.value) in {int, float} and given.value == 0:
                yield self.report(given, f"a {name} of 0 matches nothing: the callback never runs")
        slop = synchronizer.argument("slop")
        if slop is not None and isinstance(slop.value, int | float) and slop.value >= _LONG:
            message = (
                f"a slop of {slop.value} seconds matches messages that do not belong together; "
                "it is in seconds"
            )
            yield self.report(slop, message, severity=Severity.WARNING)

    def _check_inputs(
        self, types: MessageTypes, synchronizer: Synchronizer
    ) -> Iterator[Diagnostic]:
        allowed = synchronizer.argument("allow_headerless")
        if allowed is not None and allowed.value is not False:
            return
        for given in synchronizer.inputs or ():
            argument = given.type_argument if given is not None else None
            class_ = types.class_of(argument.node) if argument else None
            if argument is None or class_ is None or class_.allows("header"):
                continue
            is_exact = synchronizer.argument("slop") is None
            happens = "AttributeError at the first message" if is_exact else "it is never matched"
            message = (
                f"{class_.name} has no header, so no stamp: {happens}; use a type with a header, "
                "or ApproximateTimeSynchronizer with allow_headerless=True"
            )
            yield self.report(argument, message)


def _is_unused(package: Package, file: RclpyFile, entity: Entity) -> bool:
    """Return whether a stored object is never used in the package."""
    if entity.attribute:
        names = file.module.index.attributes(entity.attribute)
        is_read = any(isinstance(node.ctx, ast.Load) for node in names)
        return not is_read and not is_used_elsewhere(package, file, entity.attribute)
    parent = file.module.parent(entity.call)
    if entity.variable:
        variables = file.module.index.names(entity.variable)
        is_read = any(isinstance(name.ctx, ast.Load) for name in variables)
        return isinstance(parent, ast.Assign) and not is_read
    return isinstance(parent, ast.Expr)
