"""Thousands of mutated packages: no traceback, no crashed rule, bounded time and memory.

``SCAFFOLD_MUTANTS`` is their number, ``SCAFFOLD_MUTANT_SEED`` the first seed, and
``SCAFFOLD_MUTANT_BASES`` names directories of further packages to break, separated by ``:``.
"""

from __future__ import annotations

import json
import os
import resource
import select
import signal
import time
import traceback
from collections.abc import Iterator, Sequence
from pathlib import Path
from random import Random
from typing import Any

import pytest

from scaffold.check.fixes import workspace_fixer
from scaffold.check.rules import registry
from scaffold.check.rules.rule import Rule
from scaffold.check.selection import Selection
from scaffold.check.session import Session
from scaffold.cli.main import main
from scaffold.configuration import content
from scaffold.model.discovery.targets import Target
from scaffold.model.package import Package
from tests.nightly.mutation import Files, mutate

COUNT = int(os.environ.get("SCAFFOLD_MUTANTS", "2000"))
SEED = int(os.environ.get("SCAFFOLD_MUTANT_SEED", "1"))
BATCH = 50
MOST_SECONDS = 5
"""Of the processor, for one package."""
MOST_WAITING = 120
"""Seconds without a word after which a process counts as hung."""
MOST_MEMORY = 1_000_000
"""Kilobytes that are in memory."""
MOST_ADDRESSES = 3_000_000_000
_KINDS: Sequence[Sequence[str]] = (
    ("--topic", "chatter"),
    ("--build-type", "ament_cmake", "--topic", "chatter"),
    ("--build-type", "ament_python", "--extras", "launch"),
)

pytestmark = [pytest.mark.nightly, pytest.mark.timeout(0)]


def _read(directory: Path) -> Files:
    files = (path for path in sorted(directory.rglob("*")) if path.is_file())
    return {
        str(path.relative_to(directory)): path.read_bytes()
        for path in files
        if ".git" not in path.parts and path.stat().st_size < 100_000
    }


@pytest.fixture(scope="module")
def bases(tmp_path_factory: pytest.TempPathFactory) -> list[Files]:
    """Return good packages."""
    home = tmp_path_factory.mktemp("bases")
    result: list[Files] = []
    for at, arguments in enumerate(_KINDS):
        name = f"base_{at}"
        words = ["new", name, "--destination-directory", str(home), *arguments]
        assert main(words) == 0
        result.append(_read(home / name))
    for directory in os.environ.get("SCAFFOLD_MUTANT_BASES", "").split(":"):
        manifests = sorted(Path(directory).rglob("package.xml")) if directory else []
        result.extend(_read(manifest.parent) for manifest in manifests)
    assert result
    return [files for files in result if len(files) < 200]


def _seconds() -> float:
    own = resource.getrusage(resource.RUSAGE_SELF)
    others = resource.getrusage(resource.RUSAGE_CHILDREN)
    return own.ru_utime + own.ru_stime + others.ru_utime + others.ru_stime


def _kilobytes() -> int:
    return max(
        resource.getrusage(who).ru_maxrss
        for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)
    )


class _NoProgress:
    """A progress bar that shows nothing."""

    def begin(self, label: str, total: int) -> None:
        """Start another part of the work."""

    def step(self) -> None:
        """Count one of the total as done."""


def _problem(session: Session, files: Files, *, fix: bool) -> str:
    """Check a package; return a description of the failure, if any."""
    package = Package.of(dict(files))
    try:
        if fix:
            workspace_fixer.fix([Target(package)], session, _NoProgress(), unsafe=True)
            return ""
        findings = session.check(package)
    except Exception:  # noqa: BLE001  whatever it is, it is what the test looks for
        return traceback.format_exc()
    return "; ".join(
        f"{finding.location.path}: {finding.message}"
        for finding in findings
        if finding.code == "SC002"
    )


def _check_seeds(
    pipe: int, rules: Sequence[type[Rule]], bases: Sequence[Files], seeds: range
) -> None:
    """Check packages and write a JSON line per step."""
    resource.setrlimit(resource.RLIMIT_AS, (MOST_ADDRESSES, MOST_ADDRESSES))
    session = Session(rules, Selection())
    for seed in seeds:
        random = Random(seed)  # noqa: S311  it is repeatable on purpose
        files, story = mutate(random.choice(bases), random)
        before = _seconds()
        os.write(pipe, f"{json.dumps({'seed': seed, 'story': story})}\n".encode())
        problem = _problem(session, files, fix=random.random() < 0.15)
        spent = _seconds() - before
        line = {"seed": seed, "problem": problem[-3000:], "spent": spent, "size": _kilobytes()}
        os.write(pipe, f"{json.dumps(line)}\n".encode())


def _batch(
    rules: Sequence[type[Rule]], bases: Sequence[Files], seeds: range
) -> Iterator[dict[str, Any]]:
    """Yield the lines of a child process about some packages; the last one may be incomplete."""
    reading, writing = os.pipe()
    process = os.fork()
    if process == 0:
        os.close(reading)
        try:
            _check_seeds(writing, rules, bases, seeds)
        finally:
            os._exit(0)
    os.close(writing)
    rest = b""
    while select.select([reading], [], [], MOST_WAITING)[0]:
        part = os.read(reading, 1 << 16)
        if not part:
            break
        *lines, rest = (rest + part).split(b"\n")
        yield from map(json.loads, lines)
    else:
        os.kill(process, signal.SIGKILL)
    os.close(reading)
    os.waitpid(process, 0)


def _failures(
    rules: Sequence[type[Rule]], bases: Sequence[Files], seeds: range
) -> Iterator[tuple[int, str]]:
    """Yield the seeds of the packages that fail, with a description."""
    at = seeds.start
    while at < seeds.stop:
        story: list[str] = []
        done = False
        for line in _batch(rules, bases, range(at, min(at + BATCH, seeds.stop))):
            if "story" in line:
                at, story, done = line["seed"], line["story"], False
                continue
            done = True
            if line["problem"]:
                yield at, f"{story}: {line['problem']}"
            if line["spent"] > MOST_SECONDS:
                yield at, f"{story}: {line['spent']:.1f} s"
            if line["size"] > MOST_MEMORY:
                yield at, f"{story}: {line['size']} kB"
                break
        if not done:
            yield at, f"{story}: the process ended, or hung"
        at += 1
        print(f"{at - seeds.start} packages", flush=True)  # noqa: T201  hours may be left


def test_mutated_packages_cause_no_failure(
    bases: list[Files], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("SCAFFOLD_NO_CACHE", "1")
    rules = registry.load(content.roots("rules", ()))
    problems: list[str] = []
    start = time.monotonic()
    with capsys.disabled():
        for seed, problem in _failures(rules, bases, range(SEED, SEED + COUNT)):
            problems.append(f"seed {seed}: {problem}")
            print(problems[-1], flush=True)  # noqa: T201  hours may be left
        print(f"{COUNT} packages in {time.monotonic() - start:.0f} s")  # noqa: T201
    assert problems == []
