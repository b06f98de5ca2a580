"""TS043: what a test states is looked at."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Report, Severity, TestRule
from scaffold.api.python import PythonModule
from scaffold.api.tests import test_functions

_TEST = "import pytest\n\n\ndef ready():\n    return False\n\n\ndef test_text():\n{}"
_ENDS = frozenset({"pytest.fail", "pytest.skip", "pytest.xfail"})


class AssertionWithoutEffect(TestRule):
    """A test states something that nothing looks at.

    **Why.** The test passes whatever happens: a comparison without ``assert``, ``pytest.raises``
    with nothing to call, ``assert`` in a ``try`` that drops the AssertionError.

    **Fix.** Write ``assert``, or ``with pytest.raises(...):``.

    **Source.** pytest documentation, "How to write and report assertions in tests".
    """

    code = "TS043"
    name = "assertion-without-effect"
    severity = Severity.WARNING
    examples = (
        Example(
            "looked at",
            {
                "test/test_text.py": _TEST.format(
                    "    assert ready()\n    with pytest.raises(ValueError):\n        1 < ready()\n"
                )
            },
        ),
        Example(
            "a comparison, an error that nothing raises",
            {
                "test/test_text.py": _TEST.format(
                    "    1 == ready()\n    pytest.raises(ValueError)\n"
                )
            },
            Report(
                "test/test_text.py:9:5",
                "nothing looks at this comparison: write assert in front of it",
            ),
            Report(
                "test/test_text.py:10:5", "nothing is called here: write `with pytest.raises(...):`"
            ),
        ),
        Example(
            "an error that is dropped",
            {
                "test/test_text.py": _TEST.format(
                    "    try:\n        assert ready()\n    except Exception:\n        pass\n"
                )
            },
            Report(
                "test/test_text.py:11:5",
                "this drops the AssertionError: the test passes all the same",
            ),
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for test in test_functions(module):
            for node in ast.walk(test.node):
                at, problem = _problem(module, node)
                if problem:
                    yield self.report(module.location(at), problem)


def _problem(module: PythonModule, node: ast.AST) -> tuple[ast.AST, str]:
    problem = ""
    match node:
        case ast.Expr(value=value):
            problem = _statement_problem(module, value)
        case ast.Try(body=body, handlers=handlers) if any(
            isinstance(one, ast.Assert) for one in body
        ):
            for handler in handlers:
                if _drops(module, handler):
                    return handler, "this drops the AssertionError: the test passes all the same"
    return node, problem


def _statement_problem(module: PythonModule, value: ast.expr) -> str:
    match value:
        case ast.Compare() if not _in_with(module, value):
            return "nothing looks at this comparison: write assert in front of it"
        case ast.Call(args=[_], keywords=[]) if (
            module.qualified_name(value.func) == "pytest.raises"
        ):
            return "nothing is called here: write `with pytest.raises(...):`"
        case ast.Attribute(attr=name) if (
            name.startswith("assert_") or module.qualified_name(value) in _ENDS
        ):
            return f"{module.text(value)} is not called: parentheses are missing"
    return ""


def _in_with(module: PythonModule, node: ast.expr) -> bool:
    """Tell whether something may be expected to raise here."""
    return any(isinstance(parent, ast.With | ast.Try) for parent in module.parents(node))


def _drops(module: PythonModule, handler: ast.ExceptHandler) -> bool:
    """Tell whether a handler catches an AssertionError and does nothing."""
    kinds = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    names = {module.qualified_name(kind) if kind is not None else "Exception" for kind in kinds}
    nothing = all(isinstance(one, ast.Pass | ast.Continue) for one in handler.body)
    return nothing and not names.isdisjoint({"Exception", "BaseException", "AssertionError"})
