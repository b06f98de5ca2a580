"""Measures the speed of `check`, as ratios within one run (ratios are less noisy than times).

Usage: ``python benchmarks/check_speed.py DIRECTORY [--repeat N] [--ament BIN_DIRECTORY]...``

DIRECTORY holds packages, for instance a clone of ros2/demos. Each figure is the CPU time, user and
system, of a command with all that it starts, the least of N runs; wall time would tell more about
what else the machine does. `check` is measured in three states:

- new: nothing is in its cache;
- seen: the style of each file is, results are not (as after an update of the rules);
- unchanged: it has checked the same before.

Printed are, each as a ratio:

- the smallest package against the floor: a bare Python start and one call of ruff on its files;
- all packages against ruff alone on the same files, the memory, and with ``--ament`` against
  ament_flake8, ament_pep257 and ament_copyright;
- an edit in one file, one in a package.xml, an unchanged workspace and `check --fix` against a
  check from scratch;
- with ``--ament``: ten packages against the ament linters found there;
- growth: the time for a package among 10, 40, 160 and 600 copies of the ten under new names,
  against that among 10, and the memory of the largest process.

``--only large`` prints the second of them alone: what a new `check` of the directory costs, as a
ratio to the linters, and its memory. All programs run from compiled modules, as installed ones do.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from scaffold.ament import ruff
from scaffold.model.discovery import targets

LINTERS = ("ament_flake8", "ament_pep257", "ament_copyright", "ament_lint_cmake", "ament_xmllint")
PYTHON_LINTERS = ("ament_flake8", "ament_pep257", "ament_copyright")
SAMPLE = 10
GROWTH = (10, 40, 160, 600)
PARTS = ("small", "large", "linters", "growth")


class Cost(NamedTuple):
    """The cost of a command."""

    seconds: float
    """CPU time, user and system, of the process and its children."""
    megabytes: float
    """Peak memory of the largest process."""


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("directory", type=Path)
    parser.add_argument("--repeat", type=int, default=7)
    parser.add_argument("--ament", type=Path, action="append", default=[])
    parser.add_argument("--up-to", type=int, default=GROWTH[-1], help="packages of the growth")
    parser.add_argument("--only", choices=PARTS, action="append", help="what to measure")
    options = parser.parse_args()
    wanted = options.only or PARTS
    found_targets = targets.find([str(options.directory.resolve())])
    packages = [Path(target.package.directory) for target in found_targets]
    with TemporaryDirectory() as scratch:
        os.environ["XDG_CACHE_HOME"] = os.path.join(scratch, "cache")
        os.environ["PYTHONPYCACHEPREFIX"] = os.path.join(scratch, "bytecode")
        for variable in ("SCAFFOLD_NO_CACHE", "PYTHONDONTWRITEBYTECODE"):
            os.environ.pop(variable, None)
        linters = _linters(options.ament)
        sample = packages[:: max(1, len(packages) // SAMPLE)][:SAMPLE]
        if "small" in wanted:
            _print_small(min(packages, key=_python_size), options.repeat)
        if "large" in wanted:
            large = _copied(options.directory, Path(scratch))
            _print_large(large, len(packages), linters, max(2, options.repeat // 3))
        if "linters" in wanted and linters:
            _print_linters(sample, linters)
        if "growth" in wanted:
            _print_growth(sample, options.up_to, Path(scratch))


def cost(
    *commands: Sequence[str], repeat: int = 1, before: Callable[[], None] | None = None
) -> Cost:
    """Return the cost of commands together, the lowest of several runs."""
    costs: list[Cost] = []
    for _ in range(repeat):
        if before is not None:
            before()
        costs.append(_total([_run(command) for command in commands]))
    return min(costs)


def _run(command: Sequence[str]) -> Cost:
    null = subprocess.DEVNULL
    process = subprocess.Popen(command, stdin=null, stdout=null, stderr=null)
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return Cost(used.ru_utime + used.ru_stime, used.ru_maxrss / 1024)


def _total(costs: Sequence[Cost]) -> Cost:
    return Cost(sum(cost.seconds for cost in costs), max(cost.megabytes for cost in costs))


class States(NamedTuple):
    """The cost of `check` in its three states."""

    new: Cost
    seen: Cost
    unchanged: Cost

    @classmethod
    def of(cls, paths: Sequence[Path], repeat: int = 1) -> States:
        """Measure."""
        command = _check(paths)
        return cls(
            cost(command, repeat=repeat, before=_forget_everything),
            cost(command, repeat=repeat, before=_forget_results),
            cost(command, repeat=repeat),
        )

    def lines(self, unit: float) -> list[str]:
        """Return a line for each state, in units of ``unit`` seconds."""
        return [
            f"  check, {name:10} {cost.seconds / unit:8.2f}  ({cost.seconds * 1000:.0f} ms)"
            for name, cost in self._asdict().items()
        ]


def _print_small(package: Path, repeat: int) -> None:
    files = _python_files([package])
    floor = cost([sys.executable, "-c", "pass"], _ruff(files), repeat=3 * repeat).seconds
    version = cost([sys.executable, "-m", "scaffold", "--version"], repeat=3 * repeat).seconds
    print(f"smallest package, {package.name}, {len(files)} Python files")
    print(f"  floor: bare Python, one ruff    1.00  ({floor * 1000:.0f} ms)")
    print(f"  --version         {version / floor:8.2f}  ({version * 1000:.0f} ms)")
    print(*States.of([package], repeat).lines(floor), sep="\n", flush=True)


def _copied(directory: Path, scratch: Path) -> Path:
    copy = scratch / "large"
    shutil.copytree(directory, copy, symlinks=True, ignore=shutil.ignore_patterns(".git"))
    return copy


def _print_large(copy: Path, packages: int, linters: Mapping[str, Path], repeat: int) -> None:
    """Measure a directory of packages, and edit a file and a manifest in it."""
    files = _python_files([copy])
    alone = cost(_ruff(files), repeat=repeat).seconds
    states = States.of([copy], repeat)
    by_size = sorted(files, key=lambda path: Path(path).stat().st_size)
    edited = Path(by_size[len(by_size) * 3 // 4])
    manifests = (parent / "package.xml" for parent in edited.parents)
    manifest = next(path for path in manifests if path.is_file())
    cost(_check([copy]))

    def measured_after(path: Path, line: str) -> Cost:
        def edit() -> None:
            with path.open("a", encoding="utf-8") as file:
                file.write(line)

        return cost(_check([copy]), repeat=repeat, before=edit)

    once = measured_after(edited, "# edited\n")
    declared = measured_after(manifest, "<!-- edited -->\n")
    print(f"{packages} packages, {len(files)} Python files")
    print(f"  ruff alone            1.00  ({alone * 1000:.0f} ms)")
    print(*states.lines(alone), sep="\n")
    print(f"  memory of check, new  {states.new.megabytes:.0f} MB", flush=True)
    _forget_everything()
    fixed = cost([*_check([copy]), "--fix"])
    print("  against a check with nothing in the cache")
    for name, measured in (
        ("unchanged", states.unchanged),
        ("one edited", once),
        ("package.xml edited", declared),
        ("--fix", fixed),
    ):
        print(f"  check, {name:18} {measured.seconds / states.new.seconds:8.2f}", end="")
        print(f"  ({measured.seconds * 1000:.0f} ms, {measured.megabytes:.0f} MB)", flush=True)
    of_python = {name: program for name, program in linters.items() if name in PYTHON_LINTERS}
    if of_python:
        commands = [[str(program), str(copy)] for program in of_python.values()]
        new: list[Cost] = []
        theirs: list[Cost] = []
        for _ in range(repeat):  # alternating, as other programs disturb both
            new.append(cost(_check([copy]), before=_forget_everything))
            theirs.append(cost(*commands))
        together = min(theirs).seconds
        print(f"  {', '.join(of_python)}: {together * 1000:.0f} ms")
        print(f"  check, new, against them  {min(new).seconds / together:.2f}", flush=True)
    shutil.rmtree(copy)


def _linters(places: Sequence[Path]) -> dict[str, Path]:
    """Return the programs of the ament linters, each from the first place that has it."""
    return {
        name: place / name
        for name in LINTERS
        for place in reversed(places)
        if (place / name).exists()
    }


def _print_linters(packages: Sequence[Path], linters: Mapping[str, Path]) -> None:
    commands = [[str(linter), str(package)] for linter in linters.values() for package in packages]
    together = cost(*commands).seconds
    states = States.of(packages)
    print(f"{len(packages)} packages, each with {', '.join(linters)}")
    print(f"  the linters           1.00  ({together * 1000:.0f} ms)")
    for name, measured in states._asdict().items():
        print(f"  check, {name:10} {together / measured.seconds:8.1f} times faster", flush=True)


def _print_growth(packages: Sequence[Path], most: int, scratch: Path) -> None:
    print("growth: ms for a package, against that among 10; memory of the largest process")
    first: States | None = None
    for count in (cost for cost in GROWTH if cost <= most):
        top = scratch / f"growth_{count}"
        for number in range(count):
            _copy(packages[number % len(packages)], top, number // len(packages))
        states = States.of([top])
        first = first or states
        figures = [
            f"{name} {cost.seconds / count * 1000:6.2f} "
            f"({cost.seconds / count / (base.seconds / GROWTH[0]):.2f})"
            for (name, cost), base in zip(states._asdict().items(), first, strict=True)
        ]
        memory = max(cost.megabytes for cost in states)
        print(f"  {count:4} packages: {'  '.join(figures)}  {memory:.0f} MB", flush=True)
        shutil.rmtree(top)


def _copy(package: Path, top: Path, number: int) -> None:
    """Copy a package under a new name, in its files as well."""
    old, new = package.name, f"{package.name}_n{number}"
    for path in package.rglob("*"):
        if not path.is_file():
            continue
        to = top / new / str(path.relative_to(package)).replace(old, new)
        to.parent.mkdir(parents=True, exist_ok=True)
        data = path.read_bytes()
        to.write_bytes(data.replace(old.encode(), new.encode()))
        to.chmod(path.stat().st_mode)


def _check(paths: Sequence[Path]) -> list[str]:
    return [sys.executable, "-m", "scaffold", "check", *map(str, paths)]


def _ruff(files: Sequence[str]) -> list[str]:
    return [ruff.executable(), "check", "--isolated", "--no-cache", "--quiet", *files]


def _python_files(tops: Sequence[Path]) -> list[str]:
    return [str(path) for top in tops for path in sorted(top.rglob("*.py")) if path.is_file()]


def _python_size(package: Path) -> int:
    return sum(Path(path).stat().st_size for path in _python_files([package])) or sys.maxsize


def _forget_everything() -> None:
    shutil.rmtree(os.environ["XDG_CACHE_HOME"], ignore_errors=True)


def _forget_results() -> None:
    place = os.path.join(os.environ["XDG_CACHE_HOME"], "ros2-scaffold", "runs")
    shutil.rmtree(place, ignore_errors=True)


if __name__ == "__main__":
    main()
