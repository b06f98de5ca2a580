"""The interactive questions of `new`, answered on a real pseudo-terminal."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from scaffold.cli.interactive.answer_text import quoted
from scaffold.cli.main import main
from tests import PATIENCE

pexpect = pytest.importorskip("pexpect")
ENTER, DOWN, BACK = "\r", "\x1b[B", "<"
SHELLS = ("bash", "zsh", "fish")


@pytest.fixture(autouse=True)
def _isolated_directories(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Isolate a test from the user's settings, in a directory of its own."""
    for name in ("HOME", "XDG_CONFIG_HOME"):
        monkeypatch.setenv(name, str(tmp_path / "home"))
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv(
        "PYTHONPATH", os.path.dirname(os.path.dirname(str(Path(__file__).parent.parent)))
    )
    monkeypatch.chdir(tmp_path)


class Terminal:
    """A run of `new` on a pseudo-terminal, with methods to type and to read."""

    def __init__(self, *arguments: str, size: tuple[int, int] = (40, 100), **more: str) -> None:
        self.child = pexpect.spawn(
            sys.executable,
            ["-m", "scaffold", "new", *arguments],
            encoding="utf-8",
            timeout=PATIENCE,
            dimensions=size,
            env={**os.environ, **more},
        )

    def answer(self, question: str, text: str) -> None:
        """Wait for a question and type."""
        self.child.expect_exact(question)
        self.child.send(text)

    def says(self, text: str) -> None:
        """Wait for a text."""
        self.child.expect_exact(text)

    def end(self) -> tuple[str, int]:
        """Wait for the end; return the last output and the exit code."""
        self.child.expect(pexpect.EOF)
        self.child.close()
        return self.child.before.replace("\r\n", "\n"), self.child.exitstatus


@pytest.fixture
def start() -> Iterator[Callable[..., Terminal]]:
    """Return a function that starts `new` on a terminal of a given size; end it afterwards."""
    started: list[Terminal] = []

    def begin(*arguments: str, size: tuple[int, int] = (40, 100), **more: str) -> Terminal:
        started.append(Terminal(*arguments, size=size, **more))
        return started[-1]

    yield begin
    for item in started:
        item.child.close(force=True)


@pytest.fixture
def terminal(start: Callable[..., Terminal]) -> Terminal:
    """Start `new` without arguments."""
    return start()


def answer_publisher_questions(terminal: Terminal, then: str = ENTER) -> None:
    """Answer the questions before the extras, for a publisher."""
    terminal.answer("Name of the new package:", "talker" + ENTER)
    terminal.answer("Build system:", DOWN + ENTER)
    terminal.answer("What is in the package?", "publisher" + ENTER)
    terminal.answer("Name of the node", "\x15speaker" + ENTER)
    terminal.answer("Topic to publish on", "\x15chatter" + ENTER)
    terminal.answer("Type of the published messages:", "\x15sensor_msgs/msg/Temperature" + ENTER)
    terminal.answer("Messages per second", "\x155" + ENTER)
    terminal.answer("Quality of service", ENTER)
    terminal.answer("What else is in the package?", then)


def answer_remaining_questions(terminal: Terminal, mail: str = "ada@example.com") -> str:
    """Answer the questions after the parts; return the last output."""
    terminal.answer("What else to add:", ENTER)
    terminal.answer("What the package is for", "Speaks" + ENTER)
    terminal.answer("License of the package:", ENTER)
    terminal.answer("Who maintains the package:", "\x15Ada" + ENTER)
    terminal.answer("Email address:", "\x15" + mail + ENTER)
    terminal.answer("Write the package?", ENTER)
    output, code = terminal.end()
    assert code == 0, output
    return output


