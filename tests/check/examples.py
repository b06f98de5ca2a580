"""Assertions about the examples of rules."""

from __future__ import annotations

from collections.abc import Iterable

from scaffold.check import runner, suppression
from scaffold.check.fixes import fixer
from scaffold.check.rules.examples import package_of, reports
from scaffold.check.rules.rule import Example, Rule


def assert_reported(rule: type[Rule], example: Example) -> None:
    """Fail unless the reports and fixes of a rule equal those of an example exactly."""
    with example.targeting():
        _assert_reported(rule, example)


def _assert_reported(rule: type[Rule], example: Example) -> None:
    package = package_of(example)
    diagnostics = runner.check(package, [rule()])
    assert {diagnostic.code for diagnostic in diagnostics} <= {rule.code}
    assert [vars(report) for report in reports(rule, example)] == [
        vars(report) for report in example.reports
    ], "`make examples` writes what is reported now"

    fixed = fixer.fix(package, lambda one: runner.check(one, [rule()]), unsafe=True)
    after = dict(fixed.changed)
    expected = {path: text.encode() for path, text in (example.fixed or {}).items()}
    for path in fixed.executable - after.keys():
        after[path] = package.tree.read(path)
    assert after == expected
    if example.fixed is not None:
        assert runner.check(fixed.package, [rule()]) == []


def assert_suppressible(examples: Iterable[tuple[type[Rule], Example]]) -> None:
    """Fail unless ``noqa`` suppresses the reports of a Python or CMake example."""
    silenced = 0
    for rule, example in examples:
        if len(example.reports) != 1:
            continue
        path, line = example.reports[0].path, example.reports[0].line
        if not path.endswith((".py", ".txt")) or path not in example.files:
            continue
        lines = example.files[path].split("\n")
        if line > len(lines):
            continue
        reported = lines[line - 1]
        if '"""' in reported or reported.startswith("#!"):  # no place for a comment
            continue
        lines[line - 1] += f"  # noqa: {rule.code}"
        files = {**example.files, path: "\n".join(lines)}
        package = package_of(
            Example("", files, executable=example.executable, neighbors=example.neighbors)
        )
        with example.targeting():
            diagnostics = runner.check(package, [rule()])
        assert suppression.apply(package, diagnostics, {rule.code}) == [], example.title
        silenced += bool(diagnostics)
    assert silenced > 0
