"""Run ``add publisher extra_talker`` on copies of public packages, twice, and judge the result.

    python benchmarks/add_public.py [--every N] [--build] [--diffs FILE] [--extra EXTRA] DIR...

With ``--extra launch`` it runs ``add launch`` instead; packages for which an extra has nothing to
write are skipped.

Printed per package: the lines added to and removed from existing files, new findings
afterwards, what is left to do by hand, whether a second run changes anything, and, with
``--build``, whether colcon builds it and installs the new program. Only packages that build
without the new node are built with it. Then the sums.

The exit status is 1 when ``add`` fails, a second run changes something, the checker finds
something new, or a package does not build any more.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import os
import shutil
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from scaffold.cli import exit_codes, main
from scaffold.model.discovery import targets as discovery
from scaffold.model.package import Package
from scaffold.smoke import environment

NODE = "extra_talker"
PASSED_OVER = ("has nothing to write", "already exists and differs; overwrite")
"""Messages of ``add`` for extras that do not apply, or exist already."""
SKIPPED = shutil.ignore_patterns(".git", "build", "install", "log")
BUILDERS = ("ament_cmake", "ament_python")


class Outcome(NamedTuple):
    """The outcome for one package."""

    name: str
    build_type: str
    code: int
    added: int
    """Lines added to existing files."""
    removed: int
    by_hand: int
    notes: list[str]
    """The new findings."""
    is_stable: bool
    """Whether the second run changes nothing."""
    built: str
    """``builds``, ``broken``, or why it was not built."""
    error: str
    """The error of ``add``, if it failed."""
    diff: str

    @property
    def is_good(self) -> bool:
        """Return whether there is no problem."""
        failed = self.code not in {exit_codes.CLEAN, exit_codes.FINDINGS}
        return not failed and self.is_stable and not self.notes and self.built != "broken"


def run_add(what: list[str], directory: Path, *more: str) -> tuple[int, str, str]:
    """Run the command in this process; return its exit code and what it prints."""
    out, error = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
        code = main.main(["add", *what, "--package-directory", str(directory), *more])
    return code, out.getvalue(), error.getvalue()


def judge(
    package: Package, root: Path, ros: environment.Environment | None, what: list[str]
) -> Outcome:
    """Add a node or an extra to a copy of a package."""
    directory = root / "src" / package.name
    shutil.copytree(package.directory, directory, ignore=SKIPPED, symlinks=True)
    before = builds(root, package, ros) if ros else "not asked for"
    _, diff, _ = run_add(what, directory, "--diff")
    code, _, error = run_add(what, directory)
    again, changes, _ = run_add(what, directory, "--diff")
    built = before
    if before == "builds" and ros is not None and code in {exit_codes.CLEAN, exit_codes.FINDINGS}:
        # Edits left to the user may be needed to install the program.
        program = NODE if code == exit_codes.CLEAN and NODE in what else ""
        built = "builds" if builds(root, package, ros, program) == "builds" else "broken"
    added, removed = counts(diff)
    lines = error.splitlines()
    return Outcome(
        package.name,
        package.build_type,
        code,
        added,
        removed,
        sum(line.startswith("        because ") for line in lines),
        [line for line in lines if line.startswith("note: ") and str(directory) in line],
        code not in {exit_codes.CLEAN, exit_codes.FINDINGS} or (again == code and not changes),
        built,
        error.strip() if code not in {exit_codes.CLEAN, exit_codes.FINDINGS} else "",
        diff,
    )


def counts(diff: str) -> tuple[int, int]:
    """Return the numbers of lines that a diff adds to and removes from existing files."""
    added = removed = 0
    is_new = False
    for line in diff.splitlines():
        if line.startswith("--- "):
            is_new = line == "--- /dev/null"
        elif not line.startswith("+++ ") and not is_new:
            added += line.startswith("+")
            removed += line.startswith("-")
    return added, removed


def builds(root: Path, package: Package, ros: environment.Environment, program: str = "") -> str:
    """Build a package; return ``builds``, or why not."""
    variables = {**ros.variables}
    variables.pop("PYTHONDONTWRITEBYTECODE", None)
    prefixes = variables.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    unmet = sorted(
        name for name in package.manifest.build_names if not is_installed(name, prefixes)
    )
    if unmet:
        return f"needs {unmet[0]}"
    command = [ros.colcon, "build", "--packages-select", package.name]
    done = subprocess.run(command, cwd=root, env=variables, capture_output=True, check=False)
    if done.returncode:
        return "does not build"
    where = root / "install" / package.name / "lib" / package.name
    names = [path.name.removesuffix(".py") for path in where.glob("*")]
    return "builds" if not program or program in names else "program is not installed"


def is_installed(name: str, prefixes: list[str]) -> bool:
    """Return whether a package is in the environment."""
    marker = os.path.join("share", "ament_index", "resource_index", "packages", name)
    return any(os.path.exists(os.path.join(prefix, marker)) for prefix in prefixes)


def shown(outcome: Outcome) -> str:
    """Return a line for a package, and what is wrong with it."""
    state = "" if outcome.is_stable else ", NOT STABLE"
    line = (
        f"{outcome.name}: {outcome.build_type}, exit {outcome.code}, "
        f"+{outcome.added} -{outcome.removed}, {outcome.by_hand} by hand, "
        f"{len(outcome.notes)} new findings, {outcome.built}{state}"
    )
    return "\n    ".join([line, *outcome.notes, *filter(None, [outcome.error])])


def summary(outcomes: list[Outcome]) -> str:
    """Return the sums."""
    added = [outcome for outcome in outcomes if not outcome.error]
    sizes = Counter((outcome.added, outcome.removed) for outcome in added)
    good = sum(outcome.is_good for outcome in outcomes)
    built = Counter(outcome.built.partition(" ")[0] for outcome in outcomes)
    return "\n".join(
        [
            f"{len(outcomes)} packages, {good} without a complaint",
            f"failed: {len(outcomes) - len(added)}",
            f"with new findings: {sum(bool(outcome.notes) for outcome in outcomes)}",
            f"with something by hand: {sum(bool(outcome.by_hand) for outcome in outcomes)}",
            f"second run changes something: {sum(not outcome.is_stable for outcome in outcomes)}",
            f"only added lines: {sum(not outcome.removed for outcome in added)}",
            f"most lines added: {max((lines for lines, _ in sizes), default=0)}",
            f"builds: {dict(built)}",
        ]
    )


def parse() -> argparse.Namespace:
    """Read the command line."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("directories", nargs="+", metavar="DIR")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="take each Nth package")
    parser.add_argument("--extra", metavar="EXTRA", help="add this, not a node")
    parser.add_argument("--build", action="store_true", help="build with colcon")
    parser.add_argument("--diffs", metavar="FILE", help="write all diffs into a file")
    return parser.parse_args()


def run() -> int:
    """Judge the packages; return the exit status."""
    options = parse()
    ros = environment.select(os.environ) if options.build else None
    targets = discovery.find(options.directories)[:: options.every]
    what = [options.extra] if options.extra else ["publisher", NODE]
    outcomes: list[Outcome] = []
    for target in targets:
        if target.package.build_type not in BUILDERS:
            continue
        with tempfile.TemporaryDirectory() as root:
            outcome = judge(target.package, Path(root), ros, what)
        if not any(reason in outcome.error for reason in PASSED_OVER):
            outcomes.append(outcome)
            print(shown(outcome), flush=True)
    print(summary(outcomes))
    if options.diffs:
        Path(options.diffs).write_text(
            "".join(f"# {outcome.name}\n{outcome.diff}" for outcome in outcomes)
        )
    return 0 if all(outcome.is_good for outcome in outcomes) else 1


if __name__ == "__main__":
    sys.exit(run())
