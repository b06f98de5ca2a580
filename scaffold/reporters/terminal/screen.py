"""The report on a terminal: errors first, one entry per cause, one screen."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TextIO

from rich.console import Console
from rich.text import Text

from scaffold.check.adjustments import runs_linter
from scaffold.check.result import Result
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.printable import printable
from scaffold.record import NamedTuple
from scaffold.reporters import ReportOptions, rule_pages
from scaffold.reporters.order import SEVERITIES, is_style
from scaffold.reporters.summary import by_severity, count, fixable, summary
from scaffold.reporters.terminal import crowded
from scaffold.reporters.terminal.entries import (
    Entry,
    by_cause,
    in_order,
    merged,
    merged_causes,
)
from scaffold.reporters.terminal.entry_text import full, height

_MAX_NAMED = 4
"""The maximum number of packages or codes listed with counts."""
_MIN_LINES = 12
"""The minimum number of lines for findings on small terminals."""


class _Folded(NamedTuple):
    """Style findings that are counted instead of shown, by the directory of their package."""

    results: Sequence[Result]
    """The results of packages with style findings, restricted to these."""

    @property
    def all(self) -> list[Diagnostic]:
        return [diagnostic for result in self.results for diagnostic in result.diagnostics]


def report(results: Sequence[Result], out: TextIO, options: ReportOptions) -> None:
    """Write to a terminal.

    Style findings are counted in one line while there are errors, and always for a package that
    does not run that linter itself. Skipped findings still count for the exit code.
    """
    console = Console(file=out, highlight=False, soft_wrap=True)
    folded = _fold(results, options)
    style = {id(result.package): set(result.diagnostics) for result in folded.results}
    kept = [_without(result, style.get(id(result.package), set())) for result in results]
    entries = merged(
        in_order(
            [
                entry
                for result in kept
                for entry in by_cause(result, everything=options.everything)
                if SEVERITIES.index(entry.severity) <= SEVERITIES.index(options.severity)
            ]
        )
    )
    footer = [] if options.quiet else _footer(results, folded, options)
    room = max(_MIN_LINES, console.height - len(footer) - 6)
    shown, hidden = _shown(entries, room, console.width, options)
    for block in shown:
        console.print(block)
    if hidden and not options.quiet:
        footer = [*_hidden_lines(hidden), *footer]
    if shown and footer:
        console.print()
    for text in footer:
        console.print(text)


def _shown(
    entries: Sequence[Entry], room: int, width: int, options: ReportOptions
) -> tuple[list[Text], Sequence[Entry]]:
    """Return the texts of the entries that fit, and the other entries.

    If those of the highest severity do not fit, they are shown briefly.
    """
    blocks = _blocks(entries, options, width)
    fitting = len(blocks) if options.everything else _fitting_blocks(blocks, room, width)
    rest = entries[fitting:]
    if rest and rest[0].severity is entries[0].severity:
        return _crowded(entries, room, width, options)
    links = rule_pages.links({entry.first.code for entry in entries[:fitting]})
    return _blocks(entries[:fitting], options, width, links), rest


def _crowded(
    entries: Sequence[Entry], room: int, width: int, options: ReportOptions
) -> tuple[list[Text], Sequence[Entry]]:
    """Return the texts of as many of the worst entries as possible, and the other entries.

    Those of the next severity are shown if there is room after all of the worst.
    """
    texts: list[Text] = []
    rest = list(entries)
    while rest and room > 0:
        worst = [entry for entry in rest if entry.severity is rest[0].severity]
        rest = rest[len(worst) :]
        shown, hidden = crowded.choose(in_order(merged_causes(worst)), room, width, options)
        links = rule_pages.links({item.entry.first.code for item in shown})
        texts += [item.text(width, options, links.get(item.entry.first.code)) for item in shown]
        if hidden:
            return texts, [*hidden, *rest]
        room -= sum(item.height(width, options) for item in shown) + 1
        texts += [Text()] if rest and room > 0 else []
    return texts, rest


def _without(result: Result, hidden: set[Diagnostic]) -> Result:
    kept = [diagnostic for diagnostic in result.diagnostics if diagnostic not in hidden]
    return Result(result.package, result.files, kept)


def _fold(results: Sequence[Result], options: ReportOptions) -> _Folded:
    if options.style:
        return _Folded(())
    has_errors = any(
        diagnostic.severity is Severity.ERROR
        for result in results
        for diagnostic in result.diagnostics
    )
    styles = [
        Result(
            result.package,
            result.files,
            [
                diagnostic
                for diagnostic in result.diagnostics
                if is_style(diagnostic)
                and (has_errors or not runs_linter(result.package, diagnostic))
            ],
        )
        for result in results
    ]
    return _Folded([result for result in styles if result.diagnostics])


def _blocks(
    entries: Sequence[Entry],
    options: ReportOptions,
    width: int,
    links: Mapping[str, str] = MappingProxyType({}),
) -> list[Text]:
    """Return the text of each entry, with the name of the package above the first of each.

    Args:
        entries: The entries in order.
        options: The display options.
        width: The number of columns.
        links: The pages of codes; terminals without links ignore them.
    """
    blocks: list[Text] = []
    package = None
    for entry in entries:
        text = full(entry, options, width, links.get(entry.first.code))
        if entry.package is not package:
            package = entry.package
            name = Text(printable(package.name), style="bold underline")
            text = Text("\n").join([*([Text()] if blocks else []), name, text])
        blocks.append(text)
    return blocks


def _fitting_blocks(blocks: Sequence[Text], room: int, width: int) -> int:
    """Return the number of blocks that fit on the screen, at least one."""
    used = 0
    for at, block in enumerate(blocks):
        used += height(block, width)
        if used > room:
            return max(1, at)
    return len(blocks)


def _hidden_lines(entries: Sequence[Entry]) -> list[Text]:
    """Return lines about hidden findings by code and package, and how to show them."""
    result = [item for entry in entries for item in entry.places]
    codes = Counter(item.finding.code for item in result)
    names = Counter(printable(item.package.name) for item in result)
    numbers = by_severity(item.finding for item in result)
    return [
        Text(
            f"not shown: {numbers}; --all shows them",
            style="bold",
        ),
        Text(f"    by code: {_named(codes)}", style="dim"),
        Text(f"    by package: {_named(names)}", style="dim"),
    ]


def _named(numbers: Counter[str]) -> str:
    """Return ``PX020 12, CM014 3 and 2 others``."""
    common = [f"{name} {number:,}" for name, number in numbers.most_common(_MAX_NAMED)]
    rest = len(numbers) - len(common)
    return ", ".join(common) + (f" and {count(rest, 'other')}" if rest else "")


def _footer(results: Sequence[Result], folded: _Folded, options: ReportOptions) -> list[Text]:
    lines = [_style_line(result, unsafe=options.unsafe) for result in folded.results]
    if len(lines) > _MAX_NAMED:
        style = folded.all
        lines = [
            Text.assemble(
                ("style: ", "bold"),
                f"{count(len(style), 'finding')} in {count(len(folded.results), 'package')}",
                _hints(style, unsafe=options.unsafe),
            )
        ]
    notes = [Text(printable(note)) for note in options.notes]
    return [*lines, *notes, Text(summary(results, options), style="bold")]


def _style_line(result: Result, *, unsafe: bool) -> Text:
    diagnostics = result.diagnostics
    return Text.assemble(
        (f"{printable(result.package.name)}: ", "bold"),
        count(len(diagnostics), "style finding"),
        _hints(diagnostics, unsafe=unsafe),
    )


def _hints(diagnostics: Iterable[Diagnostic], *, unsafe: bool) -> str:
    """Return hints on fixing and showing style findings."""
    fixes = fixable(diagnostics, unsafe=unsafe)
    return f", {fixes}; --style shows them" if fixes else "; --style shows them"
