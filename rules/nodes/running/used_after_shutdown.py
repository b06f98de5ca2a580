"""ND140: nodes publish only before rclpy is shut down and they are destroyed."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from scaffold.api import Diagnostic, Example, Location, RclpyRule
from scaffold.api.python import is_handled
from scaffold.api.rclpy import RclpyFile, class_of

from ._interrupts import following, run_after_interrupt

_PUBLISHING = {
    "publish": "rclpy.publisher.Publisher",
    "sendTransform": "tf2_ros.TransformBroadcaster",
}
_MAX_DEPTH = 3
"""Deeper calls are not followed."""
_MAIN = (
    "import rclpy\nfrom geometry_msgs.msg import Twist\nfrom rclpy.node import Node\n\n\n"
    "class Driver(Node):\n"
    "    def __init__(self):\n        super().__init__('driver')\n"
    "        self.pub = self.create_publisher(Twist, 'cmd_vel', 10)\n\n"
    "    def stop(self):\n{}\n\n"
    "def main():\n    rclpy.init({})\n    node = Driver()\n"
    "    try:\n        rclpy.spin(node)\n"
    "    except KeyboardInterrupt:\n        pass\n"
    "    finally:\n{}"
)
_PUBLISH = "        self.pub.publish(Twist())\n"
_NO = "signal_handler_options=SignalHandlerOptions.NO"
_STOP = "        node.stop()\n        node.destroy_node()\n        rclpy.try_shutdown()\n"


class UsedAfterShutdown(RclpyRule):
    """A node publishes after Ctrl-C, or after it was destroyed.

    **Why.** The handler of SIGINT and SIGTERM shuts down rclpy before ``KeyboardInterrupt`` is
    raised: ``RCLError: Failed to publish: publisher's context is invalid``. The robot does not get
    the command to stop. After ``destroy_node()`` it is an ``InvalidHandle``.

    **Fix.** Keep rclpy running until the node has published:
    ``rclpy.init(signal_handler_options=SignalHandlerOptions.NO)``.

    **Source.** https://github.com/ros2/rclpy/issues/1077; ``rclpy/signals.py``.
    """

    code = "ND140"
    name = "used-after-shutdown"
    examples = (
        Example(
            "signal handlers that leave rclpy running",
            {
                "driver.py": _MAIN.format(_PUBLISH, _NO, _STOP).replace(
                    "import Node\n", "import Node\nfrom rclpy.signals import SignalHandlerOptions\n"
                )
            },
        ),
        Example(
            "only while rclpy runs",
            {
                "driver.py": _MAIN.format("        if rclpy.ok():\n    " + _PUBLISH, "", _STOP),
                "tried.py": _MAIN.format(
                    _PUBLISH,
                    "",
                    "        try:\n            node.stop()\n"
                    "        except Exception as error:\n            print(error)\n",
                ),
            },
        ),
        Example(
            "before a spin that is in the finally",
            {
                "driver.py": _MAIN.format(
                    _PUBLISH, "", "        node.stop()\n        rclpy.spin(node)\n"
                ).replace(
                    "try:\n        rclpy.spin(node)\n    except",
                    "try:\n        print()\n    except",
                )
            },
        ),
        Example(
            "after Ctrl-C",
            {"driver.py": _MAIN.format(_PUBLISH, "", _STOP)},
            "23:9: stop() publishes (line 12) after Ctrl-C has shut down rclpy: RCLError, nothing "
            "is sent; use SignalHandlerOptions.NO",
        ),
        Example(
            "after Ctrl-C, in the handler",
            {
                "driver.py": _MAIN.format(_PUBLISH, "", "        rclpy.try_shutdown()\n").replace(
                    "pass", "node.pub.publish(Twist())"
                )
            },
            "21:9: publish() is called after Ctrl-C has shut down rclpy: RCLError, nothing is "
            "sent; use SignalHandlerOptions.NO",
        ),
        Example(
            "after the shutdown, and after the node was destroyed",
            {
                "destroyed.py": _MAIN.format(
                    _PUBLISH, _NO, "        node.destroy_node()\n        node.stop()\n"
                ),
                "late.py": _MAIN.format(
                    _PUBLISH, _NO, "        rclpy.shutdown()\n        node.stop()\n"
                ),
                "new.py": _MAIN.format(
                    _PUBLISH,
                    _NO,
                    "        node.destroy_node()\n        node = Driver()\n        node.stop()\n",
                ),
            },
            "destroyed.py:24:9: stop() publishes (line 12) after destroy_node() in line 23: "
            "InvalidHandle, nothing is sent",
            "late.py:24:9: stop() publishes (line 12) after the shutdown in line 23: RCLError, "
            "nothing is sent",
        ),
        Example(
            "in a method of a base class in another file",
            {
                "arm/base.py": _MAIN.format(_PUBLISH, "", "        pass\n"),
                "arm/run.py": "import rclpy\nfrom arm.base import Driver\n\n\n"
                "class Arm(Driver):\n    pass\n\n\n"
                "def main():\n    rclpy.init()\n    node = Arm()\n"
                "    rclpy.shutdown()\n    node.stop()\n",
                "arm/__init__.py": "",
                "package.xml": "<package><name>arm</name></package>\n",
            },
            "arm/run.py:13:5: stop() publishes (line 12 of arm/base.py) after the shutdown in "
            "line 12: RCLError, nothing is sent",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        reported: set[ast.AST] = set()
        for end in _ends(file):
            call, what = _first_publishing(file, end) or (None, "")
            if call is not None and call not in reported:
                reported.add(call)
                yield self.report(file.module.location(call), f"{what} after {end.event}")


class _End(NamedTuple):
    """The end of rclpy, or of a node."""

    event: str
    """What ends it, and the error that publishing raises then."""
    after: Sequence[ast.stmt]
    """The statements that run after it."""
    node: str = ""
    """The variable of the node; empty for all nodes."""


def _ends(file: RclpyFile) -> Iterator[_End]:
    words = [word.arg for init in file.init_calls for word in init.call.keywords]
    has_handlers = file.init_calls and "signal_handler_options" not in words
    if has_handlers and not file.module.mentions("signal.signal", "install_signal_handlers"):
        for spin in file.spin_calls:
            event = (
                "Ctrl-C has shut down rclpy: RCLError, nothing is sent; use SignalHandlerOptions.NO"
            )
            yield _End(event, [*run_after_interrupt(file, spin)])
    for shutdown in file.shutdown_calls:
        statement = file.module.parent(shutdown.call)
        if isinstance(statement, ast.Expr) and not shutdown.call.args:
            event = f"the shutdown in line {statement.lineno}: RCLError, nothing is sent"
            yield _End(event, following(file, statement))
    for call, method in file.module.method_calls("destroy_node"):
        statement = file.module.parent(call)
        if isinstance(statement, ast.Expr) and isinstance(method.value, ast.Name):
            event = f"destroy_node() in line {statement.lineno}: InvalidHandle, nothing is sent"
            yield _End(event, following(file, statement), method.value.id)


def _first_publishing(file: RclpyFile, end: _End) -> tuple[ast.Call, str] | None:
    """Return the first call after an end that publishes, itself or in a method; it raises."""
    for statement in end.after:
        for call in file.module.below(statement, ast.Call):
            if file.module.qualified_name(call.func) == "rclpy.init":
                return None
            if not isinstance(call.func, ast.Attribute) or _is_guarded(file, call):
                continue
            if end.node and not ast.unparse(call.func).startswith(f"{end.node}."):
                continue
            if _publishes(file, call):
                return call, f"{call.func.attr}() is called"
            if at := _publishing_in(file, call):
                of_file = "" if at.path == file.module.path else f" of {at.path}"
                return call, f"{call.func.attr}() publishes (line {at.line}{of_file})"
        names = file.module.below(statement, ast.Name) if end.node else ()
        if any(name.id == end.node and isinstance(name.ctx, ast.Store) for name in names):
            return None
    return None


def _publishes(file: RclpyFile, call: ast.Call) -> bool:
    match call.func:
        case ast.Attribute(attr="publish", value=ast.Attribute(value=holder, attr=attribute)):
            node = file.owner_of(holder)
            if node is not None and any(x.attribute == attribute for x in node.publishers):
                return True
    match call.func:
        case ast.Attribute(attr=name, value=owner) if name in _PUBLISHING:
            return class_of(file, owner) == _PUBLISHING[name]
    return False


def _publishing_in(file: RclpyFile, call: ast.Call, depth: int = 0) -> Location | None:
    """Return where a called method publishes in any case; ``None`` if it does not."""
    other, function = file.definition_of(call.func) or (file, None)
    for inner in other.calls_in(function) if isinstance(function, ast.FunctionDef) else ():
        if _is_guarded(other, inner):
            continue
        if _publishes(other, inner):
            return other.module.location(inner)
        at = _publishing_in(other, inner, depth + 1) if depth < _MAX_DEPTH else None
        if at is not None:
            return at
    return None


def _is_guarded(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether an error of a call is caught, or a condition may ask whether rclpy runs."""
    if is_handled(file.module, call, "RCLError"):
        return True
    for parent in file.module.parents(call):
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            return isinstance(parent, ast.Lambda)
        if isinstance(parent, ast.If | ast.While | ast.IfExp) and "ok" in ast.unparse(parent.test):
            return True
    return False
