"""TS077: tests stand where pytest collects them."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Report, Severity, TestRule
from scaffold.api.python import PythonModule
from scaffold.api.tests import test_functions

_TEST = "def ready():\n    return False\n\n\ndef test_text():\n{}"
_OWN = "    class Case:\n        def test_more(self):\n            pass\n\n    assert run(Case)\n"
_MORE = "    assert ready()\n\n    def test_more():\n        assert ready()\n"


class TestInTest(TestRule):
    """A test stands inside of another test, and that does nothing with it.

    **Why.** pytest does not collect it: it is never run, whatever it states.

    **Fix.** Move it out, after the test that it stands in.

    **Source.** pytest documentation, "Conventions for Python test discovery".
    """

    code = "TS077"
    name = "test-in-test"
    severity = Severity.WARNING
    examples = (
        Example("a class that the test runs", {"test/test_text.py": _TEST.format(_OWN)}),
        Example(
            "a function that nothing calls",
            {"test/test_text.py": _TEST.format(_MORE)},
            Report(
                "test/test_text.py:8:5", "test_more is inside test_text: pytest does not collect it"
            ),
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for test in test_functions(module):
            for node in ast.walk(test.node):
                is_other = isinstance(node, ast.FunctionDef) and node is not test.node
                if isinstance(node, ast.FunctionDef) and is_other and _is_lost(module, node):
                    place = f"{node.name} is inside {test.node.name}"
                    message = f"{place}: pytest does not collect it"
                    yield self.report(module.location(node), message)


def _is_lost(module: PythonModule, node: ast.FunctionDef) -> bool:
    """Tell whether a function is a test by its name, and nothing has to do with it."""
    holder = module.parent(node)
    used = isinstance(holder, ast.ClassDef) and _is_used(module, holder)
    return node.name.startswith("test_") and not (used or _is_used(module, node))


def _is_used(module: PythonModule, node: ast.FunctionDef | ast.ClassDef) -> bool:
    """Tell whether anything else has to do with a function or class."""
    return bool(node.decorator_list or module.index.names(node.name))
