"""Files with merge conflicts: reported as such, not as syntax errors."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from scaffold.cli.main import main

GIT = ("git", "-c", "user.name=A", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false")
LINES = {
    "talker/minimal_publisher.py": ("import rclpy", "import rclpy  # {}"),
    "package.xml": ("<license>Apache-2.0<", "<license>MIT-{}<"),
    "CMakeLists.txt": ("ament_package()", "ament_package()  # {}"),
    "config/talker.yaml": ("    rate: 2.0", "    rate: {}.5"),
    "launch/talker.launch.xml": ("  <group/>", "  <arg name='a' default='{}'/>"),
}


def git(directory: Path, *words: str) -> int:
    done = subprocess.run([*GIT, *words], cwd=directory, check=False, capture_output=True)
    return done.returncode


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a package in its own repository."""
    monkeypatch.chdir(tmp_path)
    assert main(["new", "talker", "--topic", "chatter"]) == 0
    package = tmp_path / "talker"
    (package / "config").mkdir()
    (package / "config/talker.yaml").write_text(
        "minimal_publisher:\n  ros__parameters:\n    rate: 2.0\n"
    )
    (package / "launch").mkdir()
    (package / "launch/talker.launch.xml").write_text("<launch>\n  <group/>\n</launch>\n")
    git(package, "init", "-q", "-b", "main")
    git(package, "add", "-A")
    assert git(package, "commit", "-qm", "Start") == 0
    return package


def conflict(package: Path, path: str) -> int:
    """Change a line on two branches and merge them; return the line of the conflict."""
    before, after = LINES[path]
    text = (package / path).read_text()
    assert before in text
    for branch, value in (("other", 1), ("main", 2)):
        git(package, "checkout", "-qB", branch, "HEAD" if branch == "other" else "main")
        (package / path).write_text(text.replace(before, after.format(value), 1))
        assert git(package, "commit", "-qam", branch) == 0
    assert git(package, "merge", "other") == 1
    return (package / path).read_text().split("\n").index("<<<<<<< HEAD") + 1


@pytest.mark.parametrize("path", LINES)
def test_conflict_is_reported_once(
    package: Path, path: str, capsys: pytest.CaptureFixture[str]
) -> None:
    line = conflict(package, path)
    capsys.readouterr()
    assert main(["check", "--format", "json", "talker"]) == 1
    findings = json.loads(capsys.readouterr().out)["diagnostics"]
    here = [item for item in findings if item["path"].endswith(path)]
    assert [item["message"] for item in here] == [
        f"merge conflict marks at line {line}: resolve the conflict"
    ]
    assert [item["severity"] for item in here] == ["error"]


def test_underlined_headings_are_no_conflict(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    node = package / "talker/minimal_publisher.py"
    node.write_text(f"{node.read_text()}\n=======\n>>>>>>>\n")
    capsys.readouterr()
    assert main(["check", "talker"]) == 1
    out = capsys.readouterr().out
    assert "E999" in out
    assert "conflict" not in out


def test_update_rejects_a_file_with_a_conflict(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line = conflict(package, "CMakeLists.txt")
    before = (package / "CMakeLists.txt").read_bytes()
    capsys.readouterr()
    assert main(["update", "talker"]) == 2
    assert capsys.readouterr().err == (
        "ros2-scaffold: error: talker/CMakeLists.txt: has conflict markers on line "
        f"{line}; resolve the conflict first; nothing was changed\n"
    )
    assert (package / "CMakeLists.txt").read_bytes() == before
