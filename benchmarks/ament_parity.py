"""Compare ``check`` with ament_copyright, ament_lint_cmake and ament_xmllint, package by package.

    python benchmarks/ament_parity.py [--jobs N] [--show N] DIRECTORY...

Every package at or below a DIRECTORY is linted by the three linters of the system, run inside of
it as its own tests do, and by our rules. Printed per linter: the packages that it rejects, the
*false passes* among them (we say nothing at all), the packages that only we reject, and how many
findings agree. A finding of ament_copyright or ament_xmllint is a file, one of ament_lint_cmake
is (file, line, filter). Where ament_copyright does not run in a package's tests we give one
piece of advice for the package; its files still count one by one here. Manifests without a
schema pass ament_xmllint whatever is in them: what we say about those counts as ours only.

The exit status is 1 when there is a false pass.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from scaffold.ament import lint_cmake
from scaffold.ament.copyright import headers
from scaffold.check import runner
from scaffold.check.rules import registry
from scaffold.check.rules.rule import Rule
from scaffold.check.session import all_rules
from scaffold.configuration import content
from scaffold.diagnostic import Diagnostic
from scaffold.errors import InputError
from scaffold.model.discovery import targets
from scaffold.model.package import Package
from tests import oracles

Finding = tuple[str, int, str]
Oracle = Callable[[Path], set[oracles.Finding]]
CRASH: Finding = ("", 0, "crash")

NESTED = "LY001"
"""Covers nested packages, which the linters check but colcon ignores."""
WHOLE_FILE = ("convention/filename", "package/consistency")


class Linter(NamedTuple):
    """A linter and the codes of our rules that stand for it."""

    name: str
    oracle: Oracle
    codes: tuple[str, ...]
    ours: Callable[[Package, list[Diagnostic]], set[Finding]]


class Verdict(NamedTuple):
    """The findings of a linter and ours about one package."""

    package: str
    theirs: set[Finding]
    ours: set[Finding]
    diagnostics: list[Diagnostic]


def rejected_files(package: Package, _diagnostics: list[Diagnostic]) -> set[Finding]:
    """Return the files whose header the linter would reject."""
    return {(h.path, 0, "copyright") for h in headers(package) if not h.is_known}


def cmake_findings(package: Package, _diagnostics: list[Diagnostic]) -> set[Finding]:
    """Return the findings of our scanner, with line numbers as in the linter."""
    return {
        (finding.source.path, 0 if name in WHOLE_FILE else finding.location.line, name)
        for name in lint_cmake.FILTERS
        for finding in lint_cmake.findings(package, name)
    }


def xml_files(_package: Package, diagnostics: list[Diagnostic]) -> set[Finding]:
    """Return the XML files that a rule complains about."""
    return {(d.location.path, 0, "xmllint") for d in diagnostics if d.code != NESTED}


LINTERS = (
    Linter("ament_copyright", oracles.ament_copyright, ("LY020", "LY021", "LY022"), rejected_files),
    Linter(
        "ament_lint_cmake",
        oracles.ament_lint_cmake,
        tuple(f"CM0{number}" for number in range(70, 86)),
        cmake_findings,
    ),
    Linter(
        "ament_xmllint",
        lambda directory: {
            oracles.Finding(path, 0, "xmllint")
            for path in oracles.files_rejected_by_xmllint(directory)
        },
        ("PX050", "PX051", *(f"PX0{number}" for number in range(60, 80))),
        xml_files,
    ),
)


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare and print; return 1 when there is a false pass."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0] if __doc__ else "")
    parser.add_argument("directories", nargs="+", metavar="DIRECTORY")
    parser.add_argument("--jobs", type=int, default=2, help="linters that run at a time")
    parser.add_argument("--show", type=int, default=5, help="differences shown per linter")
    parser.add_argument("--rules", default=None, help="another directory of rules")
    names = [linter.name for linter in LINTERS]
    parser.add_argument("--linter", choices=names, action="append", help="compare with this only")
    options = parser.parse_args(arguments)
    packages = [package for directory in options.directories for package in _find(directory)]
    rules = all_rules(registry.load([options.rules] if options.rules else content.roots("rules")))
    print(f"{len(packages)} packages")
    passes = 0
    for linter in LINTERS:
        if options.linter and linter.name not in options.linter:
            continue
        chosen = [rule() for rule in rules if rule.code in {*linter.codes, NESTED}]
        passes += _compare(linter, packages, chosen, options.jobs, options.show)
    return 1 if passes else 0


def _find(directory: str) -> list[Package]:
    try:
        return [target.package for target in targets.find([directory])]
    except InputError as error:
        print(error)
        return []


def _compare(
    linter: Linter, packages: list[Package], rules: list[Rule], jobs: int, show: int
) -> int:
    started = time.perf_counter()
    with ThreadPoolExecutor(jobs) as pool:
        theirs = list(pool.map(lambda package: _run_linter(linter, package), packages))
    between = time.perf_counter()
    verdicts = []
    for package, their in zip(packages, theirs, strict=True):
        diagnostics = runner.check(package, rules)
        verdicts.append(
            Verdict(package.directory, their, linter.ours(package, diagnostics), diagnostics)
        )
        package.forget()
    _print(linter, verdicts, show)
    print(f"  linter {between - started:.1f} s, ours {time.perf_counter() - between:.1f} s")
    return sum(bool(verdict.theirs) and not verdict.diagnostics for verdict in verdicts)


def _run_linter(linter: Linter, package: Package) -> set[Finding]:
    try:
        findings = linter.oracle(Path(package.directory).resolve())
    except AssertionError:
        return {CRASH}
    if linter.name == "ament_lint_cmake":
        return {(finding.path, finding.line, finding.code) for finding in findings}
    return {(finding.path, 0, finding.code) for finding in findings}


def _print(linter: Linter, verdicts: list[Verdict], show: int) -> None:
    rejected = [v for v in verdicts if v.theirs]
    passes = [v for v in rejected if not v.diagnostics]
    alarms = [v for v in verdicts if {d.code for d in v.diagnostics} - {NESTED} and not v.theirs]
    nested = [v for v in rejected if {d.code for d in v.diagnostics} == {NESTED}]
    both = sum(len(v.theirs & v.ours) for v in verdicts)
    only_theirs = [(v.package, f) for v in verdicts for f in sorted(v.theirs - v.ours)]
    only_ours = [(v.package, f) for v in verdicts for f in sorted(v.ours - v.theirs)]
    print(
        f"{linter.name}: rejects {len(rejected)} packages, false passes {len(passes)} "
        f"(of the others {len(nested)} only through {NESTED}), rejected by us only {len(alarms)}\n"
        f"  findings: {both} agree, {len(only_theirs)} theirs only, {len(only_ours)} ours only, "
        f"{sum(CRASH in v.theirs for v in verdicts)} crashes of the linter"
    )
    for title, rows in (
        ("false pass", [(v.package, sorted(v.theirs)[:3]) for v in passes]),
        (
            "rejected by us only",
            [(v.package, [d.message for d in v.diagnostics[:2]]) for v in alarms],
        ),
        ("theirs only", only_theirs),
        ("ours only", only_ours),
    ):
        for row in rows[:show]:
            print(f"  {title}: {row[0]}: {row[1]}")


if __name__ == "__main__":
    sys.exit(main())
