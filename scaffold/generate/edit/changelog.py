"""Adds lines to the next release in a CHANGELOG.rst like those that are there."""

from __future__ import annotations

from scaffold.check.diagnostic import Edit
from scaffold.generate.edit.addition import Addition, Outcome, spliced
from scaffold.model.source import Source

UPCOMING = "Forthcoming"


def add_to_changelog(source: Source, addition: Addition) -> Outcome:
    """Add lines below the last one of the section ``Forthcoming``, if it has any."""
    for line in addition.changes:
        source = _add(source, line)
    return Outcome(source)


def _add(source: Source, line: str) -> Source:
    lines = [one.rstrip() for one in source.lines]
    if UPCOMING not in lines or line in lines:
        return source
    first = lines.index(UPCOMING) + 2
    last = None
    for number in range(first, len(lines)):
        if lines[number].startswith("* "):
            last = number
        elif lines[number] and not lines[number].startswith(" "):
            break
    if last is None:
        return source
    while last + 1 < len(lines) and lines[last + 1].startswith("  "):
        last += 1
    at = source.offset(last + 1) + len(source.lines[last])
    return spliced(source, [Edit(source.path, at, at, f"{source.newline}{line}")])
