"""Files ignored by git are created on each machine."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold.files.tree import DiskTree
from scaffold.model.discovery.gitignore import is_untracked
from scaffold.model.package import Package
from scaffold.model.workspace.workspace import Workspace


@pytest.mark.parametrize(("checkout", "expected"), [("src", True), ("", True), (None, False)])
def test_gitignore_files_of_the_checkout_are_used(
    tmp_path: Path, checkout: str | None, *, expected: bool
) -> None:
    directory = tmp_path / "src" / "talker"
    directory.mkdir(parents=True)
    (tmp_path / "src" / ".gitignore").write_text("# made by calibration\ncalibrated_*.yaml\n")
    if checkout is not None:
        (tmp_path / checkout / ".git").mkdir()
    package = Package(DiskTree(str(directory)), workspace=Workspace())
    (tmp_path / "src" / ".gitmodules").write_text('[submodule "a"]\n\tpath = talker/external/a\n')
    assert is_untracked(package, "config/calibrated_head.yaml") is expected
    assert is_untracked(package, "external/a/include/a.hpp") is expected
    assert not is_untracked(package, "external/b/include/b.hpp")
    assert not is_untracked(package, "config/head.yaml")


@pytest.mark.parametrize(
    ("pattern", "path", "expected"),
    [
        ("lib/", "lib", True),
        ("lib/", "resource/lib/libcar.so", True),
        ("/lib/", "lib", True),
        ("/lib/", "resource/lib", False),
        ("resource/lib", "resource/lib/libcar.so", True),
        ("resource/lib", "lib/libcar.so", False),
        ("# lib/", "lib", False),
        ("!lib/", "lib", False),
    ],
)
def test_patterns_match_directories_and_paths(pattern: str, path: str, *, expected: bool) -> None:
    package = Package.of({".gitignore": f"{pattern}\n"})
    assert is_untracked(package, path) is expected


def test_nested_gitignore_applies_below_its_directory() -> None:
    package = Package.of({"simulator/.gitignore": "/controller\n*.log\n"})
    assert is_untracked(package, "simulator/controller")
    assert is_untracked(package, "simulator/logs/run.log")
    assert not is_untracked(package, "simulator/lib/controller")
    assert not is_untracked(package, "controller")
    assert not is_untracked(package, "../controller")
