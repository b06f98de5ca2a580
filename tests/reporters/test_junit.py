"""JUnit: what `colcon test-result` reads from a report."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

from tests import PATIENCE

Check = Callable[..., str]


def test_result(build: Path, *words: str) -> tuple[int, str]:
    """Return the exit code of `colcon test-result` and what it prints."""
    colcon = os.path.join(os.path.dirname(sys.executable), "colcon")
    done = subprocess.run(
        [colcon, "test-result", "--all", "--test-result-base", build, *words],
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
        cwd=build,
    )
    assert "Skipping" not in done.stderr
    return done.returncode, done.stdout


test_result.__test__ = False  # type: ignore[attr-defined]  # named after the command


def read(text: str) -> ET.Element:
    return ET.fromstring(text)  # noqa: S314  our own


def test_colcon_counts_a_case_per_rule_and_file(
    check: Check, diagnostics: list[dict[str, Any]], tmp_path: Path
) -> None:
    build = tmp_path / "build"
    build.mkdir()
    check("--format", "junit", "--output-file", str(build / "check.xunit.xml"))
    cases = {(finding["code"], finding["path"]) for finding in diagnostics}
    failures = {
        (finding["code"], finding["path"])
        for finding in diagnostics
        if finding["severity"] != "info"
    }
    code, output = test_result(build, "--verbose")
    assert code == 1
    assert f"{len(cases)} tests, 0 errors, {len(failures)} failures, 0 skipped" in output
    for finding in diagnostics:
        if finding["severity"] == "info":
            continue
        assert (
            f"{finding['line']}:{finding['column']}: {finding['code']} {finding['message']}"
            in output
        )


def test_a_clean_package_is_a_case_that_passes(check: Check, tmp_path: Path) -> None:
    build = tmp_path / "build"
    build.mkdir()
    path = build / "check.xunit.xml"
    check("--format", "junit", "--select", "ND", "--output-file", str(path), code=0)
    code, output = test_result(build)
    assert code == 0
    assert "1 test, 0 errors, 0 failures, 0 skipped" in output


def test_info_findings_are_no_failures(check: Check) -> None:
    (suite,) = read(check("--format", "junit", "--select", "LY", code=0))
    assert (suite.get("tests"), suite.get("failures")) == ("1", "0")
    (case,) = suite
    assert case.findtext("system-out")


def test_characters_forbidden_in_xml_are_escaped(check: Check, repository: Path) -> None:
    path = repository / "src" / "talker" / "talker" / "bell\a.py"
    path.write_text("import os\n")
    root = read(check("--format", "junit"))
    assert any("bell\\x07.py" in (case.get("file") or "") for case in root.iter("testcase"))
