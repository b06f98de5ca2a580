"""TS079: a test that waits for messages spins its node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.python import PythonModule
from scaffold.api.tests import node_tests, test_functions

_TEST = (
    "import time\n\nimport rclpy\nfrom std_msgs.msg import String\n\n\n"
    "def test_talker():\n"
    "    rclpy.init()\n"
    "    node = rclpy.create_node('test')\n"
    "    received = []\n"
    "    node.create_subscription(String, 'chatter', received.append, 10)\n"
    "    {}\n"
    "    assert received\n"
)
_WORDS = ("spin", "launch_testing", "Executor")


class WaitedWithoutSpin(Rule):
    """A test sleeps until a message has arrived, and nothing spins its node.

    **Why.** Callbacks run while somebody spins: nothing is ever received, and the assertion fails.

    **Fix.** ``rclpy.spin_once(node, timeout_sec=0.1)`` in a loop until it has arrived or a limit of
    time is over.

    **Source.** ROS 2 documentation, "Executors".
    """

    code = "TS079"
    name = "waited-without-spin"
    examples = (
        Example(
            "spun",
            {"test/test_a.py": _TEST.format("rclpy.spin_once(node, timeout_sec=1.0)")},
        ),
        Example(
            "slept",
            {"test/test_a.py": _TEST.format("time.sleep(0.5)")},
            Report(
                "12:5",
                "nothing spins the node while the test sleeps: no callback runs, "
                "and line 13 fails; call rclpy.spin_once() in a loop instead",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for module, texts in node_tests(package):
            if any(word in texts for word in _WORDS) or module.mentions(*_WORDS):
                continue
            for test in test_functions(module):
                sleeps = [call for call in _calls(test.node) if _is_sleep(module, call)]
                filled = {name for call in _calls(test.node) for name in _filled(call)}
                for node in ast.walk(test.node):
                    if not isinstance(node, ast.Assert) or not sleeps:
                        continue
                    names = {item.id for item in ast.walk(node) if isinstance(item, ast.Name)}
                    if names & filled and sleeps[0].lineno < node.lineno:
                        message = (
                            "nothing spins the node while the test sleeps: no callback runs, and "
                            f"line {node.lineno} fails; call rclpy.spin_once() in a loop instead"
                        )
                        yield self.report(module.location(sleeps[0]), message)
                        break


def _calls(function: ast.AST) -> Iterator[ast.Call]:
    return (node for node in ast.walk(function) if isinstance(node, ast.Call))


def _is_sleep(module: PythonModule, call: ast.Call) -> bool:
    return module.qualified_name(call.func) == "time.sleep"


def _filled(call: ast.Call) -> Iterator[str]:
    """Yield the lists that a subscription appends to."""
    if isinstance(call.func, ast.Attribute) and call.func.attr == "create_subscription":
        for node in (*call.args, *(word.value for word in call.keywords)):
            match node:
                case ast.Attribute(value=ast.Name(id=name), attr="append"):
                    yield name
                case ast.Lambda(body=body):
                    yield from (item.id for item in ast.walk(body) if isinstance(item, ast.Name))
