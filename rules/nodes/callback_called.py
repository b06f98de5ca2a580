"""ND002: callbacks are passed, not called."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, {})\n\n"
    "    def tick(self):\n"
    "        pass\n"
)


class CallbackCalled(RclpyRule):
    """A callback is called where it should be passed.

    **Why.** It runs once, at once, and its result, ``None``, becomes the callback: ``TypeError:
    'NoneType' object is not callable``.

    **Fix.** Leave out the parentheses.

    **Source.** ``rclpy/node.py``, ``create_timer`` and ``create_subscription``.
    """

    code = "ND002"
    name = "callback-called"
    examples = (
        Example("passed", {"talker.py": _NODE.format("self.tick")}),
        Example(
            "called",
            {"talker.py": _NODE.format("self.tick()")},
            reports=(
                Report(
                    "talker.py:7:32",
                    "self.tick() is called here, and what it returns becomes the callback",
                    fix="pass it",
                ),
            ),
            fixed={"talker.py": _NODE.format("self.tick")},
        ),
    )

    def check_file(self, facts: RclpyFile) -> Iterator[Diagnostic]:
        for _, callback in facts.callbacks:
            if not callback.is_called:
                continue
            text = facts.module.text(callback.node)
            fix = None
            if text.endswith("()"):
                _, end = facts.module.span(callback.node)
                edit = Edit(facts.module.path, end - 2, end, "")
                fix = Fix("pass it", (edit,))
            message = f"{text} is called here, and what it returns becomes the callback"
            yield self.report(callback, message, fix)
