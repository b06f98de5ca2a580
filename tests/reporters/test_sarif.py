"""SARIF: valid, complete, and with fingerprints that survive moved lines."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import jsonschema
import pytest

from scaffold.model.package import Package
from scaffold.reporters.fingerprints import line_hash
from tests.reporters.sarif_schema import SCHEMA

Check = Callable[..., str]


@pytest.fixture
def run(check: Check) -> dict[str, Any]:
    """Return the only run of the report."""
    return _run(check("--format", "sarif"))


def _run(text: str) -> dict[str, Any]:
    report = json.loads(text)
    jsonschema.validate(report, SCHEMA)
    (item,) = report["runs"]
    assert isinstance(item, dict)
    return item


def test_every_finding_has_its_location(
    run: dict[str, Any], diagnostics: list[dict[str, Any]]
) -> None:
    levels = {"error": "error", "warning": "warning", "info": "note"}
    expected = [
        {
            "rule": finding["code"],
            "level": levels[finding["severity"]],
            "message": finding["message"],
            "path": finding["path"],
            "region": [finding[name] for name in ("line", "column", "end_line", "end_column")],
        }
        for finding in diagnostics
    ]
    actual = []
    for result in run["results"]:
        place = result["locations"][0]["physicalLocation"]
        actual.append(
            {
                "rule": result["ruleId"],
                "level": result["level"],
                "message": result["message"]["text"],
                "path": unquote(place["artifactLocation"]["uri"]),
                "region": [*place["region"].values()],
            }
        )
    assert actual == expected
    assert actual


def test_rules_of_findings_are_documented(run: dict[str, Any]) -> None:
    rules = run["tool"]["driver"]["rules"]
    for result in run["results"]:
        assert rules[result["ruleIndex"]]["id"] == result["ruleId"]
    assert {rule["id"] for rule in rules} == {result["ruleId"] for result in run["results"]}
    by_code = {rule["id"]: rule for rule in rules}
    assert by_code["F401"]["properties"]["tags"] == ["ROS 2", "ament_flake8"]
    assert "**Why.**" in by_code["SP006"]["help"]["markdown"]
    assert "**" not in by_code["SP006"]["help"]["text"]


def test_edits_of_a_fix_are_replacements(run: dict[str, Any], repository: Path) -> None:
    (quotes,) = [item for item in run["results"] if item["ruleId"] == "Q000"]
    (fix,) = quotes["fixes"]
    (change,) = fix["artifactChanges"]
    path = repository / unquote(change["artifactLocation"]["uri"])
    lines = path.read_text().split("\n")
    for replacement in reversed(change["replacements"]):
        region = replacement["deletedRegion"]
        assert region["startLine"] == region["endLine"]
        line = lines[region["startLine"] - 1]
        lines[region["startLine"] - 1] = (
            line[: region["startColumn"] - 1]
            + replacement["insertedContent"]["text"]
            + line[region["endColumn"] - 1 :]
        )
    assert "    print('hällo')" in lines


def test_fix_that_creates_a_file_is_omitted(
    run: dict[str, Any], diagnostics: list[dict[str, Any]]
) -> None:
    creating = {
        finding["code"] for finding in diagnostics if finding["fix"] and finding["fix"]["creates"]
    }
    assert creating
    for result in run["results"]:
        assert ("fixes" in result) <= (result["ruleId"] not in creating)


def test_moved_lines_keep_their_fingerprints(check: Check, repository: Path) -> None:
    before = _run(check("--format", "sarif"))["results"]
    path = repository / "src" / "talker" / "talker" / "talk.py"
    text = path.read_text()
    path.write_text(text.replace("import os\n", "import os\n\n\nLIMIT = 1\n"))
    after = _run(check("--format", "sarif"))["results"]
    assert [_line(item) for item in before] != [_line(item) for item in after]
    names = [item["partialFingerprints"]["finding/v1"] for item in before]
    assert names == [item["partialFingerprints"]["finding/v1"] for item in after]
    assert len({*names}) == len(names)


def _line(result: dict[str, Any]) -> int:
    line = result["locations"][0]["physicalLocation"]["region"]["startLine"]
    assert isinstance(line, int)
    return line


def test_identical_findings_have_distinct_fingerprints(check: Check, repository: Path) -> None:
    path = repository / "src" / "talker" / "talker" / "talk.py"
    path.write_text(path.read_text() + '    print("hällo")\n')
    results = _run(check("--format", "sarif", "--select", "Q000"))["results"]
    assert len(results) == 2
    assert len({item["partialFingerprints"]["finding/v1"] for item in results}) == 2


@pytest.mark.parametrize(
    ("text", "hashes"),
    [
        ("", ["c129715d7a2bc9a3:1"]),
        (
            " a\nb\n  \t\tc\n d",
            ["271789c17abda88f:1", "54703d4cd895b18:1", "180aee12dab6264:1", "a23a3dc5e078b07b:1"],
        ),
        ("x\n" * 101, ["c0fe7b2700d6c254:1", "c0fe7b2700d6c254:2"]),
        ("\r\n".join("ab"), ["c74339777b6a2c60:1", "8ee5a81e681643c1:1"]),
        ("\U0001f600\n", ["49e42825ed591e1a:1"]),
    ],
    ids=["empty", "spaces", "repeated", "carriage returns", "emoji"],
)
def test_line_hashes_equal_those_of_code_scanning(text: str, hashes: list[str]) -> None:
    """The upload to GitHub warns of each that differs from its own."""
    package = Package.of({"a.py": text})
    assert [line_hash(package, "a.py", number + 1) for number in range(len(hashes))] == hashes


def test_paths_are_relative_to_the_repository(
    check: Check, repository: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    expected = _paths(check("--format", "sarif"))
    monkeypatch.chdir(repository / "src" / "talker")
    assert _paths(check("--format", "sarif", ".")) == expected
    (repository.parent / "link").symlink_to(repository / "src")
    monkeypatch.chdir(repository.parent)
    assert _paths(check("--format", "sarif", "link/talker")) == expected


def _paths(text: str) -> set[str]:
    return {
        item["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
        for item in _run(text)["results"]
    }


def test_a_clean_package_gives_a_valid_report(check: Check) -> None:
    run = _run(check("--format", "sarif", "--select", "ND", code=0))
    assert run["results"] == run["tool"]["driver"]["rules"] == []


def test_cached_run_gives_the_same_report(check: Check, tmp_path: Path) -> None:
    first = check("--format", "sarif")
    path = tmp_path / "again.sarif"
    command = ("--format", "sarif", "--output-file", str(path))
    check(*command)
    check(*command)  # what is known of the packages is taken from the run before
    assert path.read_text() == first
