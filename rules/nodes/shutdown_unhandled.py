"""ND008: a node stops without a traceback."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
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
    """Nothing catches what ends a spinning node.

    **Why.** Ctrl-C raises KeyboardInterrupt, SIGTERM (``docker stop``, systemd, a launch file)
    ExternalShutdownException: a traceback, and an exit code that says it failed.

    **Fix.** Put ``rclpy.spin`` into ``try``, and write
    ``except (KeyboardInterrupt, ExternalShutdownException): pass``.

    **Source.** ROS 2 documentation, "Migrating a Python package example"; ``demo_nodes_py``.
    """

    code = "ND008"
    name = "shutdown-unhandled"
    examples = (
        Example(
            "both are caught",
            {
                "talker.py": _IMPORTS
                + _HANDLED.format("(KeyboardInterrupt, ExternalShutdownException)")
            },
        ),
        Example(
            "none is caught",
            {"talker.py": _IMPORTS + _BARE},
            reports=(
                Report(
                    "talker.py:8:5",
                    "nothing catches KeyboardInterrupt (Ctrl-C) and "
                    "ExternalShutdownException (SIGTERM)",
                ),
            ),
        ),
        Example(
            "Ctrl-C has a handler of its own, and SIGTERM is caught",
            {
                "talker.py": f"import signal\n{_IMPORTS}"
                + _HANDLED.format("ExternalShutdownException").replace(
                    "    try", "    signal.signal(signal.SIGINT, lambda *_: 0)\n    try"
                )
            },
        ),
        Example(
            "SIGTERM is forgotten",
            {"talker.py": _IMPORTS + _HANDLED.format("KeyboardInterrupt")},
            reports=(
                Report("talker.py:9:9", "nothing catches ExternalShutdownException (SIGTERM)"),
            ),
        ),
    )

    def check_file(self, facts: RclpyFile) -> Iterator[Diagnostic]:
        if not facts.init_calls:
            return
        for call in facts.spin_calls:
            if not call.name.endswith("spin") or self._runs_in_thread(facts, call):
                continue
            missing = self._missing(facts, call)
            if missing:
                yield self.report(call, f"nothing catches {missing}")

    def _runs_in_thread(self, facts: RclpyFile, call: RclpyCall) -> bool:
        """Tell whether another function than that of ``rclpy.init`` spins: it may be a thread."""
        return all(init.function is not call.function for init in facts.init_calls)

    def _missing(self, facts: RclpyFile, call: RclpyCall) -> str:
        caught = call.handlers | call.outer_handlers
        problems: list[str] = []
        if caught.isdisjoint({"KeyboardInterrupt", "BaseException"}) and not _handles_int(facts):
            problems.append("KeyboardInterrupt (Ctrl-C)")
        names = {"rclpy.executors.ExternalShutdownException", "Exception", "BaseException"}
        if caught.isdisjoint(names) and not call.asks_ok:
            problems.append("ExternalShutdownException (SIGTERM)")
        return " and ".join(problems)


def _handles_int(facts: RclpyFile) -> bool:
    """Tell whether Ctrl-C calls a function of the file instead of raising an exception."""
    name = facts.module.qualified_name
    return any(
        call.args and name(call.func) == "signal.signal" and name(call.args[0]) == "signal.SIGINT"
        for call in facts.module.walk(ast.Call)
    )
