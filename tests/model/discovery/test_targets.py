"""Packages and files selected by the paths on the command line."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from scaffold.errors import InputError
from scaffold.files.tree import DiskTree
from scaffold.model.discovery import targets as discovery
from scaffold.model.discovery.colcon import IGNORE_MARKERS

MANIFEST = "<package format='3'><name>{}</name></package>\n"


def make_package(path: Path, name: str | None = None) -> Path:
    path.mkdir(parents=True)
    (path / "package.xml").write_text(MANIFEST.format(name or path.name))
    return path


def found_packages(*paths: Path | str) -> list[str]:
    targets = discovery.find([str(path) for path in paths])
    return [Path(target.package.directory).name for target in targets]


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    make_package(tmp_path / "src" / "b_package")
    make_package(tmp_path / "src" / "group" / "a_package")
    for skipped in ("build", "install", "log", ".hidden"):
        make_package(tmp_path / skipped / f"in_{skipped.strip('.')}")
    for marker in IGNORE_MARKERS:
        ignored = make_package(tmp_path / "src" / f"with_{marker.lower()}")
        (ignored / marker).touch()
    return tmp_path


def test_packages_of_a_workspace(workspace: Path) -> None:
    assert found_packages(workspace) == ["b_package", "a_package"]


def test_package_given_twice_is_found_once(workspace: Path) -> None:
    assert found_packages(workspace, workspace / "src", workspace / "src" / "b_package") == [
        "b_package",
        "a_package",
    ]


def test_ignored_package_given_explicitly_is_found(workspace: Path) -> None:
    assert found_packages(workspace / "src" / "with_colcon_ignore") == ["with_colcon_ignore"]


def test_only_ignored_packages_is_an_error(tmp_path: Path) -> None:
    (make_package(tmp_path / "only") / "COLCON_IGNORE").touch()
    assert found_packages(tmp_path) == ["only"]


def test_packages_in_a_virtual_environment_are_skipped(workspace: Path) -> None:
    make_package(workspace / "tools" / "share" / "std_msgs")
    (workspace / "tools" / "pyvenv.cfg").touch()
    assert found_packages(workspace) == ["b_package", "a_package"]


def test_nested_packages_are_ignored(tmp_path: Path) -> None:
    outer = make_package(tmp_path / "outer")
    inner = make_package(outer / "inner")
    (inner / "node.py").touch()
    assert found_packages(tmp_path) == ["outer"]
    tree = DiskTree(outer)
    assert tree.files == ("package.xml",)
    assert tree.nested == ["inner"]


def test_file_of_a_package(workspace: Path) -> None:
    node = workspace / "src" / "b_package" / "b_package" / "node.py"
    node.parent.mkdir()
    node.touch()
    (target,) = discovery.find([str(node)])
    assert target.only == frozenset({"b_package/node.py"})
    assert target.package.name == "b_package"


def test_package_path_is_relative_if_the_given_path_is(
    workspace: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = workspace / "src" / "b_package"
    (package / "node.py").touch()
    monkeypatch.chdir(package.parent)
    for given, shown in (("b_package/node.py", "b_package"), (package / "node.py", package)):
        (target,) = discovery.find([str(given)])
        assert target.package.directory == str(shown)
    monkeypatch.chdir(package)
    (target,) = discovery.find(["node.py"])
    assert target.package.directory == "."


def test_file_without_package_in_the_current_directory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "node.py").touch()
    monkeypatch.chdir(tmp_path)
    (target,) = discovery.find(["node.py"])
    assert (target.package.directory, target.package.files) == (".", ("node.py",))


def test_file_without_package(tmp_path: Path) -> None:
    (tmp_path / "node.py").touch()
    (tmp_path / "other.py").touch()
    (target,) = discovery.find([str(tmp_path / "node.py")])
    assert target.package.files == ("node.py",)


def test_symlink_loops_and_dangling_symlinks(tmp_path: Path) -> None:
    package = make_package(tmp_path / "round")
    (package / "again").symlink_to(package)
    (package / "dangling.py").symlink_to(package / "nowhere")
    assert found_packages(tmp_path) == ["round"]
    assert DiskTree(package).files == ("package.xml",)


@pytest.mark.parametrize(
    ("name", "message"),
    [("missing", "no such file or directory"), ("empty", "no ROS 2 package"), ("a.txt", "belongs")],
)
def test_invalid_paths_are_errors(tmp_path: Path, name: str, message: str) -> None:
    (tmp_path / "empty").mkdir()
    (tmp_path / "a.txt").touch()
    with pytest.raises(InputError, match=message):
        found_packages(tmp_path / name)


def test_setup_py_without_manifest(tmp_path: Path) -> None:
    (tmp_path / "setup.py").touch()
    with pytest.raises(InputError, match=r"no package\.xml; colcon does not take it"):
        found_packages(tmp_path)


def test_whole_packages_of_given_files(workspace: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(workspace)
    (workspace / "loose.py").touch()
    packages = [os.path.normpath(item.package.directory) for item in discovery.find(["."])]
    files = [str(Path(item) / "package.xml") for item in packages]
    chosen = discovery.find([files[0], "loose.py", files[0]], whole_packages=True)
    assert [(item.package.directory, item.only) for item in chosen] == [(packages[0], None)]
    assert discovery.find(["loose.py"], whole_packages=True) == []
    everything = discovery.find([*files, "loose.py"], whole_packages=True)
    assert [item.package.directory for item in everything] == packages


def test_files_below_an_ignored_directory_select_nothing(
    workspace: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(workspace)
    vendored = make_package(workspace / "vendored" / "other")
    path = str(vendored.relative_to(workspace) / "package.xml")
    assert discovery.find([path], whole_packages=True)
    (workspace / "vendored" / "COLCON_IGNORE").touch()
    assert discovery.find([path], whole_packages=True) == []


def test_file_of_nested_package_selects_the_outer_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    outer = make_package(tmp_path / "outer")
    make_package(outer / "test" / "data" / "inner")
    monkeypatch.chdir(tmp_path)
    (target,) = discovery.find(["outer/test/data/inner/package.xml"], whole_packages=True)
    assert target.package.directory == "outer"
    monkeypatch.chdir(outer / "test")
    (target,) = discovery.find(["data/inner/package.xml"], whole_packages=True)
    assert target.package.directory == ".."


def test_build_products_of_a_nested_workspace_are_ignored(tmp_path: Path) -> None:
    package = make_package(tmp_path / "only")
    for place in ("build", "driver/install", "driver/src"):
        (package / place).mkdir(parents=True)
        (package / place / "file.cmake").touch()
    for place in ("build", "driver/install"):
        (package / place / "COLCON_IGNORE").touch()
    (target,) = discovery.find([str(package)])
    assert list(target.package.files) == ["driver/src/file.cmake", "package.xml"]
