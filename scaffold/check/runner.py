"""Runs rules on one package; a rule that crashes does not stop the others."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import islice
from typing import TYPE_CHECKING

from scaffold import time_limit
from scaffold.check.cache.facts import EarlierFacts, to_store
from scaffold.check.result import Earlier, Part, Verdict
from scaffold.check.rules.engine_rules import FileTooLarge, RuleCrashed, UnparsableFile
from scaffold.check.rules.file_rules import FileRule
from scaffold.check.rules.rule import Rule
from scaffold.diagnostic import MAX_FINDINGS, Diagnostic, Severity, crash_message
from scaffold.errors import EXHAUSTED, EXHAUSTION, OutOfTimeError, exhausted
from scaffold.files.tree import MANIFEST
from scaffold.model.package import Package
from scaffold.model.reads import Fact, Reads, recorded
from scaffold.source import (
    EncodingError,
    Location,
    ParseError,
    TooLargeError,
    UnreadEndError,
    ViewError,
)

if TYPE_CHECKING:
    from scaffold.model.reads import Settled

MOST_REFUSED = 100
"""The maximum number of files of a package that exhaust a rule."""
_OF_ANY_ENCODING = (
    *("CMakeLists.txt", ".cmake", ".in", ".txt", ".md", ".rst"),
    *(".c", ".cc", ".cpp", ".cxx", ".h", ".hh", ".hpp", ".hxx", ".cu"),
)
"""Extensions of files whose readers, such as CMake and compilers, accept any bytes."""


def check(package: Package, rules: Iterable[Rule]) -> list[Diagnostic]:
    """Return the diagnostics of the rules, in reading order.

    An unparsable file gives one SC001, a crashing rule one SC002.
    """
    return Check(package).run(rules)


class Check:
    """A run of rules on one package.

    Args:
        package: The package.
        earlier: Earlier results, whose valid parts are reused.
    """

    def __init__(self, package: Package, earlier: Earlier | None = None) -> None:
        self._package = package
        self._kept: dict[str, Part] = {}
        self._reads: dict[str, Reads] = {}
        self._diagnostics: dict[str, list[Diagnostic]] = {}
        self._unparsable: list[Diagnostic] = []
        self._earlier_facts: EarlierFacts | None = None
        self._settled: Settled = {}
        self._is_whole = True
        """Whether each finding belongs to a part."""
        if earlier is not None:
            self._take_over(earlier)

    def _take_over(self, earlier: Earlier) -> None:
        package, verdict = self._package, earlier.verdict
        edited = frozenset(earlier.edited)
        self._settled = earlier.settled
        facts = self._earlier_facts = EarlierFacts(package, verdict.facts, edited, self._settled)
        self._kept = {
            key: part
            for key, part in verdict.parts.items()
            if part.files.isdisjoint(edited) and facts.hold(part.facts)
        }
        self._unparsable = [
            item
            for item in verdict.unparsable
            if package.full_path(item.location.path) not in edited
        ]

    def run(self, rules: Iterable[Rule]) -> list[Diagnostic]:
        """Return the diagnostics of the rules, in reading order."""
        for rule in rules:
            if rule.code in self._kept:
                continue
            for key, part_diagnostics in self._run(rule).items():
                self._diagnostics.setdefault(key, []).extend(part_diagnostics)
        self._unparsable = [*dict.fromkeys([*self._unparsable, *_unparsable(self._package)])]
        diagnostics = [item for part in self._kept.values() for item in part.diagnostics]
        diagnostics += [
            item for part_diagnostics in self._diagnostics.values() for item in part_diagnostics
        ]
        diagnostics = [*dict.fromkeys([*diagnostics, *self._unparsable])]
        return sorted(diagnostics, key=lambda diagnostic: diagnostic.sort_key)

    def end(self) -> None:
        """Drop the facts of the package, so that it computes them again."""
        if self._earlier_facts is not None:
            self._earlier_facts.end()

    @property
    def parts(self) -> Mapping[str, Part]:
        """The reused parts."""
        return self._kept

    def verdict(self, style: Mapping[str, Sequence[Diagnostic]]) -> Verdict | None:
        """Return the findings in parts, ``None`` if they cannot be split.

        Args:
            style: The known style findings of files.
        """
        exhausted_here = any(item.message in EXHAUSTION for item in self._unparsable)
        if exhausted_here or not self._is_whole:
            return None  # files may have been marked unparsable because of others
        parts = dict(self._kept)
        # The set of files to check may depend on any requested fact.
        facts: set[Fact] = {*self._package.facts}
        taken_over = {wanted for part in self._kept.values() for wanted in part.facts}
        for key, reads in self._reads.items():
            files, used = reads.all()
            facts |= used
            ids = frozenset(fact.id for fact in used)
            parts[key] = Part(files, ids, tuple(self._diagnostics.get(key, ())))
        stored = to_store(facts, taken_over, self._settled)
        return Verdict(parts, style, self._unparsable, stored)

    def _run(self, rule: Rule) -> Mapping[str, list[Diagnostic]]:
        """Return the diagnostics of a rule; a file that exhausts it is marked unparsable."""
        package = self._package
        for _ in range(MOST_REFUSED):
            result: dict[str, list[Diagnostic]] = {}
            try:
                with time_limit.limited():
                    self._collect(rule, result)
            except EXHAUSTED as error:
                self._is_whole = False
                package.is_repeatable &= not isinstance(error, OutOfTimeError)
                path = _file_at_fault(package, error)
                if path is not None and package.refuse(path, exhausted(error)):
                    continue
                result.setdefault(rule.code, []).append(_crash(rule, package, error))
            except Exception as error:  # noqa: BLE001  a defect in one rule must not hide the others
                self._is_whole = False
                result.setdefault(rule.code, []).append(_crash(rule, package, error))
            break
        return result

    def _collect(self, rule: Rule, parts: dict[str, list[Diagnostic]]) -> None:
        """Add the diagnostics of a rule to ``parts``."""
        # One more than is shown, so that the session notices it.
        most = MAX_FINDINGS + 1
        for key, say in self._steps_of(rule):
            diagnostics = parts.setdefault(key, [])
            try:
                with recorded(self._reads_of(key)):
                    diagnostics.extend(islice(say(), most))
            except ViewError:
                continue  # a required view is missing
            most -= len(diagnostics)
            self._is_whole &= most > 0  # otherwise other files decide what is omitted

    def _reads_of(self, key: str) -> Reads:
        """Return the recorded accesses of a part."""
        if key not in self._reads:
            self._reads[key] = Reads()
        return self._reads[key]

    def _steps_of(self, rule: Rule) -> Iterator[tuple[str, Callable[[], Iterable[Diagnostic]]]]:
        """Yield the steps of a rule, each with its part."""
        package = self._package
        if not isinstance(rule, FileRule):
            yield rule.code, lambda: rule.check(package)
            return
        for path in rule.paths(package):
            key = f"{rule.code} {path}" if rule.looks_further else path
            if key not in self._kept:
                self._reads_of(key).files.add(package.full_path(path))
                yield key, lambda path=path: rule.check_path(package, path)  # type: ignore[misc]


def _crash(rule: Rule, package: Package, error: Exception) -> Diagnostic:
    path = _file_at_fault(package, error) or MANIFEST
    message = crash_message(f"the rule {rule.code} {rule.name}", error)
    return RuleCrashed().report(Location.start_of(path), message)


def _file_at_fault(package: Package, error: Exception) -> str | None:
    """Return the file that the failing code was reading, judging by its variables."""
    path: str | None = None
    trace = error.__traceback__
    while trace is not None:
        for value in trace.tb_frame.f_locals.values():
            held = value if isinstance(value, str) else getattr(value, "path", None)
            if isinstance(held, str) and package.has(held):
                path = held
        trace = trace.tb_next
    return path


def _unparsable(package: Package) -> list[Diagnostic]:
    return [*dict.fromkeys(_diagnostic(error) for error in package.parse_errors)]


def _diagnostic(error: ParseError) -> Diagnostic:
    if isinstance(error, TooLargeError):
        return FileTooLarge().report(error.location, error.message)
    is_read = isinstance(error, EncodingError) and error.location.path.endswith(_OF_ANY_ENCODING)
    is_read = is_read or isinstance(error, UnreadEndError)
    severity = Severity.WARNING if is_read else None
    return UnparsableFile().report(error.location, error.message, severity=severity)
