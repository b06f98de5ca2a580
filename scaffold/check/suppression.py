"""``noqa`` comments for the rules, in every kind of file.

``# noqa: CM001`` in Python, CMake, YAML and configuration files, ``<!-- noqa: PX001 -->`` in XML,
on the line of the diagnostic; a ``noqa`` without codes covers the whole line. Style codes are
suppressed by the style backend, in flake8's and pydocstyle's own ways.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

from scaffold.check.engine_rules import UnusedSuppression
from scaffold.check.renamed_codes import renamed_codes
from scaffold.diagnostic import Diagnostic
from scaffold.model.package import Package
from scaffold.source import Source, ViewError

COMMENT = r"(?:#|<!--)\s*noqa(?![a-z])(?::\s*(?P<codes>[A-Z]+[0-9]+(?:[\s,]+[A-Z]+[0-9]+)*))?"
"""Matches a comment; its group ``codes`` is missing where it covers the whole line."""
_CODE = r"\b[A-Z]+[0-9]+"
_MAY_HOLD = (".py", ".xml", ".urdf", ".xacro", ".txt", ".cmake", ".cfg", ".yaml", ".yml")


def apply(
    package: Package, diagnostics: Iterable[Diagnostic], ran: Collection[str]
) -> list[Diagnostic]:
    """Drop what is suppressed, and report suppressions that suppress nothing.

    Args:
        package: Where the diagnostics were found.
        diagnostics: What the rules said.
        ran: The codes of the rules that ran; only for these an unused suppression is known.
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
    return kept


def _codes_on(package: Package, path: str, line: int) -> list[str] | None:
    """Return the codes of the ``noqa`` on a line, ``[]`` for all, ``None`` without one."""
    try:
        source = package.source(path)
    except ViewError:
        return None
    has_any = package.remember(("noqa", path), lambda: "noqa" in source.text.lower())
    if not has_any or line > len(source.lines):
        return None
    matched = re.search(COMMENT, source.lines[line - 1], re.IGNORECASE)
    return re.findall(_CODE, (matched["codes"] or "").upper()) if matched else None


def _unused(
    package: Package, used: Collection[tuple[str, int, str]], ran: Collection[str]
) -> list[Diagnostic]:
    rule = UnusedSuppression()
    diagnostics: list[Diagnostic] = []
    for path in package.files:
        for source, line, code, start in _suppressions(package, path):
            if code.upper() in ran and (path, line, code.upper()) not in used:
                message = f"noqa: {code} suppresses nothing on this line"
            elif code.upper() not in ran and code.upper() in renamed_codes():
                message = (
                    f"noqa: {code} suppresses nothing: renamed to {renamed_codes()[code.upper()]}"
                )
            else:
                continue
            diagnostics.append(rule.report(source.location(start, start + len(code)), message))
    return diagnostics


def _suppressions(package: Package, path: str) -> Iterable[tuple[Source, int, str, int]]:
    if not _may_hold_suppression(path):
        return
    try:
        source = package.source(path)
    except ViewError:
        return
    if "noqa:" not in source.text.lower():
        return
    for number, line in enumerate(source.lines, 1):
        comment = re.search(COMMENT, line, re.IGNORECASE)
        if comment and comment["codes"]:
            start = source.offset(number) + comment.start("codes")
            for code in re.finditer(_CODE, comment["codes"], re.IGNORECASE):
                yield source, number, code[0], start + code.start()


def _may_hold_suppression(path: str) -> bool:
    return path.endswith(_MAY_HOLD)
