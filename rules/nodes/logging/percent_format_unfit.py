"""ND073: ``%`` format strings get one value for each placeholder."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule
from scaffold.api.messages import MessageTypes, ValueTypes
from scaffold.api.python import is_handled

_PLACE = r"%(?:%|[-+ #0]*(?:\*|[1-9]\d*)?(?:\.(?:\*|\d+))?[diouxXeEfFgGcrsa])"
_SINGLE = frozenset({"bool", "float", "int", "str"})
_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Listener(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('listener')\n"
    "        self.create_subscription(String, 'chatter', self.on_chatter, 10)\n\n"
    "    def on_chatter(self, msg):\n"
    "        self.get_logger().info('{}' % msg.data)\n"
)


class PercentFormatUnfit(MessageRule):
    """A ``%`` format string with no placeholder or several gets a single value.

    **Why.** ``TypeError: not enough arguments for format string``, or ``not all arguments
    converted during string formatting``: in a callback, it ends the node.

    **Fix.** Pass a tuple with a value for each placeholder, or use an f-string. flake8 checks
    tuples (F507).

    **Source.** Python documentation, "printf-style String Formatting".
    """

    code = "ND073"
    name = "percent-format-unfit"
    examples = (
        Example("one placeholder", {"listener.py": _NODE.format("100 %% heard: %5.1s")}),
        Example(
            "two placeholders",
            {"listener.py": _NODE.format("%d: %s")},
            "11:32: format string with 2 placeholders gets 1 value: TypeError; use an f-string",
        ),
        Example(
            "no placeholder",
            {"listener.py": _NODE.format("heard 5 %%")},
            "11:32: format string with no placeholder gets 1 value: TypeError; use an f-string",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        kinds = ValueTypes(types)
        for node in types.module.walk(ast.BinOp):
            match node:
                case ast.BinOp(left=ast.Constant(value=str(text)), op=ast.Mod(), right=value):
                    problem = _problem(text, kinds.of(value))
                    if problem and not is_handled(types.module, node, "TypeError"):
                        yield self.report(types.module.location(node), problem)


def _problem(text: str, kind: str | None) -> str:
    """Return the message, if the value is certainly not a tuple or dict."""
    if kind not in _SINGLE or "%(" in text or "*" in text:
        return ""
    places = [place for place in re.findall(_PLACE, text) if place != "%%"]
    if len(places) == 1 or len(re.sub(_PLACE, "", text).split("%")) > 1:
        return ""
    count = f"{len(places)} placeholders" if places else "no placeholder"
    return f"format string with {count} gets 1 value: TypeError; use an f-string"
