"""A baseline hides exactly its findings, even if their lines have moved."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from scaffold.cli.main import main

FLAWS = "import os\n\n\ndef talk(a):\n    x = 1;\n    return a\n"


@pytest.fixture
def talker(
    own_cache: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> Path:
    """Return a package with findings, below the current directory, which is a repository."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    top = tmp_path / "workspace"
    top.mkdir()
    monkeypatch.chdir(top)
    subprocess.run(["git", "init", "--quiet"], check=True)
    assert main(["new", "talker"]) == 0
    (top / "talker" / "talker" / "extra.py").write_text(FLAWS)
    capsys.readouterr()
    return top / "talker"


def check(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, list[str]]:
    code = main(["check", *words])
    return code, capsys.readouterr().out.splitlines()


def test_only_new_findings_are_reported(talker: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, (*old, _) = check(capsys)
    assert len(old) > 3
    code, lines = check(capsys, "--write-baseline", "base.json")
    assert (code, lines) == (0, [f"{len(old)} findings written to base.json"])
    known = ["--baseline", "base.json"]
    hidden = f"baseline base.json: {len(old)} findings hidden"
    clean = [hidden, "1 package, 13 files for Jazzy: no findings"]
    for _ in range(2):  # the second one is remembered
        assert check(capsys, *known) == (0, clean)

    extra = talker / "talker" / "extra.py"
    extra.write_text(f"# What talks.\n\n{FLAWS}")
    assert check(capsys, *known) == (0, clean), "lines have moved"

    extra.write_text(f"# What talks.\n\nimport sys\n{FLAWS}")
    code, lines = check(capsys, *known, "--select", "F")
    assert code == 1
    assert [line.split(": ")[0] for line in lines[:-2]] == ["talker/talker/extra.py:3:1"]
    data = json.loads("".join(check(capsys, *known, "--select", "F", "--format", "json")[1]))
    assert {item["line"] for item in data["diagnostics"]} == {3}

    extra.write_text(f"{FLAWS}\n\ndef more(a):\n    x = 1;\n    return a\n")
    code, lines = check(capsys, *known, "--select", "F841,E703")
    assert [line.split(": ")[0] for line in lines[:-2]] == [
        "talker/talker/extra.py:10:5",
        "talker/talker/extra.py:10:10",
    ], "the same fault once more is new"


def test_baseline_matches_whatever_the_target_distributions(
    talker: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (talker / "talker" / "extra.py").write_text(
        "import asynchat\nimport imp\n\nfrom rclpy import nothing\n\n"
        "USED = asynchat, imp, nothing\n"
    )
    several = ["--select", "TY", "--distro", "jazzy,lyrical"]
    for written, used in ((["--select", "TY", "--distro", "jazzy"], several), (several, several)):
        _, (*old, _) = check(capsys, *written)
        assert len(old) == 3
        check(capsys, *written, "--write-baseline", "base.json")
        code, (note, *_) = check(capsys, *used, "--baseline", "base.json")
        assert (code, note) == (0, "baseline base.json: 3 findings hidden")
    code, (note, *_) = check(capsys, "--select", "TY", "--baseline", "base.json")
    assert (code, note) == (0, "baseline base.json: 3 findings hidden")


def test_entries_that_no_longer_occur_are_counted(
    talker: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["check", "--write-baseline", "base.json"])
    capsys.readouterr()
    known = ["--baseline", "base.json"]
    (talker / "talker" / "extra.py").write_text(FLAWS.replace("import os\n", "\n"))
    (*_, note, _) = check(capsys, *known, "--select", "F")[1]
    assert note == "baseline base.json: 1 finding hidden, 1 entry no longer occurs"
    (*_, note, _) = check(capsys, *known, "--select", "CM")[1]
    assert note == "baseline base.json: 0 findings hidden", "what is not asked for is not missed"
    (*_, note, _) = check(capsys, *known, "talker/package.xml")[1]
    assert note == "baseline base.json: 0 findings hidden", "nor what is not checked"


def test_edited_baseline_is_not_served_from_the_cache(
    talker: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["check", "--write-baseline", "base.json"])
    main(["check", "--baseline", "base.json"])
    capsys.readouterr()
    path = talker.parent / "base.json"
    data = json.loads(path.read_text())
    removed = data["findings"].pop()
    path.write_text(json.dumps(data))
    code, lines = check(capsys, "--baseline", "base.json")
    assert code == 1
    assert f" {removed['code']} " in lines[0]
    path.write_text(json.dumps({"version": 1, "findings": []}))
    assert len(check(capsys, "--baseline", "base.json")[1]) == len(data["findings"]) + 3


def test_git_merges_baselines_of_two_branches(
    talker: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["check", "--write-baseline", "base.json"])
    capsys.readouterr()
    head, *entries, end = (talker.parent / "base.json").read_text().splitlines()
    assert (head, end) == ('{"version": 1, "findings": [', "]}")
    findings = [json.loads(entry.removesuffix(",")) for entry in entries]
    places = [(item["path"], item["code"]) for item in findings]
    assert places == sorted(places)
    assert str(talker.parent) not in json.dumps(findings)


@pytest.mark.usefixtures("talker")
def test_baseline_findings_are_fixed_or_hidden(capsys: pytest.CaptureFixture[str]) -> None:
    main(["check", "--write-baseline", "base.json"])
    capsys.readouterr()
    words = ["--baseline", "base.json", "--fix", "--select", "F,LY"]
    code, (*findings, note, _) = check(capsys, *words)
    assert (code, findings) == (0, [])
    assert note == "baseline base.json: 2 findings hidden, 1 entry no longer occurs"


@pytest.mark.usefixtures("talker")
@pytest.mark.parametrize(
    ("text", "message"),
    [
        (None, "--baseline base.json: no such file; write it with `check --write-baseline`"),
        ("<<<<<<< ours\n", "--baseline base.json: not a baseline: "),
        ("[]", "not a baseline: version is None instead of 1"),
        ('{"version": 2}', "not a baseline: version is 2 instead of 1"),
        ('{"version": 1}', "not a baseline: 'findings' is not a list"),
        ('{"version": 1, "findings": [{"path": "a"}]}', "not a baseline: entry 1 is not one of "),
        ("[" * 100_000, "not a baseline: "),
    ],
)
def test_invalid_baseline_is_rejected(
    capsys: pytest.CaptureFixture[str], text: str | None, message: str
) -> None:
    if text is not None:
        Path("base.json").write_text(text)
    assert main(["check", "--baseline", "base.json"]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert message in line


@pytest.mark.usefixtures("talker")
@pytest.mark.parametrize("flag", [["--fix"], ["--baseline", "a"], ["--output-file", "a"]])
def test_write_baseline_excludes_other_output_flags(
    capsys: pytest.CaptureFixture[str], flag: list[str]
) -> None:
    assert main(["check", "--write-baseline", "base.json", *flag]) == 2
    assert f"omit {flag[0]}\n" in capsys.readouterr().err
    assert main(["check", "--write-baseline", "nowhere/base.json"]) == 2
    assert "--write-baseline nowhere/base.json: No such file" in capsys.readouterr().err
