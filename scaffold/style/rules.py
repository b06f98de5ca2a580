"""The verdict on one file: our own rules, and what ruff said, put together."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence

from scaffold.style import (
    blank_lines,
    comprehensions,
    continuation,
    defaults,
    docstrings,
    flakes,
    imports,
    indentation,
    literals,
    noqa,
    operators,
    physical,
    quotes,
    redefinitions,
    shadowing,
    statements,
)
from scaffold.style.codes import CODES
from scaffold.style.finding import FLAKE8, PEP257, Finding
from scaffold.style.ruff import Said
from scaffold.style.text import PythonText, decode

_TAKEN = "E211 E261 E262 E265 E266 E401 W605"
TAKEN = frozenset(_TAKEN.split())
"""Codes on which ruff's verdict is pycodestyle's."""

_OWN = (
    physical,
    blank_lines,
    indentation,
    continuation,
    statements,
    quotes,
    redefinitions,
    imports,
    shadowing,
    comprehensions,
    literals,
    docstrings,
)


def check(
    name: str, data: bytes, ask_ruff: Callable[[], Sequence[Said]], linters: int
) -> list[Finding]:
    """Return the findings of one file.

    Args:
        name: The name of the file, without its directory.
        data: Its bytes.
        ask_ruff: Waits for ruff and returns what it says about the file; asked after the own
            rules, which run at the same time as ruff.
        linters: Which of the two linters look at the file.
    """
    decoded = decode(data)
    text = PythonText(name, decoded.text)
    own = list(_own(text))
    said = ask_ruff()
    broken = _broken(text, said, is_clean=decoded.is_clean)
    if broken is not None:
        return [broken._replace(linters=linters)]
    findings = [*_from_ruff(text, said), *own]
    findings = _with_fixes(findings, said)
    kept = [
        finding._replace(linters=finding.linters & linters)
        for finding in findings
        if finding.linters & linters
    ]
    return _once(noqa.apply(text, kept))


def _own(text: PythonText) -> Iterator[Finding]:
    # Without a tree a newer Python may still parse the file: ruff speaks for the other rules.
    for module in _OWN if text.tree is not None else (physical,):
        yield from module.check(text)


def _broken(text: PythonText, said: Sequence[Said], *, is_clean: bool) -> Finding | None:
    """Return the one finding of a file that no Python of the target can read."""
    both = FLAKE8 | PEP257
    if not is_clean:
        return Finding(
            "E902", 1, 1, "the bytes are not text of the declared encoding", linters=both
        )
    errors = [one for one in said if not one.code]
    if not errors:
        return None
    first = min(errors, key=lambda one: (one.line, one.column))
    line, column = first.line, first.column
    if text.tree is None:
        line, column = _place_of_syntax_error(text) or (line, column)
    message = f"not valid Python 3.12: {flakes.worded(first.message)}"
    return Finding("E999", line, column, message, linters=both)


def _place_of_syntax_error(text: PythonText) -> tuple[int, int] | None:
    """Return where the running Python finds the error; it names the line that flake8 names."""
    import ast
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            ast.parse(text.text)
        except SyntaxError as error:
            if error.lineno:
                return error.lineno, max(error.offset or 1, 1)
        except (ValueError, RecursionError, MemoryError):
            pass
    return None


def _from_ruff(text: PythonText, said: Sequence[Said]) -> Iterator[Finding]:
    if text.tree is None:
        yield from (flakes.plain(one) for one in said if one.code in CODES)
        return
    yield from flakes.translate(text, [one for one in said if one.code.startswith("F")])
    for module in (operators, defaults):
        rows = [one.line for one in said if one.code in module.CODES]
        rows += [
            text.line_of(found.start())
            for found in re.finditer(module.CANDIDATES, text.text, re.MULTILINE)
        ]
        logical_lines = {row: text.logical_line_at(row) for row in sorted(set(rows))}
        for logical in dict.fromkeys(one for one in logical_lines.values() if one):
            yield from module.check(logical)
    for one in said:
        if one.code in TAKEN:
            yield flakes.plain(one)


def _with_fixes(findings: Iterable[Finding], said: Sequence[Said]) -> list[Finding]:
    """Give our findings the safe fixes that ruff has for the same code at the same line."""
    fixes = {(one.code, one.line): one for one in said if one.fix}
    result = []
    for finding in findings:
        one = fixes.get((finding.code, finding.line))
        if one is not None and not finding.fix:
            result.append(finding._replace(fix=one.fix, fix_title=one.fix_title))
        else:
            result.append(finding)
    return result


def _once(findings: Iterable[Finding]) -> list[Finding]:
    """Return one finding for each line and code, in reading order."""
    found: dict[tuple[int, str], Finding] = {}
    for finding in sorted(findings, key=lambda one: (one.line, one.column, one.code)):
        key = (finding.line, finding.code)
        if key in found:
            linters = found[key].linters | finding.linters
            found[key] = found[key]._replace(linters=linters)
        else:
            found[key] = finding
    return list(found.values())
