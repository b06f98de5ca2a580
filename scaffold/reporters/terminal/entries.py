"""Findings grouped by cause, the most important first."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Mapping, Sequence

from scaffold import lazy_re
from scaffold.check.result import Result
from scaffold.check.rules import registry
from scaffold.check.rules.rule import Rule
from scaffold.diagnostic import Diagnostic, Effect, Severity
from scaffold.model.package import Package
from scaffold.record import NamedTuple
from scaffold.reporters.order import DEPENDENCY, effect_of, is_dependency, rank

_OF_ROS1 = "of ROS 1"
"""The end of causes that all findings in a file share: it was never ported."""
_UNDEFINED = "F821"
_PLAIN = lazy_re.compile(r"[a-z]+[,:]?")
"""Matches words that are neither names nor numbers."""
_SEVERAL = 3
"""The number of undefined names from which missing imports are assumed."""


class Place(NamedTuple):
    """A finding and its location."""

    package: Package
    finding: Diagnostic


class Entry(NamedTuple):
    """Findings with one cause: one edit may resolve all, or one edit in each package.

    Attributes:
        places: The findings, the worst first, then in reading order; there is at least one.
    """

    places: tuple[Place, ...]

    @property
    def package(self) -> Package:
        """The package of the first finding."""
        return self.places[0].package

    @property
    def first(self) -> Diagnostic:
        """The finding whose message is shown."""
        return self.places[0].finding

    @property
    def severity(self) -> Severity:
        """The highest severity of its findings."""
        return self.first.severity


def by_cause(result: Result, *, everything: bool = False) -> list[Entry]:
    """Return the findings of a package as entries.

    Findings have one cause if their rules say so, or if their messages are equal. Unless everything
    is shown, so do dependencies that the manifest lacks, imports that a file lacks, and all
    findings in a file of ROS 1.
    """
    rules = registry.loaded()
    bare: set[str] = set() if everything else _without_imports(result.diagnostics)
    unported = {} if everything else _of_ros1(result.diagnostics)
    causes: dict[tuple[str, ...], list[Place]] = {}
    for diagnostic in result.diagnostics:
        path = diagnostic.location.path
        key: tuple[str, ...] = (diagnostic.code, diagnostic.message, diagnostic.severity.value)
        if diagnostic.code == _UNDEFINED and path in bare:
            key = (diagnostic.code, path)
        elif path in unported and diagnostic.severity is Severity.ERROR:
            key = (unported[path],)
        elif is_dependency(diagnostic) and not everything:
            effect = effect_of(diagnostic, rules)
            key = (DEPENDENCY, diagnostic.severity.value, effect.name)
        elif diagnostic.cause:
            key = (diagnostic.cause,)
        causes.setdefault(key, []).append(Place(result.package, diagnostic))
    return [_entry(places, rules) for places in causes.values()]


def _entry(places: Sequence[Place], rules: Mapping[str, type[Rule]]) -> Entry:
    return Entry(tuple(sorted(places, key=lambda item: rank(item.package, item.finding, rules))))


def _of_ros1(diagnostics: Sequence[Diagnostic]) -> dict[str, str]:
    """Return the cause of all findings in each file of ROS 1."""
    return {item.location.path: item.cause for item in diagnostics if item.cause.endswith(_OF_ROS1)}


def _without_imports(diagnostics: Sequence[Diagnostic]) -> set[str]:
    """Return the files in which several names are undefined."""
    names: dict[str, set[str]] = {}
    for diagnostic in diagnostics:
        if diagnostic.code == _UNDEFINED:
            names.setdefault(diagnostic.location.path, set()).add(diagnostic.message)
    return {path for path, messages in names.items() if len(messages) >= _SEVERAL}


def merged(entries: Sequence[Entry]) -> list[Entry]:
    """Merge equal entries of several packages, at the first of them.

    Copied packages have copied mistakes; two entries are equal if their messages are.
    """
    return _merged(entries, [_content(entry) for entry in entries])


def merged_causes(entries: Sequence[Entry]) -> list[Entry]:
    """Merge entries with one cause and message, missing dependencies, and similar messages.

    The first two may be of several packages. Similar messages differ only in names and numbers.
    """
    rules = registry.loaded()
    causes = _merged(entries, [_cause(entry, rules) for entry in entries])
    causes = [_frequent_first(entry) if names_dependencies(entry) else entry for entry in causes]
    return _merged(causes, [_kind(entry, rules) for entry in causes])


def _frequent_first(entry: Entry) -> Entry:
    """Return an entry about dependencies with those that most packages lack first."""
    numbers = Counter(dependency_of(item.finding) for item in entry.places)
    return Entry(
        tuple(sorted(entry.places, key=lambda item: -numbers[dependency_of(item.finding)]))
    )


def _cause(entry: Entry, rules: Mapping[str, type[Rule]]) -> Hashable:
    first = entry.first
    if is_dependency(first):
        return first.severity, effect_of(first, rules)
    return (first.severity, first.cause, first.message) if first.cause else _content(entry)


def _kind(entry: Entry, rules: Mapping[str, type[Rule]]) -> Hashable:
    words = pattern(entry.first.message)
    return entry.first.code, words, id(entry.package), _rank(entry, rules)


def pattern(message: str) -> tuple[str, ...]:
    """Return the words of a message, up to the advice, without names and numbers."""
    words = message.partition("; ")[0].split()
    return tuple(word if _PLAIN.fullmatch(word) else "" for word in words)


def _content(entry: Entry) -> Hashable:
    findings = [item.finding for item in entry.places]
    return frozenset((item.code, item.message, item.severity) for item in findings)


def _merged(entries: Sequence[Entry], keys: Sequence[Hashable]) -> list[Entry]:
    same: dict[Hashable, list[Place]] = {}
    for entry, key in zip(entries, keys, strict=True):
        same.setdefault(key, []).extend(entry.places)
    return [Entry(tuple(places)) for places in same.values()]


def dependency_of(diagnostic: Diagnostic) -> str:
    """Return the name of the dependency that a finding is about; empty if it is about none."""
    return diagnostic.cause.removeprefix(DEPENDENCY) if is_dependency(diagnostic) else ""


def names_dependencies(entry: Entry) -> bool:
    """Return whether an entry is about several dependencies, possibly of several packages."""
    names = {(id(item.package), dependency_of(item.finding)) for item in entry.places}
    return len(names) > 1 and all(name for _, name in names)


def in_order(entries: Sequence[Entry]) -> list[Entry]:
    """Return entries by severity and effect; see `Effect`. Those with more files come first.

    What always has an effect comes before what only has it on machines without a dependency.
    """
    rules = registry.loaded()
    return sorted(
        entries,
        key=lambda entry: (_rank(entry, rules), is_dependency(entry.first), -_files(entry)),
    )


def _rank(entry: Entry, rules: Mapping[str, type[Rule]]) -> tuple[int, bool, bool, Effect]:
    return rank(entry.package, entry.first, rules)


def _files(entry: Entry) -> int:
    """Return the number of files that an entry is about."""
    return len({(id(item.package), item.finding.location.path) for item in entry.places})
