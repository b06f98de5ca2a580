"""ND008: nodes stop without a traceback."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report, Severity
from scaffold.api.rclpy import RclpyCall, RclpyFile

_IMPORTS = "import rclpy\nfrom rclpy.executors import ExternalShutdownException\n\n\n"
_HANDLED = (
    "def main():\n    rclpy.init()\n    node = rclpy.create_node('talker')\n"
    "    try:\n        rclpy.spin(node)\n"
    "    except {}:\n        pass\n    finally:\n        rclpy.try_shutdown()\n"
)
_BARE = (
    "def main():\n    rclpy.init()\n    node = rclpy.create_node('talker')\n"
    "    rclpy.spin(node)\n    rclpy.shutdown()\n"
)


class ShutdownUnhandled(RclpyRule):
    """A node does not catch the exceptions that end ``spin``.

    **Why.** Ctrl-C raises KeyboardInterrupt, SIGTERM (``docker stop``, systemd, a launch file)
    raises ExternalShutdownException: the node ends with a traceback and exit code 1.

    **Fix.** Wrap ``rclpy.spin`` in ``try``, with
    ``except (KeyboardInterrupt, ExternalShutdownException): pass``.

    **Source.** ROS 2 documentation, "Migrating a Python package example"; ``demo_nodes_py``.
    """

    code = "ND008"
    name = "shutdown-unhandled"
    severity = Severity.WARNING
    examples = (
        Example(
            "both caught",
            {
                "talker.py": _IMPORTS
                + _HANDLED.format("(KeyboardInterrupt, ExternalShutdownException)")
            },
        ),
        Example(
            "none caught",
            {"talker.py": _IMPORTS + _BARE},
            Report(
                "8:5",
                "Ctrl-C and SIGTERM end this with a traceback and exit code 1; "
                "catch KeyboardInterrupt and ExternalShutdownException",
            ),
        ),
        Example(
            "a handler for Ctrl-C, and SIGTERM caught",
            {
                "talker.py": f"import signal\n{_IMPORTS}"
                + _HANDLED.format("ExternalShutdownException").replace(
                    "    try", "    signal.signal(signal.SIGINT, lambda *_: 0)\n    try"
                )
            },
        ),
        Example(
            "SIGTERM not caught",
            {"talker.py": _IMPORTS + _HANDLED.format("KeyboardInterrupt")},
            Report(
                "9:9",
                "SIGTERM ends this with a traceback and exit code 1; catch "
                "ExternalShutdownException",
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.init_calls:
            return
        for call in file.spin_calls:
            if not call.name.endswith("spin") or self._runs_in_thread(file, call):
                continue
            missing = self._missing(file, call)
            if missing:
                yield self.report(call, missing, cause="unclean shutdown")

    def _runs_in_thread(self, file: RclpyFile, call: RclpyCall) -> bool:
        """Return whether ``rclpy.init`` is called in another function: this may be a thread."""
        return all(init.function is not call.function for init in file.init_calls)

    def _missing(self, file: RclpyFile, call: RclpyCall) -> str:
        caught = call.handlers | call.outer_handlers
        signals: dict[str, str] = {}
        if caught.isdisjoint({"KeyboardInterrupt", "BaseException"}) and not _handles_int(file):
            signals["Ctrl-C"] = "KeyboardInterrupt"
        names = {"rclpy.executors.ExternalShutdownException", "Exception", "BaseException"}
        if caught.isdisjoint(names) and not call.asks_ok:
            signals["SIGTERM"] = "ExternalShutdownException"
        if not signals:
            return ""
        end = "end" if len(signals) > 1 else "ends"
        return (
            f"{' and '.join(signals)} {end} this with a traceback and exit code 1; "
            f"catch {' and '.join(signals.values())}"
        )


def _handles_int(file: RclpyFile) -> bool:
    """Return whether a handler in this file replaces the exception of Ctrl-C."""
    name = file.module.qualified_name
    return any(
        call.args and name(call.func) == "signal.signal" and name(call.args[0]) == "signal.SIGINT"
        for call in file.module.walk(ast.Call)
    )
