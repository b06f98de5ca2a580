"""The style findings of one file: those of our own rules and of ruff, merged."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain, pairwise
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.ament.codes import CODES
from scaffold.ament.finding import FLAKE8, PEP257, TOO_LARGE, UNPARSABLE, Finding, Replacement
from scaffold.ament.flake8 import builtins as shadowing
from scaffold.ament.flake8 import (
    complexity,
    comprehensions,
    flakes,
    indirect_names,
    noqa,
    plugins,
    quotes,
)
from scaffold.ament.flake8.import_order import check as import_order
from scaffold.ament.flake8.options import AMENT, Options
from scaffold.ament.flake8.pycodestyle import (
    blank_lines,
    continuation,
    indentation,
    keyword_spacing,
    operators,
    optional,
    physical,
    statements,
)
from scaffold.ament.pep257 import complete
from scaffold.ament.pep257 import form as docstrings
from scaffold.ament.python_text.logical import LogicalLine
from scaffold.ament.python_text.text import BOM, PythonText, decode
from scaffold.ament.ruff import MOST_OF_A_LINE, RuffDiagnostic, plain, worded
from scaffold.ament.settings import Settings
from scaffold.errors import exhausted
from scaffold.model.rclpy.topics.transforms import CONVERSIONS

if TYPE_CHECKING:
    from scaffold.model.python.module import PythonModule

MOST_EDITS = 200
"""The maximum number of edits per fix; lines with more need several rounds."""

_TAKEN = "E211 E261 E262 E265 E266 E401 W605"
TAKEN = frozenset(_TAKEN.split())
"""Codes for which ruff and pycodestyle agree."""

_EXCEPTIONS = "multiple exception types must be parenthesized"
"""The start of ruff's message about ``except A, b:``, which Python 3.14 allows again."""
_OF_PYTHON_2 = "exceptions without parentheses; write `except A as b:`, or `except (A, B):`"
_OWN = (blank_lines, statements, indirect_names, comprehensions)
_CONFIGURED = (
    indentation,
    continuation,
    quotes,
    import_order,
    shadowing,
    plugins,
    optional,
    complexity,
)
"""Codes that depend on options of flake8."""


def check(
    path: str,
    data: bytes,
    ask_ruff: Callable[[], Sequence[RuffDiagnostic]],
    settings: Sequence[Settings],
    parsed: PythonModule | None = None,
) -> list[Finding]:
    """Return the findings of one file.

    Args:
        path: The path of the file in its package.
        data: Its bytes.
        ask_ruff: Waits for ruff and returns its diagnostics; called after our own
            rules, which run at the same time as ruff.
        settings: The linters of the file, with their options.
        parsed: The file, if parsed before.
    """
    decoded = decode(data)
    is_same = parsed is not None and parsed.source.text.removeprefix(BOM) == decoded.text
    text = PythonText(path, decoded.text, parsed.index if parsed and is_same else None)
    if text.why_unchecked:
        linters = settings[0].linters
        return [Finding(TOO_LARGE, 1, 1, text.why_unchecked, linters=linters)]
    own = [list(_own_findings(text, item)) for item in settings]
    reported = ask_ruff()
    broken = _broken(text, reported, is_clean=decoded.is_clean)
    if broken is not None:
        return _unique(_reported([broken], settings))
    results = [_findings_for(text, *item, reported) for item in zip(settings, own, strict=True)]
    judged = results[0] if len(results) == 1 else _unique(chain.from_iterable(results))
    if text.is_too_deep:
        linters = settings[0].linters
        judged.insert(0, Finding(UNPARSABLE, 1, 1, exhausted(RecursionError()), linters=linters))
    return judged


def _findings_for(
    text: PythonText,
    settings: Settings,
    own: Sequence[Finding],
    reported: Sequence[RuffDiagnostic],
) -> list[Finding]:
    """Return the findings for one of the settings, given those of our own rules."""
    options = settings.flake8
    ruff_findings = _from_ruff(text, reported, options)
    if options.inline_quotes != AMENT.inline_quotes:
        reported = [item for item in reported if not item.code.startswith("Q")]
    placed = [*flakes.placed(text, reported)]
    findings = _reported(_with_fixes([*ruff_findings, *own], placed), [settings])
    silence = noqa.apply_of_plugins if options.disable_noqa else noqa.apply
    return [*map(_Alignment(text).keep_alignment, _unique(silence(text, findings)))]


