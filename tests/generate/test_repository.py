"""Extras that belong at the top of a git repository, in real repositories."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest
import yaml

from scaffold.cli.main import main
from scaffold.errors import ConflictError
from scaffold.files.disk import Disk
from scaffold.files.tree import DiskTree
from scaffold.generate import repository
from scaffold.generate.update import provenance, update
from scaffold.generate.update.provenance import NAME
from scaffold.model.discovery import colcon
from scaffold.writing.plan import WritePlan
from tests.generate.test_pre_commit import CONFIG, FINDING, Repository, remove_dependency, variables

__all__ = ["variables"]

PERSON = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.com")
EXTRAS = ("ci", "pre_commit", "devcontainer")
AT_TOP = [
    ".devcontainer/talker/devcontainer.json",
    ".github/workflows/talker.yaml",
    CONFIG,
]


def git(directory: Path, *words: str) -> None:
    identity = ["-c", "user.name=Ada", "-c", "user.email=ada@example.com"]
    allowed = ["-c", "protocol.file.allow=always"]
    command = ["git", "-C", str(directory), *identity, *allowed, *words]
    subprocess.run(command, check=True, capture_output=True)


def new(place: Path, *words: str, name: str = "talker") -> int:
    command = ["new", name, *PERSON, "--destination-directory", str(place)]
    return main([*command, *words])


def add(package: Path, *words: str) -> int:
    return main(["add", *words, "--package-directory", str(package)])


def files(top: Path) -> dict[str, bytes]:
    """Return the files of a repository without those of git."""
    result = [file for file in top.rglob("*") if file.is_file()]
    paths = {str(file.relative_to(top)): file.read_bytes() for file in result}
    return {path: data for path, data in paths.items() if not path.startswith(".git/")}


def write_record(package: Path, record: provenance.Provenance) -> None:
    for name, text in record.files(is_new=False).items():
        (package / name).write_text(text)


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """Return the top of a repository that is a workspace."""
    top = tmp_path / "workspace"
    (top / "src").mkdir(parents=True)
    git(top, "init", "-q")
    return top


def test_new_writes_extras_at_the_top(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert new(workspace / "src", "--extras", *EXTRAS) == 0
    assert sorted(path for path in files(workspace) if not path.startswith("src/")) == AT_TOP
    hidden = [file.name for file in (workspace / "src" / "talker").glob(".*")]
    assert sorted(hidden) == sorted(provenance.PURPOSES)
    assert not (workspace / "src" / "talker" / "CONTRIBUTING.md").exists()
    captured = capsys.readouterr()
    assert ".github/workflows/talker.yaml" in captured.out
    assert captured.err == ""
    assert main(["check", str(workspace)]) == 0
    assert main(["update", str(workspace / "src" / "talker"), "--diff"]) == 0
    assert capsys.readouterr().out.endswith("no findings\n")


@pytest.mark.parametrize("extra", EXTRAS)
def test_add_equals_new(extra: str, tmp_path: Path) -> None:
    made: list[dict[str, bytes]] = []
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        git(tmp_path / name, "init", "-q")
        words = ["--extras", extra] if name == "first" else []
        assert new(tmp_path / name / "src", *words) == 0
        if name == "second":
            assert add(tmp_path / name / "src" / "talker", extra) == 0
        made.append(files(tmp_path / name))
    assert made[0] == made[1]
    assert add(tmp_path / "second" / "src" / "talker", extra) == 0
    assert files(tmp_path / "second") == made[0]


def test_add_to_a_package_not_generated_by_this_tool(workspace: Path) -> None:
    package = workspace / "src" / "talker"
    assert new(workspace / "src") == 0
    (package / NAME).unlink()
    before = files(package)
    assert add(package, "ci") == 0
    assert files(package) == before
    assert (workspace / ".github" / "workflows" / "talker.yaml").is_file()


@pytest.mark.parametrize("kind", ["worktree", "submodule", "repository"])
def test_innermost_repository_is_used(kind: str, workspace: Path, tmp_path: Path) -> None:
    """A worktree and a submodule have a file `.git`, and no directory."""
    inner = workspace / "src" / "inner"
    git(workspace, "commit", "-q", "--allow-empty", "-m", "start")
    if kind == "worktree":
        git(workspace, "worktree", "add", "-q", str(inner))
    elif kind == "submodule":
        other = tmp_path / "other"
        other.mkdir()
        git(other, "init", "-q")
        git(other, "commit", "-q", "--allow-empty", "-m", "start")
        git(workspace, "submodule", "add", "-q", str(other), "src/inner")
    else:
        inner.mkdir()
        git(inner, "init", "-q")
    assert new(inner / "packages", "--extras", "ci") == 0
    assert (inner / ".github" / "workflows" / "talker.yaml").is_file()
    assert not (workspace / ".github").exists()


def test_package_that_is_a_repository_gets_the_extras(tmp_path: Path) -> None:
    assert new(tmp_path) == 0
    git(tmp_path / "talker", "init", "-q")
    assert add(tmp_path / "talker", "ci") == 0
    assert (tmp_path / "talker" / ".github" / "workflows" / "ci.yaml").is_file()


def test_missing_repository_is_noted(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / ".git").mkdir()  # neither a repository nor a link to one
    assert new(tmp_path, "--extras", "ci") == 0
    assert (tmp_path / "talker" / ".github" / "workflows" / "ci.yaml").is_file()
    assert capsys.readouterr().err == (
        "note: .github/workflows/ci.yaml is read only at the top of a git repository, and "
        f"{tmp_path}/talker is not in one; run `git init {tmp_path}/talker`\n"
    )


def test_each_package_has_its_own_workflow_and_container(workspace: Path) -> None:
    for name in ("talker", "listener"):
        assert new(workspace / "src", "--extras", "ci", "devcontainer", name=name) == 0
    workflows = workspace / ".github" / "workflows"
    assert sorted(file.name for file in workflows.iterdir()) == ["listener.yaml", "talker.yaml"]
    containers = workspace / ".devcontainer"
    assert sorted(file.name for file in containers.iterdir()) == ["listener", "talker"]


def test_paths_in_the_workflow_exist(workspace: Path, tmp_path: Path) -> None:
    """The commands run above the checkout, where colcon finds every package below `src`."""
    assert new(workspace / "src", "--extras", "ci") == 0
    path = workspace / ".github" / "workflows" / "talker.yaml"
    steps: Any = yaml.safe_load(path.read_text())["jobs"]["test"]["steps"]
    checkout = tmp_path / "job" / steps[0]["with"]["path"]
    checkout.parent.mkdir(parents=True)
    git(workspace, "add", "-A")
    git(workspace, "commit", "-q", "-m", "work")
    git(tmp_path, "clone", "-q", str(workspace), str(checkout))
    result = colcon.package_directories(Disk(), str(tmp_path / "job"))
    assert result == [str(checkout / "src" / "talker")]
    assert "$(colcon list --packages-up-to talker --paths-only)" in steps[1]["run"]
    assert "colcon build --packages-up-to talker" in steps[2]["run"]
    assert "colcon test --packages-select talker" in steps[3]["run"]


def test_pre_commit_checks_the_package_directory(
    workspace: Path, variables: dict[str, str]
) -> None:
    assert new(workspace / "src", "--extras", "pre_commit") == 0
    shared = Repository(workspace, variables)
    shared.run("pre-commit", "install")
    assert "Passed" in shared.commit()
    (workspace / "other.py").write_text("import nothing\n")
    assert "Skipped" in shared.commit()
    remove_dependency(workspace / "src" / "talker")
    assert f"src/talker/talker/minimal_publisher.py:35:1: error PX020 {FINDING}" in (
        shared.commit(code=1)
    )


OF_A_TEAM = """\
repos:
  # ours
  - repo: local
    hooks:
      - {id: none, name: none, entry: "true", language: system}
