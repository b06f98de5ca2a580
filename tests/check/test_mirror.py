"""Directories sent to a worker of a cluster equal the originals."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

from scaffold.cluster import mirror
from scaffold.files.disk import MAX_BYTES, Disk


def sent(tmp_path: Path, *directories: Path) -> str:
    """Return the root on a worker below which the paths of the directories are mirrored."""
    packer = mirror.Packer()
    for directory in directories:
        packer.add_tree(str(directory))
        packer.add_above(str(directory))
    there = tmp_path / "there"
    there.mkdir()
    mirror.unpack(packer.mirror(), str(there))
    return os.path.realpath(there)


def test_files_symlinks_and_modes_are_mirrored(tmp_path: Path) -> None:
    here = tmp_path / "here"
    (here / "robot" / "scripts").mkdir(parents=True)
    (here / "elsewhere").mkdir()
    (here / "elsewhere" / "file").write_text("text")
    robot = here / "robot"
    (robot / "package.xml").write_text("<package/>")
    (robot / "scripts" / "run").write_text("#!/bin/sh\n")
    (robot / "scripts" / "run").chmod(0o755)
    (robot / "absolute").symlink_to(here / "elsewhere" / "file")
    (robot / "relative").symlink_to("../elsewhere/file")
    (robot / "broken").symlink_to("nowhere")
    (robot / "directory").symlink_to(here / "elsewhere")
    (robot / "loop").symlink_to("loop")
    there = sent(tmp_path, robot) + str(robot)
    for parent in ("", "scripts"):
        own, others = (Disk().names(os.path.join(top, parent)) for top in (str(robot), there))
        assert own == others
    for name in ("package.xml", "scripts/run", "absolute", "relative"):
        assert Path(there, name).read_bytes() == (robot / name).read_bytes()
        assert os.access(os.path.join(there, name), os.X_OK) == os.access(robot / name, os.X_OK)
    assert Path(there, "absolute").resolve() == Path(there).parent / "elsewhere" / "file"


def test_unread_file_keeps_only_its_size(tmp_path: Path) -> None:
    here = tmp_path / "here"
    here.mkdir()
    with (here / "mesh.stl").open("wb") as file:
        file.write(b"solid")
        file.truncate(MAX_BYTES + 1)
    there = Path(sent(tmp_path, here) + str(here), "mesh.stl")
    assert there.stat().st_size == MAX_BYTES + 1
    assert there.read_bytes()[:5] == bytes(5)


def test_build_products_and_git_data_are_not_sent(tmp_path: Path) -> None:
    here = tmp_path / "here"
    for name in ("build", "src/robot/install", "src/robot/build"):
        (here / name).mkdir(parents=True)
        (here / name / "result").touch()
    (here / "build" / "COLCON_IGNORE").touch()
    (here / "src" / "robot" / "tracked").touch()
    (here / ".env").write_text("secret")
    subprocess.run(["git", "init", "--quiet", here], check=True)
    subprocess.run(["git", "-C", here, "add", "src/robot/tracked"], check=True)
    there = sent(tmp_path, here / "src") + str(here)
    listed = ["git", "ls-files"]
    own, others = (
        subprocess.run(listed, cwd=top, capture_output=True, check=True).stdout
        for top in (here, there)
    )
    assert own == others == b"src/robot/tracked\n"
    assert sorted(os.listdir(there)) == [".git", "src"]
    assert os.path.exists(os.path.join(there, "src/robot/build/result"))
    assert not os.path.exists(os.path.join(there, ".git", "config"))
    again = tmp_path / "again"
    again.mkdir()
    whole = sent(again, here) + str(here)
    assert os.listdir(os.path.join(whole, "build")) == ["COLCON_IGNORE"]
