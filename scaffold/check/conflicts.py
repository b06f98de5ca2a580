"""Reports merge conflict markers in files, instead of the syntax errors they cause."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from scaffold.diagnostic import Diagnostic
from scaffold.formats.conflicts import first_conflict
from scaffold.model.package import Package
from scaffold.source import ViewError

UNREADABLE = frozenset({"SC001", "E999", "PX050", "PF001"})
"""The codes of files that cannot be parsed: Python, CMake, XML and YAML."""
MARKS = "merge conflict marks"
"""The start of the message."""


def named(package: Package, diagnostics: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield diagnostics, with one about the conflict for files that it makes unreadable."""
    seen: set[str] = set()
    for item in diagnostics:
        path = item.location.path
        line = _line(package, path) if item.code in UNREADABLE else 0
        if not line:
            yield item
        elif path not in seen:
            seen.add(path)
            message = f"{MARKS} at line {line}: resolve the conflict"
            yield item._replace(message=message, fix=None)


def _line(package: Package, path: str) -> int:
    """Return the line on which the first conflict starts, 0 without one."""
    try:
        return first_conflict(package.source(path).lines)
    except ViewError:
        return 0
