"""Findings grouped by cause, the most important first."""

from __future__ import annotations

import os
import re
from collections.abc import Hashable, Mapping, Sequence

from scaffold import lazy_re
from scaffold.ament.codes import STYLE
from scaffold.check.result import Result
from scaffold.check.rules import registry
from scaffold.check.rules.rule import Rule
from scaffold.diagnostic import Diagnostic, Effect, Severity
from scaffold.model.package import Package
from scaffold.record import NamedTuple
from scaffold.reporters.paths import shown

SEVERITIES = (Severity.ERROR, Severity.WARNING, Severity.INFO)
"""Worst first."""

_SET_ASIDE = lazy_re.compile(
    r"(?:.*[_ .-])?(?:archived?|archives|attic|backups?|bak|deprecated|junk|legacy|obsolete|old"
    r"|trash|unused)|[(\[](?:old|unused|deprecated)[)\]].*",
    re.IGNORECASE,
)
"""Matches the name of a directory with abandoned code."""
_AT_RUN_TIME = frozenset(
    {Effect.STOPS_START, Effect.STOPS_PROGRAM, Effect.WRONG_BEHAVIOR, Effect.IGNORED}
)
_TESTS = lazy_re.compile(r"(?:^|/)(?:tests?/|test_[^/]*$|[^/]*_test\.py$)")
"""Matches the paths of tests, which no robot runs."""
DEPENDENCY = "dependency "
"""The prefix of causes that only matter on machines without a package."""
_UNDEFINED = "F821"
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

    Findings have one cause if their rules say so, or if their messages are equal. A manifest
    without dependencies and a file without imports are one cause as well, unless everything is
    shown.
    """
    rules = registry.loaded()
    bare: set[str] = set() if everything else _without_imports(result.diagnostics)
    causes: dict[tuple[str, ...], list[Place]] = {}
    for diagnostic in result.diagnostics:
        key: tuple[str, ...] = (diagnostic.code, diagnostic.message, diagnostic.severity.value)
        if diagnostic.code == _UNDEFINED and diagnostic.location.path in bare:
            key = (diagnostic.code, diagnostic.location.path)
        elif _is_dependency(diagnostic) and not everything:
            key = (DEPENDENCY, diagnostic.severity.value, _effect(diagnostic, rules).name)
        elif diagnostic.cause:
            key = (diagnostic.cause,)
        causes.setdefault(key, []).append(Place(result.package, diagnostic))
    return [
        Entry(tuple(sorted(places, key=lambda place: SEVERITIES.index(place.finding.severity))))
        for places in causes.values()
    ]


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
    """Merge entries of several packages with one cause and message, and missing dependencies."""
    rules = registry.loaded()
    return _merged(entries, [_cause(entry, rules) for entry in entries])


def _cause(entry: Entry, rules: Mapping[str, type[Rule]]) -> Hashable:
    first = entry.first
    if _is_dependency(first):
        return first.severity, _effect(first, rules)
    return (first.severity, first.cause, first.message) if first.cause else _content(entry)


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
    return diagnostic.cause.removeprefix(DEPENDENCY) if _is_dependency(diagnostic) else ""


def names_dependencies(entry: Entry) -> bool:
    """Return whether an entry is about several dependencies, possibly of several packages."""
    names = {(id(item.package), dependency_of(item.finding)) for item in entry.places}
    return len(names) > 1 and all(name for _, name in names)


def in_order(entries: Sequence[Entry]) -> list[Entry]:
    """Return entries by severity; within one, files that cannot be read or built come first.

    Then come names at which rosdep stops, programs and launch files that do not start, crashes,
    wrong builds, missing dependencies, wrong behavior, code without effect, and declarations.

    Directories such as ``archive`` or ``old`` come last.
    """
    rules = registry.loaded()
    return sorted(entries, key=lambda entry: _rank(entry, rules))


def is_style(diagnostic: Diagnostic) -> bool:
    """Return whether a finding is a harmless one of ament_flake8 or ament_pep257."""
    return diagnostic.code in STYLE and diagnostic.severity is not Severity.ERROR


def _is_dependency(diagnostic: Diagnostic) -> bool:
    return diagnostic.cause.startswith(DEPENDENCY)


def is_set_aside(entry: Entry) -> bool:
    """Return whether all places of an entry are in directories with code that is kept, not used."""
    return all(
        any(_SET_ASIDE.fullmatch(name) for name in shown(package, path).split(os.sep)[:-1])
        for package, path in {(item.package, item.finding.location.path) for item in entry.places}
    )


def _rank(entry: Entry, rules: Mapping[str, type[Rule]]) -> tuple[int, bool, bool, Effect]:
    level = SEVERITIES.index(entry.severity)
    return level, is_style(entry.first), is_set_aside(entry), _effect(entry.first, rules)


def _effect(first: Diagnostic, rules: Mapping[str, type[Rule]]) -> Effect:
    """Return the effect of a finding, as declared by its rule."""
    code = first.code
    if code in STYLE:  # errors among them: E9 of pycodestyle is for unparsable files
        return Effect.STOPS_BUILD if code.startswith("E9") else Effect.STOPS_PROGRAM
    rule = rules.get(code)
    effect = rule.usual_effect() if rule else Effect.STOPS_PROGRAM
    if _is_dependency(first) and effect is not Effect.STOPS_ROSDEP:
        return Effect.MISSING_ELSEWHERE
    if effect in _AT_RUN_TIME and _TESTS.search(first.location.path):
        return Effect.DECLARED_WRONG
    return effect
