"""Examples of rules as authors run them."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.check.rules.examples import reports
from scaffold.errors import ContentError


class Unfinished(Rule):
    """An unfinished rule."""

    code = "LY999"
    name = "unfinished"
    examples = (Example("any package", {"a.py": ""}),)

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield self.report(package.no_such_view, "never reported")  # type: ignore[attr-defined]


def test_crash_is_no_report() -> None:
    with pytest.raises(ContentError, match=r"LY999, example 'any package': SC002 .*no_such_view"):
        reports(Unfinished, Unfinished.examples[0])
