"""ND073: a text with ``%`` gets as many values as it has places."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Report
from scaffold.api.messages import Kinds, MessageTypes
from scaffold.api.python import is_harmless

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
    """A text has none or several places for values, and gets one with ``%``.

    **Why.** ``TypeError: not enough arguments for format string``, or ``not all arguments
    converted during string formatting``: in a callback it ends the node.

    **Fix.** Give a tuple with a value for each place, or write an f-string. Tuples are counted by
    flake8 (F507).

    **Source.** Python documentation, "printf-style String Formatting".
    """

    code = "ND073"
    name = "percent-format-unfit"
    examples = (
        Example("one", {"listener.py": _NODE.format("100 %% heard: %5.1s")}),
        Example(
            "two",
            {"listener.py": _NODE.format("%d: %s")},
            reports=(
                Report(
                    "listener.py:11:32", "the text has 2 places for values and gets 1: TypeError"
                ),
            ),
        ),
        Example(
            "none",
            {"listener.py": _NODE.format("heard 5 %%")},
            reports=(
                Report(
                    "listener.py:11:32", "the text has no place for values and gets 1: TypeError"
                ),
            ),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        kinds = Kinds(types)
        for node in types.module.walk(ast.BinOp):
            match node:
                case ast.BinOp(left=ast.Constant(value=str(text)), op=ast.Mod(), right=value):
                    problem = _problem(text, kinds.of(value))
                    if problem and not is_harmless(types.module, node, "TypeError"):
                        yield self.report(types.module.location(node), problem)


def _problem(text: str, kind: str | None) -> str:
    """Say what does not fit, if the value is surely no tuple and no dict."""
    if kind not in _SINGLE or "%(" in text or "*" in text:
        return ""
    places = [place for place in re.findall(_PLACE, text) if place != "%%"]
    if len(places) == 1 or len(re.sub(_PLACE, "", text).split("%")) > 1:
        return ""
    count = f"{len(places)} places" if places else "no place"
    return f"the text has {count} for values and gets 1: TypeError"
