"""The report on a terminal: errors first, one entry per cause, one screen."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from textwrap import shorten
from types import MappingProxyType
from typing import TextIO

from rich.console import Console
from rich.style import Style
from rich.text import Text

from scaffold.check.adjustments import runs_linter
from scaffold.check.result import Result
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.printable import printable
from scaffold.record import NamedTuple
from scaffold.reporters import ReportOptions, rule_pages
from scaffold.reporters.entries import (
    SEVERITIES,
    Entry,
    Place,
    by_cause,
    in_order,
    is_style,
    merged,
)
from scaffold.reporters.excerpt import excerpt
from scaffold.reporters.paths import place
from scaffold.reporters.summary import by_severity, count, fixable, summary

_COLORS = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow", Severity.INFO: "bold cyan"}
_MAX_PLACES = 3
"""The maximum number of further places of an entry; the others are counted."""
MAX_MESSAGE = 300
"""The maximum length of a message, as it may end in a long list."""
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
    hidden = {id(result.package): set(result.diagnostics) for result in folded.results}
    kept = [_without_hidden(result, hidden.get(id(result.package), set())) for result in results]
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
    blocks = _blocks(entries, options)
    room = len(blocks)
    if not options.everything:
        room = _fitting_blocks(
            blocks, max(_MIN_LINES, console.height - len(footer) - 6), console.width
        )
    links = rule_pages.links({entry.first.code for entry in entries[:room]})
    for block in _blocks(entries[:room], options, links):
        console.print(block)
    if room < len(blocks) and not options.quiet:
        footer = [*_hidden_lines(entries[room:]), *footer]
    if blocks and footer:
        console.print()
    for text in footer:
        console.print(text)


def _without_hidden(result: Result, hidden: set[Diagnostic]) -> Result:
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
    links: Mapping[str, str] = MappingProxyType({}),
) -> list[Text]:
    """Return the lines of each entry, with the name of the package above them.

    Args:
        entries: The entries in order.
        options: The display options.
        links: The pages of codes; terminals without links ignore them.
    """
    blocks: list[Text] = []
    package = None
    for entry in entries:
        lines: list[Text] = []
        if entry.package is not package:
            package = entry.package
            lines += [Text(), Text(printable(package.name), style="bold underline")]
        lines += _lines(entry, options, links.get(entry.first.code))
        blocks.append(Text("\n").join(lines))
    if blocks:
        blocks[0] = blocks[0][1:]  # no empty line above the first package
    return blocks


def _lines(entry: Entry, options: ReportOptions, link: str | None) -> list[Text]:
    first = entry.first
    message = printable(first.text)
    if not options.everything:
        message = shorten(message, MAX_MESSAGE, placeholder=" …")
    lines = [
        Text.assemble(
            (place(entry.package, first), "cyan"),
            ": ",
            (first.severity.value, _COLORS[first.severity]),
            " ",
            (first.code, Style(bold=True, link=link)),
            f" {message} ",
            (f"[{first.name}]", "dim"),
        )
    ]
    if options.source is not False:
        for text, style in zip(excerpt(entry.package, first.location), ("", "red"), strict=False):
            lines.append(Text(f"    {text}", style=style))
    if len(entry.places) > 1:
        lines += _other_places(entry)
    return lines


def _other_places(entry: Entry) -> list[Text]:
    """Return the other places, in one line if all have the same message."""
    first = entry.first
    others = _new_first(entry)
    shown = others[:_MAX_PLACES]
    rest = len(others) - len(shown)
    more = f" and {count(rest, 'more place')}" if rest else ""
    places = [place(item.package, item.finding) for item in shown]
    findings = [item.finding for item in shown]
    if all((item.code, item.text) == (first.code, first.text) for item in findings):
        return [Text(f"    also at {', '.join(places)}{more}", style="dim")]
    lines = [
        f"    also {at}: {item.code} {shorten(printable(item.text), 80, placeholder=' …')}"
        for at, item in zip(places, findings, strict=True)
    ]
    return [Text(line, style="dim") for line in (*lines, *([f"   {more}"] if rest else []))]


def _new_first(entry: Entry) -> list[Place]:
    """Return the further places of an entry, those with repeated messages last."""
    messages = {entry.first.text}
    new: list[Place] = []
    repeated: list[Place] = []
    for item in entry.places[1:]:
        (repeated if item.finding.text in messages else new).append(item)
        messages.add(item.finding.text)
    return [*new, *repeated]


def _fitting_blocks(blocks: Sequence[Text], height: int, width: int) -> int:
    """Return the number of blocks that fit on the screen, at least one."""
    used = 0
    for at, block in enumerate(blocks):
        used += sum(max(1, -(-len(item) // width)) for item in block.plain.split("\n"))
        if used > height:
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
