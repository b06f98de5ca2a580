"""``noqa`` comments for the rules, in every kind of file.

``# noqa: CM001`` in Python, CMake, YAML and configuration files, ``<!-- noqa: PX001 -->`` in XML,
on the line of the diagnostic; a ``noqa`` without codes covers the whole line. Style codes are
suppressed by the style backend, in flake8's and pydocstyle's own ways.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator
from contextlib import suppress

from scaffold.check.distribution_branches import run_on_target
from scaffold.check.rules.engine_rules import UnusedSuppression
from scaffold.check.rules.renamed_codes import renamed_codes
from scaffold.diagnostic import Diagnostic
from scaffold.model.facts import fact
from scaffold.model.package import Package
from scaffold.record import NamedTuple
from scaffold.source import Source, ViewError

COMMENT = r"(?:#|<!--)\s*noqa(?![a-z])(?::\s*(?P<codes>[A-Z]+[0-9]+(?:[\s,]+[A-Z]+[0-9]+)*))?"
"""Matches a comment; its group ``codes`` is missing if it covers the whole line."""
_CODE = r"\b[A-Z]+[0-9]+"
_MAY_HOLD = (".py", ".xml", ".urdf", ".xacro", ".txt", ".cmake", ".cfg", ".yaml", ".yml")


def apply(
    package: Package, diagnostics: Iterable[Diagnostic], ran: Collection[str]
) -> list[Diagnostic]:
    """Drop suppressed findings, and report unused suppressions.

    Findings in branches for other distributions are dropped as well.

    Args:
        package: The package of the diagnostics.
        diagnostics: The diagnostics of the rules.
        ran: The codes of the rules that ran, for which unused suppressions are known.
    """
    kept: list[Diagnostic] = []
    used: set[tuple[str, int, str]] = set()
    for diagnostic in diagnostics:
        at = diagnostic.location
        codes = _codes_on(package, at.path, at.line)
        if codes is not None and (not codes or diagnostic.code in codes):
            used.add((at.path, at.line, diagnostic.code))
        else:
            kept.append(diagnostic)
    kept.extend(_unused(package, used, ran))
    return [*run_on_target(package, kept)]


def _codes_on(package: Package, path: str, line: int) -> list[str] | None:
    """Return the codes of the ``noqa`` on a line, ``[]`` for all, ``None`` without one."""
    comment = next((item for item in _comments(package, path) if item.line == line), None)
    return None if comment is None else [code.upper() for code, _ in comment.codes]


def _unused(
    package: Package, used: Collection[tuple[str, int, str]], ran: Collection[str]
) -> Iterator[Diagnostic]:
    rule = UnusedSuppression()
    for path in filter(_may_hold_suppression, package.files):
        for comment in _comments(package, path):
            for code, start in comment.codes:
                message = f"noqa: {code} suppresses nothing"
                if code.upper() not in ran and code.upper() in renamed_codes():
                    message = f"{message}: renamed to {renamed_codes()[code.upper()]}"
                elif code.upper() in ran and (path, comment.line, code.upper()) not in used:
                    message = f"{message} on this line"
                else:
                    continue
                at = package.source(path).location(start, start + len(code))
                yield rule.report(at, message)


def _may_hold_suppression(path: str) -> bool:
    return path.endswith(_MAY_HOLD)


class _Comment(NamedTuple):
    """A ``noqa`` comment."""

    line: int
    codes: tuple[tuple[str, int], ...]
    """The codes with their offsets; empty if the comment covers the whole line."""


def _comments(package: Package, path: str) -> tuple[_Comment, ...]:
    """Return the comments of a file; empty if it cannot be read."""
    with suppress(ViewError):
        if path.endswith(".py"):
            return _comments_in_python(package, path)
        return package.remember(("noqa", path), lambda: _comments_in(package.source(path)))
    return ()


@fact
def _comments_in_python(package: Package, path: str) -> tuple[_Comment, ...]:
    return _comments_in(package.source(path))


def _comments_in(source: Source) -> tuple[_Comment, ...]:
    if "noqa" not in source.text.lower():
        return ()
    result: list[_Comment] = []
    for number, line in enumerate(source.lines, 1):
        comment = re.search(COMMENT, line, re.IGNORECASE)
        if comment:
            start = source.offset(number) + comment.start("codes")
            codes = re.finditer(_CODE, comment["codes"] or "", re.IGNORECASE)
            result.append(
                _Comment(number, tuple((code[0], start + code.start()) for code in codes))
            )
    return tuple(result)
