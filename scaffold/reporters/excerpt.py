"""The source line of a finding, with a mark below the place."""

from __future__ import annotations

from scaffold.model.package import Package
from scaffold.printable import printable
from scaffold.source import Location, ViewError

MAX_COLUMNS = 160
"""The width of a shown line; generated code may have very long lines."""


def excerpt(package: Package, at: Location) -> tuple[str, ...]:
    """Return the line and the mark below it; nothing if the location is a whole file."""
    if (at.line, at.column, at.end_line, at.end_column) == (at.line, 1, at.line, 1):
        return ()
    try:
        lines = package.source(at.path).lines
    except ViewError:
        return ()
    if at.line > len(lines):
        return ()
    text = lines[at.line - 1].rstrip("\r\n")
    before = text[: at.column - 1].replace("\t", "    ")
    end = at.end_column - 1 if at.end_line == at.line else len(text)
    marked = text[at.column - 1 : end].rstrip().replace("\t", "    ")
    number = f"{at.line:>4}"
    source = printable(text.replace("\t", "    "))
    if len(source) > MAX_COLUMNS:
        return ()
    mark = " " * len(printable(before)) + "^" * max(1, len(printable(marked)))
    return f"{number} | {source}", f"{' ' * len(number)} | {mark}"
