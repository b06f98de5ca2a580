"""The status line that shows progress on a terminal."""

from __future__ import annotations

import io
import re
import sys
import time

import pytest

from scaffold import columns
from scaffold.cli.status_line import StatusLine


class Screen(io.StringIO):
    """A terminal of unknown width that records its output."""

    def isatty(self) -> bool:
        return True

    @property
    def drawn(self) -> list[str]:
        """The texts written between erasures of the line."""
        return self.getvalue().split("\r\033[K")[1:]


def redirect_stderr(patch: pytest.MonkeyPatch) -> Screen:
    """Redirect standard error to a terminal until the end of the test; return it."""
    screen = Screen()
    patch.setattr(sys, "stderr", screen)  # pytest sets its own one after each fixture
    return screen


def test_long_line_is_cut_and_erased(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = redirect_stderr(monkeypatch)
    with StatusLine() as status:
        status.show("building " + "package_" * 40)
    line, last = screen.drawn
    assert re.fullmatch(r"building (package_)+\w*\.\.\. 0:00", line)
    assert columns.columns(line) < columns.USUAL
    assert last == ""


def test_announcements_stay_above_the_line(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = redirect_stderr(monkeypatch)
    with StatusLine() as status:
        status.show("building")
        status.announce("a \x1b[2J is shown")
    assert screen.drawn == [
        "building 0:00", "ros2-scaffold: a \\x1b[2J is shown\n", "building 0:00", "",
    ]  # fmt: skip


def test_line_shows_elapsed_time(monkeypatch: pytest.MonkeyPatch) -> None:
    screen = redirect_stderr(monkeypatch)
    monkeypatch.setattr("scaffold.cli.status_line._PERIOD", 0.01)
    now = time.monotonic()
    monkeypatch.setattr("time.monotonic", lambda: now)
    with StatusLine() as status:
        status.show("building")
        now += 3723
        while "building 1:02:03" not in screen.drawn:
            time.sleep(0.01)


def test_file_gets_only_announcements(capsys: pytest.CaptureFixture[str]) -> None:
    with StatusLine() as status:
        status.show("building")
        status.announce("done")
    assert capsys.readouterr().err == "ros2-scaffold: done\n"
