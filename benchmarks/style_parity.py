"""Compare ``scaffold.ament`` with the real Jazzy linters, finding by finding.

    python benchmarks/style_parity.py --flake8 PATH/ament_flake8 --pep257 PATH/ament_pep257 \
        [--keep DIRECTORY] [--show CODE] [--mutants N [--seed N] | --own] DIRECTORY...

Every DIRECTORY is checked as one tree by ``ament_flake8`` and ``ament_pep257`` (they are run
inside it, as a package's own tests do) and by ``scaffold.ament``. A finding is (file, line, code);
one that both linters report counts once. Printed per code: how many the linters report, how many
agree, how many only they and only we report. A *false pass* is a file or a package (a directory
with a package.xml, else the DIRECTORY) in which the linters find something and we find nothing.

``--mutants`` compares N copies of files from below all DIRECTORY instead, each with one edit: a
line or a word that is gone, twice there or in another place, or a blank, a bracket, a quote too
many. Python has to be of the version that the linters run on.

``--own`` compares package by package instead, each linted with the command lines that its own tests
use, and without any where they run neither linter.

``--keep`` stores what the linters said, so that they run only once for each directory.
The exit status is 1 when there is a false pass.
"""

from __future__ import annotations

import argparse
import ast
import json
import os
import random
import re
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from scaffold.ament import StyleCheck, backend
from scaffold.ament.calls import linter_calls
from scaffold.ament.finding import UNFOLLOWED
from scaffold.check.adjustments import runs_linter
from scaffold.files.tree import DiskTree
from scaffold.model.package import Package

Finding = tuple[str, int, str]
FLAKE8_LINE = re.compile(r"^(.+?):(\d+):(-?\d+): ([A-Z]+\d+) ", re.MULTILINE)
INSERTED = (*" \t\n()[]{}:;,.#\\'\"", "    ", "# noqa", '"""', "not ", "import os\n", "pass\n")
LINES_OF_EDITS = 0.5
"""The share of edits of whole lines; the others are of words."""
PEP257_CASE = re.compile(r"^(.+) \((.+):(\d+|-)\)$")


def ament_flake8(executable: str, directory: Path, *arguments: str) -> set[Finding]:
    """Return what ament_flake8 reports for a directory; the findings of a crash are none."""
    done = subprocess.run(
        [executable, *arguments],
        cwd=directory,
        capture_output=True,
        text=True,
        check=False,
        errors="replace",
    )
    if done.returncode not in (0, 1) or "files checked" not in done.stdout:
        raise SystemExit(f"{executable} failed in {directory}:\n{done.stderr[-2000:]}")
    return {
        (os.path.normpath(path), int(line), code)
        for path, line, _, code in FLAKE8_LINE.findall(done.stdout)
    }


def ament_pep257(executable: str, directory: Path, *arguments: str) -> set[Finding]:
    """Return what ament_pep257 reports for a directory; an unreadable file counts as E999."""
    with tempfile.TemporaryDirectory() as scratch:
        report = Path(scratch) / "pep257.xunit.xml"
        subprocess.run(
            [executable, "--xunit-file", str(report), *arguments],
            cwd=directory,
            capture_output=True,
            check=False,
        )
        cases = ET.parse(report).iter("testcase")  # noqa: S314  written by the linter
        findings = set()
        for case in cases:
            match = PEP257_CASE.match(case.get("name", ""))
            if match and case.find("failure") is not None:
                code, path, line = match.groups()
                is_rule = line != "-"
                findings.add(
                    (
                        os.path.normpath(path),
                        int(line) if is_rule else 0,
                        code if is_rule else "E999",
                    )
                )
        return findings


def oracle(args: argparse.Namespace, directory: Path) -> tuple[set[Finding], set[Finding]]:
    """Return the findings of both linters, from the store if they are there."""
    kept = Path(args.keep, directory.name + ".json") if args.keep else None
    if kept and kept.exists():
        stored = json.loads(kept.read_text())
        return (
            {tuple(item) for item in stored["flake8"]},
            {tuple(item) for item in stored["pep257"]},
        )
    started = time.perf_counter()
    flake8 = ament_flake8(args.flake8, directory)
    middle = time.perf_counter()
    pep257 = ament_pep257(args.pep257, directory)
    seconds = [middle - started, time.perf_counter() - middle]
    if kept:
        kept.parent.mkdir(parents=True, exist_ok=True)
        data = {"flake8": sorted(flake8), "pep257": sorted(pep257), "seconds": seconds}
        kept.write_text(json.dumps(data))
    return flake8, pep257