"""


@pytest.mark.parametrize("verb", ["new", "add"])
def test_existing_pre_commit_configuration_is_kept(
    verb: str,
    workspace: Path,
    variables: dict[str, str],
    capsys: pytest.CaptureFixture[str],
) -> None:
    path, package = workspace / CONFIG, workspace / "src" / "talker"
    path.write_text(OF_A_TEAM)
    if verb == "new":
        assert new(workspace / "src", "--extras", "pre_commit", "ci") == 1
        assert (workspace / ".github" / "workflows" / "talker.yaml").is_file()
    else:
        assert new(workspace / "src") == 0
        assert add(package, "pre_commit") == 1
    assert (package / "package.xml").is_file()
    assert path.read_text() == OF_A_TEAM
    errors = capsys.readouterr().err
    _, _, line = errors.partition(f"{CONFIG}: add to `repos`: ")
    entry = line.splitlines()[0]
    assert add(package, "pre_commit", "--force") == 1
    assert path.read_text() == OF_A_TEAM
    path.write_text(f"{OF_A_TEAM}  {entry}\n")
    assert add(package, "pre_commit") == 0
    assert path.read_text() == f"{OF_A_TEAM}  {entry}\n"
    shared = Repository(workspace, variables)
    shared.run("pre-commit", "install")
    assert shared.commit().count("Passed") == 2
    remove_dependency(package)
    assert FINDING in shared.commit(code=1)


@pytest.mark.parametrize(
    "there",
    [
        "repos:\n- repo: https://x\n  rev: a\n  hooks:\n  - id: ros2-scaffold\n",
        "repos:\n- repo: https://x\n  rev: a\n  hooks:\n  - id: ros2-scaffold-fix\n",
        "repos:\n- repo: local\n  hooks:\n  - {id: ros2-scaffold, entry: ros2-scaffold check}\n",
    ],
    ids=["our repository", "our other hook", "all packages"],
)
def test_existing_hook_needs_no_note(there: str, workspace: Path) -> None:
    (workspace / CONFIG).write_text(there)
    assert new(workspace / "src", "--extras", "pre_commit") == 0
    assert (workspace / CONFIG).read_text() == there


@pytest.mark.parametrize("there", ["", "- \x00", "a: *b", "[" * 5000, "repos: 1", "repos: [x]"])
def test_invalid_pre_commit_configuration_is_kept(there: str, workspace: Path) -> None:
    (workspace / CONFIG).write_text(there)
    assert new(workspace / "src", "--extras", "pre_commit") == 1
    assert (workspace / CONFIG).read_text() == there


@pytest.mark.parametrize("verb", ["new", "add"])
def test_existing_workflow_is_not_overwritten(
    verb: str, workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = workspace / ".github" / "workflows" / "talker.yaml"
    path.parent.mkdir(parents=True)
    path.write_text("mine\n")
    if verb == "add":
        assert new(workspace / "src") == 0
    before = files(workspace)
    package = workspace / "src" / "talker"

    def run(*words: str) -> int:
        if verb == "new":
            return new(workspace / "src", "--extras", "ci", *words)
        return add(package, "ci", *words)

    assert run() == 2
    assert files(workspace) == before
    assert f".github/workflows/talker.yaml in {workspace} already exists" in capsys.readouterr().err
    assert run("--force") == 0
    assert "colcon" in path.read_text()


def test_files_at_the_top_are_restored_when_the_package_fails(
    workspace: Path,
) -> None:
    (workspace / "old").write_text("old\n")
    first = WritePlan.of(workspace, {".github/workflows/x.yaml": "x\n", "old": "new\n"})
    package = WritePlan.of(workspace / "src" / "talker", {"a": "a\n"})
    (workspace / "src" / "talker").mkdir()
    (workspace / "src" / "talker" / "a").write_text("mine\n")
    with pytest.raises(ConflictError, match="was created in the meantime"):
        package.write(force=True, around=first)
    assert files(workspace) == {"old": b"old\n", "src/talker/a": b"mine\n"}
    assert not (workspace / ".github").exists()


def test_nothing_is_written_outside_of_the_repository(workspace: Path, tmp_path: Path) -> None:
    outside = tmp_path / "outside"
    outside.mkdir()
    (outside / "secret").write_text("secret\n")
    (workspace / ".github").symlink_to(outside)
    assert new(workspace / "src", "--extras", "ci") == 2
    assert files(workspace) == {}
    assert files(outside) == {"secret": b"secret\n"}
    place = repository.place_of(str(workspace))
    assert repository.read(place, ".github/secret") is None
    assert repository.read(place, "../outside/secret") is None


def test_git_is_not_run(workspace: Path, tmp_path: Path) -> None:
    """Git would run programs named in the configuration of the repository."""
    witness = tmp_path / "witness"
    git(workspace, "config", "core.fsmonitor", f"touch {witness}; false")
    git(workspace, "config", "core.hooksPath", str(tmp_path))
    assert new(workspace / "src", "--extras", "ci") == 0
    assert add(workspace / "src" / "talker", "devcontainer") == 0
    assert main(["update", str(workspace / "src" / "talker")]) == 0
    assert not witness.exists()


def test_update_merges_at_the_top(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert new(workspace / "src", "--extras", "ci") == 0
    record = workspace / "src" / "talker" / NAME
    path = workspace / ".github" / "workflows" / "talker.yaml"
    text = path.read_text()
    old = update.read(DiskTree(record.parent), "talker")
    before = text.replace("ubuntu-24.04", "ubuntu-22.04")
    rendered = {**old.rendered, ":/.github/workflows/talker.yaml": before}
    write_record(record.parent, old.with_files(old.answers, rendered))
    path.write_text(f"# mine\n{before}")
    capsys.readouterr()
    assert main(["update", str(workspace / "src" / "talker")]) == 0
    assert capsys.readouterr().out == ":/.github/workflows/talker.yaml: merged\n"
    assert path.read_text() == f"# mine\n{text}"


def test_update_merges_in_a_package_that_is_a_repository(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert new(tmp_path, "--extras", "ci") == 0
    git(tmp_path / "talker", "init", "-q")
    name = ".github/workflows/ci.yaml"
    record, path = tmp_path / "talker" / NAME, tmp_path / "talker" / name
    text = path.read_text()
    old = update.read(DiskTree(record.parent), "talker")
    before = text.replace("ubuntu-24.04", "ubuntu-22.04")
    write_record(record.parent, old.with_files(old.answers, {**old.rendered, name: before}))
    path.write_text(f"# mine\n{before}")
    capsys.readouterr()
    assert main(["update", str(tmp_path / "talker")]) == 0
    assert capsys.readouterr().out == f"{name}: merged\n"
    assert path.read_text() == f"# mine\n{text}"


def test_update_moves_extras_to_the_top_of_a_later_repository(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert new(tmp_path / "src", "--extras", "ci") == 0
    git(tmp_path, "init", "-q")
    assert main(["update", str(tmp_path / "src" / "talker")]) == 0
    assert (tmp_path / ".github" / "workflows" / "talker.yaml").is_file()
    errors = capsys.readouterr().err
    assert "note: .github/workflows/ci.yaml is no longer in the templates; remove it" in errors


def test_record_cannot_name_files_outside_of_the_repository(
    workspace: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "secret").write_text("secret\n")
    assert new(workspace / "src", "--extras", "ci") == 0
    record = workspace / "src" / "talker" / NAME
    old = update.read(DiskTree(record.parent), "talker")
    names = [":/../secret", f":/{tmp_path}/secret", "../../../secret", ":/\0", ":/"]
    rendered = {**old.rendered, **dict.fromkeys(names, "x\n")}
    write_record(record.parent, old.with_files(old.answers, rendered))
    capsys.readouterr()
    assert main(["update", str(workspace / "src" / "talker")]) == 0
    assert "secret" not in capsys.readouterr().err
    assert (tmp_path / "secret").read_text() == "secret\n"
    assert json.loads(record.read_text())["answers"]["package"] == "talker"
