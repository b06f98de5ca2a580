"""TS049: tests of nodes initialize rclpy and spin the node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.api.parameters import own_nodes
from scaffold.api.python import FunctionNode, PythonModule, last_name
from scaffold.api.tests import (
    Fixture,
    TestFunction,
    arguments,
    constructed_class,
    fixtures,
    node_tests,
    own_fixtures,
    test_functions,
)

from ._collected_messages import appended_lists

_TEST = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "def test_node():\n    {}\n    node = Node('node')\n    got = []\n"
    "    node.create_subscription(String, 'text', got.append, 10)\n    {}\n    assert got\n"
)
_TEST_SPIN = (
    "import time\n\nimport rclpy\nfrom std_msgs.msg import String\n\n\n"
    "def test_talker():\n"
    "    rclpy.init()\n"
    "    node = rclpy.create_node('test')\n"
    "    received = []\n"
    "    node.create_subscription(String, 'chatter', received.append, 10)\n"
    "    {}\n"
    "    assert received\n"
)
_NO_INIT = "rclpy.init() is not called before this node is constructed: NotInitializedException"
_WORDS = ("spin", "launch_testing", "Executor")
_FIXTURE = (
    "import pytest\nimport rclpy\n\nfrom demo.talker import Talker\n\n\n"
    "@pytest.fixture\ndef node():\n{}    node = Talker()\n    yield node\n"
    "    rclpy.shutdown()\n\n\ndef test_node(node):\n    assert node\n"
)


class NodeTestMisused(Rule):
    """A test creates a node without rclpy.init(), or waits for messages without spinning.

    **Why.** ``NotInitializedException: rclpy.init() has not been called``; ``Context.init() must
    only be called once`` in the second test. Callbacks only run while the node is spun: without
    that, nothing is received, and the assertion fails.

    **Fix.** Write a fixture with ``rclpy.init()``, ``yield`` and ``rclpy.shutdown()``; call
    ``spin_once`` with ``timeout_sec=0.1`` in a loop until the message arrives or a timeout expires.

    **Source.** rclpy, ``context.py``, ``node.py``, ``executors.py``; ROS 2 documentation,
    "Executors".
    """

    code = "TS049"
    name = "node-test-misused"
    examples = (
        Example(
            "a node of the package, without init() and with it",
            {
                "demo/talker.py": "from rclpy.node import Node\n\n\nclass Talker(Node):\n"
                "    def __init__(self):\n        super().__init__('talker')\n",
                "test/test_a.py": _FIXTURE.format(""),
                "test/test_b.py": _FIXTURE.format("    rclpy.init()\n"),
            },
            "test/test_a.py:9:12: rclpy.init() is not called before this node is constructed: "
            "NotInitializedException",
        ),
        Example(
            "a valid test",
            {
                "test/test_node.py": _TEST.format(
                    "rclpy.init()", "rclpy.spin_once(node, timeout_sec=1.0)"
                )
            },
        ),
        Example(
            "no init, no spin",
            {"test/test_node.py": _TEST.format("pass", "pass")},
            "8:12: rclpy.init() is not called before this node is constructed: "
            "NotInitializedException",
            "10:5: this test never spins the node, so the callback is never called",
        ),
        Example(
            "initialized again",
            {
                "test/test_node.py": "import rclpy\n\n\ndef test_one():\n    rclpy.init()\n\n\n"
                "def test_two():\n    rclpy.init()\n"
            },
            "9:5: the test in line 5 also calls init(), but shutdown() is never called: the "
            "second test fails",
        ),
        Example(
            "spins until the message arrives",
            {"test/test_a.py": _TEST_SPIN.format("rclpy.spin_once(node, timeout_sec=1.0)")},
        ),
        Example(
            "sleeps until the message arrives",
            {"test/test_a.py": _TEST_SPIN.format("time.sleep(0.5)")},
            "11:5: this test never spins the node, so the callback is never called",
            "12:5: the node is not spun while the test sleeps: no callback runs, and line 13 "
            "fails; call rclpy.spin_once() in a loop instead",
        ),
        Example(
            "a test that does not request the fixture with init()",
            {
                "package.xml": "<package><name>demo</name></package>\n",
                "demo/__init__.py": "",
                "demo/talker.py": "from rclpy.node import Node\n\n\nclass Talker(Node):\n"
                "    def __init__(self):\n        super().__init__('talker')\n",
                "test/test_talker.py": "import pytest\nimport rclpy\n\n"
                "from demo.talker import Talker\n\n\n"
                "@pytest.fixture\ndef context():\n    rclpy.init()\n    yield\n"
                "    rclpy.shutdown()\n\n\n"
                "def test_name(context):\n    assert Talker().get_name() == 'talker'\n\n\n"
                "def test_space():\n    assert Talker().get_namespace() == '/'\n",
            },
            "test/test_talker.py:19:12: rclpy.init() is not called before this node is "
            "constructed: NotInitializedException",
        ),
        Example(
            "a fixture for two tests that does not shut rclpy down",
            {
                "test/test_two.py": "import pytest\nimport rclpy\n\n\n@pytest.fixture\n"
                "def node():\n    rclpy.init()\n    node = rclpy.create_node('two')\n"
                "    yield node\n    node.destroy_node()\n\n\n"
                "def test_name(node):\n    assert node.get_name() == 'two'\n\n\n"
                "def test_space(node):\n    assert node.get_namespace() == '/'\n"
            },
            "7:5: each test calls init() again, but shutdown() is never called: the second test "
            "fails; call rclpy.shutdown() after the yield",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_init(package)
        yield from self._check_fixtures(package)
        yield from self._check_spin(package)

    def _check_init(self, package: Package) -> Iterator[Diagnostic]:
        for module, texts in node_tests(package):
            seen: list[ast.Call] = []
            for test in test_functions(module):
                for node in _calls(test.node):
                    problem = _problem(module, test, node, texts, seen)
                    if problem:
                        yield self.report(module.location(node), problem)
            makers = [test.node for test in test_functions(module) if test.class_ is None]
            fixtures_made = [it.node for it in own_fixtures(module)] if "init" not in texts else []
            for maker in [*makers, *fixtures_made] if "patch" not in texts else ():
                if "init" in texts and not _is_without_init(package, module, maker):
                    continue
                for call in _calls(maker):
                    if _is_own_node(package, module, call):
                        yield self.report(module.location(call), _NO_INIT)

    def _check_fixtures(self, package: Package) -> Iterator[Diagnostic]:
        for module, texts in node_tests(package):
            if "shutdown" in texts:
                continue
            asked = [name for test in test_functions(module) for name in arguments(test.node)]
            for fixture in own_fixtures(module):
                inits = [it for it in _calls(fixture.node) if _is_init(module, it)]
                if inits and fixture.scope == "function" and asked.count(fixture.name) > 1:
                    message = (
                        "each test calls init() again, but shutdown() is never called: the second "
                        "test fails; call rclpy.shutdown() after the yield"
                    )
                    yield self.report(module.location(inits[0]), message)

    def _check_spin(self, package: Package) -> Iterator[Diagnostic]:
        for module, texts in node_tests(package):
            if any(word in texts for word in _WORDS) or module.mentions(*_WORDS):
                continue
            for test in test_functions(module):
                sleeps = [call for call in _calls(test.node) if _is_sleep(module, call)]
                filled = {name for call in _calls(test.node) for name in appended_lists(call)}
                for node in ast.walk(test.node):
                    if not isinstance(node, ast.Assert) or not sleeps:
                        continue
                    names = {item.id for item in ast.walk(node) if isinstance(item, ast.Name)}
                    if names & filled and sleeps[0].lineno < node.lineno:
                        message = (
                            "the node is not spun while the test sleeps: no callback runs, and "
                            f"line {node.lineno} fails; call rclpy.spin_once() in a loop instead"
                        )
                        yield self.report(module.location(sleeps[0]), message)
                        break


def _problem(
    module: PythonModule, test: TestFunction, call: ast.Call, texts: str, inits: list[ast.Call]
) -> str:
    name = module.qualified_name(call.func) or ""
    own = test.class_ is None and set(arguments(test.node)) <= {"monkeypatch", "capsys", "tmp_path"}
    if name == "rclpy.init" and own and "shutdown" not in texts and not call.keywords:
        inits.append(call)
        if len(inits) > 1:
            line = module.location(inits[0]).line
            return (
                f"the test in line {line} also calls init(), but shutdown() is never called: "
                f"the second test fails"
            )
    elif name in {"rclpy.node.Node", "rclpy.create_node"} and own and "init" not in texts:
        words = {word.arg for word in call.keywords}
        if words.isdisjoint({"context", None}):
            return _NO_INIT
    elif isinstance(call.func, ast.Attribute) and call.func.attr == "create_subscription":
        is_node = own and _is_made_here(module, call.func.value)
        if is_node and "spin" not in texts and _is_awaited(test, call):
            return "this test never spins the node, so the callback is never called"
    return ""


def _is_without_init(package: Package, module: PythonModule, test: FunctionNode) -> bool:
    """Return whether only fixtures that a test does not request call init(), and shut down again.

    Any other mention of an initialization may take effect in the test.
    """
    available = fixtures(package, module)
    requested, pending = {test}, arguments(test)
    while pending:
        fixture = available.get(pending.pop())
        if fixture is None:
            return False
        if fixture.node not in requested:
            requested.add(fixture.node)
            pending += arguments(fixture.node)
    ending = {
        it.node: it.module
        for it in available.values()
        if it.node not in requested and _is_ended(it)
    }
    modules = {module, *(it.module for it in available.values())}
    return all(
        any(parent in ending for parent in other.parents(node))
        for other in modules
        for node in (*other.walk(ast.Name), *other.walk(ast.Attribute))
        if "init" in last_name(node).lower()
    )


def _is_ended(fixture: Fixture) -> bool:
    """Return whether a fixture that only some tests use also shuts rclpy down."""
    text = fixture.module.text(fixture.node)
    is_for_all = "autouse" in text or fixture.scope != "function"
    return "shutdown" in text and not is_for_all


def _is_own_node(package: Package, module: PythonModule, call: ast.Call) -> bool:
    """Return whether a call makes a node of the package, which does not call init() itself."""
    name = module.qualified_name(call.func) or ""
    for node in own_nodes(package)[0]:
        dotted = node.path.removesuffix(".py").replace("/", ".")
        if node.is_class and name == f"{dotted}.{node.name}":
            own = node.definition(package).file
            return not any(own.module.enclosing_class(init.call) for init in own.init_calls)
    return False


def _is_init(module: PythonModule, call: ast.Call) -> bool:
    return module.qualified_name(call.func) == "rclpy.init" and not call.keywords


def _is_awaited(test: TestFunction, call: ast.Call) -> bool:
    """Return whether the callback collects messages that the test asserts."""
    match call.args:
        case [_, _, ast.Attribute(value=ast.Name(id=name), attr="append"), *_]:
            wanted = (item.test for item in ast.walk(test.node) if isinstance(item, ast.Assert))
            return any(isinstance(item, ast.Name) and item.id == name for item in wanted)
    return False


def _is_made_here(module: PythonModule, node: ast.expr) -> bool:
    """Return whether a name refers to a plain node that is created in the file."""
    return constructed_class(module, node) in {"rclpy.node.Node", "rclpy.create_node"}


def _calls(function: ast.AST) -> Iterator[ast.Call]:
    return (node for node in ast.walk(function) if isinstance(node, ast.Call))


def _is_sleep(module: PythonModule, call: ast.Call) -> bool:
    return module.qualified_name(call.func) == "time.sleep"
