"""Checks only the packages whose cached results are stale, and caches the new ones."""

from __future__ import annotations

import marshal
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any, cast

from scaffold.check.cache.runs import CachedRun, RunEntry
from scaffold.check.cache.worker_reads import disk_of, uses
from scaffold.check.result import Earlier, Part, Result, Verdict
from scaffold.check.rules.engine_rules import RuleCrashed
from scaffold.diagnostic import Diagnostic, Effect, Severity
from scaffold.edits import Change, CreateFile, Edit, Fix, MakeExecutable, Remove, Safety
from scaffold.errors import EnvironmentMissingError
from scaffold.files.disk import holds
from scaffold.model.package import Identity
from scaffold.model.reads import StoredFact, is_followed
from scaffold.record import NamedTuple
from scaffold.source import Location, ViewError

if TYPE_CHECKING:
    from scaffold.check.cache.runs import Seen
    from scaffold.check.session import Session
    from scaffold.files.disk import Disk
    from scaffold.model.discovery.targets import Target
    from scaffold.model.package import Package
    from scaffold.model.reads import FactId


_NOTHING = Part(frozenset(), frozenset(), ())
"""The part of a rule that read no Python file and found nothing, the usual case."""


class _Record(NamedTuple):
    """The cached results of a package, in types that marshal can write."""

    directory: str
    only: tuple[str, ...] | None
    identity: tuple[str, bool, str, bool]
    """See `Identity`."""
    needs: tuple[int, ...] | None
    """Indices of the packages that the result depends on; ``None`` for all."""
    files: int
    findings: bytes
    """The diagnostics, and the same in parts, as marshal wrote them; see ``_encode_verdict``.

    As a whole they would take ten times the memory, and of most packages nobody needs them.
    """
    foreign: tuple[str, ...]
    """The kinds of foreign files."""


