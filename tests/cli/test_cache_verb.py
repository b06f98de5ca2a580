"""``ros2-scaffold cache``: shows the size of the cache and empties it."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.files import cache


@pytest.fixture
def cache_directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the directory of the cache after a run that filled it."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    assert main(["new", "talker"]) == 0
    assert main(["check", "talker"]) == 0
    return tmp_path / "cache" / "ros2-scaffold"


def files(cache_directory: Path) -> list[Path]:
    return [path for path in cache_directory.rglob("*") if path.is_file()]


def test_directory_and_size_are_shown(
    cache_directory: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = files(cache_directory)
    capsys.readouterr()
    assert main(["cache"]) == 0
    assert capsys.readouterr().out.startswith(f"{cache_directory}: {len(before)} files, ")
    assert files(cache_directory) == before


def test_clean_removes_every_file(
    cache_directory: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert files(cache_directory)
    count, size = cache.size(str(cache_directory))
    assert (count, size) == (
        len(files(cache_directory)),
        sum(path.stat().st_size for path in files(cache_directory)),
    )
    assert main(["cache", "clean"]) == 0
    assert files(cache_directory) == []
    assert capsys.readouterr().out.rstrip().endswith(" removed")
    assert main(["cache", "clean"]) == 0
    assert main(["check", "talker"]) == 0


def test_clean_removes_whole_directories(cache_directory: Path) -> None:
    for tree in cache.TREES:
        (cache_directory / tree / "abc" / "package").mkdir(parents=True)
        (cache_directory / tree / "abc" / "package" / "file").write_text("text")
    before = cache.size(str(cache_directory))
    assert before == (
        len(files(cache_directory)),
        sum(path.stat().st_size for path in files(cache_directory)),
    )
    assert main(["cache", "clean"]) == 0
    assert not any((cache_directory / tree).exists() for tree in cache.TREES)


def test_clean_keeps_files_of_other_programs(cache_directory: Path) -> None:
    held = cache_directory / "locks" / "held"
    held.parent.mkdir()
    held.touch()
    mine = cache_directory.parent / "mine"
    mine.touch()
    theirs = cache_directory.parent.parent / "theirs"
    theirs.mkdir()
    (theirs / "kept").touch()
    os.symlink(theirs, cache_directory / "runs" / "link")
    main(["cache", "clean"])
    assert held.exists()
    assert mine.exists()
    assert (theirs / "kept").exists()


def test_names_of_cache_files_have_known_prefixes(cache_directory: Path) -> None:
    assert [
        path.name for path in cache_directory.iterdir() if not path.name.startswith(cache.KINDS)
    ] == []
