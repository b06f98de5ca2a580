"""How fast `check` is, as ratios within one run (machines are noisy, ratios less so).

Usage: ``python benchmarks/check_speed.py DIRECTORY [--repeat N] [--ament BIN_DIRECTORY]``

DIRECTORY holds packages, for instance a clone of ros2/demos. Printed are, each as a ratio:

- `check` of the smallest package against the floor: a bare Python start and one call of ruff on
  the same files;
- `check` of all packages against ruff alone on the same files;
- with ``--ament``: the ament linters found there together against `check`;
- the time per kilobyte of Python for 10, 20, 40 ... packages against that for 10: up to 1.0 is
  linear, less shows that the cost of a start is shared.
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from scaffold.model import discovery

LINTERS = ("ament_flake8", "ament_pep257", "ament_copyright", "ament_lint_cmake", "ament_xmllint")


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("directory", type=Path)
    parser.add_argument("--repeat", type=int, default=7)
    parser.add_argument("--ament", type=Path, action="append", default=[])
    options = parser.parse_args()
    packages = [
        Path(target.package.directory) for target in discovery.find([str(options.directory)])
    ]
    smallest = min(packages, key=_python_size)
    timer = _Timer(options.repeat)
    with TemporaryDirectory() as home:
        os.environ["XDG_CACHE_HOME"] = home
        _print_small(timer, smallest)
        _print_large(timer, options.directory, packages, options.ament)
        _print_growth(timer, packages)


class _Timer:
    """Shortest wall time of commands: the one that other programs disturbed least."""

    def __init__(self, repeat: int) -> None:
        self.repeat = repeat

    def __call__(self, *commands: Sequence[str], before: Callable[[], None] | None = None) -> float:
        times: list[float] = []
        for _ in range(self.repeat):
            if before is not None:
                before()
            start = perf_counter()
            for command in commands:
                subprocess.run(command, check=False, capture_output=True)
            times.append(perf_counter() - start)
        return min(times)


def _print_small(timer: _Timer, package: Path) -> None:
    files = [str(path) for path in package.rglob("*.py")]
    floor = timer([sys.executable, "-c", "pass"], _ruff(files))
    warm = timer(_check(package))
    cold = timer(_check(package), before=_forget_cache)
    print(f"smallest package, {package.name}, {len(files)} Python files")
    print(f"  floor: bare Python and one ruff            1.0  ({floor * 1000:.0f} ms)")
    print(f"  check, files seen before                  {warm / floor:4.1f}")
    print(f"  check, files never seen                   {cold / floor:4.1f}")


def _print_large(
    timer: _Timer, directory: Path, packages: Sequence[Path], places: Sequence[Path]
) -> None:
    files = [str(path) for package in packages for path in package.rglob("*.py")]
    ruff = timer(_ruff(files))
    cold = timer(_check(directory), before=_forget_cache)
    warm = timer(_check(directory))
    print(f"{len(packages)} packages, {len(files)} Python files")
    print(f"  ruff alone                                 1.0  ({ruff * 1000:.0f} ms)")
    print(f"  check, files never seen                   {cold / ruff:4.1f}")
    print(f"  check, files seen before                  {warm / ruff:4.1f}")
    found = {
        name: place / name
        for name in LINTERS
        for place in reversed(places)
        if (place / name).exists()
    }
    linters = list(found.values())
    if linters:
        once = _Timer(1)
        together = sum(
            once([str(linter), str(package)]) for linter in linters for package in packages
        )
        names = ", ".join(linter.name for linter in linters)
        print(f"  {names} together: {together / cold:.1f} times check")


def _print_growth(timer: _Timer, packages: Sequence[Path]) -> None:
    base = 0.0
    count = 10
    while count <= len(packages):
        chosen = [str(package) for package in packages[:: max(1, len(packages) // count)][:count]]
        size = sum(path.stat().st_size for one in chosen for path in Path(one).rglob("*.py"))
        each = timer(_check(*chosen), before=_forget_cache) / (size / 1000)
        base = base or each
        print(
            f"  {count:4} packages: {each * 1000:.2f} ms per kB of Python, {each / base:.2f} of 10"
        )
        count *= 2


def _check(*paths: Path | str) -> list[str]:
    return [sys.executable, "-m", "scaffold", "check", *map(str, paths)]


def _ruff(files: Sequence[str]) -> list[str]:
    return ["ruff", "check", "--isolated", "--no-cache", "--quiet", *files]


def _python_size(package: Path) -> int:
    return sum(path.stat().st_size for path in package.rglob("*.py")) or sys.maxsize


def _forget_cache() -> None:
    for path in Path(os.environ["XDG_CACHE_HOME"]).rglob("*"):
        if path.is_file():
            path.unlink()


if __name__ == "__main__":
    main()
