"""After random edits, a cached check gives the same report as a check from scratch."""

from __future__ import annotations

import shutil
from collections import defaultdict
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest

from scaffold.check import runner, session
from scaffold.check.cache import runs
from scaffold.check.result import Earlier
from scaffold.cli.main import main
from scaffold.files import cache
from tests.check.cache.random_edits import edit

EDITS = 30

Report = Callable[[str], str]


@pytest.fixture
def report(
    new_cache: Callable[[], Path],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> Report:
    """Return a function that checks the current directory with a named cache."""
    caches: defaultdict[str, Path] = defaultdict(new_cache)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.delenv(cache.SWITCH, raising=False)
    # Somebody may edit the tool while its tests run.
    tool = runs.tool()
    monkeypatch.setattr(runs, "tool", lambda: tool)

    def check(name: str) -> str:
        kept = caches[name]
        monkeypatch.setenv("XDG_CACHE_HOME", str(kept))
        if name == "cold":
            # The style of a file goes by its content alone.
            shutil.rmtree(kept / "ros2-scaffold" / "runs", ignore_errors=True)
        main(["check", "--format", "json", "."])
        return capsys.readouterr().out

    return check


def compare(top: Path, report: Report, count: int, seed: int) -> int:
    """Edit a workspace many times; return after how many edits cached parts were used."""
    random = Random(seed)  # noqa: S311  no secrets
    story: list[str] = []
    taken_over: set[int] = set()
    take_over = runner.Check._take_over  # noqa: SLF001

    def watched(check: runner.Check, earlier: Earlier) -> None:
        taken_over.add(len(story))
        take_over(check, earlier)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(runner.Check, "_take_over", watched)
        patch.setattr(session, "WORTH_PARTS", 0)
        report("warm")
        for _ in range(count):
            story.append(edit(top, random))
            assert report("warm") == report("cold"), "\n".join([f"seed {seed}", *story])
    return len(taken_over)


def make_workspace(top: Path) -> None:
    """Write packages that depend on each other."""
    for name, words in (
        ("talker", ["--add", "publisher:talk", "--add", "timer:tick", "--extras", "launch"]),
        ("tuner", ["--build-type", "ament_python", "--node-kind", "parameters"]),
        ("things", ["--add", "message:Thing"]),
    ):
        assert main(["new", name, "--destination-directory", str(top), *words]) == 0


def test_cached_report_after_random_edits(
    tmp_path: Path, report: Report, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_workspace(tmp_path / "src")
    monkeypatch.chdir(tmp_path / "src")
    assert compare(tmp_path / "src", report, EDITS, seed=1) > EDITS // 4
