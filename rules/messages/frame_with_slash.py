"""MS007: frame names have no leading slash."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, MessageRule, Report
from scaffold.api.messages import MessageTypes

_FIELDS = ("frame_id", "child_frame_id")
_LOOKUPS = frozenset({"lookup_transform", "can_transform", "lookup_transform_async"})
_CODE = (
    "from geometry_msgs.msg import TransformStamped\n\n\n"
    "def make(buffer, time):\n"
    "    transform = buffer.lookup_transform({}, 'base', time)\n"
    "    sent = TransformStamped(child_frame_id={})\n"
    "    sent.header.frame_id = {}\n"
    "    return transform, sent\n"
)


class FrameWithSlash(MessageRule):
    """A frame name starts with a slash.

    **Why.** tf2 rejects it in every program that uses the message: ``Invalid argument
    "/base_link" passed to lookupTransform ... frame_ids cannot start with a '/'``.

    **Fix.** Remove the slash.

    **Source.** ``tf2/src/buffer_core.cpp``; https://wiki.ros.org/tf2/Migration.
    """

    code = "MS007"
    name = "frame-with-slash"
    examples = (
        Example("no slash", {"node.py": _CODE.format("'map'", "'base'", "'map'")}),
        Example("a test", {"test/test_a.py": _CODE.format("'/map'", "'/base'", "'/map'")}),
        Example(
            "with a slash",
            {"node.py": _CODE.format("'/map'", '"/base"', "'/map'")},
            Report(
                "5:41",
                "frame '/map' starts with '/': tf2 rejects it; remove the slash",
                fix="remove the slash",
            ),
            Report(
                "6:44",
                "frame '/base' starts with '/': tf2 rejects it; remove the slash",
                fix="remove the slash",
            ),
            Report(
                "7:28",
                "frame '/map' starts with '/': tf2 rejects it; remove the slash",
                fix="remove the slash",
            ),
            fixed={"node.py": _CODE.format("'map'", '"base"', "'map'")},
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        # Frames that a test makes up as input are never looked up.
        for node in () if types.module.in_tests else _frames(types):
            value = types.facts.evaluator.evaluate(node)
            if not (isinstance(value, str) and value.startswith("/")):
                continue
            fix = None
            start, _ = types.module.span(node)
            text = types.module.text(node)
            if isinstance(node, ast.Constant) and text[:2] in {"'/", '"/'} and value != "/":
                edit = Edit(types.module.path, start + 1, start + 2, "")
                fix = Fix("remove the slash", (edit,))
            message = f"frame {value!r} starts with '/': tf2 rejects it; remove the slash"
            yield self.report(types.module.location(node), message, fix)


def _frames(types: MessageTypes) -> Iterator[ast.expr]:
    """Yield the expressions that are used as frames."""
    for name in _FIELDS:
        for store in types.facts.evaluator.stores(name):
            # ``self.frame_id`` is an attribute of the node, not of a message.
            if store.value is not None and store.class_ is None:
                yield store.value
    for call in types.module.walk(ast.Call):
        if isinstance(call.func, ast.Attribute) and call.func.attr in _LOOKUPS:
            yield from call.args[:2]
        elif call.keywords and types.class_of(call.func):
            yield from (word.value for word in call.keywords if word.arg in _FIELDS)