class ResultCache:
    """The results of packages from the last run with the same packages, rules and targets."""

    def __init__(
        self, run: CachedRun | None, targets: Sequence[Target], *, is_saved: bool = True
    ) -> None:
        self._targets = targets
        self._is_saved = is_saved
        self._results: dict[int, bytes] = {}
        """The findings of this run by index; see ``_Record``."""
        self._records: dict[int, _Record] = {}
        """The packages with unchanged findings, by index."""
        self._earlier: dict[str, Earlier] = {}
        """The packages with some unchanged findings, by directory."""
        self._coders: dict[str, _Coder] = {}
        """The decoders of earlier findings, by directory."""
        self._needed: dict[int, tuple[int, ...] | None] = {}
        """The packages that the remaining findings depend on."""
        self._trees: dict[int, Seen] = {}
        self._outside: Seen = {}
        if run is not None and run.is_same_outside():
            self._recall(run, [_Record(*result) for result in run.results])

    def _recall(self, run: CachedRun, stored: Sequence[_Record]) -> None:
        if [(item.directory, item.only) for item in stored] != [
            _key_of(item) for item in self._targets
        ]:
            return
        edits = [self._edits(run, at) for at in range(len(stored))]
        for record, target, edited in zip(stored, self._targets, edits, strict=True):
            is_same = edited is not None and all(path.endswith(".py") for path in edited)
            if not is_same and record.identity != target.package.identity:
                return
        for at, record in enumerate(stored):
            needs = [at, *(range(len(stored)) if record.needs is None else record.needs)]
            edited = frozenset[str]()
            for other in needs:
                if edits[other] is None:
                    break
                edited |= edits[other] or frozenset()
            else:
                self._remember(run, at, record, edited)

    def _edits(self, run: CachedRun, at: int) -> frozenset[str] | None:
        """Return the followed files of a package that were edited, ``None`` after other changes."""
        package = self._targets[at].package
        changed = run.changed(at)
        if changed is None:
            return None
        start = len(package.full_path(""))
        edited: set[str] = set()
        for kind, path in changed:
            full = package.full_path(path[start:])
            # A removed file is missing from its directory, or has another type there.
            if kind != "content" or path != full or not is_followed(path):
                return None
            edited.add(full)
        return frozenset(edited)

    def _remember(self, run: CachedRun, at: int, record: _Record, edited: frozenset[str]) -> None:
        package = self._targets[at].package
        _, verdict = marshal.loads(record.findings) if edited else ((), None)  # noqa: S302  own files
        if not edited or _is_unaffected(package, verdict, edited):
            self._records[at] = record
            self._trees[at] = run.trees[at] or {}
        elif verdict is not None and not _configures(package, verdict, edited):
            self._needed[at] = record.needs
            coder = self._coders[package.directory] = _Coder()
            decoded = _decode_verdict(verdict, coder.decode)
            self._earlier[package.directory] = Earlier.of(package, decoded, edited)
            full = {("content", path) for path in edited}
            seen = (run.trees[at] or {}).items()
            self._trees[at] = {asked: answer for asked, answer in seen if asked not in full}
        else:
            return
        package.identify(Identity(*record.identity))
        self._outside = run.outside

    def run(self, session: Session) -> Iterator[Result]:
        """Yield the results of all packages in order; check those without a valid result."""
        fresh = [item for at, item in enumerate(self._targets) if at not in self._records]
        checked = session.run(fresh, self._earlier)
        for at, target in enumerate(self._targets):
            record = self._records.get(at)
            if record is None:
                result = next(checked)
                if self._is_saved:
                    coder = self._coders.pop(target.package.directory, None) or _Coder()
                    self._results[at] = _encode_findings(result, coder.encode)
                yield result._replace(verdict=None)
            else:
                stored, _ = marshal.loads(record.findings)  # noqa: S302  own files
                diagnostics = [*map(_decode, stored)]
                yield Result(target.package, record.files, diagnostics, None, record.foreign)

    def save(self, entry: RunEntry, disk: Disk, results: Sequence[Result]) -> bool:
        """Store a complete run; return whether it was stored: not if files changed meanwhile.

        Args:
            entry: The cache entry.
            disk: The accesses outside of the packages.
            results: The results of all packages, in order.
        """
        from scaffold.ament import ruff

        with suppress(EnvironmentMissingError):  # style may not be requested
            disk.stamp(ruff.executable())
        disk.note(self._outside)
        if not (disk.is_settled and holds(disk.seen)):
            return False
        if entry.last is not None and self._is_same(entry.last, disk):
            return True
        identities = [item.package.identity for item in self._targets]
        needs = Needs([item.package for item in self._targets], identities)
        trees: list[Seen | None] = []
        records: list[tuple[object, ...]] = []
        for at, (target, result) in enumerate(zip(self._targets, results, strict=True)):
            needed = needs.of(target.package, self._needed.get(at, ()))
            record = self._records.get(at) or _new_record(target, result, needed, self._results[at])
            trees.append(_accesses(target.package, self._trees.get(at, {}), result))
            records.append(tuple(record))
        entry.save(dict(disk.seen), trees, records)
        return True

    def _is_same(self, last: CachedRun, disk: Disk) -> bool:
        """Return whether the stored run is complete, including accesses for the report."""
        if len(self._records) < len(self._targets) or disk.seen != last.outside:
            return False
        return all(
            tree is not None and disk_of(target.package).seen.keys() <= tree.keys()
            for target, tree in zip(self._targets, last.trees, strict=True)
        )


def _new_record(
    target: Target, result: Result, needed: tuple[int, ...] | None, findings: bytes
) -> _Record:
    identity = (*target.package.identity,)
    return _Record(*_key_of(target), identity, needed, result.files, findings, result.foreign)


def _encode_findings(result: Result, encode: _Encode) -> bytes:
    diagnostics = tuple(map(encode, result.diagnostics))
    verdict = _encode_verdict(result.verdict, encode) if result.verdict else None
    return marshal.dumps((diagnostics, verdict))