def union(flake8: Iterable[Finding], pep257: Iterable[Finding]) -> set[Finding]:
    """Merge both; ament_pep257 has no line for a file it cannot parse, so flake8's is taken."""
    broken = {path for path, _, code in flake8 if code in ("E999", "E902")}
    return {*flake8, *(item for item in pep257 if item[1] or item[0] not in broken)}


def without_lines(mine: set[Finding], theirs: set[Finding]) -> set[Finding]:
    """Drop the line of a file that cannot be parsed where the linters have none.

    That is so for dangling symlinks, and if a ``# noqa`` on that line suppresses flake8, so that
    only ament_pep257 reports it.
    """
    lineless = {path for path, line, _ in theirs if not line}
    return {
        (path, 0 if path in lineless and code in ("E999", "E902") else line, code)
        for path, line, code in mine
    }


class WholeTree(DiskTree):
    """All Python files below a directory, including those of nested packages."""

    @property
    def files(self) -> Sequence[str]:
        """The paths of the files that the linters would find from here."""
        root = Path(self.root)
        names = (
            path for path in root.rglob("*") if path.suffix == ".py" or path.name == "AMENT_IGNORE"
        )
        return sorted(str(path.relative_to(root)) for path in names if not path.is_dir())


def ours(directory: Path) -> set[Finding]:
    """Return what scaffold.ament reports for a directory."""
    package = Package(WholeTree(directory))
    diagnostics = StyleCheck([package]).diagnostics(package)
    return {
        (diagnostic.location.path, diagnostic.location.line, diagnostic.code)
        for diagnostic in diagnostics
    }


def own(args: argparse.Namespace, directories: Iterable[Path]) -> int:
    """Compare packages with the command lines of their own tests; return the exit status."""
    tally = Tally()
    for directory in (path.parent for top in directories for path in top.rglob("package.xml")):
        package = Package.at(directory)
        theirs = union(*(own_findings(args, package, linter) for linter in ("flake8", "pep257")))
        nested = tuple(f"{path}/" for path in package.tree.nested)
        theirs = {item for item in theirs if not item[0].startswith(nested)}
        # The findings of a linter that is not run count as ours only.
        mine = {
            (diagnostic.location.path, diagnostic.location.line, diagnostic.code)
            for diagnostic in StyleCheck([package]).diagnostics(package)
            if diagnostic.code != UNFOLLOWED and runs_linter(package, diagnostic)
        }
        mine = without_lines(mine, theirs)
        tally.add(directory, theirs, mine)
        show(args, directory, theirs, mine)
    tally.show()
    return 1 if tally.passes["files"] else 0


def own_findings(args: argparse.Namespace, package: Package, linter: str) -> set[Finding]:
    """Return the findings of the runs of a linter by the tests of a package."""
    run = {"flake8": ament_flake8, "pep257": ament_pep257}[linter]
    findings: set[Finding] = set()
    for call in linter_calls(package, linter):
        words = [word for word in call.arguments if word is not None]
        if len(words) == len(call.arguments):
            findings |= run(getattr(args, linter), Path(package.directory), *words)
    return {(relative(path, package), line, code) for path, line, code in findings}


def relative(path: str, package: Package) -> str:
    """Return a path relative to a package."""
    return os.path.relpath(os.path.join(package.directory, path), package.directory)


def write_mutants(directories: Iterable[Path], count: int, seed: int, top: Path) -> None:
    """Write copies of Python files, each with one edit; the same ones for the same seed."""
    chance = random.Random(seed)  # noqa: S311  chance, not secrecy
    files = sorted(
        path for directory in directories for path in directory.rglob("*.py") if path.is_file()
    )
    number = 0
    while number < count:
        text = mutant(chance.choice(files).read_text(encoding="utf-8", errors="replace"), chance)
        if not ends_the_linters(text):
            (top / f"mutant_{number}.py").write_text(text, encoding="utf-8")
            number += 1


def ends_the_linters(text: str) -> bool:
    """Return whether a text parses and does not compile: ament_flake8 ends in a traceback."""
    try:
        tree = ast.parse(text)
    except (SyntaxError, ValueError):
        return False
    try:
        compile(tree, "mutant", "exec", dont_inherit=True)
    except (SyntaxError, ValueError):
        return True
    return False


def mutant(text: str, chance: random.Random) -> str:
    """Return a text after one edit."""
    if chance.random() < LINES_OF_EDITS:
        pieces = text.splitlines(keepends=True)
    else:
        pieces = re.findall(r"\w+|\s|[^\w\s]", text)
    at, to = (chance.randrange(len(pieces) + 1) for _ in range(2))
    match chance.choice(("drop", "repeat", "move", "insert")):
        case "drop":
            del pieces[at : at + 1]
        case "repeat":
            pieces[at:at] = pieces[at : at + 1]
        case "move":
            piece = pieces[at : at + 1]
            del pieces[at : at + 1]
            pieces[to:to] = piece
        case "insert":
            pieces.insert(at, chance.choice(INSERTED))
    return "".join(pieces)


