"""The examples of every rule, run as tests."""

from __future__ import annotations

import ast
import os
import re
import sys
from collections.abc import Callable, Iterator
from inspect import cleandoc
from pathlib import Path
from types import FrameType
from typing import Any

import pytest

from scaffold.check import runner
from scaffold.check.rules import docs, registry
from scaffold.check.rules.examples import package_of
from scaffold.check.rules.rule import Example, Rule
from scaffold.configuration import content
from tests.check.examples import assert_reported, assert_suppressible

TraceFunction = Callable[[FrameType, str, Any], Any]

ROOT = Path(__file__).parents[2]
RULES = registry.load(content.roots("rules"))
FILES = [path for root in content.roots("rules") for path in sorted(Path(root).glob("*/**/*.py"))]
"""Rules, and what those of an area share."""
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
    "tests": "TS",
    "names": "NM",
    "imports": "IM",
    "nodes": "ND",
    "messages": "MS",
    "launch": "LF",
    "parameters": "PF",
    "types": "TY",
    "urdf": "UR",
    "bridge": "BR",
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
def test_page_is_current(rule: type[Rule]) -> None:
    """A change of the severity or of a text changes the page of the rule."""
    page = ROOT / "docs" / "rules" / f"{rule.code}.md"
    written = page.read_text(encoding="utf-8") if page.is_file() else ""
    assert written == docs.page(rule), "run `make docs`"


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_code_begins_with_the_letters_of_its_area(rule: type[Rule]) -> None:
    assert rule.code.startswith(AREAS[_area(rule)])


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_imports_little(file: Path) -> None:
    """Rules only import cheap and stable modules, since every run pays for them."""
    tree = ast.parse(file.read_text(encoding="utf-8"))
    imported = {
        alias.name
        for node in ast.walk(tree)
        if isinstance(node, ast.Import)
        for alias in node.names
    }
    imported |= {
        node.module or ""
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and not node.level
    }
    allowed = {"__future__", "ast", "collections", "contextlib", "difflib", "os", "posixpath"}
    allowed |= {
        "builtins",
        "errno",
        "fnmatch",
        "itertools",
        "re",
        "scaffold",
        "tokenize",
        "typing",
        "io",
        "math",
        "sys",
        "warnings",
    }
    assert {name.split(".")[0] for name in imported} <= allowed


def test_examples_can_be_suppressed() -> None:
    """``noqa`` on the reported line suppresses the reports of Python and CMake examples."""
    assert_suppressible([(rule, example) for rule in RULES for example in rule.examples])


@pytest.mark.parametrize("area", AREAS)
def test_every_message_is_shown_by_an_example(area: str) -> None:
    """Each statement of a rule that writes a message is executed by one of its examples."""
    rules = [rule for rule in RULES if _area(rule) == area]
    (directory,) = {Path(root, area) for root in content.roots("rules")}
    executed = {place for rule in rules for place in _lines_executed(rule, directory)}
    unshown = [
        f"{path.stem}: {text}"
        for path in sorted(directory.rglob("*.py"))
        for line, text in _message_lines(path)
        if (str(path), line) not in executed
    ]
    assert unshown == []


def _lines_executed(rule: type[Rule], directory: Path) -> set[tuple[str, int]]:
    """Return the lines of the files of an area that the examples of a rule execute."""
    start, executed = f"{directory}{os.sep}", set[tuple[str, int]]()

    def trace(frame: FrameType, _event: str, _argument: object) -> TraceFunction | None:
        path = frame.f_code.co_filename
        if not path.startswith(start):
            return None
        executed.add((path, frame.f_lineno))
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        for example in rule.examples:
            with example.targeting():
                runner.check(package_of(example), [rule()])
    finally:
        sys.settrace(before)
    return executed


def _message_lines(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the statements of functions that hold a text of several words."""
    for function in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(function, ast.FunctionDef):
            continue
        for statement in ast.walk(function):
            if not isinstance(statement, ast.stmt) or hasattr(statement, "body"):
                continue
            if isinstance(statement, ast.Match) or _is_docstring(statement):
                continue
            texts = [
                node.value
                for node in ast.walk(statement)
                if isinstance(node, ast.Constant) and isinstance(node.value, str)
            ]
            if any(" " in text.strip() for text in texts):
                yield statement.lineno, ast.unparse(statement)


def _is_docstring(statement: ast.stmt) -> bool:
    return isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)


def _area(rule: type[Rule]) -> str:
    return rule.__module__.split(".")[1]


def _file_of(rule: type[Rule]) -> str:
    path = sys.modules[rule.__module__].__file__
    assert path is not None
    return path
