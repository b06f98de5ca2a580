"""TS090: tests do not print."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Report, TestRule
from scaffold.api.python import PythonModule


class PrintInTest(TestRule):
    """A test prints.

    **Why.** Nobody reads it.

    **Fix.** Assert instead.

    **Source.** None.
    """

    code = "TS090"
    name = "print-in-test"
    examples = (
        Example("an assertion", {"test/test_a.py": "def test_a():\n    assert 1\n"}),
        Example(
            "a print",
            {"test/test_a.py": "def test_a():\n    print(1)\n"},
            Report(
                "1:1",
                "the rule TS090 print-in-test failed: AttributeError: 'Call' object "
                "has no attribute 'location' (line 156 of report)",
            ),
        ),
    )

    def check_file(self, file: PythonModule) -> Iterator[Diagnostic]:
        for call in file.walk(ast.Call):
            if file.qualified_name(call.func) == "print":
                yield self.report(call, "print() in a test: nobody reads it")
