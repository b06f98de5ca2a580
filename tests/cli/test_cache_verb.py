"""``ros2-scaffold cache``: how much is remembered, and a way to be rid of it."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.files import cache


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the cache after a run that used it."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    assert main(["new", "talker"]) == 0
    assert main(["check", "talker"]) == 0
    return tmp_path / "cache" / "ros2-scaffold"


def files(place: Path) -> list[Path]:
    return [path for path in place.rglob("*") if path.is_file()]


def test_its_place_and_size_are_shown(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = files(place)
    capsys.readouterr()
    assert main(["cache"]) == 0
    assert capsys.readouterr().out.startswith(f"{place}: {len(before)} files, ")
    assert files(place) == before


def test_clean_removes_every_file(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert files(place)
    count, size = cache.size(str(place))
    assert (count, size) == (len(files(place)), sum(path.stat().st_size for path in files(place)))
    assert main(["cache", "clean"]) == 0
    assert files(place) == []
    assert capsys.readouterr().out.rstrip().endswith(" removed")
    assert main(["cache", "clean"]) == 0
    assert main(["check", "talker"]) == 0


def test_clean_removes_whole_directories(place: Path) -> None:
    for tree in cache.TREES:
        (place / tree / "abc" / "package").mkdir(parents=True)
        (place / tree / "abc" / "package" / "file").write_text("text")
    before = cache.size(str(place))
    assert before == (len(files(place)), sum(path.stat().st_size for path in files(place)))
    assert main(["cache", "clean"]) == 0
    assert not any((place / tree).exists() for tree in cache.TREES)


def test_clean_leaves_what_is_not_of_the_cache(place: Path) -> None:
    held = place / "locks" / "held"
    held.parent.mkdir()
    held.touch()
    mine = place.parent / "mine"
    mine.touch()
    theirs = place.parent.parent / "theirs"
    theirs.mkdir()
    (theirs / "kept").touch()
    os.symlink(theirs, place / "runs" / "link")
    main(["cache", "clean"])
    assert held.exists()
    assert mine.exists()
    assert (theirs / "kept").exists()


def test_every_kind_of_file_is_known(place: Path) -> None:
    assert [path.name for path in place.iterdir() if not path.name.startswith(cache.KINDS)] == []
