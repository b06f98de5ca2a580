"""Every rule's examples are its tests."""

from __future__ import annotations

import ast
import re
from inspect import cleandoc
from pathlib import Path

import pytest

from scaffold.check import registry
from scaffold.check.rule import Example, Rule
from scaffold.configuration import content
from tests.check.examples import assert_reported, assert_suppressible

RULES = registry.load(content.roots("rules"))
CASES = [
    pytest.param(rule, example, id=f"{rule.code}-{example.title}")
    for rule in RULES
    for example in rule.examples
]
AREAS = {
    "package_xml": "PX",
    "cmake": "CM",
    "setup_py": "SP",
    "layout": "LY",
    "names": "NM",
    "nodes": "ND",
    "messages": "MS",
    "launch": "LF",
    "parameters": "PF",
}


@pytest.mark.parametrize(("rule", "example"), CASES)
def test_example(rule: type[Rule], example: Example) -> None:
    assert_reported(rule, example)


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_is_documented(rule: type[Rule]) -> None:
    text = cleandoc(rule.__doc__ or "")
    for part in ("**Why.**", "**Fix.**", "**Source.**"):
        assert part in text, f"{rule.code} has no {part}"
    assert re.fullmatch(r"[A-Z]{2}[0-9]{3}", rule.code)
    assert any(example.reports for example in rule.examples), "no rejected example"
    assert any(not example.reports for example in rule.examples), "no accepted example"


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_declares_and_shows_every_severity(rule: type[Rule]) -> None:
    shown = {report.severity or rule.severity for x in rule.examples for report in x.reports}
    assert shown == {rule.severity, *rule.other_severities}


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_stands_in_its_area(rule: type[Rule]) -> None:
    area = rule.__module__.split(".")[-2]
    assert rule.code.startswith(AREAS[area])


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_imports_little(rule: type[Rule]) -> None:
    """A rule file imports what is cheap and stable; the rest would cost every run."""
    tree = ast.parse(Path(_file_of(rule)).read_text(encoding="utf-8"))
    roots = {
        name.split(".")[0]
        for node in ast.walk(tree)
        for name in (
            [alias.name for alias in node.names]
            if isinstance(node, ast.Import)
            else [node.module or ""]
            if isinstance(node, ast.ImportFrom)
            else []
        )
    }
    allowed = {"__future__", "ast", "collections", "difflib", "os", "posixpath", "re", "typing"}
    assert roots <= {*allowed, "fnmatch", "itertools", "scaffold", "tokenize", "io", "sys"}


def test_examples_can_be_suppressed() -> None:
    """A rejected Python or CMake example falls silent with ``noqa`` on the reported line."""
    assert_suppressible([(rule, example) for rule in RULES for example in rule.examples])


def _file_of(rule: type[Rule]) -> str:
    import sys

    path = sys.modules[rule.__module__].__file__
    assert path is not None
    return path