def _reported(findings: Iterable[Finding], settings: Sequence[Settings]) -> list[Finding]:
    """Return the findings that some linter reports."""
    pairs = ((item, settings_.linters_of(item)) for settings_ in settings for item in findings)
    return [
        item if item.linters == linters else item._replace(linters=linters)
        for item, linters in pairs
        if linters
    ]


def _own_findings(text: PythonText, settings: Settings) -> Iterator[Finding]:
    # Without a tree, a newer Python may still parse the file: ruff covers the other rules.
    counts: dict[tuple[str, int], int] = {}
    for finding in _all_own(text, settings):
        key = finding.code, finding.line
        counts[key] = count = counts.get(key, 0) + 1
        if count <= MOST_OF_A_LINE:
            yield finding


def _all_own(text: PythonText, settings: Settings) -> Iterator[Finding]:
    options = settings.flake8
    yield from physical.check(text, options.max_line_length)
    if text.tree is None:
        return
    for module in _OWN:
        yield from module.check(text)
    for configured in _CONFIGURED:
        yield from configured.check(text, options)
    yield from (
        complete.check(text, settings) if complete.is_needed(settings) else (docstrings.check(text))
    )


def _broken(
    text: PythonText, diagnostics: Sequence[RuffDiagnostic], *, is_clean: bool
) -> Finding | None:
    """Return the finding for a file that Python 3.12 cannot parse."""
    both = FLAKE8 | PEP257
    if not is_clean:
        return Finding(
            "E902", 1, 1, "the bytes are not text of the declared encoding", linters=both
        )
    own = _syntax_error(text) if text.tree is None else None
    errors = [
        (item.line, item.column, worded(item.message)) for item in diagnostics if not item.code
    ]
    if not errors and isinstance(own, IndentationError):
        errors = [(1, 1, own.msg)]  # ruff uses another tab width
    if not errors:
        return None
    line, column, message = min(errors)
    if message.startswith(_EXCEPTIONS):
        message = _OF_PYTHON_2
    if own is not None and own.lineno:
        # It reports the same line as flake8.
        line, column = own.lineno, max(own.offset or 1, 1)
    return Finding(
        "E999",
        line,
        column,
        f"not valid Python {distributions.target().python_version}: {message}",
        linters=both,
    )


def _syntax_error(text: PythonText) -> SyntaxError | None:
    """Return the syntax error that the running Python reports."""
    import ast
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            ast.parse(text.text)
        except SyntaxError as error:
            return error
        except (ValueError, RecursionError, MemoryError):
            pass
    return None


def _from_ruff(
    text: PythonText, diagnostics: Sequence[RuffDiagnostic], options: Options
) -> Iterator[Finding]:
    if text.tree is None:
        yield from (plain(item) for item in diagnostics if item.code in CODES)
        return
    yield from flakes.check(text, options.builtins, diagnostics)
    lines: dict[str, set[int]] = {}
    for diagnostic in diagnostics:
        lines.setdefault(diagnostic.code, set()).add(diagnostic.line)
    is_optional = options.reports("E226")
    spaced = operators.CANDIDATES + (operators.ARITHMETIC_CANDIDATES if is_optional else "")
    for module, candidates in ((operators, spaced), (keyword_spacing, keyword_spacing.CANDIDATES)):
        rows = {row for code in module.CODES for row in lines.get(code, ())}
        if module is operators:
            rows.update(
                text.line_of(at.start()) for at in re.finditer(operators.CONTINUED, text.text)
            )
        logical_lines = [text.logical_line_at(row) for row in sorted(rows)]
        for logical in dict.fromkeys((*logical_lines, *text.lines_with(candidates))):
            if logical is not None:
                yield from module.check(logical)
    for diagnostic in diagnostics:
        if diagnostic.code in TAKEN:
            yield plain(diagnostic)


def _with_fixes(
    findings: Iterable[Finding], diagnostics: Sequence[RuffDiagnostic]
) -> list[Finding]:
    """Add the fixes of ruff for the same code at the same line to our findings."""
    same_place: dict[tuple[str, int], list[Finding]] = {}
    for item in diagnostics:
        if item.fix and not _loads_conversions(item):
            same_place.setdefault((item.code, item.line), []).append(plain(item))
    fixes = {key: _merged(same) for key, same in same_place.items()}
    result = []
    for finding in findings:
        other = fixes.get((finding.code, finding.line))
        if other is not None and not finding.fix:
            result.append(
                finding._replace(
                    fix=other.fix, fix_title=other.fix_title, fix_is_unsafe=other.fix_is_unsafe
                )
            )
        else:
            result.append(finding)
    return result


