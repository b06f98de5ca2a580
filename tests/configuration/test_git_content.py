"""``--content URL@REV``: templates of a team in a remote git repository."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.configuration import git_content

BOARD = """\
summary: The board that the robot runs on
questions:
  board: { default: pi, help: name of the board }
examples:
  plain: { package: robot_board, board: nano }
"""


class Repository:
    """A repository of templates to fetch from."""

    def __init__(self, directory: Path) -> None:
        self.directory = directory
        self.url = f"file://{directory}"
        self.extra = directory / "templates" / "extras" / "board"
        self.extra.mkdir(parents=True)
        (self.extra / "template.yaml").write_text(BOARD)
        self.git("init", "--quiet", "--initial-branch", "main")

    def git(self, *words: str) -> None:
        identity = ("-c", "user.name=Ada", "-c", "user.email=ada@example.org")
        subprocess.run(["git", "-C", str(self.directory), *identity, *words], check=True)

    def release(self, tag: str, text: str) -> None:
        """Commit a version of the template and tag it."""
        (self.extra / "BOARD.md.jinja").write_text(f"{{{{ board }}}}: {text}\n")
        self.git("add", ".")
        self.git("commit", "--quiet", "-m", tag)
        self.git("tag", tag)


@pytest.fixture
def team(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Repository:
    """Return a trusted repository; the current directory is empty."""
    for name in ("HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    repository = Repository(tmp_path / "team")
    repository.release("v1", "one")
    git_content.resolve.cache_clear()
    assert main(["trust", repository.url]) == 0
    return repository


def new(content: str, *more: str) -> int:
    """Make a package with the extra of the team."""
    git_content.resolve.cache_clear()
    maintainer = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.org")
    return main(["new", "rover", "--extras", "board", "--content", content, *maintainer, *more])


def update(*words: str) -> int:
    git_content.resolve.cache_clear()
    return main(["update", "rover", *words])


def board_file() -> str:
    return Path("rover/BOARD.md").read_text()


def test_package_is_created_and_updated_from_a_revision(team: Repository) -> None:
    assert new(f"{team.url}@v1", "--board", "nano") == 0
    assert board_file() == "nano: one\n"
    team.release("v2", "two")
    assert update() == 0
    assert board_file() == "nano: one\n", "a tag stays"
    assert update("--content", f"{team.url}@v2") == 0
    assert board_file() == "nano: two\n"
    team.release("v3", "three")
    assert update("--content", f"{team.url}@main") == 0
    team.release("v4", "four")
    assert update() == 0
    assert board_file() == "nano: four\n", "a branch moves"


def test_record_has_url_revision_and_commit(team: Repository) -> None:
    assert new(f"{team.url}@v1") == 0
    (source, _) = json.loads(Path("rover/.ros2-scaffold.json").read_text())["content"]
    head = subprocess.check_output(["git", "-C", str(team.directory), "rev-parse", "v1"], text=True)
    assert source == {"url": team.url, "revision": "v1", "commit": head.strip()}


def test_add_uses_the_recorded_revision(team: Repository) -> None:
    assert new(f"{team.url}@v1") == 0
    git_content.resolve.cache_clear()
    assert main(["add", "timer", "clock", "--package-directory", "rover"]) == 0
    entries = json.loads(Path("rover/.ros2-scaffold.json").read_text())
    assert [item["url"] for item in entries["content"] if item] == [team.url]
    assert update() == 0


def test_repository_is_not_fetched_before_it_is_trusted(
    team: Repository, capsys: pytest.CaptureFixture[str]
) -> None:
    assert new(f"{team.url}@v1") == 0
    assert main(["trust", "--remove", team.url]) == 0
    shutil.rmtree("rover/.git", ignore_errors=True)
    capsys.readouterr()
    assert update() == 2, "the record of a package names no code"
    assert f"ros2-scaffold trust {team.url}" in capsys.readouterr().err
    shutil.rmtree("rover")
    assert new(f"{team.url}@v1") == 2
    assert not Path("rover").exists()


def test_tags_and_commits_are_cached(team: Repository, capsys: pytest.CaptureFixture[str]) -> None:
    assert new(f"{team.url}@v1") == 0
    commit = json.loads(Path("rover/.ros2-scaffold.json").read_text())["content"][0]["commit"]
    team.directory.rename(team.directory.with_name("gone"))
    for revision in ("v1", commit, commit[:10]):
        shutil.rmtree("rover")
        assert new(f"{team.url}@{revision}") == 0
    shutil.rmtree("rover")
    capsys.readouterr()
    assert new(f"{team.url}@main") == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "cannot be fetched" in line
    assert "tags and commits that were fetched before" in line


@pytest.mark.parametrize(
    ("revision", "message"),
    [
        ("", "add a tag, a branch or a commit"),
        ("@v9", "has no tag, branch or commit 'v9'; it has main, v1"),
        ("@../x", "is not the name of a tag"),
        ("@HEAD~1", "is not the name of a tag"),
        ("@deadbeef", "has no tag, branch or commit 'deadbeef'"),
    ],
)
def test_unknown_revision_is_one_error_line(
    team: Repository, capsys: pytest.CaptureFixture[str], revision: str, message: str
) -> None:
    capsys.readouterr()
    assert new(f"{team.url}{revision}") == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert message in line
    assert not Path("rover").exists()


@pytest.mark.parametrize("url", ["ext::sh -c touch%ran", "http://localhost:9/x.git", "git://x/y"])
def test_unsafe_git_transports_are_rejected(
    team: Repository, capsys: pytest.CaptureFixture[str], url: str
) -> None:
    del team
    main(["trust", url])
    capsys.readouterr()
    assert new(f"{url}@v1") == 2
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert not Path("ran").exists()


@pytest.mark.parametrize(
    ("text", "url", "name"),
    [
        ("https://ada@host.org/x.git@v1.2", "https://ada@host.org/x.git", "v1.2"),
        ("git@host.org:team/x.git@main", "git@host.org:team/x.git", "main"),
        ("ssh://git@host.org/x@feature/a", "ssh://git@host.org/x", "feature/a"),
    ],
)
def test_revision_follows_the_last_at_sign(text: str, url: str, name: str) -> None:
    assert git_content.split(text) == (url, name)


def test_symlinks_out_of_the_repository_are_not_followed(team: Repository, tmp_path: Path) -> None:
    (tmp_path / "secret").write_text("secret\n")
    (team.extra / "SECRET.md.jinja").symlink_to(tmp_path / "secret")
    team.release("v2", "two")
    assert new(f"{team.url}@v2") == 0
    assert not Path("rover/SECRET.md").exists()


def test_trusted_configuration_may_use_a_git_url(
    team: Repository, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("ros2-scaffold.toml").write_text(f'content = ["{team.url}@v1"]\n')
    assert main(["templates", "list"]) == 0
    assert "'content' ignored" in capsys.readouterr().err
    assert main(["trust", "."]) == 0
    assert main(["templates", "list"]) == 0
    assert "The board that the robot runs on" in capsys.readouterr().out


def test_templates_test_accepts_a_git_url(
    team: Repository, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["templates", "test", f"{team.url}@v1"]) == 0
    assert "board: plain, ament_cmake: ok" in capsys.readouterr().out
