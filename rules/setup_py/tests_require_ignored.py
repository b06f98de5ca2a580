"""SP014: newer versions of setuptools run the tests, too."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity
from scaffold.api.setup_py import setup_edit

_NEW = "extras_require={'test': ['pytest']}"
_SETUP = "from setuptools import setup\n\nsetup(\n    name='talker',\n    {},\n)\n"


class TestsRequireIgnored(Rule):
    """setup.py says with ``tests_require`` that the tests need pytest.

    **Why.** setuptools 72 dropped it: ``Unknown distribution option: 'tests_require'``, and
    ``colcon test`` runs 0 tests. The version of Ubuntu 24.04 still reads it.

    **Fix.** Write ``extras_require={'test': ['pytest']}``.

    **Source.** ros2_documentation issue 4727; ``colcon_core/task/python/test``.
    """

    code = "SP014"
    name = "tests-require-ignored"
    severity = Severity.WARNING
    examples = (
        Example("the new way", {"setup.py": _SETUP.format(_NEW)}),
        Example(
            "the old way",
            {"setup.py": _SETUP.format("tests_require=['pytest']")},
            Report(
                "setup.py:5:19",
                "setuptools 72 and later ignore tests_require: colcon runs 0 tests; "
                "write extras_require={'test': ['pytest']}",
                fix="write extras_require={'test': ['pytest']}",
            ),
            fixed={"setup.py": _SETUP.format(_NEW)},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        old = setup.keyword("tests_require")
        if old is None or setup.keyword("extras_require") is not None:
            return
        span = setup_edit.span(setup, "tests_require")
        fix = Fix(f"write {_NEW}", (Edit("setup.py", *span, _NEW),)) if span else None
        message = f"setuptools 72 and later ignore tests_require: colcon runs 0 tests; write {_NEW}"
        yield self.report(old, message, fix)
