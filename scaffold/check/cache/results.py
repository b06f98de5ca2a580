"""Checks only the packages that an earlier run cannot speak for, and remembers this one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from scaffold import edits as kinds
from scaffold.check.cache.runs import Run, Slot
from scaffold.check.cache.worker_reads import disk_of, uses
from scaffold.check.engine_rules import RuleCrashed
from scaffold.check.session import Result, Session
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.edits import Change, Fix, Safety
from scaffold.errors import EnvironmentMissingError
from scaffold.files.disk import holds
from scaffold.record import NamedTuple
from scaffold.source import Location

if TYPE_CHECKING:
    from scaffold.check.cache.runs import Seen
    from scaffold.files.disk import Disk
    from scaffold.model.discovery.targets import Target
    from scaffold.model.package import Identity, Package


class _Known(NamedTuple):
    """A package in a remembered run, made of what marshal can write."""

    directory: str
    only: tuple[str, ...] | None
    identity: tuple[str, bool]
    """What every other package may depend on."""
    needs: tuple[int, ...] | None
    """Places of the packages that the verdict depends on; ``None`` for all."""
    files: int
    diagnostics: tuple[tuple[Any, ...], ...]


class Memory:
    """What is known of some packages from the last run of the same command line."""

    def __init__(self, run: Run | None, targets: Sequence[Target]) -> None:
        self._targets = targets
        self._known: dict[int, _Known] = {}
        """By place, the packages whose verdict still stands."""
        self._trees: dict[int, Seen] = {}
        self._outside: Seen = {}
        if run is not None and run.is_same_outside():
            self._recall(run, [_Known(*one) for one in run.results])

    def _recall(self, run: Run, known: Sequence[_Known]) -> None:
        if [(one.directory, one.only) for one in known] != [_asked(one) for one in self._targets]:
            return
        same = [run.is_same(at) for at in range(len(run.trees))]
        for one, target, is_same in zip(known, self._targets, same, strict=True):
            if not is_same and one.identity != tuple(target.package.identity):
                return
        for at, one in enumerate(known):
            needs = range(len(known)) if one.needs is None else one.needs
            if same[at] and all(same[other] for other in needs):
                self._known[at] = one
                self._targets[at].package.identify(*one.identity)
                self._outside = run.outside
                self._trees[at] = run.trees[at] or {}

    def run(self, session: Session) -> Iterator[Result]:
        """Yield the results of all packages in their order; check those that are not known."""
        fresh = [one for at, one in enumerate(self._targets) if at not in self._known]
        checked = session.run(fresh)
        for at, target in enumerate(self._targets):
            known = self._known.get(at)
            if known is None:
                yield next(checked)
            else:
                found = [_decode(one) for one in known.diagnostics]
                yield Result(target.package, known.files, found)

    def save(
        self,
        slot: Slot,
        disk: Disk,
        results: Sequence[Result],
        code: int,
        output: str | None,
        warnings: Sequence[str] = (),
    ) -> None:
        """Remember a complete run.

        Args:
            slot: Where.
            disk: What was looked at outside of the packages.
            results: Of all packages, in their order.
            code: The exit code.
            output: What standard output got; ``None`` if something was written elsewhere, too.
            warnings: What of the configuration is ignored.
        """
        from scaffold.ament import ruff

        with suppress(EnvironmentMissingError):  # nobody may have asked for style
            disk.stamp(ruff.executable())
        disk.note(self._outside)
        if not (disk.is_settled and holds(disk.seen)):
            return
        identities = [one.package.identity for one in self._targets]
        needs = Needs([one.package for one in self._targets], identities)
        trees: list[Seen | None] = []
        found: list[tuple[object, ...]] = []
        for at, (target, result) in enumerate(zip(self._targets, results, strict=True)):
            known = self._known.get(at) or _Known(
                *_asked(target),
                (*identities[at],),
                needs.of(target.package),
                result.files,
                tuple(_encode(one) for one in result.diagnostics),
            )
            trees.append(_seen(target.package, self._trees.get(at, {}), result))
            found.append(tuple(known))
        slot.save(Run(disk.seen, trees, found, code, output, (*warnings,)))


def _asked(target: Target) -> tuple[str, tuple[str, ...] | None]:
    only = None if target.only is None else tuple(sorted(target.only))
    return target.package.directory, only


def _seen(package: Package, before: Seen, result: Result) -> Seen | None:
    """Return what was looked at in a package; ``None`` if its verdict is not to be kept."""
    disk = disk_of(package)
    disk.note(before)
    crashed = any(one.code == RuleCrashed.code for one in result.diagnostics)
    if crashed or not (disk.is_settled and package.is_repeatable):
        return None
    # Ruff reads the files by itself, a little later.
    return disk.seen if holds(disk.seen) else None


class Needs:
    """Which packages a verdict depends on, directly or through others."""

    def __init__(self, packages: Sequence[Package], identities: Sequence[Identity]) -> None:
        self._packages = packages
        self._places = {id(package): at for at, package in enumerate(packages)}
        self._defining = {at for at, one in enumerate(identities) if one.may_define_interfaces}

    def of(self, package: Package) -> tuple[int, ...] | None:
        """Return the places of the packages, ``None`` for all."""
        needed: set[int] = set()
        pending = [package]
        while pending:
            used, uses_all, uses_interfaces = uses(pending.pop(), self._places)
            if uses_all:
                return None
            used |= self._defining if uses_interfaces else set()
            pending += [self._packages[at] for at in used - needed]
            needed |= used
        return tuple(sorted(needed))


def _encode(one: Diagnostic) -> tuple[Any, ...]:
    fix = _encode_fix(one.fix) if one.fix else None
    return one.code, one.name, one.severity.value, tuple(one.location), one.message, fix, one.cause


def _encode_fix(fix: Fix) -> tuple[Any, ...]:
    changes = [(type(change).__name__, *change) for change in fix.changes]
    return fix.title, changes, fix.safety.value


def _decode(stored: tuple[Any, ...]) -> Diagnostic:
    code, name, severity, location, message, fix, cause = stored
    made = _decode_fix(*fix) if fix else None
    return Diagnostic(code, name, Severity(severity), Location(*location), message, made, cause)


def _decode_fix(title: str, changes: Sequence[tuple[Any, ...]], safety: str) -> Fix:
    made: list[Change] = [getattr(kinds, kind)(*fields) for kind, *fields in changes]
    return Fix(title, tuple(made), Safety(safety))
