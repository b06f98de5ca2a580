"""``# noqa`` as flake8 parses it; the variant of pydocstyle is in ``definitions``."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable

from scaffold.ament.finding import FLAKE8, Finding
from scaffold.ament.python_text.text import PythonText
from scaffold.ament.python_text.tokens import COMMENT, DEDENT, ENDMARKER, NEWLINES

_INLINE = r"# noqa(?::[\s]?(?P<codes>([A-Z]+[0-9]+(?:[,\s]+)?)+))?"
_OF_IMPORTS = r"# noqa(?:: (?P<codes>([A-Z][0-9]+(?:[,\s]+)?)+))?"
_FILE = r"^\s*# flake8[:=]\s*noqa"
_ALL = ("",)


def _skips_file(text: PythonText) -> bool:
    """Return whether a comment makes flake8 skip the whole file."""
    lowered = text.text.lower()
    if "flake8" not in lowered:
        return False
    return any(re.match(_FILE, line, re.IGNORECASE) for line in text.lines)


def apply(text: PythonText, findings: Iterable[Finding]) -> list[Finding]:
    """Remove flake8 from suppressed findings; drop those that no other linter reports."""
    if _skips_file(text):
        return _unsuppressed(findings, lambda _: True)
    if "noqa" not in text.text.lower():
        return list(findings)
    silenced = _Silenced(text)
    return _unsuppressed(findings, silenced.covers)


def apply_of_plugins(text: PythonText, findings: Iterable[Finding]) -> list[Finding]:
    """Apply the comments under ``disable_noqa``, for plugins that read them themselves."""
    silenced = _Silenced(text)
    return _unsuppressed(findings, silenced.covers_by_plugin)


def _unsuppressed(findings: Iterable[Finding], covers: Callable[[Finding], bool]) -> list[Finding]:
    kept = []
    for finding in findings:
        if finding.linters & FLAKE8 and covers(finding):
            if finding.linters == FLAKE8:
                continue
            kept.append(finding._replace(linters=finding.linters & ~FLAKE8))
        else:
            kept.append(finding)
    return kept


class _Silenced:
    """The codes that are suppressed on each line of a file."""

    def __init__(self, text: PythonText) -> None:
        self._text = text
        self._groups = _groups(text)
        self._codes: dict[int, tuple[str, ...]] = {}
        # flake8-quotes skips lines with a comment that ends with the word.
        self._quotes = {
            token.start[0]
            for token in text.tokens
            if token.type == COMMENT and token.string.endswith("noqa")
        }

    def covers(self, finding: Finding) -> bool:
        """Return whether a comment suppresses a finding."""
        if finding.code.startswith("Q") and finding.line in self._quotes:
            return True
        line = finding.line
        if line not in self._codes:
            self._codes[line] = self._read(line)
        return finding.code.startswith(self._codes[line])

    def covers_by_plugin(self, finding: Finding) -> bool:
        """Return whether a comment suppresses a finding of the plugins for quotes and imports."""
        if not finding.code.startswith("I"):
            return finding.code.startswith("Q") and finding.line in self._quotes
        matched = re.search(_OF_IMPORTS, self._text.lines[finding.line - 1], re.IGNORECASE)
        codes = matched and matched["codes"]
        return bool(matched) and (not codes or finding.code in re.split(r"[,\s]", codes))

    def _read(self, line: int) -> tuple[str, ...]:
        first, last = self._groups.get(line, (line, line))
        joined = "".join(self._text.lines[first - 1 : last])
        matched = re.search(_INLINE, joined, re.IGNORECASE)
        if matched is None:
            return ()
        if matched["codes"] is None:
            return _ALL
        return tuple(code for code in re.split(r"[,\s]", matched["codes"]) if code)


def _groups(text: PythonText) -> dict[int, tuple[int, int]]:
    """Return the first and last row of each part joined by strings or backslashes."""
    result: dict[int, tuple[int, int]] = {}
    first = last = 0
    for token in text.tokens:
        if token.type in (ENDMARKER, DEDENT):
            continue
        first = min(first, token.start[0]) if first else token.start[0]
        last = max(last, token.end[0])
        if token.type in NEWLINES:
            for row in range(first, last + 1):
                result[row] = (first, last)
            first = last = 0
    return result
