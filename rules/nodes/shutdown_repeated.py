"""ND009: the context is shut down once."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report, Severity
from scaffold.api.rclpy import RclpyFile

_MAIN = (
    "import rclpy\n\n\n"
    "def main():\n    rclpy.init()\n    node = rclpy.create_node('talker')\n"
    "    try:\n        rclpy.spin(node)\n"
    "    except KeyboardInterrupt:\n        pass\n    finally:\n        rclpy.{}()\n"
)


class ShutdownRepeated(RclpyRule):
    """``rclpy.shutdown()`` runs after a signal has already shut rclpy down.

    **Why.** The handler of SIGINT and SIGTERM does it first: ``RCLError: rcl_shutdown already
    called on the given context``, and the node ends with an error.

    **Fix.** Write ``rclpy.try_shutdown()``.

    **Source.** ``rclpy/__init__.py``, ``try_shutdown``; ``demo_nodes_py``.
    """

    code = "ND009"
    name = "shutdown-repeated"
    severity = Severity.WARNING
    examples = (
        Example("try_shutdown", {"talker.py": _MAIN.format("try_shutdown")}),
        Example(
            "shutdown",
            {"talker.py": _MAIN.format("shutdown")},
            Report(
                "12:9",
                "rclpy is already shut down after Ctrl-C: RCLError; use try_shutdown()",
                fix="use try_shutdown()",
            ),
            fixed={"talker.py": _MAIN.format("try_shutdown")},
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in file.shutdown_calls:
            if call.name != "shutdown" or call.asks_ok or call.call.args or call.call.keywords:
                continue
            if not call.in_finally or self._is_caught(call.handlers):
                continue
            spins = [spin for spin in file.spin_calls if spin.function is call.function]
            if not any(spin.catches_keyboard_interrupt for spin in spins):
                continue
            _, end = file.module.span(call.call.func)
            start = end - len("shutdown")
            edit = Edit(file.module.path, start, end, "try_shutdown")
            fix = None
            if file.module.source.text[start:end] == "shutdown":
                fix = Fix("use try_shutdown()", (edit,))
            message = "rclpy is already shut down after Ctrl-C: RCLError; use try_shutdown()"
            yield self.report(call, message, fix, cause="unclean shutdown")

    def _is_caught(self, handlers: frozenset[str]) -> bool:
        return not handlers.isdisjoint({"Exception", "BaseException"})
