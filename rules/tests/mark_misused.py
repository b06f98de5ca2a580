"""TS046: marks of tests are spelt as pytest spells them, and have what they need."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Report, TestRule
from scaffold.api.python import PythonModule
from scaffold.api.tests import keywords, marks, test_functions

_MEANT = {
    **dict.fromkeys(
        ("parameterize", "parametrise", "parameterise", "parametize", "parametrized"), "parametrize"
    ),
    **dict.fromkeys(("parameterized", "parameters", "parameter"), "parametrize"),
    **dict.fromkeys(("skip_if", "skipIf", "skif"), "skipif"),
    **dict.fromkeys(("usefixture", "use_fixtures", "use_fixture"), "usefixtures"),
    **dict.fromkeys(("x_fail", "xFail", "expected_fail"), "xfail"),
}
_TEST = (
    "import pytest\n\n\n@pytest.mark.{}('word, count', {})\ndef test_text(word, count):\n"
    "    assert len(word) == count\n"
)


class MarkMisused(TestRule):
    """A mark is misspelt or lacks something.

    **Why.** pytest stops: ``Unknown 'parameterize' mark``, ``you need to specify reason=STRING``.

    **Fix.** ``@pytest.mark.parametrize('a, b', [(1, 2)])``; ``reason='...'`` for ``skipif``.

    **Source.** pytest documentation, "How to mark test functions with attributes", "How to use skip
    and xfail".
    """

    code = "TS046"
    name = "mark-misused"
    examples = (
        Example("right", {"test/test_text.py": _TEST.format("parametrize", "[('a', 1)]")}),
        Example(
            "misspelt",
            {"test/test_text.py": _TEST.format("parameterize", "[('a', 1)]")},
            Report(
                "test/test_text.py:4:2", "pytest has no mark 'parameterize'; closest: 'parametrize'"
            ),
        ),
        Example(
            "no reason",
            {
                "test/test_text.py": "import pytest\n\n\n@pytest.mark.skipif(True)\n"
                "def test_one():\n    pass\n"
            },
            Report(
                "test/test_text.py:4:2",
                "a condition that is not a string needs reason='...': pytest stops here",
            ),
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for test in test_functions(module):
            for name, decorator in marks(module, test.node):
                problem = _mark_problem(name, decorator)
                if problem:
                    yield self.report(module.location(decorator), problem)


def _mark_problem(name: str, decorator: ast.expr) -> str:
    if name in _MEANT:
        return f"pytest has no mark {name!r}; closest: {_MEANT[name]!r}"
    if not isinstance(decorator, ast.Call):
        return "" if name != "parametrize" else "parametrize needs names and values"
    words = keywords(decorator)
    if name == "skipif" and "reason" not in words and len(decorator.args) == 1:
        match decorator.args[0]:
            case ast.Compare() | ast.BoolOp() | ast.UnaryOp() | ast.Constant(value=bool()):
                return "a condition that is not a string needs reason='...': pytest stops here"
    return ""
