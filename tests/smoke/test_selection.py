"""Selection of packages: by name, with their dependencies, and since a commit."""

from __future__ import annotations

import argparse
import json
import subprocess
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.cli.verbs import smoke as verb
from scaffold.model.discovery import targets
from scaffold.model.package import Package
from scaffold.smoke.selection import with_dependencies
from scaffold.smoke.session import packages_of
from tests.smoke.smoke_packages import ONCE, cmake_package, python_package
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, variables


def add_dependency(package: Path, name: str) -> None:
    manifest = package / "package.xml"
    depend = f"<exec_depend>{name}</exec_depend>"
    manifest.write_text(
        manifest.read_text().replace("<exec_depend>", f"{depend}\n  <exec_depend>", 1)
    )


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """Return a workspace in which ``top`` needs ``middle``, which needs ``base``."""
    for name in ("base", "middle", "top", "other"):
        python_package(tmp_path / "src", name, {f"{name}_once": ONCE})
    add_dependency(tmp_path / "src" / "middle", "base")
    add_dependency(tmp_path / "src" / "top", "middle")
    return tmp_path


def selected(workspace: Path, *words: str) -> tuple[list[str], list[str] | None]:
    """Return the packages that are built, and those that are run."""
    parser = argparse.ArgumentParser()
    verb.add_arguments(parser)
    options = parser.parse_args([str(workspace / "src"), *words])
    result = targets.find(options.paths)
    packages, names = verb._selected(options, result, packages_of(result))  # noqa: SLF001
    return [item.name for item in packages], None if names is None else sorted(names)


def test_all_packages_by_default(workspace: Path) -> None:
    assert selected(workspace) == (["base", "middle", "other", "top"], None)


def test_packages_by_name_are_run_and_their_dependencies_built(workspace: Path) -> None:
    words = ("--packages-select", "middle", "other")
    assert selected(workspace, *words) == (["base", "middle", "other"], ["middle", "other"])


def test_packages_up_to(workspace: Path) -> None:
    every = ["base", "middle", "top"]
    assert selected(workspace, "--packages-up-to", "top") == (every, every)


def test_circular_dependencies() -> None:
    text = "<package><name>{}</name><depend>{}</depend></package>"
    pair = [Package.of({"package.xml": text.format(*names)}) for names in ("ab", "ba")]
    assert with_dependencies(pair, {"a"}) == {"a", "b"}


def test_packages_since_a_commit_and_what_depends_on_them(workspace: Path) -> None:
    git = ("git", "-c", "user.name=a", "-c", "user.email=a@example.org")
    for words in (("init", "-q"), ("add", "."), ("commit", "-qm", "begin")):
        subprocess.run([*git, *words], cwd=workspace, check=True)
    assert selected(workspace, "--since", "HEAD") == ([], [])
    (workspace / "src" / "middle" / "middle" / "more.py").touch()
    assert selected(workspace, "--since", "HEAD") == (["base", "middle", "top"], ["middle", "top"])


@pytest.mark.parametrize(
    ("name", "hint"),
    [("midle", "did you mean 'middle'?"), ("x", "there are base, middle, other, top")],
)
def test_unknown_package_is_an_error(
    workspace: Path, name: str, hint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["smoke", str(workspace), "--packages-select", name]) == 2
    assert capsys.readouterr().err == (
        f"ros2-scaffold: error: --packages-select: there is no package {name!r}; {hint}\n"
    )


@pytest.mark.build
@NEEDS_ROS
def test_dependency_is_built_but_not_run(workspace: Path) -> None:
    native = cmake_package(workspace / "src", "native", {})
    add_dependency(native, "moveit_core")
    lists = (native / "CMakeLists.txt").read_text()
    (native / "CMakeLists.txt").write_text(f"{lists}find_package(moveit_core REQUIRED)\n")
    manifest = (native / "package.xml").read_text()
    needed = "<depend>moveit_core</depend>"
    declared = "<exec_depend>moveit_core</exec_depend>"
    (native / "package.xml").write_text(manifest.replace(declared, needed))
    add_dependency(workspace / "src" / "middle", "native")
    done = subprocess.run(
        command_line(workspace / "src", "--packages-select", "middle", "--format", "json"),
        env=variables(workspace),
        capture_output=True,
        text=True,
        check=False,
    )
    lack, left_out = done.stderr.splitlines()
    assert lack.startswith("ros2-scaffold: native needs moveit_core, which ")
    assert (
        left_out
        == "ros2-scaffold: not built, because they cannot be built here and are not run: native"
    )
    assert done.returncode == 0
    packages = {item["name"]: item for item in json.loads(done.stdout)["packages"]}
    assert set(packages) == {"base", "middle"}
    assert (packages["base"]["dependency"], packages["base"]["executables"]) == (True, [])
    assert packages["base"]["build"]["ok"]
    assert [item["name"] for item in packages["middle"]["executables"]] == ["middle_once"]
