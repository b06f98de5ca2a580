"""``check --since`` reports findings in changed files and those that it causes elsewhere."""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

from scaffold.cli.main import main

OLD = "import os\n"


def git(*words: str) -> None:
    identity = ("-c", "user.name=Ada", "-c", "user.email=ada@example.org")
    subprocess.run(["git", *identity, *words], check=True, capture_output=True)


@pytest.fixture(scope="module")
def generated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a directory with three generated packages; the second one depends on the first."""
    top = tmp_path_factory.mktemp("generated")
    for name in ("first", "second", "third"):
        assert main(["new", name, "--destination-directory", str(top)]) == 0
        (top / name / name / "old.py").write_text(OLD)
    manifest = top / "second" / "package.xml"
    dependency = "  <exec_depend>first</exec_depend>\n  <test_depend"
    manifest.write_text(manifest.read_text().replace("  <test_depend", dependency, 1))
    return top


@pytest.fixture
def workspace(
    own_cache: Path, generated: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Path:
    """Return the current directory: a repository with one commit, and old findings."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    top = tmp_path / "workspace"
    shutil.copytree(generated, top)
    monkeypatch.chdir(top)
    git("init", "--quiet")
    git("add", ".")
    git("commit", "--quiet", "-m", "all")
    return top


def check(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, list[str]]:
    capsys.readouterr()
    code = main(["check", "--since", *words])
    captured = capsys.readouterr()
    assert captured.err == ""
    return code, captured.out.splitlines()


@pytest.mark.usefixtures("workspace")
def test_no_findings_without_a_change(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check"]) == 1
    assert check(capsys, "HEAD") == (
        0,
        [
            "since HEAD: 0 changed files; 0 older findings in other files hidden",
            "0 packages, 0 files for Jazzy: no findings",
        ],
    )


def test_changed_and_new_files_are_reported(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    new = workspace / "third" / "third" / "new.py"
    new.write_text("import sys\n")
    (workspace / ".gitignore").write_text("ignored.py\n")
    (workspace / "third" / "third" / "ignored.py").write_text("import sys\n")
    for words, revision in (
        ((), "HEAD"),
        (("add", "."), "HEAD"),
        (("commit", "-m", "b"), "HEAD~1"),
    ):
        if words:
            git(*words)
        code, (*findings, note, summary) = check(capsys, revision, "--select", "F", "--include-all")
        assert (code, len(findings)) == (1, 1)
        assert findings[0].startswith("third/third/new.py:1:1: ")
        assert note.endswith(
            ": 2 changed files; 1 older finding in other files hidden, 1 in files that git ignores"
        )
        assert summary.startswith("1 package, 15 files for Jazzy: ")
    (workspace / "third" / "third" / "old.py").write_text(f"{OLD}import re\n")
    code, lines = check(capsys, "HEAD", "--select", "F")
    assert [line.split(": ")[0] for line in lines[:-2]] == [
        "third/third/old.py:1:1",
        "third/third/old.py:2:1",
        "excluded by default",
    ], "a changed file is reported whole"


def test_findings_in_other_files_caused_by_a_change_are_reported(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    dependency = "  <exec_depend>second</exec_depend>\n  <test_depend"
    manifest = workspace / "first" / "package.xml"
    manifest.write_text(manifest.read_text().replace("  <test_depend", dependency, 1))
    code, lines = check(capsys, "HEAD")
    assert code == 1
    assert any(line.startswith("second/package.xml:") for line in lines), "a cycle"
    assert not any("old.py" in line or line.startswith("third/") for line in lines)
    assert lines[-1].startswith("2 packages, ")


def test_added_and_removed_packages(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.copytree(workspace / "third", workspace / "fourth")
    shutil.rmtree(workspace / "first")
    lines = check(capsys, "HEAD")[1]
    assert any(line.startswith("fourth/third/old.py:1:1") for line in lines)
    assert lines[-1].startswith("2 packages, "), "the new one, and what depends on the removed one"


def test_since_and_baseline_can_be_combined(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (workspace / "third" / "third" / "old.py").write_text("import os\n\n")
    main(["check", "--write-baseline", "base.json"])
    (workspace / "third" / "third" / "old.py").write_text("import re\nimport os\n\n")
    lines = check(capsys, "HEAD", "--select", "F", "--baseline", "base.json")[1]
    assert [line.split(": ")[0] for line in lines[:-3]] == ["third/third/old.py:1:1"]


@pytest.mark.usefixtures("workspace")
@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--since", "nowhere"], "--since nowhere: no such commit in the repository"),
        (["--since=--all"], "--since --all: no such commit in the repository"),
        (["--since", "HEAD:first"], "--since HEAD:first: no such commit in the repository"),
        (["--since", "HEAD", "--fix"], "--since only reports: omit --fix"),
        (["--since", "HEAD", "--write-baseline", "a"], "omit --write-baseline"),
    ],
)
def test_invalid_revisions_are_one_error_line(
    capsys: pytest.CaptureFixture[str], words: list[str], message: str
) -> None:
    capsys.readouterr()
    assert main(["check", *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert message in line


def test_since_without_git_is_an_error(
    workspace: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.rmtree(workspace / ".git")
    assert main(["check", "--since", "HEAD"]) == 2
    assert f"{workspace} is not in a git repository of this user\n" in capsys.readouterr().err
    monkeypatch.setenv("PATH", str(workspace))
    assert main(["check", "--since", "HEAD"]) == 2
    assert "--since HEAD: git is not installed\n" in capsys.readouterr().err
