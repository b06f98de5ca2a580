"""TS043: assertions can fail."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Severity, TestRule, ViewError
from scaffold.api.python import FunctionNode, PythonModule
from scaffold.api.rclpy import LOG_METHODS
from scaffold.api.tests import test_functions

from ._assertions_in_loops import loop_over_nothing
from ._collected_messages import appended_lists

_LOOPING = (
    "import rclpy\nfrom std_msgs.msg import String\n\n\n"
    "def test_text(node):\n"
    "    received = []\n"
    "    node.create_subscription(String, 'chatter', received.append, 10)\n"
    "    rclpy.spin_once(node, timeout_sec=1.0)\n"
    "    {}\n    {}\n"
)
_MOCKED = ("called_once", "called_with", "called_once_with", "not_called", "has_calls")
_ASSERTION = "def ready():\n    return False\n\n\ndef test_text():\n    assert {}\n"
_TEST = "import pytest\n\n\ndef ready():\n    return False\n\n\ndef test_text():\n{}"
_RECEIVED = (
    "import rclpy\nfrom std_msgs.msg import String\n\n\ndef test_talker(node):\n    got = []\n"
    "    node.create_subscription(String, 'talk', got.append, 10)\n"
    "    rclpy.spin_once(node, timeout_sec=1.0)\n{}\n        assert got[0].data == 'hi'\n"
)
_ENDS = frozenset({"pytest.fail", "pytest.skip", "pytest.xfail"})


class AssertionWithoutEffect(TestRule):
    """A test compares without asserting, or asserts something that is always true.

    **Why.** The test always passes: a comparison without ``assert``, ``pytest.raises`` without a
    block, ``assert`` in a ``try`` that discards the AssertionError, all assertions in a branch that
    needs a message. A function that is not called
    is always true, and so is a string that is not compared.

    **Fix.** Write ``assert``, or ``with pytest.raises(...):``; call the function; compare with the
    string.

    **Source.** pytest documentation, "How to write and report assertions in tests"; Python
    documentation, "Truth Value Testing"; ``unittest.mock``.
    """

    code = "TS043"
    name = "assertion-without-effect"
    severity = Severity.WARNING
    examples = (
        Example(
            "valid assertions",
            {
                "test/test_text.py": _TEST.format(
                    "    assert ready()\n    with pytest.raises(ValueError):\n        1 < ready()\n"
                )
            },
        ),
        Example(
            "what was received, if anything",
            {"test/test_text.py": _LOOPING.format("for msg in received:", "    assert msg.data")},
            "9:16: nothing is asserted if received is empty: the test passes when nothing "
            "arrives; assert before the loop that it is not",
        ),
        Example(
            "what was received, and that something was",
            {
                "test/test_text.py": _LOOPING.format(
                    "assert received", "for msg in received:\n        assert msg.data"
                )
            },
        ),
        Example(
            "a comparison without assert, raises without a block",
            {
                "test/test_text.py": _TEST.format(
                    "    1 == ready()\n    pytest.raises(ValueError)\n"
                )
            },
            "9:5: the result of this comparison is ignored; write assert before it",
            "10:5: nothing is called here, so nothing is tested; write `with pytest.raises(...):`",
        ),
        Example(
            "an AssertionError that is discarded",
            {
                "test/test_text.py": _TEST.format(
                    "    try:\n        assert ready()\n    except Exception:\n        pass\n"
                )
            },
            "11:5: this discards the AssertionError: the test always passes",
        ),
        Example(
            "an AssertionError that is printed, or that fails the test",
            {
                "test/test_text.py": _TEST.format(
                    "    try:\n        assert ready()\n    except Exception as error:\n"
                    "        print(f'failed: {error}')\n"
                ),
                "test/test_fail.py": _TEST.format(
                    "    try:\n        assert ready()\n    except Exception as error:\n"
                    "        print(error)\n        pytest.fail('not ready')\n"
                ),
            },
            "test/test_text.py:11:5: this discards the AssertionError: the test always passes",
        ),
        Example(
            "an assertion about a message that may not arrive",
            {
                "test/test_a.py": _RECEIVED.format("    assert got\n    if got:"),
                "test/test_b.py": _RECEIVED.format("    if got:"),
            },
            "test/test_b.py:9:5: asserts only if got is not empty: the test passes if no message "
            "arrives; assert got first",
        ),
        Example(
            "a length compared with zero",
            {"test/test_text.py": _ASSERTION.format("len('ab') > 0\n    assert len('ab') >= 0")},
            "7:5: a length is never negative: the assertion is always true; write > 0",
        ),
        Example("a function that is called", {"test/test_text.py": _ASSERTION.format("ready()")}),
        Example(
            "a function that is not called",
            {"test/test_text.py": _ASSERTION.format("ready")},
            "6:5: ready is a function, which is always true; call it",
        ),
        Example(
            "a string next to a comparison",
            {"test/test_text.py": _ASSERTION.format("ready() == 'a' or 'b'")},
            "6:5: one side of this `or` is always true; compare both sides",
        ),
        Example(
            "values in the message of the assertion",
            {"test/test_text.py": _ASSERTION.format("ready(), (ready(), [len('ab')])")},
        ),
        Example(
            "a comma instead of a comparison",
            {"test/test_text.py": _ASSERTION.format("len('ab'), 2\n    assert ready(), 'b'")},
            "6:5: the value after the comma is only the message: the assertion is always true; "
            "write == to compare",
        ),
        Example(
            "calls without parentheses, a mock, a string",
            {
                "test/test_a.py": _TEST.format("    pytest.skip\n"),
                "test/test_b.py": "import rclpy\n\n\n" + _ASSERTION.format("rclpy.ok"),
                "test/test_c.py": _ASSERTION.format("ready.called_once()"),
                "test/test_d.py": _ASSERTION.format("'ready'"),
            },
            "test/test_a.py:9:5: pytest.skip is not called; add the parentheses",
            "test/test_b.py:9:5: rclpy.ok is a function, which is always true; call it",
            "test/test_c.py:6:5: mocks have no called_once(): the call fails, or is always true; "
            "use assert_called_once()",
            "test/test_d.py:6:5: a non-empty string is always true: nothing is asserted",
        ),
        Example(
            "a method of a class in the package, called and not called",
            {
                "talker/__init__.py": "",
                "talker/node.py": "class Talker:\n"
                "    def is_done(self):\n        return False\n\n"
                "    @property\n    def is_new(self):\n        return True\n",
                "test/test_talker.py": "from talker.node import Talker\n\n\n"
                "def test_done():\n"
                "    talker = Talker()\n"
                "    assert talker.is_new\n"
                "    assert not talker.is_done()\n"
                "    assert talker.is_done\n",
            },
            "test/test_talker.py:8:5: is_done is a method, which is always true; call it",
        ),
    )

    def check_in(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        for test in test_functions(module):
            only = _only_if_received(test.node)
            if only is not None:
                name = module.text(only.test)
                message = (
                    f"asserts only if {name} is not empty: the test passes if no message arrives; "
                    f"assert {name} first"
                )
                yield self.report(module.location(only), message)
            loop = loop_over_nothing(module, test.node)
            if loop is not None:
                text = module.text(loop.iter)
                message = (
                    f"nothing is asserted if {text} is empty: the test passes when nothing "
                    "arrives; assert before the loop that it is not"
                )
                yield self.report(module.location(loop.iter), message, severity=Severity.WARNING)
            for node in ast.walk(test.node):
                at, problem = _problem(module, node)
                if isinstance(node, ast.Assert) and not problem:
                    problem = _uncalled(package, module, node.test)
                if problem:
                    yield self.report(module.location(at), problem)


def _only_if_received(test: FunctionNode) -> ast.If | None:
    """Return the condition around all assertions that is false if no message was received."""
    filled = {
        name
        for call in ast.walk(test)
        if isinstance(call, ast.Call)
        for name in appended_lists(call)
    }
    for statement in test.body:
        match statement:
            case ast.If(test=ast.Name(id=name), orelse=[]) if name in filled:
                inside = sum(map(_asserts, ast.walk(statement)))
                if inside and inside == sum(map(_asserts, ast.walk(test))):
                    return statement
    return None


def _asserts(node: ast.AST) -> bool:
    """Return whether a node may fail the test."""
    match node:
        case ast.Assert() | ast.Raise():
            return True
        case ast.Call(func=ast.Attribute(attr=name) | ast.Name(id=name)):
            return re.search(r"assert|fail|raises|skip|wait|expect|check", name) is not None
    return False


def _problem(module: PythonModule, node: ast.AST) -> tuple[ast.AST, str]:
    problem = ""
    match node:
        case ast.Assert(msg=ast.expr() as message) if _is_value(message):
            problem = (
                "the value after the comma is only the message: the assertion is always "
                "true; write == to compare"
            )
        case ast.Assert(test=condition):
            problem = _condition_problem(module, condition)
        case ast.Expr(value=value):
            problem = _statement_problem(module, value)
        case ast.Try(body=body, handlers=handlers) if any(
            isinstance(item, ast.Assert) for item in body
        ):
            for handler in handlers:
                if _drops(module, handler):
                    return handler, "this discards the AssertionError: the test always passes"
    return node, problem


def _uncalled(package: Package, module: PythonModule, condition: ast.expr) -> str:
    """Return the problem with an uncalled method of an object; empty if there is none."""
    match condition:
        case ast.Attribute(attr=name, value=ast.Name(id=variable) as owner):
            lookup = module.index.lookup(variable, owner)
            values = [binding.value for binding in lookup[1]] if lookup else []
            made = values[0] if len(values) == 1 else None
            full = module.qualified_name(made.func) if isinstance(made, ast.Call) else ""
            path, _, class_name = (full or "").rpartition(".")
            methods = _methods_of(package, f"{path.replace('.', '/')}.py", class_name)
            return f"{name} is a method, which is always true; call it" if name in methods else ""
    return ""


def _methods_of(package: Package, path: str, class_name: str) -> set[str]:
    """Return the plain methods of a class of a package; empty if it does not exist."""
    if not package.has(path):
        return set()
    try:
        class_ = package.module(path).classes.get(class_name)
    except ViewError:
        return set()
    body = class_.node.body if class_ is not None else []
    return {
        item.name for item in body if isinstance(item, ast.FunctionDef) and not item.decorator_list
    }


def _is_value(node: ast.expr) -> bool:
    """Return whether a message is a literal but not a string, like a value to compare with."""
    match node:
        case ast.List(elts=items) | ast.Tuple(elts=items):
            return all(isinstance(item, ast.Constant) or _is_value(item) for item in items)
        case ast.Constant(value=bool() | int() | float()):
            return True
    return False


def _statement_problem(module: PythonModule, value: ast.expr) -> str:
    match value:
        case ast.Compare() if not _in_with(module, value):
            return "the result of this comparison is ignored; write assert before it"
        case ast.Call(args=[_], keywords=[]) if (
            module.qualified_name(value.func) == "pytest.raises"
        ):
            return "nothing is called here, so nothing is tested; write `with pytest.raises(...):`"
        case ast.Attribute(attr=name) if (
            name.startswith("assert_") or module.qualified_name(value) in _ENDS
        ):
            return f"{module.text(value)} is not called; add the parentheses"
    return ""


def _in_with(module: PythonModule, node: ast.expr) -> bool:
    """Return whether an exception may be expected here."""
    return any(isinstance(parent, ast.With | ast.Try) for parent in module.parents(node))


def _drops(module: PythonModule, handler: ast.ExceptHandler) -> bool:
    """Return whether a handler catches an AssertionError and does nothing."""
    kinds = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    names = {module.qualified_name(kind) if kind is not None else "Exception" for kind in kinds}
    nothing = all(_is_only_shown(module, item) for item in handler.body)
    return nothing and not names.isdisjoint({"Exception", "BaseException", "AssertionError"})


def _is_only_shown(module: PythonModule, statement: ast.stmt) -> bool:
    """Return whether a statement does nothing but print or log."""
    match statement:
        case ast.Pass() | ast.Continue():
            return True
        case ast.Expr(value=ast.Call(func=func)):
            return module.qualified_name(func) == "print" or (
                isinstance(func, ast.Attribute) and func.attr in LOG_METHODS
            )
    return False


def _condition_problem(module: PythonModule, condition: ast.expr) -> str:
    """Return why a condition is always true."""
    match condition:
        case ast.Constant(value=str(text)) if text:
            return "a non-empty string is always true: nothing is asserted"
        case ast.BoolOp(op=ast.Or(), values=values) if any(map(_is_true, values)):
            return "one side of this `or` is always true; compare both sides"
        case ast.Compare(
            left=ast.Call(func=ast.Name(id="len")),
            ops=[ast.GtE()],
            comparators=[ast.Constant(value=0)],
        ):
            return "a length is never negative: the assertion is always true; write > 0"
        case ast.Call(func=ast.Attribute(attr=name)) if name in _MOCKED:
            return f"mocks have no {name}(): the call fails, or is always true; use assert_{name}()"
        case ast.Name() | ast.Attribute() if _is_function(module, condition):
            return f"{module.text(condition)} is a function, which is always true; call it"
    return ""


def _is_function(module: PythonModule, name: ast.Name | ast.Attribute) -> bool:
    if isinstance(name, ast.Attribute):
        return module.qualified_name(name) == "rclpy.ok"
    function = module.functions.get(name.id)
    lookup = module.index.lookup(name.id, name)
    if function is None or lookup is None or lookup[0] is not module.tree:
        return False
    return not function.node.decorator_list and len(lookup[1]) == 1


def _is_true(node: ast.expr) -> bool:
    return isinstance(node, ast.Constant) and isinstance(node.value, str | int) and bool(node.value)
