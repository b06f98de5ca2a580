"""The summary line of a report: counts of findings and fixable ones."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from scaffold.check.result import Result, Summary
from scaffold.diagnostic import Diagnostic
from scaffold.distributions import titles
from scaffold.edits import Safety
from scaffold.reporters.order import SEVERITIES

if TYPE_CHECKING:
    from scaffold.reporters import ReportOptions


def summary(results: Sequence[Result], options: ReportOptions) -> str:
    """Return one line with the checked packages, the findings, and the fixable ones.

    Args:
        results: Of all packages.
        options: Has the checked distributions, and which fixes are counted.
    """
    total = Summary.of(results)
    target = titles(options.distributions)
    checked = f"{count(total.packages, 'package')}, {count(total.files, 'file')} for {target}"
    diagnostics = [diagnostic for result in results for diagnostic in result.diagnostics]
    if not diagnostics:
        return f"{checked}: no findings"
    fixes = fixable(diagnostics, unsafe=options.unsafe)
    return "; ".join(filter(None, (f"{checked}: {by_severity(diagnostics)}", fixes)))


def by_severity(diagnostics: Iterable[Diagnostic]) -> str:
    """Return ``2 errors, 1 warning``."""
    numbers = Counter(item.severity for item in diagnostics)
    return ", ".join(count(numbers[item], item.value) for item in SEVERITIES if numbers[item])


def count(number: int, noun: str) -> str:
    """Return ``1 error``, ``1,200 errors``."""
    return f"{number:,} {noun}" if number == 1 else f"{number:,} {noun}s"


def fixable(diagnostics: Iterable[Diagnostic], *, unsafe: bool) -> str:
    """Return the number of fixes with the flags that apply them; empty if there are none."""
    fixes = [item.fix for item in diagnostics if item.fix is not None]
    careful = 0 if unsafe else sum(fix.safety is Safety.SAFE for fix in fixes)
    others = len(fixes) - careful
    parts = [f"{careful:,} fixable with --fix"] if careful else []
    if others:
        adjective = "more" if careful else "fixable"
        parts.append(f"{others:,} {adjective} with --fix --unsafe-fixes")
    return ", ".join(parts)