def _is_unaffected(
    package: Package, verdict: tuple[Any, ...] | None, edited: frozenset[str]
) -> bool:
    """Return whether no finding in a package depends on the edited files.

    Filters of its findings may depend on the manifests of other packages.
    """
    start = package.full_path("")
    if verdict is None or any(path.startswith(start) or path[-3:] != ".py" for path in edited):
        return False
    paths, parts, types, *_, facts, _ = verdict
    places = {at for at, path in enumerate(paths) if path in edited}
    made_of = [files for _, files, *_ in (*parts, *types, *facts)]
    return all(map(places.isdisjoint, made_of))


def _configures(package: Package, verdict: tuple[Any, ...], edited: frozenset[str]) -> bool:
    """Return whether an edited file is or was a style configuration."""
    paths, *_, configuring = verdict
    if any(paths[at] in edited for at in configuring):
        return True
    start = package.full_path("")
    tests = [path for path in edited if path.startswith(start) and "test" in path]
    try:
        return any(b"ament_" in package.data(path[len(start) :]) for path in tests)
    except ViewError:
        return True


def _key_of(target: Target) -> tuple[str, tuple[str, ...] | None]:
    only = None if target.only is None else tuple(sorted(target.only))
    return target.package.directory, only


def _accesses(package: Package, before: Seen, result: Result) -> Seen | None:
    """Return the accesses in a package; ``None`` if its result must not be stored."""
    disk = disk_of(package)
    disk.note(before)
    crashed = any(diagnostic.code == RuleCrashed.code for diagnostic in result.diagnostics)
    if crashed or not (disk.is_settled and package.is_repeatable):
        return None
    # Ruff reads the files itself, slightly later.
    return disk.seen if holds(disk.seen) else None


class Needs:
    """The packages that a result depends on, directly and indirectly."""

    def __init__(self, packages: Sequence[Package], identities: Sequence[Identity]) -> None:
        self._packages = packages
        self._places = {id(package): at for at, package in enumerate(packages)}
        self._defining = {at for at, item in enumerate(identities) if item.may_define_interfaces}

    def of(self, package: Package, before: Iterable[int] | None = ()) -> tuple[int, ...] | None:
        """Return the indices of the packages, ``None`` for all.

        Args:
            package: The package of the result.
            before: The indices of the packages that reused parts depend on.
        """
        if before is None:
            return None
        needed = set(before)
        pending = [package]
        while pending:
            used, uses_all, uses_interfaces = uses(pending.pop(), self._places)
            if uses_all:
                return None
            used |= self._defining if uses_interfaces else set()
            pending += [self._packages[at] for at in used - needed]
            needed |= used
        return tuple(sorted(needed))


class _Coder:
    """Converts diagnostics to data for marshal and back, each only once."""

    def __init__(self) -> None:
        self._stored: dict[int, tuple[Any, ...]] = {}
        self._kept: list[Diagnostic] = []
        self._texts: dict[str, str] = {}
        """Interned strings, as marshal writes an object only once."""

    def encode(self, diagnostic: Diagnostic) -> tuple[Any, ...]:
        """Return a diagnostic as a tuple."""
        stored = self._stored.get(id(diagnostic))
        return stored or self._note(diagnostic, _encode(diagnostic, self._texts.setdefault))

    def decode(self, stored: tuple[Any, ...]) -> Diagnostic:
        """Decode a diagnostic from a tuple."""
        diagnostic = _decode(stored)
        self._note(diagnostic, stored)
        return diagnostic

    def _note(self, diagnostic: Diagnostic, stored: tuple[Any, ...]) -> tuple[Any, ...]:
        self._kept.append(diagnostic)  # so that no other object gets its id
        self._stored[id(diagnostic)] = stored
        return stored


_Encode = Callable[[Diagnostic], "tuple[Any, ...]"]
_Decode = Callable[["tuple[Any, ...]"], Diagnostic]