def _loads_conversions(item: RuffDiagnostic) -> bool:
    """Return whether an unused import has side effects, like those of tf2 conversions."""
    name = item.message.partition("`")[2].partition(".")[0].partition("`")[0].partition(" ")[0]
    return item.code == "F401" and name in CONVERSIONS


class _Alignment:
    """The columns of aligned continuation lines."""

    def __init__(self, text: PythonText) -> None:
        self._text = text
        self._starts: dict[int, frozenset[int]] = {}
        self._columns: dict[int, list[int]] = {}

    def keep_alignment(self, finding: Finding) -> Finding:
        """Return the finding, without a fix that would break the alignment of lines below."""
        for row, start, end_row, end, new in finding.fix:
            if row != end_row or "\n" in new or end - start == len(new):
                continue
            logical = self._text.logical_line_at(row)
            if logical is None or logical.end_row == row:
                continue
            starts = self._line_starts(logical)
            columns = self._columns_of(logical, row)
            behind = columns[bisect_left(columns, start) :]
            if len(behind) > MOST_EDITS or not starts.isdisjoint(behind):
                return finding._replace(fix=(), fix_title="")
        return finding

    def _line_starts(self, logical: LogicalLine) -> frozenset[int]:
        """Return the columns, from 0, where the continuation lines of a statement start."""
        if logical.row not in self._starts:
            self._starts[logical.row] = frozenset(
                item.start[1]
                for before, item in pairwise(logical.tokens)
                if item.start[0] > before.start[0]
            )
        return self._starts[logical.row]

    def _columns_of(self, logical: LogicalLine, row: int) -> list[int]:
        """Return the columns, from 0, of the tokens of a row."""
        if row not in self._columns:
            self._columns[row] = [item.start[1] for item in logical.tokens if item.start[0] == row]
        return self._columns[row]


def _unique(findings: Iterable[Finding]) -> list[Finding]:
    """Return one finding for each line and code, in reading order."""
    result: dict[tuple[int, str], list[Finding]] = {}
    for finding in sorted(findings, key=lambda item: (item.line, item.column, item.code)):
        result.setdefault((finding.line, finding.code), []).append(finding)
    return [_merged(same) for same in result.values()]


def _merged(findings: Sequence[Finding]) -> Finding:
    """Return the first of some findings, with the fixes of all if they do not overlap."""
    first, *others = findings
    if not others:
        return first
    linters = first.linters
    for other in others:
        linters |= other.linters
    fixable = [finding for finding in findings if finding.fix]
    if not fixable:
        return first._replace(linters=linters)
    leading = fixable[0]
    edits = sorted({*leading.fix})
    has_grown = False
    before = leading.fix
    for other in fixable[1:] if not _overlap(edits) else ():
        if len(edits) > MOST_EDITS:
            break
        # A fix of a whole line belongs to each of its findings.
        if other.fix_is_unsafe == leading.fix_is_unsafe and other.fix != before:
            has_grown = _added(edits, other.fix) or has_grown
        before = other.fix
    return first._replace(
        linters=linters,
        fix=tuple(edits) if has_grown else leading.fix,
        fix_title=leading.fix_title,
        fix_is_unsafe=leading.fix_is_unsafe,
    )


def _added(edits: list[Replacement], more: Sequence[Replacement]) -> bool:
    """Merge sorted edits, all or none, as overlapping ones are impossible."""
    new = sorted({*more})
    if _overlap(new):
        return False
    places: list[tuple[int, Replacement]] = []
    for edit in new:
        at = bisect_left(edits, edit)
        if edits[at : at + 1] == [edit]:
            continue
        if _overlap([*edits[max(at - 1, 0) : at], edit, *edits[at : at + 1]]):
            return False
        places.append((at, edit))
    for at, edit in reversed(places):
        edits.insert(at, edit)
    return True


def _overlap(edits: Sequence[Replacement]) -> bool:
    """Return whether any of some sorted edits overlap."""
    return any(item[2:4] > other[:2] for item, other in pairwise(edits))
