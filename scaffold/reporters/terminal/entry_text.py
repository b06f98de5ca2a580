"""The text of an entry on a terminal: with its source line and further places, or brief."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import shorten

from rich.style import Style
from rich.text import Text

from scaffold.diagnostic import Severity
from scaffold.printable import printable
from scaffold.reporters import ReportOptions
from scaffold.reporters.excerpt import excerpt
from scaffold.reporters.paths import place
from scaffold.reporters.summary import count
from scaffold.reporters.terminal.entries import (
    Entry,
    Place,
    dependency_of,
    names_dependencies,
    pattern,
)

_COLORS = {Severity.ERROR: "bold red", Severity.WARNING: "bold yellow", Severity.INFO: "bold cyan"}
_MAX_PLACES = 3
"""The maximum number of further places with the same message; the others are counted."""
_MAX_OTHERS = 3
"""The maximum number of other messages in an entry; the others are counted."""
MAX_MESSAGE = 300
"""The maximum length of a message, as it may end in a long list."""
_ALSO = "    also "
_MIN_BRIEF = 40
"""The minimum length of a brief message, even if the path is long."""
_ALSO_LINES = 6
"""The maximum number of lines with further places or dependencies."""
_MAX_NAMES = (1_000, 5, 2, 1)
"""The maximum number of dependencies per package, tried in this order until they fit."""


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
    return Text("\n").join([*lines, *also(entry, _ALSO_LINES * width)])


def brief(entry: Entry, width: int, lines: int, link: str | None = None) -> Text:
    """Return the finding with the number of other places; of dependencies, the other names.

    Args:
        entry: The entry.
        width: The number of columns.
        lines: The number of lines for the finding. If there are several, there are as many for
            other places.
        link: The page of the code.
    """
    others = len(entry.places) - 1
    named = lines > 1 or names_dependencies(entry)
    below = also(entry, lines * width) if named else []
    more = Text(
        f" (and {count(others, 'more place')})" if others and not below else "", style="dim"
    )
    room = min(lines, 2) * width - len(_line(entry, "", link)) - len(more)
    if room < _MIN_BRIEF:
        room += width  # it fills another line anyway
    message = _cut(printable(entry.first.text), max(_MIN_BRIEF, room))
    return Text("\n").join([_line(entry, message, link) + more, *below])


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


def also(entry: Entry, room: int) -> list[Text]:
    """Return the other dependencies, places or messages of an entry."""
    if len(entry.places) == 1:
        return []
    if names_dependencies(entry):
        return [Text(_ALSO + _dependencies(entry, room - len(_ALSO)), style="dim")]
    words = pattern(entry.first.message)
    if all(pattern(item.finding.message) == words for item in entry.places):
        return [Text(_ALSO + _places(entry, room - len(_ALSO)), style="dim")]
    return _messages(entry)


def _dependencies(entry: Entry, room: int) -> str:
    """Return the other dependencies by package; if that is too long, only some of each."""
    packages: dict[str, dict[str, None]] = {}
    for item in entry.places:
        name = printable(dependency_of(item.finding))
        packages.setdefault(printable(item.package.name), {})[name] = None
    (_, own), *others = packages.items()
    own.pop(printable(dependency_of(entry.first)))
    equal: dict[tuple[str, ...], list[str]] = {}
    for package, names in others:
        equal.setdefault(tuple(names), []).append(package)
    text = ""
    for number in _MAX_NAMES:
        parts = [_some(tuple(own), number)] if own else []
        parts += [
            f"in {', '.join(those)}: {_some(names, number)}" for names, those in equal.items()
        ]
        text = "; ".join(parts)
        if len(text) <= room:
            break
    return shorten(text, room, placeholder=" …")


def _some(names: Sequence[str], number: int) -> str:
    """Return the first names, and the number of the others."""
    if len(names) <= number + 1:
        return ", ".join(names)
    return f"{', '.join(names[:number])} and {len(names) - number} more"


def _places(entry: Entry, room: int) -> str:
    """Return the other places, each with the names that are different in its message."""
    others = _new_first(entry)
    new = len({item.finding.text for item in entry.places}) - 1
    before = entry.places[0]
    known = ""
    parts: list[str] = []
    room -= len("at ") + len(f" and {len(others)} more places")
    for item in others[: new + _MAX_PLACES]:
        names = _difference(entry.first.text, item.finding.text)
        part = _place_after(before, item)
        if names and names != known:
            part = names if part == _place_after(before, before) else f"{names} in {part}"
        room -= len(part) + len(", ")
        if room < 0 and parts:
            break
        parts.append(part)
        before, known = item, names
    rest = len(others) - len(parts)
    more = f" and {count(rest, 'more place')}" if rest else ""
    return ("" if new else "at ") + ", ".join(parts) + more


def _place_after(before: Place, item: Place) -> str:
    """Return the place of an item, without the path if it is that of the one before."""
    at = item.finding.location
    if (before.package, before.finding.location.path) == (item.package, at.path):
        return f"line {at.line}"
    return place(item.package, item.finding)


def _difference(first: str, other: str) -> str:
    """Return the names in a message, up to the advice, that the first message does not have."""
    known, names = (
        dict.fromkeys(word.strip("'`:,") for word in text.partition("; ")[0].split())
        for text in (first, other)
    )
    new = [name for name in names if name not in known]
    return printable(" ".join(new[:1] if new[1:2] and new[1] in new[0] else new[:2]))


def _messages(entry: Entry) -> list[Text]:
    """Return the other messages, the new ones first."""
    others = _new_first(entry)
    lines = [
        f"{_ALSO}{place(item.package, item.finding)}: {item.finding.code} "
        f"{shorten(printable(item.finding.text), 80, placeholder=' …')}"
        for item in others[:_MAX_OTHERS]
    ]
    if rest := len(others) - len(lines):
        lines.append(f"    and {count(rest, 'more place')}")
    return [Text(line, style="dim") for line in lines]


def _new_first(entry: Entry) -> list[Place]:
    """Return the further places of an entry, those with repeated messages last."""
    messages = {entry.first.text}
    new: list[Place] = []
    repeated: list[Place] = []
    for item in entry.places[1:]:
        (repeated if item.finding.text in messages else new).append(item)
        messages.add(item.finding.text)
    return [*new, *repeated]
