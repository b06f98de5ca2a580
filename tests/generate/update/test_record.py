"""The record of a package and its sidecar, and how git merges them."""

from __future__ import annotations

import base64
import hashlib
import json
import os
import subprocess
import zlib
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.files.tree import DiskTree
from scaffold.generate.update import bases, provenance, update
from scaffold.generate.update.provenance import ATTRIBUTES, NAME, Provenance
from scaffold.writing.transaction import BASES
from tests.generate.update.test_update import change, node_of
from tests.generate.update.test_update import team as team  # noqa: PLC0414  a fixture

NODE = "talker/minimal_publisher.py"


@pytest.fixture(autouse=True)
def _isolated_directories(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Isolate a test from the user's settings, in a directory of its own."""
    for name in ("HOME", "XDG_CONFIG_HOME"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    for role in ("AUTHOR", "COMMITTER"):
        monkeypatch.setenv(f"GIT_{role}_NAME", "Ada")
        monkeypatch.setenv(f"GIT_{role}_EMAIL", "ada@example.com")
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def package(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Path:
    command = ["new", "talker", "--maintainer-name", "Ada", "--maintainer-email", "ada@example.com"]
    assert main(command) == 0
    capsys.readouterr()
    return tmp_path / "talker"


def git(package: Path, *words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ["git", "-C", str(package), *words], check=False, capture_output=True, text=True
    )


def commit(package: Path) -> None:
    assert git(package, "add", "--all").returncode == 0
    assert git(package, "commit", "--quiet", "--message", "work").returncode == 0


def add(*words: str) -> int:
    return main(["add", *words, "--package-directory", "talker"])


def record_of(package: Path) -> Provenance:
    return update.read(DiskTree(str(package)), package.name)


def merge_branches(package: Path, ours: list[str], theirs: list[str]) -> list[str]:
    """Run `add` on each of two branches and merge them; return the files in conflict."""
    git(package, "init", "--quiet", "--initial-branch", "main")
    commit(package)
    git(package, "checkout", "--quiet", "-b", "theirs")
    assert add(*theirs) == 0
    commit(package)
    git(package, "checkout", "--quiet", "main")
    assert add(*ours) == 0
    commit(package)
    git(package, "merge", "theirs")
    return git(package, "diff", "--name-only", "--diff-filter=U").stdout.split()


def keep_both(package: Path, conflicts: list[str]) -> None:
    """Resolve conflicts by keeping the lines of both sides."""
    for path in conflicts:
        lines = (package / path).read_text().splitlines(keepends=True)
        kept = [line for line in lines if not line.startswith(("<<<<<<<", "=======", ">>>>>>>"))]
        (package / path).write_text("".join(kept))
    commit(package)


def without_sidecar(package: Path) -> str:
    """Return the record as versions without a sidecar wrote it."""
    record = record_of(package)
    packed = zlib.compress(json.dumps(dict(record.rendered)).encode(), 9)
    entries = {
        "about": "",
        "version": record.version,
        "date": record.date.isoformat(),
        "answers": dict(record.answers),
        "rendered": base64.b64encode(packed).decode(),
    }
    return json.dumps(entries, indent=2) + "\n"


def test_the_record_has_answers_and_a_hash_for_each_file(package: Path) -> None:
    text = (package / NAME).read_text()
    entries = json.loads(text)
    assert entries["answers"]["maintainer_name"] == "Ada"
    assert entries["answers"]["add"][0]["rate"] == 2.0
    hashes = {path: hash_ for path, hash_ in entries["files"].items() if path}
    assert hashes == {
        path: hashlib.sha256((package / path).read_bytes()).hexdigest()
        for path in record_of(package).rendered
    }
    assert list(hashes) == sorted(hashes)
    assert all(
        f"\n    {json.dumps(path)}: {json.dumps(hashes[path])},\n" in text for path in hashes
    )
    assert len(text) < 3_000
    header, *lines = (package / BASES).read_text().splitlines()
    assert header.startswith("# ")
    assert [line.split("\t")[:2] for line in lines] == [list(item) for item in hashes.items()]


def test_two_branches_that_add_nodes_merge(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    conflicts = merge_branches(package, ["subscriber", "listener"], ["timer", "tick"])
    assert {NAME, BASES} & set(conflicts) == set()
    keep_both(package, conflicts)
    before = {path: (package / path).read_bytes() for path in (*conflicts, NODE)}
    capsys.readouterr()
    assert main(["update", "talker"]) == 0
    assert capsys.readouterr().out == "The package is up to date with the templates.\n"
    assert {path: (package / path).read_bytes() for path in before} == before
    record = record_of(package)
    assert record.is_canonical
    names = [part["node_name"] for part in record.answers["add"]]
    assert names == ["minimal_publisher", "listener", "tick"]
    assert "listener and the timer node tick" in record.answers["description"]
    text = (package / NAME).read_text()
    assert main(["update", "talker"]) == 0
    assert (package / NAME).read_text() == text


def test_bases_of_both_branches_can_be_rendered_again(package: Path) -> None:
    keep_both(package, merge_branches(package, ["subscriber", "listener"], ["timer", "tick"]))
    (package / BASES).unlink()
    assert main(["update", "talker"]) == 0
    assert record_of(package).is_canonical


def test_node_can_be_added_after_a_merge(package: Path) -> None:
    keep_both(package, merge_branches(package, ["subscriber", "listener"], ["timer", "tick"]))
    assert add("timer", "third") == 0
    names = [part["node_name"] for part in record_of(package).answers["add"]]
    assert names == ["minimal_publisher", "listener", "tick", "third"]
    assert record_of(package).is_canonical


def test_branches_that_add_extras_merge(package: Path) -> None:
    assert merge_branches(package, ["gitignore"], ["pre_commit"]) == []
    assert record_of(package).answers["extras"] == ["gitignore", "pre_commit"]
    assert main(["update", "talker"]) == 0
    assert record_of(package).is_canonical


def test_update_after_a_merge(package: Path, team: Path) -> None:
    keep_both(package, merge_branches(package, ["subscriber", "listener"], ["timer", "tick"]))
    change(team, node_of(team), "Log the next message", "Tell the next message")
    change(team, "CHANGELOG.rst.jinja", "Forthcoming", "Upcoming...")
    assert main(["update", "talker", "--content", str(team)]) in {0, 1}
    assert "Tell the next message" in (package / NODE).read_text()
    changes = (package / "CHANGELOG.rst").read_text()
    assert "Upcoming..." in changes
    assert "``listener``" in changes
    assert "``tick``" in changes


def test_conflict_in_the_record_is_reported_as_such(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / ATTRIBUTES).unlink()
    conflicts = merge_branches(package, ["subscriber", "listener"], ["timer", "tick"])
    assert {NAME, BASES} <= set(conflicts)
    capsys.readouterr()
    assert main(["update", "talker"]) == 2
    assert capsys.readouterr().err == (
        f"ros2-scaffold: error: talker/{NAME}: has a merge conflict; take the same side of "
        f"{NAME} and {BASES}, as with `git checkout --ours`, and repeat each `add` of the "
        "other side; nothing was changed\n"
    )
    git(package, "checkout", "--ours", NAME)
    assert main(["update", "talker"]) == 2
    assert f"talker/{BASES}: has a merge conflict" in capsys.readouterr().err
    git(package, "checkout", "--ours", BASES)
    keep_both(package, conflicts)
    assert add("timer", "tick") == 0
    names = [part["node_name"] for part in record_of(package).answers["add"]]
    assert names == ["minimal_publisher", "listener", "tick"]


def test_a_conflict_stops_add(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    record = package / NAME
    record.write_text(f"<<<<<<< HEAD\n{record.read_text()}=======\n>>>>>>> theirs\n")
    assert add("timer", "tick") == 2
    assert "has a merge conflict" in capsys.readouterr().err


@pytest.mark.parametrize("verb", ["update", "add"])
def test_records_without_a_sidecar_get_one(
    package: Path, verb: str, capsys: pytest.CaptureFixture[str]
) -> None:
    expected = {name: (package / name).read_bytes() for name in provenance.PURPOSES}
    record = record_of(package)
    (package / NAME).write_text(without_sidecar(package))
    (package / BASES).unlink()
    (package / ATTRIBUTES).unlink()
    assert record_of(package).rendered == record.rendered
    if verb == "update":
        assert main(["update", "talker"]) == 0
        assert capsys.readouterr().out == f"{ATTRIBUTES}: new\n"
        assert {name: (package / name).read_bytes() for name in expected} == expected
    else:
        assert add("timer", "tick") == 0
        assert (package / ATTRIBUTES).read_bytes() == expected[ATTRIBUTES]
        assert record_of(package).rendered.keys() > record.rendered.keys()
    assert record_of(package).is_canonical


def test_gitattributes_of_the_user_are_kept(package: Path) -> None:
    (package / NAME).write_text(without_sidecar(package))
    (package / ATTRIBUTES).write_text("* text=auto\n")
    assert main(["update", "talker"]) == 0
    assert (package / ATTRIBUTES).read_text() == "* text=auto\n"
    (package / ATTRIBUTES).unlink()
    assert add("timer", "tick") == 0
    assert not (package / ATTRIBUTES).exists()


def test_lost_sidecar_is_restored_if_templates_are_unchanged(package: Path) -> None:
    before = (package / BASES).read_bytes()
    (package / BASES).unlink()
    (package / NODE).write_text("mine\n")
    assert main(["update", "talker"]) == 0
    assert (package / BASES).read_bytes() == before
    (package / BASES).unlink()
    assert add("timer", "tick") == 0
    assert record_of(package).is_canonical


def test_unedited_file_needs_no_sidecar(package: Path, team: Path) -> None:
    (package / BASES).unlink()
    change(team, node_of(team), "Log the next message", "Tell the next message")
    assert main(["update", "talker", "--content", str(team)]) == 0
    assert "Tell the next message" in (package / NODE).read_text()


def test_an_edited_file_is_not_merged_without_its_base(
    package: Path, team: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / BASES).unlink()
    (package / NODE).write_text("mine\n")
    change(team, node_of(team), "Log the next message", "Tell the next message")
    before = {path: path.read_bytes() for path in package.rglob("*") if path.is_file()}
    for words in (["update", "talker"], ["add", "timer", "tick", "--package-directory", "talker"]):
        assert main([*words, "--content", str(team)]) == 2
        assert capsys.readouterr().err == (
            f"ros2-scaffold: error: talker/{BASES}: lacks the rendered templates of {NODE}, "
            "which are needed for the merge; restore the file from git; nothing was changed\n"
        )
    assert {path: path.read_bytes() for path in package.rglob("*") if path.is_file()} == before


def test_a_shallow_clone_of_a_package_edited_before_its_first_commit(
    package: Path, team: Path, tmp_path: Path
) -> None:
    node = package / NODE
    node.write_text(node.read_text().replace("import", "import os\nimport", 1))
    git(package, "init", "--quiet")
    commit(package)
    clone = tmp_path / "clone"
    assert git(package, "clone", "--depth=1", f"file://{package}", str(clone)).returncode == 0
    change(team, node_of(team), "Log the next message", "Tell the next message")
    assert main(["update", "clone", "--content", str(team)]) == 0
    merged = (clone / NODE).read_text()
    assert "import os\n" in merged
    assert "Tell the next message" in merged


def test_add_after_a_template_change_does_not_hide_the_change(package: Path, team: Path) -> None:
    change(team, node_of(team), "Log the next message", "Tell the next message")
    assert (
        main(["add", "timer", "tick", "--package-directory", "talker", "--content", str(team)]) == 0
    )
    assert "Log the next message" in (package / NODE).read_text()
    assert "Log the next message" in record_of(package).rendered[NODE]
    assert main(["update", "talker", "--content", str(team)]) == 0
    assert "Tell the next message" in (package / NODE).read_text()


def _line(path: str, text: bytes, packed: bytes | None = None) -> bytes:
    packed = packed if packed is not None else base64.b85encode(zlib.compress(text, 9))
    return b"\t".join([path.encode(), hashlib.sha256(text).hexdigest().encode(), packed]) + b"\n"


@pytest.mark.parametrize(
    "sidecar",
    [
        b"\0",
        b"\xff",
        b"CMakeLists.txt\n",
        b"CMakeLists.txt\t\t\n",
        _line("CMakeLists.txt", b"", b"\x20"),
        _line("CMakeLists.txt", b"text", base64.b85encode(zlib.compress(b"another"))),
        _line("CMakeLists.txt", b"text", base64.b85encode(zlib.compress(b"text" * 99)[:20])),
        _line("CMakeLists.txt", bytes(bases.MOST + 1)),
        _line("a", bytes(bases.MOST // 2)) + _line("b", bytes(bases.MOST // 2 + 1)),
        _line("%ff", b""),
        b"# " + bytes(100_000_000),
    ],
    ids=lambda data: repr(data[:40]),
)
def test_invalid_sidecar_is_an_error(
    package: Path, sidecar: bytes, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / BASES).write_bytes(sidecar)
    for words in (["update", "talker"], ["add", "timer", "tick", "--package-directory", "talker"]):
        assert main(words) == 2
        error = capsys.readouterr().err
        assert error.count("\n") == 1
        assert BASES in error


@pytest.mark.parametrize(
    "files",
    [
        "5",
        "[]",
        '{"a": 5}',
        '{"a": null}',
        '{"a": ["x"]}',
        r'{"\ud800": "x"}',
        "{" + ", ".join(f'"a": "{number}"' for number in range(1_000)) + "}",
    ],
    ids=lambda text: text[:20],
)
def test_invalid_hashes_are_an_error(
    package: Path, files: str, capsys: pytest.CaptureFixture[str]
) -> None:
    text = (package / NAME).read_text()
    start = text.index('"files": ')
    (package / NAME).write_text(f'{text[:start]}"files": {files}}}')
    for words in (["update", "talker"], ["add", "timer", "tick", "--package-directory", "talker"]):
        assert main(words) == 2
        error = capsys.readouterr().err
        assert error.count("\n") == 1
        assert f"{NAME}: damaged" in error


def test_paths_out_of_the_package_are_not_read(
    package: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "secret").write_text("secret\n")
    paths = ["../secret", "/secret", "a\tb", "a\nb", ":/../secret"]
    entries = json.loads((package / NAME).read_text())
    hash_ = hashlib.sha256(b"secret\n").hexdigest()
    entries["files"] |= dict.fromkeys(paths, hash_)
    (package / NAME).write_text(json.dumps(entries))
    assert main(["update", "talker"]) == 0
    assert "secret" not in capsys.readouterr().err
    assert record_of(package).rendered.keys().isdisjoint(paths)


@pytest.mark.parametrize(
    "path", ["a b", "a\tb", "a\nb", "#a", "ä", "%41", ":/.github/a", "<<<<<<<"]
)
def test_sidecar_lines_round_trip_any_path(path: str) -> None:
    text = bases.text({path: "x\n"})
    assert text.count("\n") == 2
    assert bases.parse(text, "here") == {(path, bases.hash_of(b"x\n")): "x\n"}


def test_combined_text_has_the_lines_of_both_sides() -> None:
    ours, theirs = "a\nb\nours\nc\n", "a\ntheirs\nb\nc\nd\n"
    assert bases.combined([ours, theirs]) == "a\ntheirs\nb\nours\nc\nd\n"
    assert bases.combined(["x\n" * 9_000, "y\n" * 9_000]).count("\n") == 18_000
