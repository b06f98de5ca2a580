"""ND009: the context is shut down once."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report, Severity
from scaffold.api.programs import phases_of
from scaffold.api.rclpy import RclpyCall, RclpyFile

from ._interrupts import leaves, run_after_interrupt, run_after_return

_MAIN = (
    "import rclpy\n\n\n"
    "def main():\n    rclpy.init()\n    node = rclpy.create_node('talker')\n"
    "    try:\n        rclpy.spin(node)\n"
    "    except KeyboardInterrupt:\n        pass\n    finally:\n        rclpy.{}()\n"
)
_AFTER = _MAIN.replace("pass\n    finally:\n        rclpy", "{}\n    rclpy")
_AROUND = (
    "import rclpy\n\n\n"
    "def main():\n    rclpy.init()\n    try:\n        try:\n"
    "            rclpy.spin(rclpy.create_node('talker'))\n"
    "        except KeyboardInterrupt:\n            pass\n"
    "    finally:\n        rclpy.shutdown()\n"
)
_CALLBACK = (
    "import rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n        super().__init__('talker')\n"
    "        self.create_timer(1.0, self.finish)\n\n"
    "    def finish(self):\n        {}\n\n\n"
    "def main():\n    rclpy.init()\n    node = Talker()\n    rclpy.spin(node)\n"
    "    rclpy.shutdown()\n"
)


class ShutdownRepeated(RclpyRule):
    """``rclpy.shutdown()`` runs after a signal or a callback has already shut rclpy down.

    **Why.** The handler of SIGINT and SIGTERM calls it first: ``RCLError: rcl_shutdown already
    called on the given context``, and the node exits with an error. After a callback that ends the
    program it is a ``RuntimeError: Context must be initialized before it can be shutdown``.

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
                fix="Replace with try_shutdown()",
            ),
            fixed={"talker.py": _MAIN.format("try_shutdown")},
        ),
        Example(
            "after the try",
            {"talker.py": _AFTER.format("pass", "shutdown")},
            Report(
                "11:5",
                "rclpy is already shut down after Ctrl-C: RCLError; use try_shutdown()",
                fix="Replace with try_shutdown()",
            ),
            fixed={"talker.py": _AFTER.format("pass", "try_shutdown")},
        ),
        Example(
            "around the try",
            {"talker.py": _AROUND},
            Report(
                "12:9",
                "rclpy is already shut down after Ctrl-C: RCLError; use try_shutdown()",
                fix="Replace with try_shutdown()",
            ),
            fixed={"talker.py": _AROUND.replace(".shutdown", ".try_shutdown")},
        ),
        Example(
            "in a callback, before the end of the program",
            {
                "talker.py": _CALLBACK.format("rclpy.shutdown()"),
                "other.py": _CALLBACK.format("raise SystemExit"),
            },
            Report(
                "talker.py:18:5",
                "rclpy is already shut down by the callback in line 11: RuntimeError; use "
                "try_shutdown()",
                fix="Replace with try_shutdown()",
            ),
            fixed={"talker.py": _CALLBACK.format("rclpy.shutdown()")[:-11] + "try_shutdown()\n"},
        ),
        Example("after a handler that returns", {"talker.py": _AFTER.format("return", "shutdown")}),
        Example(
            "in the handler",
            {"talker.py": _AFTER.format("rclpy.shutdown()", "try_shutdown")},
            Report(
                "10:9",
                "rclpy is already shut down after Ctrl-C: RCLError; use try_shutdown()",
                fix="Replace with try_shutdown()",
            ),
            fixed={"talker.py": _AFTER.format("rclpy.try_shutdown()", "try_shutdown")},
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        words = [word.arg for init in file.init_calls for word in init.call.keywords]
        if "signal_handler_options" in words:
            return  # signal handlers may not shut down rclpy
        for call in file.shutdown_calls:
            if call.name != "shutdown" or call.asks_ok or call.call.args or call.call.keywords:
                continue
            earlier = _shut_down_by(file, call)
            if not earlier or not call.handlers.isdisjoint({"Exception", "BaseException"}):
                continue
            _, end = file.module.span(call.call.func)
            start = end - len("shutdown")
            edit = Edit(file.module.path, start, end, "try_shutdown")
            fix = None
            if file.module.source.text[start:end] == "shutdown":
                fix = Fix("Replace with try_shutdown()", (edit,))
            message = f"rclpy is already shut down {earlier}; use try_shutdown()"
            yield self.report(call, message, fix, cause="unclean shutdown")


def _shut_down_by(file: RclpyFile, call: RclpyCall) -> str:
    """Describe what has shut down rclpy before a call does, and the error; empty if unknown."""
    statement = file.module.parent(call.call)
    around = {statement, *(file.module.parents(call.call) if call.in_finally else ())}
    spins = [spin for spin in file.spin_calls if spin.function is call.function]
    caught = [spin for spin in spins if spin.catches_keyboard_interrupt]
    if any(after in around for spin in caught for after in run_after_interrupt(file, spin)):
        return "after Ctrl-C: RCLError"
    if not any(after in around for spin in spins for after in run_after_return(file, spin)):
        return ""
    for other in file.shutdown_calls:
        if other is call or other.function not in phases_of(file).running:
            continue
        if other.function is not None and not any(map(leaves, ast.walk(other.function))):
            return f"by the callback in line {other.location.line}: RuntimeError"
    return ""
