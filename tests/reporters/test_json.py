"""JSON: what a program needs to show a finding, to fix it and to explain it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from scaffold.reporters.fixes import MOST_REPEATED_EDITS
from tests import PATIENCE

Check = Callable[..., str]
Finding = dict[str, Any]


def test_report_has_a_format_version(check: Check) -> None:
    assert json.loads(check("--format", "json"))["schema_version"] == 1


def test_applying_edits_fixes_their_findings(check: Check, diagnostics: list[Finding]) -> None:
    edited = [one for one in diagnostics if one["fix"] and one["fix"]["edits"]]
    assert {one["code"] for one in edited} == {"F401", "Q000"}
    assert {one["fix"]["safety"] for one in edited} == {"safe"}
    edits = [edit for one in edited for edit in one["fix"]["edits"]]
    for edit in sorted(edits, key=lambda one: (one["line"], one["column"]), reverse=True):
        _apply(edit)
    remaining = json.loads(check("--format", "json"))["diagnostics"]
    assert not {one["code"] for one in remaining} & {one["code"] for one in edited}


def _apply(edit: dict[str, Any]) -> None:
    path = Path(edit["path"])
    lines = path.read_text().splitlines(keepends=True)
    before = "".join(lines[: edit["line"] - 1]) + lines[edit["line"] - 1][: edit["column"] - 1]
    after = "".join(lines[edit["end_line"] - 1 :])[edit["end_column"] - 1 :]
    path.write_text(before + edit["text"] + after)


def test_a_fix_names_the_files_that_it_creates(check: Check, diagnostics: list[Finding]) -> None:
    (creating,) = [
        finding for finding in diagnostics if finding["fix"] and finding["fix"]["creates"]
    ]
    for file in creating["fix"]["creates"]:
        Path(file["path"]).write_text(file["text"])
    remaining = json.loads(check("--format", "json"))["diagnostics"]
    assert creating["code"] not in {finding["code"] for finding in remaining}


def test_a_fix_of_a_whole_file_is_written_once(check: Check, repository: Path) -> None:
    package = repository / "src" / "talker"
    count = MOST_REPEATED_EDITS + 1
    commands = "".join(f"SET(x{number} 1)\n" for number in range(count))
    (package / "CMakeLists.txt").write_text(
        f"cmake_minimum_required(VERSION 3.8)\nproject(talker)\n{commands}ament_package()\n"
    )
    report = json.loads(check("--format", "json", "--select", "CM076"))["diagnostics"]
    first, *others = [item["fix"] for item in report]
    assert len(first["edits"]) == len(report) == count
    assert others == [{"title": first["title"], "safety": "safe", "same_as": 0}] * len(others)


def test_a_rule_has_no_url_where_nothing_names_the_repository(
    diagnostics: list[Finding],
) -> None:
    assert {item["url"] for item in diagnostics} == {None}


def test_the_url_of_a_rule_is_its_page_in_the_repository(repository: Path, tmp_path: Path) -> None:
    metadata = tmp_path / "named" / "ros2_scaffold-0.1.0.dist-info" / "METADATA"
    metadata.parent.mkdir(parents=True)
    metadata.write_text(
        "Metadata-Version: 2.4\nName: ros2-scaffold\nVersion: 0.1.0\n"
        "Project-URL: Issues, https://example.org/tool/issues\n"
        "Project-URL: Repository, https://example.org/tool.git\n"
    )
    done = subprocess.run(
        [sys.executable, "-m", "scaffold", "check", "--format", "json", repository],
        env={**os.environ, "PYTHONPATH": str(metadata.parent.parent)},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    report = json.loads(done.stdout)["diagnostics"]
    assert report
    for item in report:
        assert item["url"] == f"https://example.org/tool/blob/HEAD/docs/rules/{item['code']}.md"
        page = f"docs/rules/{item['code']}.md"
        assert (Path(__file__).parents[2] / page).is_file()
