"""Patches: applying them with git gives the same files as writing the plan."""

from __future__ import annotations

import os
import stat
import subprocess
from collections.abc import Mapping
from pathlib import Path

import pytest

from scaffold.printable import write_lines
from scaffold.writing import patch
from scaffold.writing.plan import WritePlan

Tree = dict[str, tuple[bytes, bool]]
"""Content of all files by path, and whether they are executable."""


def git(directory: Path, *arguments: str) -> str:
    """Run git without the user's configuration."""
    environment = {
        **os.environ,
        "GIT_CONFIG_GLOBAL": os.devnull,
        "GIT_CONFIG_SYSTEM": os.devnull,
    }
    done = subprocess.run(
        ["git", *arguments], cwd=directory, env=environment, capture_output=True, check=False
    )
    assert done.returncode == 0, done.stderr.decode(errors="replace")
    return done.stdout.decode(errors="surrogateescape")


def fill(root: Path, files: Mapping[str, bytes]) -> None:
    """Write files."""
    for name, data in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


def tree(root: Path) -> Tree:
    """Return the contents of a directory without `.git`."""
    return {
        os.fsdecode(path.relative_to(root)): (
            path.read_bytes(),
            bool(path.stat().st_mode & stat.S_IXUSR),
        )
        for path in root.rglob("*")
        if path.is_file() and ".git" not in path.relative_to(root).parts
    }


def save(text: str, path: Path) -> Path:
    """Write a patch as the verbs write it to a file."""
    with path.open("w", encoding="ascii") as out:
        write_lines(text, out)
    return path


CASES: dict[str, tuple[bytes | None, bytes | None, bool]] = {
    "edited": (b"one\ntwo\nthree\n", b"one\n2\nthree\n", False),
    "edited and executable": (b"#!x\n", b"#!y\n", True),
    "executable": (b"#!x\n", b"#!x\n", True),
    "new": (None, b"1\n2\n", False),
    "new and executable": (None, b"#!x\n", True),
    "new and empty": (None, b"", False),
    "emptied": (b"1\n", b"", False),
    "filled": (b"", b"1\n", False),
    "removed": (b"1\n2\n", None, False),
    "removed while empty": (b"", None, False),
    "loses its last line end": (b"1\n2\n", b"1\n2", False),
    "gets a last line end": (b"1\n2", b"1\n2\n", False),
    "never has a last line end": (b"1\n2", b"1\n3", False),
    "CRLF": (b"1\r\n2\r\n", b"1\r\n3\r\n", False),
    "CRLF becomes LF": (b"1\r\n2\r\n", b"1\n2\n", False),
    "lone returns, form feeds": (b"1\r2\x0c3\x1c\n4\n", b"1\r2\x0c3\x1c\n5\n", False),
    "latin-1": (b"# caf\xe9\nx = 1 \n", b"# caf\xe9\nx = 1\n", False),
    "UTF-8 with a mark": ("\ufeffé\u2028\nx \n".encode(), "\ufeffé\u2028\nx\n".encode(), False),
    "UTF-16": ("é\nx \n".encode("utf-16"), "é\nx\n".encode("utf-16"), False),
    "binary": (bytes(range(256)) * 9, bytes(range(255, -1, -1)) * 9, False),
    "new and binary": (None, b"\0\xff" * 40, True),
    "binary and removed": (b"\0\xff" * 40, None, False),
    "looks like a patch": (b"--- a/x\n+++ b/x\n@@ -1 +1 @@\n-1\n", b"--- a/x\n+++ b/y\n", False),
}

NAMES = (
    "plain.py",
    "with space.py",
    "tab\there.py",
    "line\nend.py",
    'quote".py',
    "back slash.py",
    "café.py",
    "caf\udce9.py",
    "\x1b[31m.py",
    "deep/er/file.py",
    "--option.py",
)


@pytest.mark.parametrize("name", NAMES, ids=ascii)
def test_git_applies_patch_of_files_with_odd_names(tmp_path: Path, name: str) -> None:
    check(
        tmp_path, {name: CASES["edited"], f"x/{name}": CASES["new"], f"y/{name}": CASES["removed"]}
    )
    check(tmp_path / "modes", {name: CASES["executable"], f"z/{name}": CASES["new and empty"]})


