"""The sdist and the wheel hold the repository, and the installed tool works."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import sysconfig
import tarfile
import venv
import zipfile
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.version import Version

from scaffold import __version__
from scaffold.check.rules import registry
from scaffold.check.session import all_rules
from scaffold.cli.verbs import VERBS
from scaffold.configuration import content
from scaffold.generate import yaml_file
from tests import PATIENCE
from tests.oracles import system_environment

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parent.parent


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a directory with the sdist, and the wheel made from it."""
    directory = tmp_path_factory.mktemp("dist")
    run(sys.executable, "-m", "build", "--no-isolation", "--outdir", directory, ROOT)
    return directory


@pytest.fixture(scope="module")
def wheel(built: Path) -> Path:
    return only(built, "*.whl")


@pytest.fixture(scope="module")
def command(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return ``ros2-scaffold`` of an environment that the wheel alone is installed in.

    The libraries that it needs are those of this environment, of which a ``.pth`` file shows the
    packages but not the ``.pth`` files, so not the checkout.
    """
    fresh = tmp_path_factory.mktemp("installed") / "venv"
    venv.create(fresh, symlinks=True)
    python = fresh / "bin" / "python"
    options = ["--quiet", "--no-deps", "--no-index", "--disable-pip-version-check"]
    run(sys.executable, "-m", "pip", "--python", python, "install", *options, wheel)
    site_packages = only(fresh, "lib/python*/site-packages")
    (site_packages / "libraries.pth").write_text(sysconfig.get_path("purelib") + "\n")
    return fresh / "bin" / "ros2-scaffold"


def test_wheel_contains_the_repository(wheel: Path) -> None:
    names = names_in_wheel(wheel)
    assert {name for name in names if ".dist-info/" not in name} == {
        *tracked("scaffold"),
        *(f"scaffold/_content/{path}" for path in tracked("rules", "templates")),
    }


def test_wheel_has_entry_point_and_license(wheel: Path) -> None:
    information = f"ros2_scaffold-{__version__}.dist-info"
    with zipfile.ZipFile(wheel) as archive:
        entry_points = archive.read(f"{information}/entry_points.txt").decode()
        licence = archive.read(f"{information}/licenses/LICENSE")
    assert "ros2-scaffold = scaffold.__main__:main" in entry_points.splitlines()
    assert licence == (ROOT / "LICENSE").read_bytes()


def test_wheels_from_checkout_and_sdist_have_the_same_files(wheel: Path, tmp_path: Path) -> None:
    run(sys.executable, "-m", "build", "--no-isolation", "--wheel", "--outdir", tmp_path, ROOT)
    assert names_in_wheel(only(tmp_path, "*.whl")) == names_in_wheel(wheel)


def test_sdist_contains_the_repository(built: Path) -> None:
    with tarfile.open(only(built, "*.tar.gz")) as archive:
        names = {name.partition("/")[2] for name in archive.getnames()}
    assert names - {"PKG-INFO"} == tracked()


def test_installed_command_finds_its_rules(command: Path, tmp_path: Path) -> None:
    assert run(command, "--version", cwd=tmp_path) == f"ros2-scaffold {__version__}\n"

    rules = json.loads(run(command, "rules", "--format", "json", cwd=tmp_path))
    checkout = all_rules(registry.load(content.roots("rules")))
    assert [rule["code"] for rule in rules] == [rule.code for rule in checkout]

    program = "from scaffold.configuration import content; print(content.built_in())"
    result = run(command.parent / "python", "-c", program, cwd=tmp_path).strip()
    assert Path(result).is_relative_to(command.parent.parent)


def run(*command: str | Path, cwd: Path = ROOT) -> str:
    """Run a program of any environment; return what it prints."""
    done = subprocess.run(
        command,
        cwd=cwd,
        env=system_environment(),
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def tracked(*directories: str) -> set[str]:
    """Return the files of the repository, those not committed yet included."""
    if not (ROOT / ".git").exists():
        pytest.skip("not a git checkout: nothing tells which files belong to it")
    listed = run(
        "git", "-c", f"safe.directory={ROOT}", "ls-files", "-z", "--cached", "--others",
        "--exclude-standard", "--", *directories,
    )  # fmt: skip
    return {name for name in listed.split("\0") if name and os.path.lexists(ROOT / name)}


def names_in_wheel(wheel: Path) -> set[str]:
    with zipfile.ZipFile(wheel) as archive:
        return set(archive.namelist())


def only(directory: Path, pattern: str) -> Path:
    """Return the one path that matches."""
    (item,) = directory.glob(pattern)
    return item


def test_pre_commit_accepts_the_hook() -> None:
    run(sys.executable, "-m", "pre_commit", "validate-manifest", ROOT / ".pre-commit-hooks.yaml")
    hooks = {hook["id"]: hook for hook in yaml_file.read(str(ROOT / ".pre-commit-hooks.yaml"))}
    assert set(hooks) == {"ros2-scaffold-check", "ros2-scaffold-fix", "ros2-scaffold"}
    assert hooks["ros2-scaffold-check"]["files"] == hooks["ros2-scaffold-fix"]["files"]
    for hook in hooks.values():
        command, verb, *_ = hook["entry"].split()
        assert command == "ros2-scaffold"
        assert verb in VERBS


def test_hooks_run_on_every_file_that_a_rule_reports() -> None:
    hooks = yaml_file.read(str(ROOT / ".pre-commit-hooks.yaml"))
    pattern = re.compile(hooks[0]["files"])
    rules = registry.load(content.roots("rules"))
    examples = [example for rule in rules for example in rule.examples]
    reported = {report.at.split(":")[0] for example in examples for report in example.reports}
    assert {path for path in reported if not pattern.search(path)} == set()


ADVISORIES = {
    "jinja2": ("CVE-2025-27516", "3.1.6"),
    "lxml": ("CVE-2026-41066", "6.1"),
    "pytest": ("CVE-2025-71176", "9.0.3"),
    "setuptools": ("CVE-2025-47273", "78.1.1"),
    "tqdm": ("CVE-2024-34062", "4.66.3"),
}
"""By distribution, an advisory and the first version with the fix."""


def test_every_dependency_has_a_lower_bound_and_a_reason() -> None:
    text = (ROOT / "pyproject.toml").read_text()
    project = tomllib.loads(text)["project"]
    wanted = [*project["dependencies"], *project["optional-dependencies"]["ros"]]
    assert [item for item in wanted if not re.search(r"[>=]=", item)] == []
    lines = {line.strip() for line in text.splitlines()}
    reasons = [re.escape(f'"{item}",') + " +# .+" for item in wanted]
    assert [item for item in reasons if not any(re.fullmatch(item, line) for line in lines)] == []


def test_lower_bounds_include_security_fixes() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    groups = [project["dependencies"], *project["optional-dependencies"].values()]
    seen = set()
    for requirement in [Requirement(item) for group in groups for item in group]:
        name = requirement.name.lower()
        if name in ADVISORIES:
            seen.add(name)
            bounds = [item.version for item in requirement.specifier if item.operator == ">="]
            advisory, fixed = ADVISORIES[name]
            (bound,) = bounds
            assert Version(bound) >= Version(fixed), f"{requirement}: {advisory}"
    assert seen == set(ADVISORIES)
