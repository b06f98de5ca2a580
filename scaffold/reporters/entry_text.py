"""The text of an entry on a terminal: with its source line and further places, or brief."""

from __future__ import annotations

from textwrap import shorten

from rich.style import Style
from rich.text import Text

from scaffold.diagnostic import Severity
from scaffold.printable import printable
from scaffold.reporters import ReportOptions
from scaffold.reporters.entries import Entry, Place, dependency_of, names_dependencies
from scaffold.reporters.excerpt import excerpt
from scaffold.reporters.paths import place
from scaffold.reporters.summary import count

_COLORS = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow", Severity.INFO: "bold cyan"}
_MAX_PLACES = 3
"""The maximum number of further places of an entry; the others are counted."""
MAX_MESSAGE = 300
"""The maximum length of a message, as it may end in a long list."""
_ALSO = "    also "
_MIN_BRIEF = 40
"""The minimum length of a brief message, even if the path is long."""
_NAME_LINES = 6
"""The maximum number of lines with names of further dependencies."""


def full(entry: Entry, options: ReportOptions, width: int, link: str | None = None) -> Text:
    """Return the finding, its source line, and other places.

    Args:
        entry: The entry.
        options: The display options.
        width: The number of columns.
        link: The page of the code; terminals without links ignore it.
    """
    message = printable(entry.first.text)
    if not options.everything:
        message = shorten(message, MAX_MESSAGE, placeholder=" …")
    name = Text(f" [{entry.first.name}]", style="dim")
    lines = [_line(entry, message, link) + name]
    if options.source is not False:
        source = excerpt(entry.package, entry.first.location)
        for text, style in zip(source, ("", "red"), strict=False):
            lines.append(Text(f"    {text}", style=style))
    if len(entry.places) > 1:
        lines += _dependencies(entry, _NAME_LINES * width) or _other_places(entry)
    return Text("\n").join(lines)


def brief(entry: Entry, width: int, lines: int, link: str | None = None) -> Text:
    """Return the finding with the number of other places; of dependencies, the other names.

    Args:
        entry: The entry.
        width: The number of columns.
        lines: The number of lines for the finding.
        link: The page of the code.
    """
    names = _dependencies(entry, (2 * lines - 1) * width)
    others = len(entry.places) - 1
    more = Text(
        f" (and {count(others, 'more place')})" if others and not names else "", style="dim"
    )
    room = lines * width - len(_line(entry, "", link)) - len(more)
    message = _cut(printable(entry.first.text), max(_MIN_BRIEF, room))
    return Text("\n").join([_line(entry, message, link) + more, *names])


def height(text: Text, width: int) -> int:
    """Return the number of lines that a text fills."""
    return sum(max(1, -(-len(line) // width)) for line in text.plain.split("\n"))


def _cut(text: str, length: int) -> str:
    return text if len(text) <= length else f"{text[: length - 2].rstrip()} …"


def _line(entry: Entry, message: str, link: str | None) -> Text:
    first = entry.first
    return Text.assemble(
        (place(entry.package, first), "cyan"),
        ": ",
        (first.severity.value, _COLORS[first.severity]),
        " ",
        (first.code, Style(bold=True, link=link)),
        f" {message}",
    )


def _dependencies(entry: Entry, room: int) -> list[Text]:
    """Return a line with the other dependencies by package, or their numbers if it is too long."""
    if not names_dependencies(entry):
        return []
    first = entry.first
    packages: dict[str, dict[str, None]] = {}
    for item in entry.places:
        name = printable(dependency_of(item.finding))
        packages.setdefault(printable(item.package.name), {})[name] = None
    (own, names), *others = packages.items()
    names.pop(printable(dependency_of(first)))
    parts = [", ".join(names)] if names else []
    text = "; ".join([*parts, *(f"in {name}: {', '.join(others)}" for name, others in others)])
    if len(_ALSO + text) > room:
        parts = [f"{len(names)} in {own}"] if names else []
        text = ", ".join([*parts, *(f"{len(others)} in {name}" for name, others in others)])
    return [Text(_ALSO + shorten(text, room - len(_ALSO), placeholder=" …"), style="dim")]


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
        return [Text(f"{_ALSO}at {', '.join(places)}{more}", style="dim")]
    lines = [
        f"{_ALSO}{at}: {item.code} {shorten(printable(item.text), 80, placeholder=' …')}"
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
