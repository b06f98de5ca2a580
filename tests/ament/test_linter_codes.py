"""The codes of ament_lint_cmake, ament_xmllint and ament_copyright, tested by their cases."""

from __future__ import annotations

import re
from inspect import cleandoc

import pytest

from scaffold.ament.codes import CODES, STYLE
from scaffold.check.rules.ament_rules import AMENT_RULES
from scaffold.check.rules.rule import Example, Rule
from tests.ament import copyright_cases, lint_cmake_cases, xmllint_cases
from tests.check.examples import assert_reported, assert_suppressible

CASES = {**lint_cmake_cases.CASES, **copyright_cases.CASES, **xmllint_cases.CASES}
RULES = {rule.code: rule for rule in AMENT_RULES}


def test_every_code_has_cases() -> None:
    assert list(CASES) == [code for code in CODES if code not in STYLE]


@pytest.mark.parametrize(
    ("rule", "example"),
    [
        pytest.param(RULES[code], example, id=f"{code}-{example.title}")
        for code, examples in CASES.items()
        for example in examples
    ],
)
def test_reports_of_case(rule: type[Rule], example: Example) -> None:
    assert_reported(rule, example)


@pytest.mark.parametrize("code", CASES)
def test_cases_cover_the_table(code: str) -> None:
    row, reports = CODES[code], [report for item in CASES[code] for report in item.reports]
    assert any(not item.reports for item in CASES[code]), "no accepted case"
    shown = {report.severity or row.severity for report in reports}
    assert shown == {row.severity, *(row.other_severities or {})}
    assert row.message in {report.message for report in reports}
    assert (row.fix is not None) == any(item.fixed is not None for item in CASES[code])


@pytest.mark.parametrize("code", CASES)
def test_code_is_documented(code: str) -> None:
    text = cleandoc(CODES[code].documentation)
    assert re.findall(r"^\*\*(\w+)\.\*\*", text, re.MULTILINE) == ["Why", "Fix", "Source"]


def test_cases_can_be_suppressed() -> None:
    pairs = [(RULES[code], item) for code, examples in CASES.items() for item in examples]
    assert_suppressible(pairs)
