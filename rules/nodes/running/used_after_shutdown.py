"""ND140: nodes publish as long as rclpy runs and they exist."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Example, RclpyRule
from scaffold.api.python import is_handled
from scaffold.api.rclpy import RclpyFile, class_of

from ._interrupts import following, run_after_interrupt

_PUBLISHING = {
    "publish": "rclpy.publisher.Publisher",
    "sendTransform": "tf2_ros.TransformBroadcaster",
}
_MOST_CALLS = 3
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
                "driver.py": _MAIN.format(
                    _PUBLISH, "signal_handler_options=SignalHandlerOptions.NO", _STOP
                ).replace(
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
            "after Ctrl-C",
            {"driver.py": _MAIN.format(_PUBLISH, "", _STOP)},
            "23:9: stop() publishes in line 12, after Ctrl-C, which shuts down rclpy: RCLError, "
            "and nothing is sent; use SignalHandlerOptions.NO",
        ),
        Example(
            "after Ctrl-C, in the handler",
            {
                "driver.py": _MAIN.format(_PUBLISH, "", "        rclpy.try_shutdown()\n").replace(
                    "pass", "node.pub.publish(Twist())"
                )
            },
            "21:9: publish() after Ctrl-C, which shuts down rclpy: RCLError, and nothing is sent; "
            "use SignalHandlerOptions.NO",
        ),
        Example(
            "after the shutdown, and after the node was destroyed",
            {
                "driver.py": _MAIN.format(
                    _PUBLISH, "", "        node.destroy_node()\n        node.stop()\n"
                ).replace("except KeyboardInterrupt:", "except RuntimeError:"),
                "late.py": _MAIN.format(
                    _PUBLISH, "", "        rclpy.shutdown()\n        node.stop()\n"
                ).replace("except KeyboardInterrupt:", "except RuntimeError:"),
            },
            "driver.py:24:9: stop() publishes in line 12, after Ctrl-C, which shuts down rclpy: "
            "RCLError, and nothing is sent; use SignalHandlerOptions.NO",
            "late.py:24:9: stop() publishes in line 12, after Ctrl-C, which shuts down rclpy: "
            "RCLError, and nothing is sent; use SignalHandlerOptions.NO",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        reported: set[ast.AST] = set()
        for statements, of, event, error in _stretches(file):
            for call, what in _uses(file, statements, of):
                if call not in reported:
                    reported.add(call)
                    yield self.report(file.module.location(call), f"{what} after {event}: {error}")
                break  # raises, so that nothing after it runs


def _stretches(file: RclpyFile) -> Iterator[tuple[Sequence[ast.stmt], str, str, str]]:
    """Yield statements that run after an event, the node it is about or "", and its error."""
    words = [word.arg for init in file.init_calls for word in init.call.keywords]
    has_handlers = file.init_calls and "signal_handler_options" not in words
    if has_handlers and not file.module.mentions("signal.signal", "install_signal_handlers"):
        for spin in file.spin_calls:
            error = "RCLError, and nothing is sent; use SignalHandlerOptions.NO"
            yield [*run_after_interrupt(file, spin)], "", "Ctrl-C, which shuts down rclpy", error
    for shutdown in file.shutdown_calls:
        statement = file.module.parent(shutdown.call)
        if isinstance(statement, ast.Expr) and not shutdown.call.args:
            event = f"the shutdown in line {statement.lineno}"
            yield following(file, statement), "", event, "RCLError, and nothing is sent"
    for attribute in file.module.index.attributes("destroy_node"):
        call = file.module.parent(attribute)
        statement = file.module.parent(call) if isinstance(call, ast.Call) else None
        if isinstance(statement, ast.Expr) and isinstance(attribute.value, ast.Name):
            event = f"destroy_node() in line {statement.lineno}"
            error = "InvalidHandle, and nothing is sent"
            yield following(file, statement), attribute.value.id, event, error


def _uses(
    file: RclpyFile, statements: Sequence[ast.stmt], of: str
) -> Iterator[tuple[ast.Call, str]]:
    """Yield the calls in some statements that publish, directly or in a method of the node."""
    for statement in statements:
        for call in file.module.below(statement, ast.Call):
            if file.module.qualified_name(call.func) == "rclpy.init":
                return
            if not isinstance(call.func, ast.Attribute) or _is_guarded(file, call):
                continue
            if of and not ast.unparse(call.func).startswith(f"{of}."):
                continue
            if _publishes(file, call):
                yield call, f"{call.func.attr}()"
            elif line := _publishes_in(file, call):
                yield call, f"{call.func.attr}() publishes in {line},"
        if of and any(
            isinstance(name.ctx, ast.Store) and name.id == of
            for name in file.module.below(statement, ast.Name)
        ):
            return


def _publishes(file: RclpyFile, call: ast.Call) -> bool:
    match call.func:
        case ast.Attribute(attr="publish", value=ast.Attribute(value=holder, attr=name)):
            node = file.owner_of(holder)
            if node is not None and any(item.attribute == name for item in node.publishers):
                return True
    match call.func:
        case ast.Attribute(attr=name, value=owner) if name in _PUBLISHING:
            return class_of(file, owner) == _PUBLISHING[name]
    return False


def _publishes_in(file: RclpyFile, call: ast.Call, depth: int = 0) -> str:
    """Return the line where a called method publishes in any case; empty if it does not."""
    other, function = file.definition_of(call.func) or (file, None)
    for inner in other.calls_in(function) if isinstance(function, ast.FunctionDef) else ():
        if _is_guarded(other, inner):
            continue
        if _publishes(other, inner):
            return f"line {inner.lineno}" + ("" if other is file else f" of {other.module.path}")
        line = _publishes_in(other, inner, depth + 1) if depth < _MOST_CALLS else ""
        if line:
            return line if other is file or " of " in line else f"{line} of {other.module.path}"
    return ""


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