def _encode_verdict(verdict: Verdict, encode: _Encode) -> tuple[Any, ...]:
    """Encode a verdict as a tuple; its paths are indices into the first item."""
    paths: dict[str, int] = {}

    def places(files: Iterable[str]) -> tuple[int, ...]:
        return tuple([paths.setdefault(path, len(paths)) for path in files])

    numbers = {wanted: at for at, wanted in enumerate(verdict.facts)}

    def numbered(facts: Iterable[FactId]) -> tuple[int, ...]:
        return tuple([numbers[wanted] for wanted in facts])

    parts = [
        (key, places(part.files), numbered(part.facts), tuple(map(encode, part.diagnostics)))
        for key, part in verdict.parts.items()
        if part != _NOTHING
    ]
    types = [
        (path, places(part.files), numbered(part.facts), tuple(map(encode, part.diagnostics)))
        for path, part in verdict.types.items()
    ]
    silent = " ".join(key for key, part in verdict.parts.items() if part == _NOTHING)
    style = [(path, tuple(map(encode, item))) for path, item in verdict.style.items()]
    facts = [
        (wanted, places(fact.files), numbered(fact.facts), fact.encoded)
        for wanted, fact in verdict.facts.items()
    ]
    unparsable = tuple(map(encode, verdict.unparsable))
    configuring = places(sorted(verdict.configuring))
    return tuple(paths), parts, types, silent, style, unparsable, facts, configuring


def _decode_verdict(stored: tuple[Any, ...], decode: _Decode) -> Verdict:
    paths, parts, types, silent, style, unparsable, facts, configuring = stored
    names = [wanted for wanted, *_ in facts]

    sets: dict[tuple[int, ...], frozenset[str]] = {}

    def files(places: tuple[int, ...]) -> frozenset[str]:
        if places not in sets:
            sets[places] = frozenset([paths[at] for at in places])
        return sets[places]

    def ids(numbers: Iterable[int]) -> list[FactId]:
        return [names[number] for number in numbers]

    def decoded(parts: Iterable[tuple[Any, ...]]) -> dict[str, Part]:
        return {
            key: Part(files(read), frozenset(ids(used)), tuple(map(decode, item)))
            for key, read, used, item in parts
        }

    return Verdict(
        decoded(parts) | dict.fromkeys(silent.split(), _NOTHING),
        {path: list(map(decode, item)) for path, item in style},
        list(map(decode, unparsable)),
        {
            wanted: _new_tuple(StoredFact, (files(read), tuple(ids(used)), encoded))
            for wanted, read, used, encoded in facts
        },
        decoded(types),
        files(configuring),
    )


def _encode(diagnostic: Diagnostic, once: Callable[[str, str], str]) -> tuple[Any, ...]:
    fix = _encode_fix(diagnostic.fix, once) if diagnostic.fix else None
    message = diagnostic.message
    return (
        diagnostic.code,
        diagnostic.name,
        diagnostic.severity.value,
        tuple(diagnostic.location),
        once(message, message),
        fix,
        diagnostic.cause,
        None if diagnostic.effect is None else diagnostic.effect.value,
    )


def _encode_fix(fix: Fix, once: Callable[[str, str], str]) -> tuple[Any, ...]:
    changes = [(type(change).__name__, *change) for change in fix.changes]
    return once(fix.title, fix.title), changes, fix.safety.value


def _decode(stored: tuple[Any, ...]) -> Diagnostic:
    code, name, severity, location, message, fix, cause, effect = stored
    place = _new_tuple(Location, location)
    made = _decode_fix(*fix) if fix else None
    fields = (code, name, _SEVERITIES[severity], place, message, made, cause, (), _EFFECTS[effect])
    return cast("Diagnostic", _new_tuple(Diagnostic, fields))


def _decode_fix(title: str, changes: Sequence[tuple[Any, ...]], safety: str) -> Fix:
    made = tuple([_new_tuple(_CHANGES[change[0]], change[1:]) for change in changes])
    return cast("Fix", _new_tuple(Fix, (title, made, _SAFETIES[safety])))


_new_tuple: Any = tuple.__new__
"""A fast constructor of records, as thousands are decoded at each edit."""
_SEVERITIES = {item.value: item for item in Severity}
_EFFECTS: Mapping[int | None, Effect | None] = {None: None} | {item.value: item for item in Effect}
_SAFETIES = {item.value: item for item in Safety}
_CHANGES: Mapping[str, type[Change]] = {
    kind.__name__: kind for kind in (Edit, CreateFile, MakeExecutable, Remove)
}
