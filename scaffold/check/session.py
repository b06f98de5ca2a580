"""One run of `check`: style in the background, rules, suppression, in reading order."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.ament.settings import files_of_settings
from scaffold.check import conflicts, runner, suppression
from scaffold.check.adjustments import Adjustments
from scaffold.check.cache.facts import recalled, to_store
from scaffold.check.result import Earlier, Part, Result, Ruled
from scaffold.check.rules.ament_rules import AMENT_RULES
from scaffold.check.rules.engine_rules import (
    INTERNAL_RULES,
    FileTooLarge,
    LicenseNotAllowed,
    PackageOfRos1,
    RuleCrashed,
    TooManyFindings,
    UnparsableFile,
)
from scaffold.check.rules.rule import Rule
from scaffold.check.rules.type_rules import TypeRule
from scaffold.check.selection import Selection
from scaffold.configuration.exclusion import Exclusion
from scaffold.diagnostic import MAX_FINDINGS, Diagnostic, Severity
from scaffold.files.tree import CMAKE_LISTS
from scaffold.model.contents.ament_cmake import uses_ament
from scaffold.model.contents.source_directories import is_in_no_workspace
from scaffold.model.discovery.targets import Target
from scaffold.model.package import Package
from scaffold.model.reads import Reads, recorded
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.ament import StyleCheck
    from scaffold.check.type_findings import TypeFindings


WORTH_PARTS = 2
"""The number of Python files from which findings are kept in parts."""

_REPORT = ""
"""The part of a verdict with what the severities and the selection of its findings depend on."""
_ABOUT_PYTHON = frozenset({"IM", "LF", "MS", "ND"})
"""The areas whose rules overlap with types."""


class Session:
    """Rules and a selection, ready to run over packages.

    Args:
        rules: The rules.
        selection: The selected codes.
        adjustments: The adjustments of findings by the configuration.
        has_types: Whether the type checker runs.
        is_reference: Whether style is checked with the configuration that ament ships with.
        line_length: The line length for packages whose tests do not run flake8.
        is_remembered: Whether the results are stored in parts for later runs.
    """

    def __init__(
        self,
        rules: Sequence[type[Rule]],
        selection: Selection,
        adjustments: Adjustments | None = None,
        *,
        has_types: bool = False,
        is_reference: bool = False,
        line_length: int | None = None,
        is_remembered: bool = True,
    ) -> None:
        self._is_remembered = is_remembered
        self._is_reference = is_reference
        self._line_length = line_length
        self.selection = selection
        self.adjustments = adjustments or Adjustments()
        self._wants = lru_cache(maxsize=None)(selection.wants)
        self._areas = {rule.code[:2] for rule in all_rules(rules)}
        wanted: list[type[Rule]] = [*rules, *AMENT_RULES, LicenseNotAllowed]
        selected = [rule() for rule in wanted if selection.wants(rule.code)]
        self._rules = [rule for rule in selected if not isinstance(rule, TypeRule)]
        self._ran = {rule.code for rule in self._rules if not rule.is_about_moves}
        self._type_rules = [rule for rule in selected if isinstance(rule, TypeRule)]
        self.codes_fixed_for_all = {rule.code for rule in selected if rule.is_fixed_for_all}
        """See `Rule.is_fixed_for_all`."""
        self._has_types = has_types
        self._types: TypeFindings | None = None
        self.types_failure = ""
        """Why types were not checked; empty if they were, or are disabled."""
        self.unchecked: dict[str, list[str]] = {}
        """Packages that could not be checked, by the reason."""

    def run(
        self, targets: Sequence[Target], earlier: Mapping[str, Earlier] | None = None
    ) -> Iterator[Result]:
        """Check packages, in several processes where that pays; yield in the order given.

        Args:
            targets: The packages.
            earlier: Earlier results of some packages, by directory.
        """
        from scaffold.check.parallel import run

        self._types = self._start_types(targets, earlier or {})
        try:
            yield from run(self, targets, earlier or {})
        finally:
            self._end_types()

    def run_batch(
        self,
        targets: Sequence[Target],
        style: StyleCheck | None = None,
        earlier: Mapping[str, Earlier] | None = None,
    ) -> list[Result]:
        """Check packages in this process, with one start of the style backend for all.

        Args:
            targets: The packages.
            style: The style backend, if already started for them.
            earlier: Earlier results of some packages, by directory.
        """
        previous = earlier or {}
        is_first = self._types is None
        if is_first:
            self._types = self._start_types(targets, previous)
        try:
            return self._run_batch(targets, style, previous)
        finally:
            if is_first:
                self._end_types()
            for target in targets:
                target.package.forget()

    def _run_batch(
        self, targets: Sequence[Target], style: StyleCheck | None, earlier: Mapping[str, Earlier]
    ) -> list[Result]:
        style = style or self.start_style([target.package for target in targets], earlier)
        results: list[Result] = []
        for target in targets:
            package = target.package
            previous = earlier.get(package.directory)
            rules = self.check_rules(package, previous)
            styles = style.by_file(package) if style else {}
            results.append(self.result(target, rules, styles, previous))
            # The next packages may read the edited files, and have cached data of all others.
            package.forget_views(previous.edited if previous else ())
        return results

    def result(
        self,
        target: Target,
        rules: Ruled,
        style: Mapping[str, Sequence[Diagnostic]],
        earlier: Earlier | None = None,
    ) -> Result:
        """Combine the findings of rules, types and style in a package."""
        everything = {**rules.style, **style}
        typed = self._types.of(target.package) if self._types is not None else None
        styles = (item for path in sorted(everything) for item in everything[path])
        diagnostics = [*rules.diagnostics, *styles]
        verdict = rules.verdict._replace(style=everything) if rules.verdict else None
        if typed is not None:
            of_rules = [*rules.diagnostics, *rules.suppressed]
            diagnostics += _unreported(of_rules, typed.diagnostics)
            if verdict is not None:
                facts = {**verdict.facts, **typed.facts}
                verdict = verdict._replace(types=typed.parts, facts=facts)
        reads = Reads()
        with recalled(target.package, earlier), recorded(reads):
            diagnostics = self._report(target, diagnostics)
        if verdict is not None:
            files, used = reads.all()
            stored = to_store(used, (), earlier.settled if earlier else {})
            part = Part(files, frozenset(fact.id for fact in used), ())
            parts = {**verdict.parts, _REPORT: part}
            verdict = verdict._replace(parts=parts, facts={**verdict.facts, **stored})
        if target.only is not None:
            return Result(target.package, len(target.only), diagnostics, verdict)
        return Result(target.package, rules.files, diagnostics, verdict, rules.foreign)

    def check(self, package: Package, style: StyleCheck | None = None) -> list[Diagnostic]:
        """Check one package, for instance one in memory; see `run_batch`."""
        (result,) = self.run_batch([Target(package)], style)
        return result.diagnostics

    def check_styles(
        self, packages: Sequence[Package]
    ) -> Iterator[Mapping[str, Sequence[Diagnostic]]]:
        """Check the style of packages; yield the findings of each by path."""
        from scaffold.check.parallel import MOST_PACKAGES

        for start in range(0, len(packages), MOST_PACKAGES):
            some = packages[start : start + MOST_PACKAGES]
            style = self.start_style(some)
            for package in some:
                diagnostics = style.by_file(package) if style else {}
                package.forget()
                yield diagnostics

    def check_style(
        self, package: Package, paths: Collection[str]
    ) -> Mapping[str, Sequence[Diagnostic]]:
        """Check the style of some files only; return the findings by path."""
        style = self.start_style([package], None, paths)
        result = style.by_file(package) if style else {}
        package.forget()
        return result

    def selected(self, target: Target, diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
        """Return the selected findings in reading order."""
        return self._report(target, list(diagnostics))

    def start_style(
        self,
        packages: Sequence[Package],
        earlier: Mapping[str, Earlier] | None = None,
        paths: Collection[str] | None = None,
    ) -> StyleCheck | None:
        """Start the style backend, unless no style code is selected.

        Args:
            packages: The packages to check.
            earlier: Earlier results of some, by directory; files with known style are skipped.
            paths: Check only these files.
        """
        chosen = self.selection.select
        if chosen and all(prefix[:2] in self._areas for prefix in chosen):
            return None
        from scaffold.ament import StyleCheck

        def is_wanted(package: Package, path: str) -> bool:
            previous = (earlier or {}).get(package.directory)
            if previous is not None and path in previous.verdict.style:
                return False
            if self.adjustments.excludes(package, path) or _of_ros1(package):
                return False
            return paths is None or path in paths

        return StyleCheck(
            packages,
            is_wanted,
            is_reference=self._is_reference,
            line_length=None if self._is_reference else self._line_length,
        )

    def _start_types(
        self, targets: Sequence[Target], earlier: Mapping[str, Earlier]
    ) -> TypeFindings | None:
        """Start the type checker, unless no code of types is selected."""
        if not self._has_types or not self._type_rules:
            return None
        from scaffold.check.type_findings import TypeFindings

        only = {id(target.package): target.only for target in targets}

        def is_wanted(package: Package, path: str) -> bool:
            chosen = only[id(package)]
            is_left_out = self.adjustments.excludes(package, path) or _of_ros1(package)
            return not is_left_out and (chosen is None or path in chosen)

        packages = [target.package for target in targets]
        return TypeFindings(self._type_rules, packages, is_wanted, earlier)

    def _end_types(self) -> None:
        if self._types is not None:
            self.types_failure = self.types_failure or self._types.failure
            self._types.close()
            self._types = None

    def check_rules(self, package: Package, earlier: Earlier | None = None) -> Ruled:
        """Run the rules over a package."""
        if package.parse_errors:
            # They were found for other packages: findings must not depend on the order.
            package.forget()
            if earlier is not None:
                earlier.settled.clear()  # to find them again
            _ = package.name  # which all rules need: a malformed manifest is reported
        check = runner.Check(package, earlier)
        of_ros1 = [*_of_ros1(package)]
        diagnostics = of_ros1 or check.run(self._rules)
        reported = suppression.apply(package, diagnostics, self._ran)
        _ = package.identity  # while the manifest is at hand
        verdict = None
        is_worth = self._is_remembered and len(package.python_files) >= WORTH_PARTS
        if is_worth and not of_ros1:
            verdict = check.verdict({})
        check.end()
        if verdict is not None:
            verdict = verdict._replace(configuring=files_of_settings(package))
        count = sum(not self.adjustments.excludes(package, path) for path in package.files)
        foreign = tuple(sorted(self.adjustments.foreign_files(package).values()))
        left = {*reported}
        suppressed = tuple(item for item in diagnostics if item not in left)
        style = earlier.verdict.style if earlier else {}
        return Ruled(count, reported, verdict, style, foreign, suppressed)

    def _paths(self, package: Package, path: str) -> tuple[str, ...]:
        """Return the paths of a file to match with patterns of the configuration."""
        origin = self.selection.origin
        if not origin or not package.directory:
            return (path,)
        place = package.remember(
            "relative to the selection",
            lambda: Exclusion(("*",), origin).relative(package.outside, package.directory),
        )
        return (path,) if place is None else (path, f"{place}/{path}" if place else path)

    def _report(self, target: Target, diagnostics: list[Diagnostic]) -> list[Diagnostic]:
        """Return the selected findings in reading order, without duplicates."""
        # flake8 has its own code for an unparsable Python file.
        reported = {d.location.path for d in diagnostics if d.code.startswith("E9")}
        unreadable = (UnparsableFile.code, FileTooLarge.code)
        wanted = [
            d
            for d in _limited([*dict.fromkeys(diagnostics)])
            if not (d.code in unreadable and d.location.path in reported)
            and (target.only is None or d.location.path in target.only)
            and (d.code == RuleCrashed.code or self._wants(d.code))
            and not (
                self.selection.per_path
                and not self.selection.wants_at(
                    d.code, self._paths(target.package, d.location.path)
                )
            )
        ]
        named = [*conflicts.named(target.package, wanted)]
        return sorted(self.adjustments.apply(target.package, named), key=lambda d: d.sort_key)


def _of_ros1(package: Package) -> Sequence[Diagnostic]:
    """Return the only finding of a ROS 1 package; empty for others."""
    try:
        catkin = package.manifest.catkin
        if catkin is None or (package.has(CMAKE_LISTS) and uses_ament(package)):
            return ()
    except ViewError:
        return ()
    title = distributions.target().title
    message = (
        f"a ROS 1 package, which is not checked: {title} has no 'catkin' to build it; "
        "migrate it, or put COLCON_IGNORE next to package.xml"
    )
    severity = Severity.WARNING if is_in_no_workspace(package) else Severity.ERROR
    return (PackageOfRos1().report(catkin, message, severity=severity),)


def _limited(diagnostics: list[Diagnostic]) -> list[Diagnostic]:
    """Limit the findings per code, and add a note about the rest."""
    if len(diagnostics) <= MAX_FINDINGS:
        return diagnostics
    counts: dict[str, int] = {}
    kept: list[Diagnostic] = []
    for item in diagnostics:
        counts[item.code] = count = counts.get(item.code, 0) + 1
        if count <= MAX_FINDINGS:
            kept.append(item)
        elif count == MAX_FINDINGS + 1:
            message = f"{item.code} is found more than {MAX_FINDINGS} times"
            kept.append(
                TooManyFindings().report(item.location, f"{message}; the rest is not shown")
            )
    return kept


def all_rules(rules: Sequence[type[Rule]]) -> list[type[Rule]]:
    """Return rules of content directories, of ament's linters and of the engine, by code."""
    return sorted([*rules, *AMENT_RULES, *INTERNAL_RULES], key=lambda rule: rule.code)


def _unreported(of_rules: Sequence[Diagnostic], of_types: Sequence[Diagnostic]) -> list[Diagnostic]:
    """Return the type findings that no rule has reported.

    A rule explains an error better than its types, at the same place or for errors in
    Python code on the same line. A suppression of the rule covers the types as well.
    """
    places = {item.location[:3] for item in of_rules}
    lines = {
        item.location[:2]
        for item in of_rules
        if item.severity is Severity.ERROR and item.code[:2] in _ABOUT_PYTHON
    }
    return [
        item
        for item in of_types
        if item.location[:3] not in places and item.location[:2] not in lines
    ]