@pytest.mark.parametrize("case", CASES)
def test_git_applies_patch_with_each_kind_of_change(tmp_path: Path, case: str) -> None:
    check(tmp_path, {"file": CASES[case]})


def test_git_applies_patch_with_all_kinds_of_changes(tmp_path: Path) -> None:
    check(tmp_path, {f"directory {at}/file": case for at, case in enumerate(CASES.values())})


def check(directory: Path, cases: Mapping[str, tuple[bytes | None, bytes | None, bool]]) -> None:
    """Apply a patch with git, write the same plan elsewhere, and compare."""
    old = {name: before for name, (before, _, _) in cases.items() if before is not None}
    applied, written = (directory / side for side in ("applied", "written"))
    for side in (applied, written):
        (side / "package").mkdir(parents=True)
        fill(side / "package", old)
    git(applied, "init", "-q")
    git(applied, "add", "-A")

    def plan(root: Path) -> WritePlan:
        return WritePlan.of(
            root / "package",
            {name: after for name, (_, after, _) in cases.items() if after is not None},
            executable=[name for name, (_, _, executable) in cases.items() if executable],
            remove=[name for name, (_, after, _) in cases.items() if after is None],
        )

    text = plan(applied).diff(relative_to=str(applied))
    saved = str(save(text, directory / "saved.patch"))
    git(applied, "apply", "--check", "--index", saved)
    git(applied, "apply", saved)
    plan(written).write(force=True)
    assert tree(applied) == tree(written)
    assert tree(applied / "package") == {
        name: (after, executable)
        for name, (_, after, executable) in cases.items()
        if after is not None
    }


@pytest.mark.parametrize("below", ["", "src", "src/pkg", "other"])
@pytest.mark.parametrize("is_repository", [True, False])
def test_paths_are_relative_to_directory_of_git_apply(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, below: str, is_repository: bool
) -> None:
    """From the top of the repository, from below it, and without a repository."""
    top = tmp_path / "top"
    fill(top, {"src/pkg/a": b"1\n", "src/second/a": b"1\n", "other/a": b"1\n"})
    if is_repository:
        git(top, "init", "-q")
    here = top / below
    monkeypatch.chdir(here)
    roots = [path for path in (top / "src" / "pkg", here) if here in (path, *path.parents)]
    plans = [WritePlan.of(root, {"a": "2\n"}, executable=["a"]) for root in roots or [here]]
    base = patch.base([plan.root for plan in plans])
    text = "".join(dict.fromkeys(plan.diff(relative_to=base) for plan in plans))
    git(here, "apply", str(save(text, tmp_path / "saved.patch")))
    assert all(not plan_again(plan).changes for plan in plans)


def plan_again(plan: WritePlan) -> WritePlan:
    """Return a plan for the same files against their current content."""
    return WritePlan.of(plan.root, {"a": "2\n"}, executable=["a"])


def test_paths_are_relative_to_common_parent_of_packages(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The current directory is elsewhere: no two files of a patch get the same path."""
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    roots = [str(tmp_path / "ws" / name) for name in ("a", "b")]
    assert patch.base(roots) == str(tmp_path / "ws")
    (tmp_path / "ws").mkdir()
    git(tmp_path / "ws", "init", "-q")
    assert patch.base([f"{root}/deep" for root in roots]) == str(tmp_path / "ws")
    assert patch.base(roots[:1]) == str(tmp_path / "ws")


def test_patch_changes_target_of_symlink(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    fill(tmp_path, {"real": b"1\n"})
    (tmp_path / "link").symlink_to("real")
    git(tmp_path, "init", "-q")
    monkeypatch.chdir(tmp_path)
    text = WritePlan.of(tmp_path, {"link": "2\n"}).diff()
    git(tmp_path, "apply", str(save(text, tmp_path / "saved.patch")))
    assert (tmp_path / "real").read_bytes() == b"2\n"
    assert (tmp_path / "link").is_symlink()
