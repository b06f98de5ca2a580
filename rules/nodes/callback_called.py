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
    """A callback is called instead of passed.

    **Why.** It runs once, immediately, and its result, ``None``, becomes the callback: ``TypeError:
    'NoneType' object is not callable``.

    **Fix.** Remove the parentheses.

    **Source.** ``rclpy/node.py``, ``create_timer`` and ``create_subscription``.
    """

    code = "ND002"
    name = "callback-called"
    examples = (
        Example("passed", {"talker.py": _NODE.format("self.tick")}),
        Example(
            "called",
            {"talker.py": _NODE.format("self.tick()")},
            Report(
                "7:32",
                "self.tick() is called here: its return value becomes the callback",
                fix="remove the parentheses",
            ),
            fixed={"talker.py": _NODE.format("self.tick")},
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for _, callback in file.callbacks:
            if not callback.is_called:
                continue
            text = file.module.text(callback.node)
            fix = None
            if text.endswith("()"):
                _, end = file.module.span(callback.node)
                edit = Edit(file.module.path, end - 2, end, "")
                fix = Fix("remove the parentheses", (edit,))
            message = f"{text} is called here: its return value becomes the callback"
            yield self.report(callback, message, fix)
