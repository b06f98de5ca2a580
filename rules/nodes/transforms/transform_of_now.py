"""ND109: transforms are looked up at times for which they have arrived."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, RclpyRule, Severity
from scaffold.api.programs import in_callbacks, may_run_meanwhile
from scaffold.api.rclpy import Lookup, RclpyFile, is_spun_by_listener, lookups_in

_NODE = (
    "from rclpy.duration import Duration\nfrom rclpy.node import Node\n"
    "from rclpy.time import Time\nfrom tf2_ros import Buffer, TransformListener\n\n\n"
    "class Follower(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('follower')\n"
    "        self.buffer = Buffer()\n"
    "        self.listener = TransformListener(self.buffer, self{})\n"
    "        self.create_timer(0.1, self.tick)\n\n"
    "    def tick(self):\n"
    "        now = self.get_clock().now()\n"
    "        self.buffer.lookup_transform('map', 'base_link', {})\n"
)


class TransformOfNow(RclpyRule):
    """A transform is looked up at the current time, before it can arrive.

    **Why.** Transforms arrive after their time stamp: a lookup at ``now()`` raises
    ``ExtrapolationException: Lookup would require extrapolation into the future``, unless all
    transforms between the frames are static. A timeout does not help with one thread: while a
    callback waits, no transform is received.

    **Fix.** Request the latest transform: ``Time()``. Or wait, with ``timeout=Duration(...)`` and
    ``TransformListener(buffer, node, spin_thread=True)``.

    **Source.** ROS 2 documentation, "Using time (Python)"; ``tf2_ros/buffer.py``.
    """

    code = "ND109"
    name = "transform-of-now"
    severity = Severity.WARNING
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("the latest", {"follower.py": _NODE.format("", "Time()")}),
        Example(
            "at the current time",
            {"follower.py": _NODE.format("", "now")},
            "16:58: lookup_transform() at the current time: the transform arrives later; use "
            "Time() for the latest, or a timeout",
        ),
        Example(
            "waits in the only thread",
            {"follower.py": _NODE.format("", "now, Duration(seconds=0.5)")},
            "16:58: lookup_transform() at the current time waits in the thread that would receive "
            "the transform: always a timeout; use Time(), or spin_thread=True",
        ),
        Example(
            "waits while another thread receives",
            {"follower.py": _NODE.format(", spin_thread=True", "now, Duration(seconds=0.5)")},
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if file.module.in_tests:
            return
        lookups = [x for x in lookups_in(file) if x.method in _WAITING and _is_of_now(file, x)]
        alone = {
            executed.function
            for executed in in_callbacks(file)
            if lookups
            if not may_run_meanwhile(file, executed)
        }
        for lookup in lookups:
            at = file.module.location(lookup.arguments["time"])
            if not _has_timeout(file, lookup):
                message = (
                    f"{lookup.method}() at the current time: the transform arrives later; "
                    "use Time() for the latest, or a timeout"
                )
                yield self.report(at, message)
            elif file.function_of(lookup.call) in alone and not is_spun_by_listener(file):
                message = (
                    f"{lookup.method}() at the current time waits in the thread that would "
                    "receive the transform: always a timeout; use Time(), or spin_thread=True"
                )
                yield self.report(at, message)


_WAITING = ("lookup_transform", "can_transform")


def _is_of_now(file: RclpyFile, lookup: Lookup) -> bool:
    time = lookup.arguments.get("time")
    origins = file.evaluator.origins(time) if time is not None else ()
    return bool(origins) and all(_is_now(file, origin) for origin in origins)


def _is_now(file: RclpyFile, node: ast.expr) -> bool:
    match node:
        case ast.Call(func=ast.Attribute(attr="now"), args=[], keywords=[]):
            return True
        case ast.Call(func=ast.Attribute(attr="to_msg" | "from_msg", value=inner), args=args):
            given = args[0] if args else inner
            return all(_is_now(file, x) for x in file.evaluator.origins(given))
    return False


def _has_timeout(file: RclpyFile, lookup: Lookup) -> bool:
    """Return whether a timeout is passed that may be greater than 0."""
    given = lookup.arguments.get("timeout")
    if given is None:
        return any(word.arg is None for word in lookup.call.keywords)
    match file.evaluator.single_value(given):
        case ast.Call(args=[], keywords=[]):
            return False
        case ast.Call(args=[], keywords=words):
            return any(file.evaluator.evaluate(word.value) != 0 for word in words)
    return True
