"""The text report: a screen on a terminal, one line per finding elsewhere."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache
from typing import TextIO

from scaffold.check.result import Result
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.model.package import Package
from scaffold.printable import printable
from scaffold.reporters import ReportOptions
from scaffold.reporters.excerpt import excerpt
from scaffold.reporters.order import SEVERITIES
from scaffold.reporters.paths import place, printable_path
from scaffold.reporters.summary import summary


def report(results: Sequence[Result], out: TextIO, options: ReportOptions) -> None:
    """Write the findings and a summary; see `Reporter`.

    A terminal gets one screen. Other outputs get all findings, one line each, in a form
    for editors and ``grep``, with nothing folded.
    """
    if options.statistics:
        _statistics(results, out)
    elif out.isatty():
        from scaffold.reporters.terminal import screen

        screen.report(results, out, options)
        return
    else:
        name = lru_cache(maxsize=None)(printable_path)
        for package, diagnostic in worst_first(results, options):
            out.write(f"{line(package, diagnostic, name)}\n")
            if options.source:
                out.writelines(f"    {text}\n" for text in excerpt(package, diagnostic.location))
    if not options.quiet:
        out.writelines(f"{printable(note)}\n" for note in options.notes)
        out.write(summary(results, options) + "\n")


def worst_first(
    results: Sequence[Result], options: ReportOptions
) -> Iterator[tuple[Package, Diagnostic]]:
    """Yield the findings to show: errors, then warnings, then advice."""
    for severity in SEVERITIES[: SEVERITIES.index(options.severity) + 1]:
        for result in results:
            for diagnostic in result.diagnostics:
                if diagnostic.severity is severity:
                    yield result.package, diagnostic


def line(
    package: Package, diagnostic: Diagnostic, name: Callable[[Package, str], str] = printable_path
) -> str:
    """Return the line of a finding: ``path:line:column: severity code message [name]``."""
    head = f"{place(package, diagnostic, name)}: {diagnostic.severity.value} {diagnostic.code}"
    return f"{head} {printable(diagnostic.text)} [{diagnostic.name}]"


def _by_number(item: tuple[tuple[str, str, Severity], int]) -> tuple[int, str]:
    (code, _, _), number = item
    return -number, code


def _statistics(results: Sequence[Result], out: TextIO) -> None:
    """Write the count of each code, the most frequent first."""
    diagnostics = [diagnostic for result in results for diagnostic in result.diagnostics]
    numbers = Counter((item.code, item.name, item.severity) for item in diagnostics)
    fixable = {item.code for item in diagnostics if item.fix is not None}
    width = len(str(max(numbers.values(), default=0)))
    for (code, name, severity), number in sorted(numbers.items(), key=_by_number):
        mark = "[*]" if code in fixable else "[ ]"
        out.write(f"{number:>{width}}  {severity.value:<7}  {code:<6} {mark} {name}\n")
    if fixable:
        out.write("[*] some or all of these are fixable with --fix or --fix --unsafe-fixes\n")
