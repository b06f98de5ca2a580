"""Baselines: accepted findings, so that only new ones are reported.

A baseline is a JSON file with one sorted entry per line, so that git can merge the additions of two
branches. Entries contain no line numbers, so they still match after lines have moved.
"""

from __future__ import annotations

import json
from collections.abc import Collection, Iterator, Sequence

from scaffold.check.result import Result
from scaffold.check.rules.engine_rules import RuleCrashed
from scaffold.check.session import Session
from scaffold.errors import InputError
from scaffold.files.disk import Disk
from scaffold.model.discovery.targets import Target
from scaffold.record import NamedTuple
from scaffold.reporters.fingerprints import Fingerprints
from scaffold.reporters.paths import in_repository
from scaffold.reporters.summary import count

VERSION = 1
_HOW = "write it with `check --write-baseline`"


class Entry(NamedTuple):
    """An accepted finding."""

    path: str
    code: str
    message: str
    fingerprint: str


class Filtered(NamedTuple):
    """Results without accepted findings, and notes about the baseline."""

    results: list[Result]
    note: str


def text(results: Sequence[Result]) -> str:
    """Return the baseline of the findings of a run."""
    lines = [json.dumps(entry._asdict(), ensure_ascii=False) for entry in sorted(_entries(results))]
    body = ",\n".join(lines)
    return f'{{"version": {VERSION}, "findings": [\n{body}\n]}}\n'


def _entries(results: Sequence[Result]) -> Iterator[Entry]:
    fingerprints = Fingerprints()
    for result in results:
        for diagnostic in result.diagnostics:
            if diagnostic.code != RuleCrashed.code:
                path = in_repository(result.package, diagnostic.location.path)
                fingerprint = fingerprints.of(result.package, diagnostic)
                yield Entry(path, diagnostic.code, diagnostic.message, fingerprint)


def read(path: str, disk: Disk) -> list[Entry]:
    """Return the entries of a baseline.

    Args:
        path: The file.
        disk: Records its content, so that cached results depend on it.

    Raises:
        InputError: there is no such file, or it is not a baseline.
    """
    try:
        data = json.loads(disk.read(path))
        return [Entry(**entry) for entry in _findings(data)]
    except OSError as error:
        raise InputError(f"--baseline {path}: {error.strerror}; {_HOW}") from error
    except (ValueError, RecursionError) as error:
        raise InputError(f"--baseline {path}: not a baseline: {error}; {_HOW}") from error


def _findings(data: object) -> list[dict[str, str]]:
    """Return the entries of a file; raise ValueError if it has another form."""
    version = data.get("version") if isinstance(data, dict) else None
    if not isinstance(data, dict) or version != VERSION:
        raise ValueError(f"version is {version!r} instead of {VERSION}")
    findings = data.get("findings")
    if not isinstance(findings, list):
        raise ValueError("'findings' is not a list")  # noqa: TRY004  `read` names the file for all
    for at, entry in enumerate(findings, 1):
        is_entry = isinstance(entry, dict) and {*entry} == {*Entry._fields}
        if not is_entry or not all(isinstance(value, str) for value in entry.values()):
            raise ValueError(f"entry {at} is not one of {', '.join(Entry._fields)}")
    return findings


def hide(
    entries: Collection[Entry],
    results: Sequence[Result],
    targets: Sequence[Target],
    session: Session,
    name: str,
) -> Filtered:
    """Remove the findings of a baseline from results.

    Args:
        entries: The baseline.
        results: The findings.
        targets: The checked packages, in the same order.
        session: The session: entries with codes that it does not report are not counted as missing.
        name: The name of the baseline, for messages.
    """
    accepted = {entry.fingerprint for entry in entries}
    seen: set[str] = set()
    fingerprints = Fingerprints()
    kept: list[Result] = []
    hidden = 0
    for result in results:
        new = []
        for diagnostic in result.diagnostics:
            fingerprint = fingerprints.of(result.package, diagnostic)
            if fingerprint in accepted and diagnostic.code != RuleCrashed.code:
                hidden += 1
                seen.add(fingerprint)
            else:
                new.append(diagnostic)
        kept.append(Result(result.package, result.files, new, result.verdict))
    covered = _checked_prefixes(targets)
    gone = sum(
        entry.fingerprint not in seen
        and session.selection.wants(entry.code)
        and entry.path.startswith(covered)
        for entry in {*entries}
    )
    note = f"baseline {name}: {count(hidden, 'finding')} hidden"
    if gone:
        verb = "occurs" if gone == 1 else "occur"
        noun = "entry" if gone == 1 else "entries"
        note += f", {gone:,} {noun} no longer {verb}"
    return Filtered(kept, note)


def _checked_prefixes(targets: Sequence[Target]) -> tuple[str, ...]:
    """Return the prefixes of the paths that were checked."""
    prefixes: list[str] = []
    for package, only in targets:
        if only is not None:
            prefixes += [in_repository(package, path) for path in only]
        else:
            place = in_repository(package, ".")
            prefixes.append("" if place == "." else f"{place}/")
    return tuple(prefixes)
