"""TS076: tests of nodes end."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.api.python import FunctionNode, PythonModule
from scaffold.api.tests import (
    constructed_class,
    fixture_decorator,
    node_tests,
    own_fixtures,
    test_functions,
)

_WAYS_OUT = (
    *("Thread(", "threading", "Timer", "timer", "multiprocessing", "concurrent", "signal"),
    *("timeout", "shutdown_callback", "on_shutdown", "sys.exit", "subprocess", "raise "),
)
_TEST = (
    "import rclpy\nfrom rclpy.node import Node\n\n\ndef test_node():\n    rclpy.init()\n"
    "    node = Node('node')\n    {}\n    assert node.get_name() == 'node'\n"
)
_AROUND = ("setup", "teardown")


class TestNeverEnds(Rule):
    """A test spins a node or waits for a response without a timeout.

    **Why.** ``rclpy.spin`` only returns at shutdown, and ``client.call`` only if another thread
    spins the node: ``colcon test`` hangs.

    **Fix.** Use ``spin_once`` with ``timeout_sec`` until a deadline, or ``call_async`` and
    ``spin_until_future_complete`` with ``timeout_sec``.

    **Source.** rclpy, ``__init__.py``, ``executors.py``.
    """

    code = "TS076"
    name = "test-never-ends"
    examples = (
        Example(
            "spin_once", {"test/test_node.py": _TEST.format("rclpy.spin_once(node, timeout_sec=1)")}
        ),
        Example(
            "a response without spinning",
            {
                "test/test_node.py": _TEST.format(
                    "client = node.create_client(Trigger, 'a')\n    client.call(Trigger.Request())"
                )
            },
            "9:5: call() waits for a response while the node is not spun; use call_async, and "
            "spin until the future is done",
        ),
        Example(
            "a callback that shuts down",
            {
                "test/test_node.py": _TEST.format(
                    "node.create_subscription(str, 'a', lambda _: rclpy.shutdown(), 1)\n"
                    "    rclpy.spin(node)"
                )
            },
        ),
        Example(
            "a teardown that shuts down",
            {
                "test/test_node.py": _TEST.format("rclpy.spin(node)\n    rclpy.shutdown()")
                + "\n\ndef teardown_function():\n    rclpy.try_shutdown()\n"
            },
            "8:5: this never returns: the test hangs; use spin_once with timeout_sec",
        ),
        Example(
            "spin without an end",
            {"test/test_node.py": _TEST.format("rclpy.spin(node)")},
            "8:5: this never returns: the test hangs; use spin_once with timeout_sec",
        ),
        Example(
            "a fixture that spins",
            {
                "test/test_cam.py": "import pytest\nimport rclpy\n\n\n@pytest.fixture\n"
                "def cam():\n    rclpy.init()\n    node = rclpy.create_node('cam')\n"
                "    rclpy.spin(node)\n    yield node\n    node.destroy_node()\n\n\n"
                "def test_name(cam):\n    assert cam.get_name() == 'cam'\n"
            },
            "9:5: this never returns: the test hangs; use spin_once with timeout_sec",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for module, texts in node_tests(package):
            if any(word in texts for word in _WAYS_OUT):
                continue
            functions = [test.node for test in test_functions(module)]
            functions += [fixture.node for fixture in own_fixtures(module)]
            for function in functions:
                for node in ast.walk(function):
                    if not isinstance(node, ast.Call):
                        continue
                    if _waits(module, node):
                        message = "call() waits for a response while the node is not spun"
                        at = module.location(node)
                        yield self.report(
                            at, f"{message}; use call_async, and spin until the future is done"
                        )
                    if not _spins(module, node):
                        continue
                    is_own = module.enclosing_function(node) is function
                    if is_own and not _is_shut_down(module):
                        message = "this never returns: the test hangs"
                        at = module.location(node)
                        yield self.report(at, f"{message}; use spin_once with timeout_sec")


def _spins(module: PythonModule, call: ast.Call) -> bool:
    """Return whether a call is ``rclpy.spin``, or ``spin`` of an executor made in the file."""
    match call.func:
        case ast.Attribute(value=holder, attr="spin"):
            if constructed_class(module, holder).endswith("ThreadedExecutor"):
                return True
    return module.qualified_name(call.func) == "rclpy.spin"


def _waits(module: PythonModule, call: ast.Call) -> bool:
    """Return whether a call is ``call`` of a client created in the file."""
    match call.func:
        case ast.Attribute(value=ast.Name(id=name), attr="call"):
            lookup = module.index.lookup(name, call)
            values = [binding.value for binding in lookup[1]] if lookup else []
            made = values[0] if len(values) == 1 else None
            match made:
                case ast.Call(func=ast.Attribute(attr="create_client")):
                    return True
    return False


def _is_shut_down(module: PythonModule) -> bool:
    """Return whether code that may run during a test shuts down.

    Other tests, fixtures and teardown methods run before or after it.
    """
    names: list[tuple[ast.AST, str]] = [(node, node.id) for node in module.walk(ast.Name)]
    names += [(node, node.attr) for node in module.walk(ast.Attribute)]
    return any("shutdown" in name and not _runs_around_tests(module, node) for node, name in names)


def _runs_around_tests(module: PythonModule, node: ast.AST) -> bool:
    """Return whether a node is in a test, a fixture, or a setup or teardown function.

    Nested functions and lambdas may run at any time.
    """
    for parent in module.parents(node):
        match parent:
            case ast.Lambda():
                return False
            case ast.FunctionDef() | ast.AsyncFunctionDef():
                is_test = parent.name.startswith("test")
                is_around = parent.name.lower().startswith(_AROUND)
                is_fixture = fixture_decorator(module, parent) is not None
                return (is_test or is_around or is_fixture) and not _is_nested(module, parent)
    return False


def _is_nested(module: PythonModule, function: FunctionNode) -> bool:
    return any(
        isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda)
        for parent in module.parents(function)
    )