def test_shown_command_creates_the_same_package(
    terminal: Terminal, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    answer_publisher_questions(terminal)
    output = answer_remaining_questions(terminal)
    command = command_in(output)
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
    assert_same(command, tmp_path / "talker")
    capsys.readouterr()


def test_questions_for_interfaces_and_programs(
    start: Callable[..., Terminal], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    terminal = start("--build-type", "ament_cmake")
    terminal.answer("new package:", "robot_interfaces" + ENTER)
    terminal.answer("What is in the package?", "message" + ENTER)
    terminal.answer("Name of the new type:", "\x15Scan" + ENTER)
    terminal.answer("Fields of the message", "\x15float64 range; string unit 'm'" + ENTER)
    terminal.answer("What else is in the package?", "service" + ENTER)
    terminal.answer("Name of the new type:", ENTER)
    terminal.answer("Fields of the request", '\x15Scan scan  # a "first" one' + ENTER)
    terminal.answer("Fields of the response", ENTER)
    terminal.answer("What else is in the package?", "timer")
    terminal.answer("no match for 'timer'", "\x15cpp_sets" + ENTER)
    terminal.answer("Name of the", ENTER)
    terminal.answer("What else is in the package?", ENTER)
    command = command_in(answer_remaining_questions(terminal))
    assert_same(command, tmp_path / "robot_interfaces")
    capsys.readouterr()


def command_in(said: str) -> str:
    """Return the command that is shown at the end."""
    return said.rpartition("The same as a command:\n")[2].strip()


def assert_same(command: str, made: Path) -> None:
    """Fail if a command writes something else than what is there."""
    asked = {path.relative_to(made): path.read_bytes() for path in made.rglob("*.*")}
    shutil.rmtree(made)
    assert main(shlex.split(command)[1:]) == 0
    assert {path.relative_to(made): path.read_bytes() for path in made.rglob("*.*")} == asked


def test_answers_are_validated_while_typing(terminal: Terminal) -> None:
    terminal.answer("Name of the new package:", "Talker" + ENTER)
    terminal.says("must be lower-case words")
    terminal.answer("Name of the new package:", "\x15std_msgs" + ENTER)
    terminal.says("existing")
    terminal.answer("Name of the new package:", "\x15talker" + ENTER)
    terminal.says("Build system:")


def test_message_types_are_completed(terminal: Terminal) -> None:
    terminal.answer("Name of the new package:", "talker" + ENTER)
    terminal.answer("Build system:", ENTER)
    terminal.answer("What is in the package?", "publisher" + ENTER)
    terminal.answer("Name of the node", ENTER)
    terminal.answer("Topic to publish on", ENTER)
    terminal.answer("Type of the published messages:", "\x15LaserSc")
    terminal.says("sensor_msgs/msg/LaserScan")


@pytest.mark.parametrize("key", ["\x03", "\x04"], ids=["interrupted", "closed"])
@pytest.mark.parametrize("questions", [0, 1, 8])
def test_interrupted_run_writes_nothing(
    terminal: Terminal, tmp_path: Path, questions: int, key: str
) -> None:
    asked = ["new package:", "Build system:", "What is in", "Name of the node", "Topic to"]
    asked += ["Type of the published", "Messages per", "Quality of", "What else", "else to add"]
    for question, text in zip(asked[:questions], ["talker", *[""] * questions], strict=False):
        terminal.answer(question, text + ENTER)
    terminal.answer(asked[questions], key)
    terminal.says("ros2-scaffold: interrupted")
    assert terminal.end() == ("\n", 130)
    assert not (tmp_path / "talker").exists()


@pytest.mark.parametrize("size", [(10, 40), (24, 60)])
def test_validation_message_is_shown_in_full(
    start: Callable[..., Terminal], size: tuple[int, int]
) -> None:
    terminal = start(size=size)
    terminal.answer("new package:", "Talker" + ENTER)
    lines: list[str] = []
    while not lines or not lines[-1].endswith("talker"):
        terminal.child.expect_exact("\n")
        line = re.sub(r"\x1b\[[\d;?]*[a-zA-Z]", "", terminal.child.before).replace("\r", "")
        lines += [line] if line.startswith("  ") else []
    assert max(map(len, lines)) < size[1]
    assert " ".join(map(str.strip, lines)) == (
        "the package name 'Talker' must be lower-case words of letters and digits joined by single "
        "underscores, starting with a letter, such as talker"
    )


def test_text_without_a_match_selects_nothing(terminal: Terminal) -> None:
    terminal.answer("new package:", "talker" + ENTER)
    terminal.answer("Build system:", "pyton")
    terminal.answer("no match for 'pyton'", ENTER + "\x15setuptools" + ENTER)
    terminal.says("Build system: ament_python")


def test_exact_match_is_listed_first(terminal: Terminal) -> None:
    terminal.answer("new package:", "talker_msgs" + ENTER)
    terminal.answer("Build system:", ENTER)
    terminal.answer("What is in the package?", "service" + ENTER)
    terminal.says("Name of the new type")


def test_existing_directory_is_rejected_immediately(terminal: Terminal, tmp_path: Path) -> None:
    (tmp_path / "talker").mkdir()
    terminal.answer("new package:", "talker" + ENTER)
    terminal.says("talker already exists")
    terminal.answer("new package:", "\x15speaker" + ENTER)
    terminal.says("Build system:")


def test_conflicting_parts_are_asked_for_again(terminal: Terminal) -> None:
    terminal.answer("new package:", "talker" + ENTER)
    terminal.answer("Build system:", ENTER)
    terminal.answer("What is in the package?", "publisher_subscriber" + ENTER)
    terminal.answer("Name of the node", ENTER)
    terminal.answer("Topic to subscribe to", "\x15chatter" + ENTER)
    terminal.answer("Topic to publish on", "\x15chatter" + ENTER)
    terminal.answer("Type of the published messages:", ENTER)
    terminal.answer("Type of the received messages (default: the published type):", ENTER)
    terminal.answer("Quality of service", ENTER)
    terminal.answer("Quality of service of the subscription", ENTER)
    terminal.says("both '/chatter'")
    terminal.answer("What is in the package?", "timer" + ENTER)
    terminal.answer("Name of the node", ENTER)
    terminal.answer("Calls per second", ENTER)
    terminal.answer("What else is in the package?", "timer" + ENTER)
    terminal.answer("minimal_timer_2", "\x15minimal_timer" + ENTER)
    terminal.says("the package already has minimal_timer")


def test_type_of_a_topic_is_asked_once(terminal: Terminal) -> None:
    answer_publisher_questions(terminal, "subscriber" + ENTER)
    terminal.answer("Name of the node", ENTER)
    terminal.answer("Topic to subscribe to", "\x15/chatter" + ENTER)
    terminal.says("sensor_msgs/msg/Temperature")


def test_pasted_lines_are_one_answer(terminal: Terminal) -> None:
    terminal.answer("new package:", "\x1b[200~tal\nker\n\x1b[201~" + ENTER)
    terminal.says("'tal ker'")


def test_going_back_to_an_earlier_question(terminal: Terminal) -> None:
    terminal.answer("new package:", "talker" + ENTER)
    terminal.answer("Build system:", ENTER)
    terminal.answer("What is in the package?", "timer" + ENTER)
    terminal.answer("Name of the node", "\x15clock" + ENTER)
    terminal.answer("Calls per second", BACK)
    terminal.answer("Name of the node", "")
    terminal.answer("clock", BACK)
    terminal.answer("What is in the package?", "\x15publisher" + ENTER)
    terminal.answer("Name of the node", ENTER)
    terminal.answer("Topic to publish on", "\x15chatter" + ENTER)
    terminal.answer("Type of the published messages:", ENTER)
    terminal.answer("Messages per second", ENTER)
    terminal.answer("Quality of service", ENTER)
    terminal.answer("What else is in the package?", BACK)
    terminal.answer("Quality of service", BACK)
    terminal.answer("Messages per second", "2" + BACK + ENTER)  # an edited line needs enter
    terminal.answer("Type of the published messages:", "\x15LaserScan" + ENTER)
    terminal.answer("Messages per second", ENTER)
    terminal.answer("Quality of service", ENTER)
    terminal.answer("What else is in the package?", ENTER)
    words = shlex.split(command_in(answer_remaining_questions(terminal)))
    assert words[words.index("--add") + 1] == (
        "publisher:minimal_publisher topic=chatter message_type=LaserScan"
    )


def test_going_back_from_the_first_question_does_nothing(terminal: Terminal) -> None:
    terminal.answer("new package:", BACK)
    terminal.answer("new package:", "talker" + ENTER)
    terminal.says("Build system:")


def test_qos_is_chosen_from_a_menu(terminal: Terminal) -> None:
    terminal.answer("new package:", "talker" + ENTER)
    terminal.answer("Build system:", ENTER)
    terminal.answer("What is in the package?", "publisher_subscriber" + ENTER)
    for question in (
        "Name of",
        "Topic to sub",
        "Topic to pub",
        "Type of the published",
        "Type of the rec",
    ):
        terminal.answer(question, ENTER)
    terminal.says("Quality of service:")
    terminal.says("sensor_data")
    terminal.says("best effort")
    terminal.answer("settings such as", "sensor" + ENTER)
    terminal.answer("Quality of service of the subscription:", "other" + ENTER)
    terminal.answer("Depth, profile or settings:", "reliably" + ENTER)
    terminal.says("neither a depth")
    terminal.answer("Depth, profile or settings:", "\x15best_effort,depth=1" + ENTER)
    terminal.answer("What else is in the package?", ENTER)
    words = shlex.split(command_in(answer_remaining_questions(terminal)))
    assert words[words.index("--add") + 1].split()[1:] == [
        "qos=sensor_data",
        "input_qos=best_effort,depth=1",
    ]


def test_kinds_are_listed_in_groups(terminal: Terminal) -> None:
    terminal.answer("new package:", "talker" + ENTER)
    terminal.answer("Build system:", ENTER)
    terminal.says("What is in the package?")
    for heading_or_kind in ("topics", "publisher", "services and actions", "service_server"):
        terminal.says(heading_or_kind)
    for heading_or_kind in ("transforms", "tf2_listener", "interfaces", "C++ programs"):
        terminal.says(heading_or_kind)


def test_files_are_previewed_before_writing(terminal: Terminal, tmp_path: Path) -> None:
    answer_publisher_questions(terminal)
    terminal.answer("What else to add:", ENTER)
    terminal.answer("What the package is for", ENTER)
    terminal.answer("License of the package:", ENTER)
    terminal.answer("Who maintains the package:", "\x15Ada" + ENTER)
    terminal.answer("Email address:", "\x15ada@example.com" + ENTER)
    terminal.says("test_speaker.py")
    terminal.answer("Write the package?", "change" + ENTER)
    assert not (tmp_path / "talker").exists()
    terminal.answer("Email address:", "\x15eve@example.com" + ENTER)
    terminal.answer("Write the package?", ENTER)
    output, code = terminal.end()
    assert code == 0, output
    assert "eve@example.com" in (tmp_path / "talker" / "package.xml").read_text()


def test_stop_after_the_preview_writes_nothing(start: Callable[..., Terminal]) -> None:
    known = ("--node-kind", "timer", "--maintainer-name", "Ada", "--maintainer-email", "a@x.org")
    terminal = start(*known, "--description", "Ticks", "--extras", "ci", "--license", "MIT")
    terminal.answer("new package:", "talker" + ENTER)
    terminal.answer("Build system:", ENTER)
    terminal.answer("Write the package?", "stop" + ENTER)
    terminal.says("ros2-scaffold: interrupted")
    assert terminal.end() == ("\n", 130)
    assert not os.path.exists("talker")


def test_empty_description_gives_the_shown_default(
    start: Callable[..., Terminal], tmp_path: Path
) -> None:
    terminal = start(size=(40, 200))
    answer_publisher_questions(terminal)
    terminal.answer("What else to add:", ENTER)
    terminal.says("default: A ROS 2 package with the publisher node speaker")
    terminal.child.send(ENTER)
    terminal.answer("License of the package:", ENTER)
    terminal.answer("Who maintains the package:", "\x15Ada" + ENTER)
    terminal.answer("Email address:", "\x15ada@example.com" + ENTER)
    terminal.answer("Write the package?", ENTER)
    assert terminal.end()[1] == 0
    manifest = (tmp_path / "talker" / "package.xml").read_text()
    assert "<description>A ROS 2 package with the publisher node speaker</description>" in manifest


def test_dumb_terminal_takes_choices_by_name(
    start: Callable[..., Terminal], tmp_path: Path
) -> None:
    terminal = start(TERM="dumb")
    terminal.answer("new package:", "talker\n")
    terminal.answer("Build system: [ament_cmake]", "setuptools\n")
    terminal.answer("'setuptools' is not in the list above", "ament_python\n")
    terminal.answer("What is in the package? [publisher]", "timer\n")
    terminal.answer("executable: [minimal_timer]", "<\n")
    terminal.answer("What is in the package? [timer]", "\n")
    terminal.answer("executable: [minimal_timer]", "\n")
    terminal.answer("per second: [2.0]", "\n")
    terminal.answer("What else is in the package? [nothing more]", "\n")
    terminal.answer("What else to add", "launch gitignore\n")
    terminal.answer("What the package is for", "\n")
    terminal.answer("License of the package: [Apache-2.0]", "MIT\n")
    terminal.answer("Who maintains the package:", "Ada\n")
    terminal.answer("Email address:", "ada@example.com\n")
    terminal.answer("Write the package? [write]", "\n")
    output, code = terminal.end()
    assert code == 0, output
    assert "\x1b" not in output
    assert "--extras gitignore launch --license MIT" in output
    assert (tmp_path / "talker" / "launch" / "talker.launch.py").exists()


def test_unencodable_characters_are_escaped(start: Callable[..., Terminal]) -> None:
    known = ("--node-kind", "timer", "--maintainer-name", "Zo\xeb", "--maintainer-email", "z@x.org")
    terminal = start(*known, "--description", "Ticks", PYTHONIOENCODING="ascii:strict")
    terminal.answer("new package:", "talker" + ENTER)
    terminal.answer("Build system:", ENTER)
    terminal.answer("What else to add:", ENTER)
    terminal.answer("License of the package:", ENTER)
    terminal.answer("Write the package?", ENTER)
    output, code = terminal.end()
    assert code == 0, output
    assert "--maintainer-name 'Zo\\xeb'" in output


def test_shown_command_includes_given_flags(start: Callable[..., Terminal], tmp_path: Path) -> None:
    terminal = start("--destination-directory", "a b", "--license", "MIT", "--qos", "latched")
    answer_publisher_questions(terminal)
    terminal.answer("What else to add:", ENTER)
    terminal.answer("What the package is for", "-x `y` $z \"a\" 'b' \\\\ !" + ENTER)
    terminal.answer("Who maintains the package:", "\x15O'Brien" + ENTER)
    terminal.answer("Email address:", "\x15ada@example.com" + ENTER)
    terminal.answer("Write the package?", ENTER)
    output, code = terminal.end()
    assert code == 0, output
    command = command_in(output)
    made = tmp_path / "a b" / "talker"
    asked = {path.relative_to(made): path.read_bytes() for path in made.rglob("*.*")}
    (tmp_path / "bin").mkdir()
    program = tmp_path / "bin" / "ros2-scaffold"
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m scaffold "$@"\n')
    program.chmod(0o755)
    path = f"{program.parent}{os.pathsep}{os.environ['PATH']}"
    for shell in filter(shutil.which, SHELLS):
        shutil.rmtree(made)
        subprocess.run([shell, "-c", command], check=True, env={**os.environ, "PATH": path})
        assert {item.relative_to(made): item.read_bytes() for item in made.rglob("*.*")} == asked


@pytest.mark.parametrize("shell", SHELLS)
def test_quoted_words_survive_each_shell(shell: str) -> None:
    if shutil.which(shell) is None:
        pytest.skip(f"{shell} is not installed")
    words = [
        "",
        "a b",
        "'",
        "\\",
        "\\\\'",
        "it's \\' $HOME `id` $(id)",
        "~/x",
        "=ls",
        "a\nb",
        "{a,b}",
    ]
    words += [
        "*",
        "%self",
        "!!",
        "#x",
        '"',
        "é\u202f日",
        "a;b&c|d<e>f",
        "-n",
        "~",
        "[x]",
        "^a",
        "--x=~",
    ]
    command = "printf '%s\\0' " + " ".join(map(quoted, words))
    done = subprocess.run([shell, "-c", command], capture_output=True, check=True)
    assert done.stdout.decode().split("\0")[:-1] == words


def test_name_is_required_without_a_terminal(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new"]) == 2
    assert "PACKAGE is required: the name of the new package" in capsys.readouterr().err
