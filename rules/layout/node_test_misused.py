"""LY049: tests of nodes initialize rclpy, spin, and end."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.python_module import PythonModule
from scaffold.model.test_files import LAUNCH, TestFunction, arguments, test_functions, test_modules

_SPINS = frozenset({"rclpy.spin"})
_WAYS_OUT = (
    *(
        "Thread(",
        "threading",
        "Timer",
        "timer",
        "multiprocessing",
        "concurrent",
        "signal",
        "timeout",
    ),
    *("shutdown_callback", "on_shutdown", "sys.exit", "subprocess", "raise "),
)
_TEST = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "def test_node():\n    {}\n    node = Node('node')\n    got = []\n"
    "    node.create_subscription(String, 'text', got.append, 10)\n    {}\n    assert got\n"
)


class NodeTestMisused(Rule):
    """A test makes a node without rclpy.init(), waits for messages without spinning, or never ends.

    **Why.** ``NotInitializedException: rclpy.init() has not been called``; ``Context.init() must
    only be called once`` in the second test; no callback is ever called; ``rclpy.spin`` in a test
    returns only when somebody shuts down, so ``colcon test`` hangs.

    **Fix.** A fixture with ``rclpy.init()``, ``yield`` and ``rclpy.shutdown()``; ``spin_once`` with
    ``timeout_sec`` until a deadline.

    **Source.** rclpy, ``context.py``, ``node.py``, ``executors.py``.
    """

    code = "LY049"
    name = "node-test-misused"
    examples = (
        Example(
            "right",
            {
                "test/test_node.py": _TEST.format(
                    "rclpy.init()", "rclpy.spin_once(node, timeout_sec=1.0)"
                )
            },
        ),
        Example(
            "no init, nothing spins",
            {"test/test_node.py": _TEST.format("pass", "pass")},
            at=("test/test_node.py:8", "test/test_node.py:10"),
        ),
        Example(
            "never ends",
            {"test/test_node.py": _TEST.format("rclpy.init()", "rclpy.spin(node)")},
            at=("test/test_node.py:11",),
        ),
        Example(
            "initialized again",
            {
                "test/test_node.py": "import rclpy\n\n\ndef test_one():\n    rclpy.init()\n\n\n"
                "def test_two():\n    rclpy.init()\n"
            },
            at=("test/test_node.py:9",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        around = [one for one in package.modules() if one.path.endswith("conftest.py")]
        for module in test_modules(package):
            if "rclpy" not in module.imports_by_root or LAUNCH in module.functions:
                continue
            if module.has_main_guard or "launch_pytest" in module.imports_by_root:
                continue
            texts = "\n".join(one.source.text for one in [module, *around])
            seen: list[ast.Call] = []
            for test in test_functions(module):
                for node in ast.walk(test.node):
                    if isinstance(node, ast.Call):
                        problem = _problem(module, test, node, texts, seen)
                        if problem:
                            yield self.report(module.location(node), problem)


def _problem(
    module: PythonModule, test: TestFunction, call: ast.Call, texts: str, inits: list[ast.Call]
) -> str:
    name = module.qualified_name(call.func) or ""
    own = test.class_ is None and set(arguments(test.node)) <= {"monkeypatch", "capsys", "tmp_path"}
    if name == "rclpy.init" and own and "shutdown" not in texts and not call.keywords:
        inits.append(call)
        if len(inits) > 1:
            line = module.location(inits[0]).line
            return f"the test of line {line} calls init() as well, and nothing shuts down"
    elif name in {"rclpy.node.Node", "rclpy.create_node"} and own and "init" not in texts:
        words = {word.arg for word in call.keywords}
        if words.isdisjoint({"context", None}):
            return "nothing calls rclpy.init() before this node is made: NotInitializedException"
    elif isinstance(call.func, ast.Attribute) and call.func.attr == "create_subscription":
        is_node = own and _is_made_here(module, call.func.value)
        if is_node and "spin" not in texts and _is_awaited(test, call):
            return "nothing spins in this test, so the callback is never called"
    elif (name in _SPINS or _is_executor(module, call)) and not any(
        word in texts for word in _WAYS_OUT
    ):
        is_last = "shutdown" not in _before(module, call)
        if is_last and module.enclosing_function(call) is test.node:
            return "nothing ends this: the test waits forever; use spin_once with timeout_sec"
    return ""


def _before(module: PythonModule, call: ast.Call) -> str:
    """Return the text of the file without the test that a call stands in."""
    function = module.enclosing_function(call)
    start, end = module.span(function) if function is not None else (0, 0)
    return module.source.text[:start] + module.source.text[end:]


def _is_awaited(test: TestFunction, call: ast.Call) -> bool:
    """Tell whether the callback collects messages that the test asserts to be there."""
    match call.args:
        case [_, _, ast.Attribute(value=ast.Name(id=name), attr="append"), *_]:
            wanted = (one.test for one in ast.walk(test.node) if isinstance(one, ast.Assert))
            return any(isinstance(one, ast.Name) and one.id == name for one in wanted)
    return False


def _is_made_here(module: PythonModule, node: ast.expr) -> bool:
    """Tell whether a name stands for a plain node that is made in the file."""
    return _made(module, node) in {"rclpy.node.Node", "rclpy.create_node"}


def _is_executor(module: PythonModule, call: ast.Call) -> bool:
    """Tell whether this is ``spin()`` of an executor that is made in the file."""
    match call.func:
        case ast.Attribute(value=holder, attr="spin"):
            return _made(module, holder).endswith("ThreadedExecutor")
    return False


def _made(module: PythonModule, node: ast.expr) -> str:
    """Return the full name of what is called for the only value of a name."""
    if not isinstance(node, ast.Name):
        return ""
    found = module.index.lookup(node.id, node)
    values = [binding.value for binding in found[1]] if found else []
    made = values[0] if len(values) == 1 else None
    return (module.qualified_name(made.func) or "") if isinstance(made, ast.Call) else ""
