"""ND005: rclpy is initialized once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import RclpyCall, RclpyFile

_MAIN = (
    "import rclpy\n\n\ndef main(args=None):\n    rclpy.init(args=args)\n{}    rclpy.shutdown()\n"
)


class InitRepeated(RclpyRule):
    """``rclpy.init()`` is called twice in a row.

    **Why.** ``RuntimeError: Context.init() must only be called once``.

    **Fix.** Keep the first call.

    **Source.** ``rclpy/context.py``.
    """

    code = "ND005"
    name = "init-repeated"
    examples = (
        Example("once", {"talker.py": _MAIN.format("")}),
        Example(
            "again after a shutdown",
            {"talker.py": _MAIN.format("    rclpy.shutdown()\n    rclpy.init()\n")},
        ),
        Example(
            "twice",
            {"talker.py": _MAIN.format("    rclpy.init()\n")},
            Report("6:5", "rclpy.init() is already called in line 5: RuntimeError"),
        ),
        Example(
            "in the constructor of a node",
            {
                "talker.py": "from rclpy.node import Node\n"
                + _MAIN.format("    Talker()\n")
                + "\n\nclass Talker(Node):\n"
                "    def __init__(self):\n"
                "        rclpy.init()\n"
                "        super().__init__('talker')\n"
            },
            Report("13:9", "rclpy.init() is called before this node is constructed: RuntimeError"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        started: RclpyCall | None = None
        calls = sorted((*file.init_calls, *file.shutdown_calls), key=lambda call: call.location)
        for call in calls:
            in_node = call.name == "init" and self._is_in_node(file, call)
            if in_node and any(not self._is_in_node(file, x) for x in file.init_calls):
                message = "rclpy.init() is called before this node is constructed: RuntimeError"
                yield self.report(call, message)
                continue
            if call.name != "init":
                started = None
                continue
            if self._has_own_context(call) or file.is_conditional(call.call):
                started = None
                continue
            if started is not None and started.function is call.function:
                line = started.location.line
                yield self.report(
                    call, f"rclpy.init() is already called in line {line}: RuntimeError"
                )
            started = call

    def _is_in_node(self, file: RclpyFile, call: RclpyCall) -> bool:
        """Return whether a method of a node class calls it: the node already exists then."""
        class_ = file.module.enclosing_class(call.call)
        return class_ is not None and file.node_class(class_) is not None

    def _has_own_context(self, call: RclpyCall) -> bool:
        return any(word.arg in {"context", None} for word in call.call.keywords)
