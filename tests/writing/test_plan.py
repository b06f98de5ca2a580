"""WritePlan: conflicts are found before writing; all files are written or none."""

from __future__ import annotations

import os
import stat
from pathlib import Path

import pytest

from scaffold.errors import ConflictError, InputError
from scaffold.writing.plan import WritePlan
from scaffold.writing.planned_file import State


def test_new_directory_is_created_atomically(tmp_path: Path) -> None:
    root = tmp_path / "ws" / "src" / "talker"
    plan = WritePlan.of(root, {"a": "1\n", "run/me": b"#!"}, executable={"run/me"})
    assert [(f.path, f.state) for f in plan.files] == [("a", State.NEW), ("run/me", State.NEW)]
    assert not root.parent.exists()
    plan.write()
    assert tree(tmp_path) == {"ws/src/talker/a": "1\n", "ws/src/talker/run/me": "#!"}
    assert os.access(root / "run" / "me", os.X_OK)
    assert not os.access(root / "a", os.X_OK)


def test_modes_follow_the_umask(tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        WritePlan.of(tmp_path / "p", {"a": "", "x": ""}, executable={"x"}).write()
    finally:
        os.umask(before)
    modes = [stat.S_IMODE((tmp_path / "p" / name).stat().st_mode) for name in (".", "a", "x")]
    assert modes == [0o750, 0o640, 0o750]


def test_conflict_writes_nothing(tmp_path: Path) -> None:
    (tmp_path / "b").write_text("mine")
    plan = WritePlan.of(tmp_path, {"a": b"1", "b": b"2"})
    with pytest.raises(ConflictError, match=r"would overwrite b in .*; nothing was written"):
        plan.write()
    assert tree(tmp_path) == {"b": "mine"}


def test_file_with_same_content_is_no_conflict(tmp_path: Path) -> None:
    (tmp_path / "b").write_text("2")
    stamp = (tmp_path / "b").stat().st_mtime_ns
    plan = WritePlan.of(tmp_path, {"a": "1", "b": "2"})
    assert plan.conflicts == []
    plan.write()
    assert tree(tmp_path) == {"a": "1", "b": "2"}
    assert (tmp_path / "b").stat().st_mtime_ns == stamp


def test_force_overwrites_and_keeps_modes(tmp_path: Path) -> None:
    (tmp_path / "b").write_text("mine")
    (tmp_path / "b").chmod(0o604)
    WritePlan.of(tmp_path, {"b": "2"}).write(force=True)
    assert tree(tmp_path) == {"b": "2"}
    assert stat.S_IMODE((tmp_path / "b").stat().st_mode) == 0o604


def test_executable_bits_and_removed_files_are_in_diff(tmp_path: Path) -> None:
    (tmp_path / "tool.py").write_text("x\n")
    (tmp_path / "gone").write_text("old\n")
    (tmp_path / "kept").write_text("one\ntwo")
    plan = WritePlan.of(
        tmp_path, {"kept": "one\n2\n"}, executable=["tool.py"], remove=["gone", "never"]
    )
    assert plan.conflicts == ["gone", "kept", "tool.py"]
    assert plan.diff(relative_to=str(tmp_path)) == (
        "diff --git a/gone b/gone\ndeleted file mode 100644\n"
        "--- a/gone\n+++ /dev/null\n@@ -1 +0,0 @@\n-old\n"
        "diff --git a/kept b/kept\n"
        "--- a/kept\n+++ b/kept\n@@ -1,2 +1,2 @@\n one\n-two\n\\ No newline at end of file\n+2\n"
        "diff --git a/tool.py b/tool.py\nold mode 100644\nnew mode 100755\n"
    )
    plan.write(force=True)
    assert tree(tmp_path) == {"kept": "one\n2\n", "tool.py": "x\n"}
    assert os.access(tmp_path / "tool.py", os.X_OK)
    again = WritePlan.of(tmp_path, {"kept": "one\n2\n"}, executable=["tool.py"], remove=["gone"])
    assert again.changes == []
    assert again.diff() == ""


@pytest.mark.parametrize("path", ["../x", "a/../../x", "/etc/x", "", "a//b", "./a", "a\\b", "a\0b"])
def test_paths_outside_of_the_root_are_rejected(tmp_path: Path, path: str) -> None:
    with pytest.raises(InputError, match="is not a path below"):
        WritePlan.of(tmp_path / "p", {path: ""})
    assert tree(tmp_path) == {}


@pytest.mark.parametrize("path", ["link", "dir/x", "dangling"])
def test_symlinks_out_of_the_root_are_rejected(tmp_path: Path, path: str) -> None:
    root, outside = tmp_path / "p", tmp_path / "outside"
    root.mkdir()
    outside.mkdir()
    (outside / "x").write_text("secret")
    (root / "link").symlink_to(outside / "x")
    (root / "dir").symlink_to(outside)
    (root / "dangling").symlink_to(outside / "new")
    with pytest.raises(InputError, match="leads out of"):
        WritePlan.of(root, {path: "stolen"})


def test_symlink_within_the_root_is_followed(tmp_path: Path) -> None:
    (tmp_path / "real").write_text("1")
    (tmp_path / "link").symlink_to("real")
    WritePlan.of(tmp_path, {"link": "2"}).write(force=True)
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "real").read_text() == "2"


def test_file_in_place_of_directory_is_rejected(tmp_path: Path) -> None:
    (tmp_path / "d").mkdir()
    (tmp_path / "f").write_text("")
    for files, words in (
        ({"d": ""}, "but is a directory"),
        ({"f/x": ""}, "but that is a file"),
        ({"n": "", "n/x": ""}, "a file and a directory"),
    ):
        with pytest.raises(ConflictError, match=words):
            WritePlan.of(tmp_path, files)


def test_failed_write_leaves_no_new_directory(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    for root in (tmp_path / "file" / "p", tmp_path / ("n" * 300)):
        with pytest.raises((InputError, ConflictError)):
            WritePlan.of(root, {"a/b": "1"}).write()
    plan = WritePlan.of(tmp_path / "p", {"a": "1", "n" * 260: "2"})
    with pytest.raises(InputError, match="nothing was written"):
        plan.write()
    assert tree(tmp_path) == {"file": ""}
    assert os.listdir(tmp_path) == ["file"]


def test_failed_write_restores_previous_files(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("old")
    (tmp_path / "a").chmod(0o640)
    (tmp_path / "z").write_text("old")
    plan = WritePlan.of(tmp_path, {"a": "new", "new/x": "new", "z": "new"}, remove=["gone"])
    (tmp_path / "z").unlink()
    (tmp_path / "z").mkdir()  # somebody else was faster
    with pytest.raises(InputError):
        plan.write(force=True)
    assert tree(tmp_path) == {"a": "old"}
    assert stat.S_IMODE((tmp_path / "a").stat().st_mode) == 0o640
    assert sorted(os.listdir(tmp_path)) == ["a", "z"]


def test_directory_created_after_planning_is_kept(tmp_path: Path) -> None:
    plan = WritePlan.of(tmp_path / "p", {"a": "1"})
    (tmp_path / "p").mkdir()
    with pytest.raises(ConflictError, match="created in the meantime"):
        plan.write()
    assert os.listdir(tmp_path) == ["p"]


def tree(root: Path) -> dict[str, str]:
    return {
        path.relative_to(root).as_posix(): path.read_text()
        for path in sorted(root.rglob("*"))
        if path.is_file()
    }
