"""ND008: nodes exit without a traceback."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Severity
from scaffold.api.python import argument_of
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
    raises ExternalShutdownException: the node exits with a traceback and exit code 1.

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
            "8:5: Ctrl-C and SIGTERM end this with a traceback and exit code 1; catch "
            "KeyboardInterrupt and ExternalShutdownException",
        ),
        Example(
            "a loop of single steps",
            {
                "talker.py": _IMPORTS
                + _BARE.replace(
                    "    rclpy.spin(node)", "    while rclpy.ok():\n        rclpy.spin_once(node)"
                )
            },
            "9:9: Ctrl-C and SIGTERM end this with a traceback and exit code 1; catch "
            "KeyboardInterrupt and ExternalShutdownException",
        ),
        Example(
            "a loop that waits for a result",
            {
                "talker.py": _IMPORTS
                + _BARE.replace(
                    "    rclpy.spin(node)",
                    "    while not node.done:\n        rclpy.spin_once(node)",
                )
            },
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
            "9:9: SIGTERM ends this with a traceback and exit code 1; catch "
            "ExternalShutdownException",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.init_calls:
            return
        for call in file.spin_calls:
            is_endless = call.name.endswith("spin") or _is_in_main_loop(file, call)
            if not is_endless or self._runs_in_thread(file, call):
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
        if caught.isdisjoint(names) and not call.asks_ok and not _never_waits(file, call):
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


def _is_in_main_loop(file: RclpyFile, call: RclpyCall) -> bool:
    """Return whether a call is in a loop that lasts until the shutdown of rclpy."""
    if not call.name.endswith("spin_once"):
        return False
    for parent in file.module.parents(call.call):
        match parent:
            case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.Lambda():
                return False
            case ast.While(test=ast.Call(func=func)):
                return file.module.qualified_name(func) == "rclpy.ok"
            case ast.While(test=ast.Constant(value=value)):
                return bool(value) and not any(
                    isinstance(node, ast.Break | ast.Return) for node in ast.walk(parent)
                )
    return False


def _never_waits(file: RclpyFile, call: RclpyCall) -> bool:
    """Return whether ``timeout_sec=0`` lets a loop end on shutdown without an exception."""
    given = argument_of(call.call, "timeout_sec")
    return given is not None and file.evaluator.evaluate(given) == 0
