"""The installation commands in messages: always from the source of this tool."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import venv
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = "from scaffold.programs import installation; print(installation.command('ros'))"
CLONE = "pipx install --force '.[ros]' (in a clone of its repository)"


def advice(directory: Path, place: str, origin: object) -> str:
    """Return the advised command for an installation directory and its installer's metadata."""
    venv.create(directory / place, symlinks=True)
    noted = directory / "noted" / "ros2_scaffold-0.1.0.dist-info"
    noted.mkdir(parents=True)
    (noted / "METADATA").write_text("Metadata-Version: 2.1\nName: ros2-scaffold\nVersion: 0.1.0\n")
    if origin is not None:
        (noted / "direct_url.json").write_text(json.dumps(origin))
    done = subprocess.run(
        [directory / place / "bin" / "python", "-c", PROGRAM],
        env={"PYTHONPATH": f"{noted.parent}:{ROOT}"},
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.strip()


@pytest.mark.parametrize(
    ("place", "installer"),
    [
        ("pipx/venvs/ros2-scaffold", "pipx install --force"),
        ("uv/tools/ros2-scaffold", "uv tool install --force"),
        ("environment", "/bin/python -m pip install"),
    ],
)
def test_command_uses_the_same_installer(place: str, installer: str, tmp_path: Path) -> None:
    command = advice(tmp_path, place, {"url": ROOT.as_uri(), "dir_info": {}})
    before, _, source = command.rpartition(" ")
    assert before.endswith(installer)
    assert shlex.split(source) == [f"{ROOT}[ros]"]


def test_editable_installation_stays_editable(tmp_path: Path) -> None:
    origin = {"url": ROOT.as_uri(), "dir_info": {"editable": True}}
    assert shlex.split(advice(tmp_path, "pipx/x", origin))[-2:] == ["--editable", f"{ROOT}[ros]"]


def test_installation_from_a_repository_names_its_url(tmp_path: Path) -> None:
    origin = {"url": "https://git.example.com/tool.git", "vcs_info": {"vcs": "git"}}
    assert shlex.split(advice(tmp_path, "pipx/x", origin))[-1] == (
        "ros2-scaffold[ros] @ git+https://git.example.com/tool.git"
    )


@pytest.mark.parametrize(
    "origin",
    [None, {}, [], {"url": "file:///no/such/directory"}, {"url": "file:///dist/tool.whl"}],
)
def test_unknown_origin_advises_a_clone(origin: object, tmp_path: Path) -> None:
    assert advice(tmp_path, "pipx/x", origin) == CLONE


def test_no_message_installs_from_a_package_index() -> None:
    files = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / ".pre-commit-hooks.yaml"]
    for directory in ("scaffold", "templates", "docs", "rules", "changelog.d"):
        files += (file for file in (ROOT / directory).rglob("*") if file.is_file())
    index = re.compile(
        r"(pip|pipx|uv tool) install[^\n`]*\bros2[-_]scaffold\b(?!.* @ )"
        r"|additional_dependencies: \[ros2[-_]scaffold"
    )
    named = [
        f"{file.relative_to(ROOT)}: {match[0]}"
        for file in files
        if file.suffix not in {".pyc", ".bin"}
        for match in index.finditer(file.read_text(errors="replace"))
    ]
    assert named == []