def package_of(path: str, packages: list[str]) -> str:
    """Return the innermost package that a file belongs to."""
    return max((p for p in packages if not p or path.startswith(p + "/")), key=len, default="")


class Tally:
    """The agreement of both sides by code."""

    def __init__(self) -> None:
        self.agree: Counter[str] = Counter()
        self.missing: Counter[str] = Counter()
        self.extra: Counter[str] = Counter()
        self.passes: Counter[str] = Counter()
        """Files and packages that are clean for only one side, by line of the summary."""

    def add(self, directory: Path, theirs: set[Finding], mine: set[Finding]) -> None:
        """Count what was found in a directory."""
        self.agree.update(code for _, _, code in theirs & mine)
        self.missing.update(code for _, _, code in theirs - mine)
        self.extra.update(code for _, _, code in mine - theirs)
        manifests = (str(p.parent.relative_to(directory)) for p in directory.rglob("package.xml"))
        packages = ["", *("" if path == "." else path for path in manifests)]
        their_files, my_files = {f for f, _, _ in theirs}, {f for f, _, _ in mine}
        their_packages = {package_of(f, packages) for f in their_files}
        my_packages = {package_of(f, packages) for f in my_files}
        self.passes["files"] += len(their_files - my_files)
        self.passes["packages"] += len(their_packages - my_packages)
        self.passes["files that only we fail"] += len(my_files - their_files)
        self.passes["packages that only we fail"] += len(my_packages - their_packages)

    def show(self) -> None:
        """Print a line for each code, and the sums."""
        print(f"{'code':8}{'ament':>8}{'agree':>8}{'-':>6}{'+':>6}")
        for code in sorted({*self.agree, *self.missing, *self.extra}):
            self._show_line(
                code, self.agree[code], self.missing[code], self.extra[code], ending="\n"
            )
        same, missing, extra = (sum(c.values()) for c in (self.agree, self.missing, self.extra))
        everything = same + missing + extra
        agreement = same / everything if everything else 1
        self._show_line("all", same, missing, extra, ending=f"   agreement {agreement:.4%}\n")
        print(
            f"false passes: {self.passes['files']} files, {self.passes['packages']} packages; "
            f"only we fail: {self.passes['files that only we fail']} files, "
            f"{self.passes['packages that only we fail']} packages"
        )

    @staticmethod
    def _show_line(code: str, same: int, missing: int, extra: int, *, ending: str) -> None:
        print(f"{code:8}{same + missing:8}{same:8}{missing:6}{extra:6}", end=ending)


def main() -> int:
    """Compare and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("directories", nargs="+", type=Path)
    parser.add_argument("--flake8", default="ament_flake8")
    parser.add_argument("--pep257", default="ament_pep257")
    parser.add_argument("--keep")
    parser.add_argument("--show", action="append", default=[], help="list differences of a code")
    parser.add_argument("--oracle-only", action="store_true")
    parser.add_argument("--own", action="store_true", help="by the packages' own command lines")
    parser.add_argument("--mutants", type=int, metavar="N")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    # The limit of findings is for one package, but here a tree of many is checked as one.
    vars(backend)["MOST_FINDINGS"] = sys.maxsize
    if args.own:
        return own(args, args.directories)
    if not args.mutants:
        return compare(args, args.directories)
    with tempfile.TemporaryDirectory() as scratch:
        top = Path(scratch, f"mutants_{args.seed}")
        top.mkdir()
        write_mutants(args.directories, args.mutants, args.seed, top)
        return compare(args, [top])


def compare(args: argparse.Namespace, directories: Iterable[Path]) -> int:
    """Compare and print; return the exit status."""
    tally = Tally()
    for directory in directories:
        theirs = union(*oracle(args, directory))
        if args.oracle_only:
            print(f"{directory.name}: {len(theirs)} findings", flush=True)
            continue
        mine = without_lines(ours(directory), theirs)
        tally.add(directory, theirs, mine)
        show(args, directory, theirs, mine)
    if args.oracle_only:
        return 0
    tally.show()
    return 1 if tally.passes["files"] else 0


def show(
    args: argparse.Namespace, directory: Path, theirs: set[Finding], mine: set[Finding]
) -> None:
    """Print the differences that are asked for."""
    for sign, difference in (("-", theirs - mine), ("+", mine - theirs)):
        for path, line, code in sorted(difference):
            if code in args.show or "all" in args.show:
                print(f"{sign} {directory / path}:{line}: {code}")


if __name__ == "__main__":
    sys.exit(main())
