"""ND009: the context is shut down once."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report, Severity
from scaffold.api.rclpy import RclpyCall, RclpyFile

_MAIN = (
    "import rclpy\n\n\n"
    "def main():\n    rclpy.init()\n    node = rclpy.create_node('talker')\n"
    "    try:\n        rclpy.spin(node)\n"
    "    except KeyboardInterrupt:\n        pass\n    finally:\n        rclpy.{}()\n"
)
_AFTER = _MAIN.replace("pass\n    finally:\n        rclpy", "{}\n    rclpy")


class ShutdownRepeated(RclpyRule):
    """``rclpy.shutdown()`` runs after a signal has already shut rclpy down.

    **Why.** The handler of SIGINT and SIGTERM calls it first: ``RCLError: rcl_shutdown already
    called on the given context``, and the node exits with an error.

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
            if self._is_caught(call.handlers):
                continue
            spins = [spin for spin in file.spin_calls if spin.function is call.function]
            spins = [spin for spin in spins if spin.catches_keyboard_interrupt]
            if not any(call.in_finally or _follows(file, call, spin) for spin in spins):
                continue
            _, end = file.module.span(call.call.func)
            start = end - len("shutdown")
            edit = Edit(file.module.path, start, end, "try_shutdown")
            fix = None
            if file.module.source.text[start:end] == "shutdown":
                fix = Fix("Replace with try_shutdown()", (edit,))
            message = "rclpy is already shut down after Ctrl-C: RCLError; use try_shutdown()"
            yield self.report(call, message, fix, cause="unclean shutdown")

    def _is_caught(self, handlers: frozenset[str]) -> bool:
        return not handlers.isdisjoint({"Exception", "BaseException"})


def _follows(file: RclpyFile, call: RclpyCall, spin: RclpyCall) -> bool:
    """Return whether a shutdown runs once the exception of Ctrl-C has been caught."""
    statement = file.module.parent(call.call)
    if statement is None:
        return False
    for parent in file.module.parents(spin.call):
        if not isinstance(parent, ast.Try):
            continue
        handlers = [handler for handler in parent.handlers if _catches_interrupt(file, handler)]
        if not handlers:
            continue
        if statement in handlers[0].body:
            return True
        block, number = file.module.index.place(parent)
        other, later = file.module.index.place(statement)
        is_same = file.module.parent(parent) is file.module.parent(statement) and block == other
        return is_same and later > number and not any(map(_leaves_function, ast.walk(handlers[0])))
    return False


def _catches_interrupt(file: RclpyFile, handler: ast.ExceptHandler) -> bool:
    if handler.type is None:
        return True
    caught = file.evaluator.single_value(handler.type)
    types = caught.elts if isinstance(caught, ast.Tuple) else [caught]
    names = {name for type_ in types for name in file.module.qualified_names(type_)}
    return not names.isdisjoint({"KeyboardInterrupt", "BaseException"})


def _leaves_function(node: ast.AST) -> bool:
    match node:
        case ast.Return() | ast.Raise() | ast.Name(id="exit" | "quit"):
            return True
        case ast.Attribute(attr="exit" | "_exit" | "shutdown" | "try_shutdown"):
            return True
    return False
