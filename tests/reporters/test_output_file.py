"""`--output-file`: written atomically, without terminal escapes."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.reporters import NAMES
from tests import PATIENCE

pexpect = pytest.importorskip("pexpect")

Check = Callable[..., str]


@pytest.mark.parametrize("name", NAMES)
def test_file_equals_standard_output(
    check: Check, tmp_path: Path, name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    expected = check("--format", name)
    path = tmp_path / "report"
    assert main(["check", "--format", name, "--output-file", str(path)]) == 1
    output = capsys.readouterr()
    assert output.out == ""
    assert "error" in output.err
    assert str(path) in output.err
    assert path.read_text() == expected
    assert os.listdir(tmp_path).count("report") == 1
    assert not [item for item in os.listdir(tmp_path) if item.endswith(".tmp")]


def test_text_for_a_file_has_no_colors(repository: Path, tmp_path: Path) -> None:
    path = tmp_path / "report.txt"
    words = ["-m", "scaffold", "check", str(repository)]
    environment = {**os.environ, "TERM": "xterm"}
    environment.pop("NO_COLOR", None)
    shown = pexpect.run(" ".join([sys.executable, *words]), env=environment, timeout=int(PATIENCE))
    assert b"\x1b[" in shown
    pexpect.run(
        " ".join([sys.executable, *words, "--output-file", str(path)]),
        env=environment,
        timeout=int(PATIENCE),
    )
    text = path.read_text()
    assert "F401" in text
    assert "\x1b" not in text


def test_cached_run_writes_a_removed_file_again(check: Check, tmp_path: Path) -> None:
    path = tmp_path / "report"
    command = ("--output-file", str(path))
    check(*command)
    text = path.read_text()
    path.unlink()
    check(*command)
    assert path.read_text() == text


def test_file_mode_and_symlink_target_are_kept(check: Check, tmp_path: Path) -> None:
    path = tmp_path / "report"
    path.write_text("old")
    path.chmod(0o640)
    link = tmp_path / "link"
    link.symlink_to(path)
    check("--output-file", str(link))
    assert link.is_symlink()
    assert "F401" in path.read_text()
    assert path.stat().st_mode & 0o777 == 0o640


def test_device_is_written_to_but_not_replaced(check: Check) -> None:
    check("--output-file", os.devnull)
    assert Path(os.devnull).is_char_device()


@pytest.mark.usefixtures("repository")
@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--output-file", "nowhere/report"], "there is no directory 'nowhere'; create it"),
        (["--output-file", "src"], "is a directory, not a file"),
        (["--diff", "--output-file", "report"], "omit --output-file"),
    ],
)
def test_unwritable_output_file_is_one_error_line(
    words: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", *words]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1
