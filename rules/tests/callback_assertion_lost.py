"""TS078: tests assert in the main thread."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, TestRule
from scaffold.api.python import PythonModule

_TEST = (
    "import threading\n\nimport rclpy\nfrom std_msgs.msg import String\n\n\n"
    "def test_talker(node):\n"
    "    {}\n"
    "    received = []\n\n"
    "    def check(msg):\n"
    "        {}\n\n"
    "    node.create_subscription(String, 'chatter', check, 10)\n"
    "    wait_for(received)\n"
)
_THREAD = "threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()"
_MAKERS = ("create_subscription", "create_timer", "create_service", "add_done_callback")


class CallbackAssertionLost(TestRule):
    """A test asserts in a callback that runs in another thread.

    **Why.** The ``AssertionError`` only ends that thread, and pytest does not notice it: the test
    always passes.

    **Fix.** Collect the messages in the callback, and assert in the test function.

    **Source.** Python documentation, ``threading.excepthook``: exceptions end their thread alone.
    """

    code = "TS078"
    name = "callback-assertion-lost"
    examples = (
        Example("collected", {"test/test_a.py": _TEST.format(_THREAD, "received.append(msg)")}),
        Example(
            "spun by the test itself",
            {"test/test_a.py": _TEST.format("rclpy.spin_once(node)", "assert msg.data")},
        ),
        Example(
            "an assertion for type checkers",
            {"test/test_a.py": _TEST.format(_THREAD, "assert msg is not None")},
        ),
        Example(
            "asserted in the other thread",
            {"test/test_a.py": _TEST.format(_THREAD, "assert msg.data == 'hello'")},
            "12:9: this callback runs in another thread: a failure only ends that thread, and the "
            "test passes; collect the messages, and assert in the test",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        if not _spins_in_thread(module):
            return
        for call, _ in module.method_calls(*_MAKERS):
            for argument in (*call.args, *(word.value for word in call.keywords)):
                for node in _assertions(module, argument):
                    message = (
                        "this callback runs in another thread: a failure only ends that thread, "
                        "and the test passes; collect the messages, and assert in the test"
                    )
                    yield self.report(module.location(node), message)


def _spins_in_thread(module: PythonModule) -> bool:
    """Return whether a thread spins, and the tests themselves do not."""
    in_threads: set[ast.AST] = set()
    for call in module.walk(ast.Call):
        if module.qualified_name(call.func) == "threading.Thread":
            for word in call.keywords:
                if word.arg == "target":
                    in_threads.update(ast.walk(word.value))
    spins = [
        node
        for node in module.walk(ast.Attribute)
        if node.attr.startswith("spin") and isinstance(node.ctx, ast.Load)
    ]
    return bool(spins) and all(node in in_threads for node in spins)


def _assertions(module: PythonModule, argument: ast.expr) -> Iterator[ast.AST]:
    """Yield the assertions in a function used as a callback."""
    if not isinstance(argument, ast.Name):
        return
    for binding in module.index.bindings_of(argument):
        if isinstance(binding.node, ast.FunctionDef):
            yield from (
                node
                for node in ast.walk(binding.node)
                if isinstance(node, ast.Assert) and not _narrows(node.test)
            )


def _narrows(test: ast.expr) -> bool:
    """Return whether an assertion is for type checkers: later code fails without it as well."""
    match test:
        case ast.Compare(
            left=ast.Name(), ops=[ast.IsNot()], comparators=[ast.Constant(value=None)]
        ):
            return True
        case ast.Call(func=ast.Name(id="isinstance"), args=[ast.Name(), _]):
            return True
    return False
