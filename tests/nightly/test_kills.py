"""Runs of all writing verbs, killed at random steps: the next run recovers."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any, NamedTuple

import pytest

from scaffold.cli.main import main
from scaffold.configuration import content
from scaffold.files import temporary
from scaffold.writing import rename

pytestmark = [pytest.mark.nightly, pytest.mark.timeout(0)]

KILLS = int(os.environ.get("SCAFFOLD_KILLS", "100"))
"""Of each verb."""
SEED = int(os.environ.get("SCAFFOLD_KILL_SEED", "1"))
CALLS = ("open", "mkdir", "rename", "replace", "unlink", "rmdir", "fsync", "fchmod", "link")
PERSON = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.com")


class Case(NamedTuple):
    """A verb and its input."""

    before: Path | None
    """The package that it changes."""
    command: list[str]


@pytest.fixture(params=["add", "update", "fix", "new"])
def case(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Case:
    """Return a command to run next to a directory ``talker``."""
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    (tmp_path / "before").mkdir()
    monkeypatch.chdir(tmp_path / "before")
    assert main(["new", "talker", *PERSON]) == 0
    package = tmp_path / "before" / "talker"
    if request.param == "new":
        return Case(None, ["new", "talker", *PERSON])
    if request.param == "add":
        return Case(package, ["add", "timer", "beat", "--package-directory", "talker"])
    if request.param == "fix":
        for path in package.rglob("*.py"):
            path.write_text(path.read_text() + "X = 1 \n")
        return Case(package, ["check", "--fix", "talker"])
    team = tmp_path / "team" / "templates"
    for name in ("nodes/publisher", "package", "build_types/ament_cmake"):
        shutil.copytree(Path(content.roots("templates")[0]) / name, team / name)
    for path in team.rglob("*.jinja"):
        if path.name.endswith((".py.jinja", ".md.jinja", ".txt.jinja")):
            path.write_text(path.read_text().rstrip("\n") + "\n# Of the team\n")
    return Case(package, ["update", "talker", "--content", str(team.parent)])


def test_next_run_recovers_from_a_kill(
    case: Case, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = tmp_path / "here"
    start(case, place)
    monkeypatch.chdir(place)
    steps = run(case.command, None)
    expected = files(place / "talker")
    assert case.before is None or expected != files(case.before)
    chosen = Random(SEED)  # noqa: S311  it must be repeatable
    wrong: list[str] = []
    for _ in range(KILLS):
        at = chosen.randrange(1, steps + 1)
        monkeypatch.chdir(tmp_path)
        start(case, place)
        monkeypatch.chdir(place)
        run(case.command, at)
        run(case.command, None)
        left = [path for path in place.rglob(".*") if temporary.is_temporary(path.name)]
        if left or files(place / "talker") != expected:
            wrong.append(f"{case.command[0]}: step {at} of {steps}")
    assert not wrong, f"seed {SEED}"


HEALERS = (
    ("check", "--fix", "talker"),
    ("update", "talker"),
    ("add", "timer", "beat", "--package-directory", "talker"),
)
"""Commands that heal a package; the first two change nothing in one that is whole."""


@pytest.mark.parametrize("verb", ["new", "add"])
def test_any_writing_verb_recovers_files_at_the_top_of_the_repository(
    verb: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    before, after, place = (tmp_path / name for name in ("before", "after", "place"))
    (before / "src").mkdir(parents=True)
    subprocess.run(["git", "init", "-q", before], check=True)
    monkeypatch.chdir(before / "src")
    command = ["new", "talker", *PERSON, "--extras", "ci,devcontainer,pre_commit"]
    if verb == "add":
        assert main(["new", "talker", *PERSON]) == 0
        command = ["add", "ci", "--package-directory", "talker"]

    def begin(state: Path) -> None:
        monkeypatch.chdir(tmp_path)
        shutil.rmtree(place, ignore_errors=True)
        shutil.copytree(state, place)
        monkeypatch.chdir(place / "src")

    begin(before)
    steps = run(command, None)
    shutil.copytree(place, after)
    assert files(after) != files(before)
    expected: dict[tuple[str, ...], list[dict[str, bytes]]] = {}
    for healer in HEALERS:
        expected[healer] = []
        for state in (before, after):
            begin(state)
            run([*healer], None)
            expected[healer].append(files(place))
    chosen = Random(SEED)  # noqa: S311  it must be repeatable
    wrong: list[str] = []
    for number in range(KILLS):
        at = chosen.randrange(1, steps + 1)
        healer = HEALERS[number % len(HEALERS)]
        begin(before)
        run(command, at)
        run([*healer], None)
        # What a package that never appeared has left in `src`, the next `new` there sweeps.
        left = [
            path
            for path in (*place.iterdir(), *(place / "src" / "talker").rglob("*"))
            if temporary.is_temporary(path.name)
        ]
        if left or files(place) not in expected[healer]:
            wrong.append(f"{verb}, {healer[0]}: step {at} of {steps}")
    assert not wrong, f"seed {SEED}"


def start(case: Case, place: Path) -> None:
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir()
    if case.before is not None:
        shutil.copytree(case.before, place / "talker")


def files(package: Path) -> dict[str, bytes]:
    return {
        path.relative_to(package).as_posix(): path.read_bytes()
        for path in package.rglob("*")
        if path.is_file() and not any(map(temporary.is_temporary, path.parts))
    }


def run(command: list[str], at: int | None) -> int:
    """Run a command in a process that kills itself before a step; return the number of steps."""
    reading, writing = os.pipe()
    process = os.fork()
    if process == 0:
        try:
            count = _count_writes(at)
            nowhere = os.open(os.devnull, os.O_WRONLY)
            for number in (1, 2):
                os.dup2(nowhere, number)
            main(command)
            os.write(writing, str(len(count)).encode())
        finally:
            os._exit(0)
    os.close(writing)
    with open(reading, encoding="ascii") as pipe:
        steps = int(pipe.read() or "0")
    os.waitpid(process, 0)
    return steps


def _count_writes(at: int | None) -> list[str]:
    """Count calls of functions that change files, and kill this process before a given call."""
    count: list[str] = []

    def counted(name: str, function: Callable[..., Any]) -> Callable[..., Any]:
        def call(*arguments: object, **options: object) -> object:
            count.append(name)
            if len(count) == at:
                os.kill(os.getpid(), signal.SIGKILL)
            return function(*arguments, **options)

        return call

    for name in CALLS:
        setattr(os, name, counted(name, getattr(os, name)))
    vars(rename)["try_rename"] = counted("renameat2", rename.try_rename)
    return count
