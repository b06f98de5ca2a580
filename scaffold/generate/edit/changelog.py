"""Adds entries to the next release in CHANGELOG.rst, in the style of existing ones."""

from __future__ import annotations

import re

from scaffold.edits import Edit
from scaffold.generate.edit.addition import Addition, Outcome, spliced
from scaffold.source import Source

UPCOMING = "Forthcoming"
_LIKE_OURS = r"\* Add the [a-z ]+ ``\w+``\."


def add_to_changelog(source: Source, addition: Addition) -> Outcome:
    """Add lines to the section ``Forthcoming``, if it has lines in the same style."""
    for line in addition.changes:
        source = _add(source, line)
    return Outcome(source)


def _add(source: Source, line: str) -> Source:
    lines = [item.rstrip() for item in source.lines]
    if UPCOMING not in lines or line in lines:
        return source
    last = None
    for number in range(lines.index(UPCOMING) + 2, len(lines)):
        if re.fullmatch(_LIKE_OURS, lines[number]):
            last = number
        elif lines[number] and not lines[number].startswith(("* ", " ")):
            break
    if last is None:
        return source
    at = source.offset(last + 1) + len(source.lines[last])
    return spliced(source, [Edit(source.path, at, at, f"{source.newline}{line}")])
