"""The text report: one line per finding in a file, a grouped summary on a terminal."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from scaffold.cli.main import main

pexpect = pytest.importorskip("pexpect")

SIZES = ("COLUMNS", "LINES")
"""Variables that are believed more than the terminal."""
_NODE = '''"""A node."""

import rclpy
from rclpy.node import Node


class Talker(Node):
    """Talks."""

    def __init__(self):
        super().__init__("talker")
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.get_logger().warn_throttle(1, "late")


def main():
    """Run the node."""
    with rclpy.init(), Talker() as node:
        rclpy.spin(node)
'''

_CLASSES = [f"{first}{second}" for first in "abcdefgh" for second in "vwxyz"]
"""Names of classes, in lower case, so that messages about them are not similar."""


@pytest.fixture
def workspace(own_cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a directory with a clean package plus a faulty node with double quotes."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    assert main(["new", "robot", "--topic", "chatter"]) == 0
    (tmp_path / "robot" / "robot" / "faulty.py").write_text(_NODE)
    return tmp_path


def check(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, list[str]]:
    """Return the exit code and the lines of a check whose output is not a terminal."""
    capsys.readouterr()
    code = main(["check", *arguments])
    return code, capsys.readouterr().out.splitlines()


def on_terminal(directory: Path, *arguments: str, lines: int = 40) -> tuple[int, list[str]]:
    """Return the exit code and the lines that a terminal shows."""
    code, shown = shown_on_terminal(directory, *arguments, lines=lines)
    plain = re.sub(r"\x1b\[[0-9;?]*[A-Za-z]|\x1b\]8;[^\x1b]*\x1b\\", "", shown)
    return code, [line.strip("\r") for line in plain.splitlines()]


def shown_on_terminal(
    directory: Path, *arguments: str, lines: int = 40, variables: Mapping[str, str] | None = None
) -> tuple[int, str]:
    """Return the exit code and the raw output on a terminal."""
    own = {name: value for name, value in os.environ.items() if name not in SIZES}
    command = os.path.join(os.path.dirname(sys.executable), "ros2-scaffold")
    child = pexpect.spawn(
        "/bin/sh",  # the progress bar, for which a slow machine has time, goes elsewhere
        ["-c", 'exec "$0" check "$@" 2> /dev/null', command, *arguments],
        cwd=str(directory),
        dimensions=(lines, 120),
        encoding="utf-8",
        timeout=300,
        env={**own, **(variables or {}), "TERM": "xterm-256color"},
    )
    shown = child.read()
    child.close()
    return int(child.exitstatus or 0), shown


def findings(lines: list[str]) -> list[str]:
    """Return the lines that begin an entry."""
    return [line for line in lines if re.match(r"\S+:\d+:\d+: (error|warning|info) ", line)]


@pytest.mark.usefixtures("workspace")
def test_file_has_one_line_per_finding_errors_first(
    capsys: pytest.CaptureFixture[str],
) -> None:
    code, lines = check(capsys, "robot")
    levels = [line.split()[1] for line in findings(lines)]
    assert code == 1
    assert levels == sorted(levels, key=("error", "warning", "info").index)
    assert levels[0] == "error"
    assert levels.count("warning") >= 2
    assert len(findings(lines)) == len(lines) - 1


def test_terminal_folds_style_findings_while_there_are_errors(workspace: Path) -> None:
    code, lines = on_terminal(workspace, "robot")
    assert code == 1
    assert not [line for line in findings(lines) if " Q000 " in line]
    assert any(
        re.match(r"robot: \d+ style findings, \d+ fixable with --fix", item) for item in lines
    )
    assert lines[-1].startswith("1 package, ")
    _, shown = on_terminal(workspace, "--style", "robot", lines=200)
    assert [line for line in findings(shown) if " Q000 " in line]


def test_terminal_links_codes_to_rule_pages(workspace: Path) -> None:
    raw = shown_on_terminal(workspace, "robot")[1]
    pages = dict(re.findall(r"\x1b\]8;[^;]*;file://([^\x1b]+)\x1b\\\x1b\[[0-9;]*m(\w+)", raw))
    assert "TY003" in pages.values()
    for path, code in pages.items():
        assert Path(path).read_text().startswith(f"# {code} ")
    without = shown_on_terminal(workspace, "robot", variables={"SCAFFOLD_NO_CACHE": "1"})[1]
    assert "TY003" in without
    assert "\x1b]8" not in without


def test_a_file_has_no_links(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _, lines = check(capsys, str(workspace / "robot"))
    assert findings(lines)
    assert not any("\x1b" in line for line in lines)


def test_terminal_underlines_the_place_in_the_source_line(workspace: Path) -> None:
    _, lines = on_terminal(workspace, "robot")
    at = next(at for at, line in enumerate(lines) if "warn_throttle'" in line)
    assert lines[at + 1].endswith('self.get_logger().warn_throttle(1, "late")')
    mark = lines[at + 2]
    assert set(mark.partition("|")[2].strip()) == {"^"}
    assert lines[at + 1][mark.index("^") : mark.rindex("^") + 1] in lines[at + 1]


def test_findings_with_one_cause_are_one_entry(workspace: Path) -> None:
    for number in range(6):
        (workspace / "robot" / "robot" / f"other_{number}.py").write_text(_NODE)
    _, lines = on_terminal(workspace, "robot", lines=60)
    (entry,) = [at for at, line in enumerate(lines) if "warn_throttle'" in line]
    further = next(line for line in lines[entry:] if line.startswith("    also at "))
    assert further.endswith("and 3 more places")


@pytest.fixture
def crowded(workspace: Path) -> Path:
    """Return a workspace with more errors than a small terminal has lines."""
    calls = "\n".join(f"        {name}().speak(1)" for name in _CLASSES)
    node = _NODE.replace('        self.get_logger().warn_throttle(1, "late")', calls)
    for name in _CLASSES:
        node += f"\n\nclass {name}:\n    pass\n"
    (workspace / "robot" / "robot" / "faulty.py").write_text(node)
    return workspace


def test_terminal_shows_one_screen_and_counts_the_rest(crowded: Path) -> None:
    _, lines = on_terminal(crowded, "robot", lines=30)
    assert len(lines) <= 30
    assert any(re.match(r"not shown: \d+ errors.*; --all shows them", line) for line in lines)
    assert any(re.match(r"    by code: TY003 \d+", line) for line in lines)
    assert any(re.match(r"    by package: robot \d+", line) for line in lines)
    _, everything = on_terminal(crowded, "--all", "robot", lines=30)
    assert len([line for line in findings(everything) if " TY003 " in line]) == 40


def test_crowded_terminal_shows_every_kind_of_error(crowded: Path) -> None:
    (crowded / "robot" / "robot" / "client.py").write_text("value = 1\n")
    _, lines = on_terminal(crowded, "robot", lines=30)
    shown = [line.split()[2] for line in findings(lines)]
    assert shown.count("TY003") > 5
    assert shown.index("ND005") < shown.index("TY003") < shown.index("LY020")


def test_report_fits_the_height_of_the_terminal(crowded: Path) -> None:
    _, small = on_terminal(crowded, "robot", lines=30)
    _, large = on_terminal(crowded, "robot", lines=90)
    assert len(findings(small)) < len(findings(large))


@pytest.mark.usefixtures("workspace")
def test_statistics_count_codes(capsys: pytest.CaptureFixture[str]) -> None:
    _, all_lines = check(capsys, "robot")
    code, lines = check(capsys, "--statistics", "robot")
    assert code == 1
    rows = [re.match(r" *(\d+)  (\S+) +(\S+) +\[[* ]\] \S+$", line) for line in lines]
    numbers = {row[3]: int(row[1]) for row in rows if row}
    assert sum(numbers.values()) == len(findings(all_lines))
    assert numbers["Q000"] > 1
    assert list(numbers.values()) == sorted(numbers.values(), reverse=True)


@pytest.mark.usefixtures("workspace")
def test_severity_flag_hides_findings_but_counts_them(capsys: pytest.CaptureFixture[str]) -> None:
    _, lines = check(capsys, "--severity", "error", "robot")
    assert {line.split()[1] for line in findings(lines)} == {"error"}
    assert re.search(r"\d+ warnings", lines[-1])
    code, lines = check(capsys, "--severity", "error", "--ignore", "ND,MS,LY,TY", "robot")
    assert (code, findings(lines)) == (1, [])


@pytest.mark.usefixtures("workspace")
def test_severity_flag_without_effect_is_noted(capsys: pytest.CaptureFixture[str]) -> None:
    flags = ["check", "--no-types", "--severity", "error", "--format", "gitlab", "robot"]
    for _ in range(2):  # the second report is from the cache
        assert main(flags) == 1
        noted = capsys.readouterr().err.splitlines()
        assert noted == ["note: --severity has no effect: --format gitlab shows all findings"]


@pytest.mark.usefixtures("workspace")
def test_quiet_leaves_out_the_summary(capsys: pytest.CaptureFixture[str]) -> None:
    _, lines = check(capsys, "--quiet", "robot")
    assert lines == findings(lines) != []


@pytest.mark.usefixtures("workspace")
def test_exit_zero_flag(capsys: pytest.CaptureFixture[str]) -> None:
    code, lines = check(capsys, "--exit-zero", "robot")
    assert (code, bool(findings(lines))) == (0, True)


@pytest.mark.usefixtures("workspace")
def test_show_source_writes_source_lines_to_a_file(capsys: pytest.CaptureFixture[str]) -> None:
    _, lines = check(capsys, "--show-source", "robot")
    assert any(line.endswith('self.get_logger().warn_throttle(1, "late")') for line in lines)
