"""The questions of `new` on a terminal: a real one, with somebody typing."""

from __future__ import annotations

import os
import shlex
import shutil
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from scaffold.cli.main import main

pexpect = pytest.importorskip("pexpect")
ENTER, DOWN, SPACE = "\r", "\x1b[B", " "


@pytest.fixture(autouse=True)
def _own_place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No setting of the machine reaches a test, and its files are its own."""
    for name in ("HOME", "XDG_CONFIG_HOME"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    monkeypatch.setenv("PROMPT_TOOLKIT_NO_CPR", "1")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parent.parent))
    monkeypatch.chdir(tmp_path)


class Terminal:
    """`new` on a terminal, and somebody who types."""

    def __init__(self) -> None:
        self.child = pexpect.spawn(
            sys.executable,
            ["-m", "scaffold", "new"],
            encoding="utf-8",
            timeout=30,
            dimensions=(40, 100),
        )

    def answer(self, question: str, text: str) -> None:
        """Wait for a question and type."""
        self.child.expect_exact(question)
        self.child.send(text)

    def says(self, text: str) -> None:
        """Wait for a text."""
        self.child.expect_exact(text)

    def end(self) -> tuple[str, int]:
        """Wait for the end; return what was said last, and the exit code."""
        self.child.expect(pexpect.EOF)
        self.child.close()
        return self.child.before.replace("\r\n", "\n"), self.child.exitstatus


@pytest.fixture
def terminal() -> Iterator[Terminal]:
    """Start `new`, and end it."""
    one = Terminal()
    yield one
    one.child.close(force=True)


def through_the_publisher(terminal: Terminal) -> None:
    """Answer what comes before the extras."""
    terminal.answer("Name of the new package:", "talker" + ENTER)
    terminal.answer("Build system:", DOWN + ENTER)
    terminal.answer("What is in the package?", "publisher" + ENTER)
    terminal.answer("Name of the node", "\x15speaker" + ENTER)
    terminal.answer("Topic to publish on:", "\x15chatter" + ENTER)
    terminal.answer("What to publish:", "\x15sensor_msgs/msg/Temperature" + ENTER)
    terminal.answer("Messages per second:", "\x155" + ENTER)
    terminal.answer("Quality of service", ENTER)
    terminal.answer("What else is in the package?", ENTER)


def rest(terminal: Terminal, mail: str = "ada@example.com") -> str:
    """Answer what comes after the parts; return what is said at the end."""
    terminal.answer("What to add besides:", ENTER)
    terminal.answer("What the package is for", "Speaks" + ENTER)
    terminal.answer("Licence of the package:", ENTER)
    terminal.answer("Who maintains the package:", "\x15Ada" + ENTER)
    terminal.answer("Mail address:", "\x15" + mail + ENTER)
    said, code = terminal.end()
    assert code == 0, said
    return said


def test_the_command_that_is_shown_does_the_same(
    terminal: Terminal, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    through_the_publisher(terminal)
    said = rest(terminal)
    command = said.rpartition("The same without questions:\n")[2].strip()
    assert shlex.split(command) == [
        "ros2-scaffold",
        "new",
        "talker",
        "--build-type",
        "ament_python",
        "--add",
        "publisher:speaker topic=chatter message_type=sensor_msgs/msg/Temperature rate=5",
        "--description",
        "Speaks",
        "--maintainer-name",
        "Ada",
        "--maintainer-email",
        "ada@example.com",
    ]
    made = tmp_path / "talker"
    asked = {path.relative_to(made): path.read_bytes() for path in made.rglob("*.*")}
    shutil.rmtree(made)
    assert main(shlex.split(command)[1:]) == 0
    capsys.readouterr()
    assert {path.relative_to(made): path.read_bytes() for path in made.rglob("*.*")} == asked


def test_answers_are_judged_while_they_are_typed(terminal: Terminal) -> None:
    terminal.answer("Name of the new package:", "Talker" + ENTER)
    terminal.answer("must be lower-case words", "\x15std_msgs" + ENTER)
    terminal.answer("existing", "\x15talker" + ENTER)
    terminal.says("Build system:")


def test_message_types_are_completed(terminal: Terminal) -> None:
    terminal.answer("Name of the new package:", "talker" + ENTER)
    terminal.answer("Build system:", ENTER)
    terminal.answer("What is in the package?", "publisher" + ENTER)
    terminal.answer("Name of the node", ENTER)
    terminal.answer("Topic to publish on:", ENTER)
    terminal.answer("What to publish:", "\x15LaserSc")
    terminal.says("sensor_msgs/msg/LaserScan")


def test_interrupted_nothing_is_written(terminal: Terminal, tmp_path: Path) -> None:
    terminal.answer("Name of the new package:", "talker" + ENTER)
    terminal.answer("Build system:", "\x03")
    terminal.says("interrupted")
    assert terminal.end()[1] == 130
    assert not (tmp_path / "talker").exists()


def test_without_a_terminal_the_name_is_needed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new"]) == 2
    assert "PACKAGE is needed: the name of the new package" in capsys.readouterr().err
