"""GitHub annotations: a runner that parses them gets every finding."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from scaffold.cli.main import main
from tests.reporters.conftest import ODD_NAME

Check = Callable[..., str]
COMMAND = re.compile(r"::(?P<command>\w+) (?P<properties>[^:]*)::(?P<message>.*)")


def read(line: str) -> tuple[str, dict[str, str], str]:
    """Parse a workflow command as a runner does."""
    match = COMMAND.fullmatch(line)
    assert match is not None, line
    properties = dict(pair.split("=", 1) for pair in match["properties"].split(","))
    decoded = {
        name: _decode(value.replace("%3A", ":").replace("%2C", ","))
        for name, value in properties.items()
    }
    return match["command"], decoded, _decode(match["message"])


def _decode(text: str) -> str:
    return text.replace("%0D", "\r").replace("%0A", "\n").replace("%25", "%")


def test_annotations_have_place_severity_and_message(
    check: Check, diagnostics: list[dict[str, Any]]
) -> None:
    commands = {"error": "error", "warning": "warning", "info": "notice"}
    findings = [read(line) for line in check("--format", "github").splitlines()]
    assert f"src/talker/{ODD_NAME}" in {properties["file"] for _, properties, _ in findings}
    order = ["error", "warning", "info"]
    expected = sorted(diagnostics, key=lambda one: order.index(one["severity"]))
    assert len(findings) == len(expected)
    for (command, properties, message), one in zip(findings, expected, strict=True):
        assert command == commands[one["severity"]]
        assert properties["file"] == one["path"]
        assert properties["line"] == str(one["line"])
        assert properties["title"] == f"{one['code']} {one['name']}"
        place = f"{one['path']}:{one['line']}:{one['column']}"
        assert message == f"{place}: {one['code']} {one['message']}"


def test_errors_come_first(check: Check) -> None:
    commands = [read(line)[0] for line in check("--format", "github").splitlines()]
    assert commands == sorted(commands, key=["error", "warning", "notice"].index)
    assert {*commands} >= {"error", "warning"}


def test_job_summary_is_appended(
    check: Check, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, diagnostics: list[dict[str, Any]]
) -> None:
    summary = tmp_path / "summary.md"
    summary.write_text("# Before\n")
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(summary))
    check("--format", "github")
    text = summary.read_text()
    assert text.startswith("# Before\n")
    assert " 1 error, 3 warnings, 1 info;" in text
    table = [
        line for line in text.splitlines() if line.startswith(("| error", "| warning", "| info"))
    ]
    levels = ["error", "warning", "info"]
    shown = [line.split(" ")[1] for line in table]
    assert shown == sorted((item["severity"] for item in diagnostics), key=levels.index)
    assert "| F401 | unused-import | warning | 2 |" in text
    check("--format", "github")  # a remembered run adds its summary, too
    assert summary.read_text().count("### ros2-scaffold check") == 2


def test_unwritable_job_summary_is_no_failure(
    repository: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("GITHUB_STEP_SUMMARY", str(tmp_path))
    assert main(["check", "--format", "github", str(repository)]) == 1
    output = capsys.readouterr()
    assert "::error" in output.out
    assert "cannot write the job summary" in output.err
