"""``check --release`` reports findings that block a release as errors."""

from __future__ import annotations

import json
import shutil
from collections.abc import Mapping
from pathlib import Path

import pytest

from scaffold.cli.main import main

PLACEHOLDER, PIP, NAME = "PX001", "PX029", "PX022"


@pytest.fixture(scope="module")
def generated(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a generated package without findings."""
    top = tmp_path_factory.mktemp("generated")
    assert main(["new", "talker", "--destination-directory", str(top)]) == 0
    return top / "talker"


@pytest.fixture
def package(
    own_cache: Path, generated: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Path:
    """Return a package with findings that only block a release."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    copy = tmp_path / "talker"
    shutil.copytree(generated, copy)
    manifest = copy / "package.xml"
    text = manifest.read_text()
    start = text.index('email="') + len('email="')
    text = text[:start] + "ada@todo.todo" + text[text.index('"', start) :]
    dependencies = "<exec_depend>python3-mediapipe-pip</exec_depend>\n  <exec_depend>rclpy_action"
    text = text.replace("  <test_depend", f"  {dependencies}</exec_depend>\n  <test_depend", 1)
    manifest.write_text(text)
    monkeypatch.chdir(copy)
    return copy


def severities(capsys: pytest.CaptureFixture[str], *flags: str) -> Mapping[str, str]:
    capsys.readouterr()
    main(["check", "--format", "json", *flags])
    findings = json.loads(capsys.readouterr().out)["diagnostics"]
    return {finding["code"]: finding["severity"] for finding in findings}


@pytest.mark.usefixtures("package")
def test_findings_that_block_a_release_are_errors(capsys: pytest.CaptureFixture[str]) -> None:
    usual = {PLACEHOLDER: "warning", PIP: "info", NAME: "error"}
    assert severities(capsys) == usual
    assert severities(capsys, "--release") == dict.fromkeys(usual, "error")
    assert severities(capsys) == usual


@pytest.mark.usefixtures("package")
def test_release_errors_change_the_exit_code(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "--select", PIP]) == 0
    assert main(["check", "--select", PIP, "--release"]) == 1
    assert "1 error" in capsys.readouterr().out


def test_configured_severity_takes_precedence(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / "ros2-scaffold.toml").write_text(f"[check.severity]\n{PLACEHOLDER} = 'info'\n")
    result = severities(capsys, "--release")
    assert (result[PLACEHOLDER], result[PIP]) == ("info", "error")


def test_releasable_package_has_no_findings(
    generated: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(generated)
    assert main(["check", "--release"]) == 0


def test_rule_page_explains_the_release_severity(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rules", PIP]) == 0
    page = capsys.readouterr().out
    assert "error with `--release`: a released package cannot depend on pip packages" in page
