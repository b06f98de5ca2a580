"""A package is updated to the current templates, and keeps what its owner wrote."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path

import pytest

from scaffold import __version__
from scaffold.cli.main import main
from scaffold.configuration import content
from scaffold.errors import InputError
from scaffold.files.tree import DiskTree
from scaffold.generate.update import merge, provenance, update
from scaffold.programs import installation

TEMPLATES = Path(content.roots("templates")[0])
NODE = "talker/minimal_publisher.py"


@pytest.fixture(autouse=True)
def _isolated_directories(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Isolate a test from the user's settings, in a directory of its own."""
    for name in ("HOME", "XDG_CONFIG_HOME"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def package(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    """Make a package with the old templates."""
    command = ["new", "talker", "--maintainer-name", "Ada", "--maintainer-email", "ada@example.com"]
    assert main(command) == 0
    capsys.readouterr()
    return tmp_path / "talker"


@pytest.fixture
def team(tmp_path: Path) -> Path:
    """Return a copy of the templates, for a test to change."""
    for name in ("nodes/publisher", "package", "build_types/ament_cmake"):
        shutil.copytree(TEMPLATES / name, tmp_path / "team" / "templates" / name)
    return tmp_path / "team"


def change(team: Path, pattern: str, old: str, new: str) -> None:
    """Replace text in the only template file of a name."""
    (path,) = (team / "templates").rglob(pattern)
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def node_of(team: Path) -> str:
    """Return the name of the publisher's template."""
    (path,) = (team / "templates" / "nodes" / "publisher" / "{{ package }}").iterdir()
    return path.name


def test_new_records_answers_and_files(package: Path) -> None:
    text = (package / provenance.NAME).read_text()
    result = update.read(DiskTree(str(package)), "here")
    assert "Answers and hashes of the files" in text.split("\n")[1]
    assert result.answers["maintainer_name"] == "Ada"
    assert result.answers["add"][0]["rate"] == 2.0
    assert result.date.isoformat() == "2023-11-14"
    for path, written in result.rendered.items():
        assert (package / path).read_text() == written


def test_up_to_date_package_is_unchanged(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = {path: path.read_bytes() for path in package.rglob("*") if path.is_file()}
    assert main(["update", "talker"]) == 0
    assert capsys.readouterr().out == "The package is up to date with the templates.\n"
    assert {path: path.read_bytes() for path in package.rglob("*") if path.is_file()} == before


def test_template_and_user_changes_are_merged(
    package: Path, team: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    node = package / NODE
    node.write_text(node.read_text().replace("Log the next message", "Log and count the message"))
    change(team, node_of(team), "Declare the parameters, then", "Declare what can change, and")
    (team / "templates" / "package" / "NOTES.md.jinja").write_text("# {{ package }}\n")
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1800000000")
    assert main(["update", "talker", "--content", str(team)]) == 0
    assert capsys.readouterr().out == f"NOTES.md: new\n{NODE}: merged\n"
    merged = node.read_text()
    assert "Log and count the message" in merged
    assert "Declare what can change, and" in merged
    assert "# Copyright 2023 Ada\n" in merged
    assert os.access(node, os.X_OK)
    assert (package / "NOTES.md").read_text() == "# talker\n"
    assert main(["update", "talker", "--content", str(team)]) == 0
    assert capsys.readouterr().out == "The package is up to date with the templates.\n"


def test_conflict_is_marked_and_reported(
    package: Path, team: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    node = package / NODE
    node.write_text(node.read_text().replace("Log the next message", "Log and count the message"))
    change(team, node_of(team), "Log the next message", "Tell the next message")
    assert main(["update", "talker", "--content", str(team)]) == 1
    output = capsys.readouterr().out
    assert output.startswith(f"{NODE}: merged, 1 conflict to resolve\n")
    lines = [line.strip() for line in node.read_text().split("\n")]
    start = lines.index("<<<<<<< yours")
    assert lines[start : start + 7] == [
        "<<<<<<< yours",
        '"""Log and count the message and publish it."""',
        "||||||| template before",
        '"""Log the next message and publish it."""',
        "=======",
        '"""Tell the next message and publish it."""',
        ">>>>>>> template now",
    ]
    marked = node.read_text()
    assert main(["update", "talker", "--content", str(team)]) == 2
    assert "has conflict markers from an earlier update" in capsys.readouterr().err
    assert node.read_text() == marked


def test_missing_user_template_is_an_error(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    record = package / provenance.NAME
    record.write_text(record.read_text().replace('"publisher"', '"beacon"'))
    for command in (["update", "talker"], ["add", "timer", "x", "--package-directory", "talker"]):
        assert main(command) == 2
        assert capsys.readouterr().err == (
            "ros2-scaffold: error: talker/.ros2-scaffold.json: created with the template 'beacon', "
            "which does not exist here; use --content with the directory, or the URL@REV, of its "
            "templates\n"
        )


@pytest.mark.parametrize("flag", ["--dry-run", "--diff"])
def test_dry_run_and_diff_change_nothing(
    package: Path, team: Path, flag: str, capsys: pytest.CaptureFixture[str]
) -> None:
    change(team, node_of(team), "Log the next message", "Tell the next message")
    before = {path: path.read_bytes() for path in package.rglob("*") if path.is_file()}
    assert main(["update", "talker", "--content", str(team), flag]) == 0
    output = capsys.readouterr().out
    assert f"{NODE}: merged\n" in output or f"+++ b/talker/{NODE}\n" in output
    assert {path: path.read_bytes() for path in package.rglob("*") if path.is_file()} == before


def test_removed_file_is_not_restored(
    package: Path, team: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / "README.md").unlink()
    change(team, "README.md.jinja", "## Prerequisites", "## What it needs")
    assert main(["update", "talker", "--content", str(team)]) == 0
    assert not (package / "README.md").exists()
    note = "note: README.md changed in the templates, but you removed it\n"
    assert capsys.readouterr().err == note


def test_file_dropped_from_the_templates_is_kept(
    package: Path, team: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (team / "templates" / "package" / "CHANGELOG.rst.jinja").unlink()
    assert main(["update", "talker", "--content", str(team)]) == 0
    assert (package / "CHANGELOG.rst").exists()
    assert "CHANGELOG.rst is no longer in the templates" in capsys.readouterr().err


def test_removed_and_added_questions(
    package: Path, team: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = team / "templates" / "package" / "template.yaml"
    path.write_text(
        path.read_text().replace("  comments:", "  colour: { default: red, help: x }\n  comments:")
    )
    (team / "templates" / "package" / "COLOUR.jinja").write_text("{{ colour }}\n")
    assert main(["update", "talker", "--content", str(team)]) == 0
    assert (package / "COLOUR").read_text() == "red\n"
    capsys.readouterr()
    assert main(["update", "talker"]) == 0
    assert "note: the templates no longer ask for colour\n" in capsys.readouterr().err


def test_windows_line_endings_are_kept(package: Path, team: Path) -> None:
    node = package / NODE
    node.write_bytes(node.read_bytes().replace(b"\n", b"\r\n"))
    change(team, node_of(team), "Log the next message", "Tell the next message")
    assert main(["update", "talker", "--content", str(team)]) == 0
    merged = node.read_bytes()
    assert b"Tell the next message" in merged
    assert merged.count(b"\r\n") == merged.count(b"\n")


def test_package_without_a_record_is_an_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "other").mkdir()
    assert main(["update", "other"]) == 2
    assert "other/.ros2-scaffold.json is missing" in capsys.readouterr().err
    assert main(["update", "nowhere"]) == 2
    assert "nowhere: no such directory" in capsys.readouterr().err


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[",
        "[]",
        "{}",
        '{"version": "0.1", "date": "2026-01-01", "answers": {}, "rendered": "!!"}',
        '{"version": "0.1", "date": "2026-01-01", "answers": {}, "rendered": "eJwDAAAAAAE="}',
        '{"version": "0.1", "date": "yesterday", "answers": {}, "rendered": "eJyrrgUAAXUA+Q=="}',
        '{"version": "0.1", "date": "2026-01-01", "answers": 7, "rendered": "eJyrrgUAAXUA+Q=="}',
    ],
)
def test_damaged_records(text: str) -> None:
    with pytest.raises(InputError, match=r"^here: damaged: "):
        provenance.parse(text, "here")


@pytest.mark.parametrize("answers", [{}, {"add": 5}, {"add": None}, {"add": [{}]}])
def test_invalid_answers_in_the_record_are_an_error(
    package: Path, answers: dict[str, object], capsys: pytest.CaptureFixture[str]
) -> None:
    path = package / provenance.NAME
    entries = json.loads(path.read_text())
    entries["answers"] = {**entries["answers"], **answers} if answers else {}
    path.write_text(json.dumps(entries))
    for verb in (["update", "talker"], ["add", "timer", "clock", "--package-directory", "talker"]):
        assert main(verb) == 2
        assert "damaged: an entry has the wrong type" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("version", "is_newer"),
    [("0.1", False), ("0.1.0.dev3", False), ("0.0.9", False), ("0.1.1", True), ("2.0rc1", True)],
)
def test_record_of_a_newer_release_is_an_error(
    package: Path,
    version: str,
    capsys: pytest.CaptureFixture[str],
    *,
    is_newer: bool,
) -> None:
    path = package / provenance.NAME
    path.write_text(json.dumps({**json.loads(path.read_text()), "version": version}))
    before = {file: file.read_bytes() for file in package.rglob("*") if file.is_file()}
    for verb in (["update", "talker"], ["add", "timer", "clock", "--package-directory", "talker"]):
        if not is_newer:
            assert main([*verb, "--dry-run"]) == 0
            continue
        assert main(verb) == 2
        assert capsys.readouterr().err == (
            "ros2-scaffold: error: talker/.ros2-scaffold.json: written by ros2-scaffold "
            f"{version}, but this is {__version__}; install {version} or later: update its "
            f"source, then run `{installation.command()}`\n"
        )
    assert {file: file.read_bytes() for file in package.rglob("*") if file.is_file()} == before


def test_add_updates_the_version_of_the_record(package: Path) -> None:
    path = package / provenance.NAME
    path.write_text(json.dumps({**json.loads(path.read_text()), "version": "0.0.1"}))
    assert main(["add", "timer", "clock", "--package-directory", "talker"]) == 0
    assert json.loads(path.read_text())["version"] == __version__


def test_binary_files_are_not_merged() -> None:
    with pytest.raises(InputError, match="git cannot merge: "):
        merge.merge(b"\0a", b"\0b", b"\0c")
