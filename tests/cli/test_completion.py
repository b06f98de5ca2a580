"""Tab completion, tested through the protocol of the shells."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from scaffold.cli.main import main


def completions(line: str) -> list[str]:
    """Return the completions of a command line, through the protocol of argcomplete."""
    variables = {
        **os.environ,
        "_ARGCOMPLETE": "1",
        "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_SUPPRESS_SPACE": "1",
        "COMP_LINE": line,
        "COMP_POINT": str(len(line)),
        "PYTHONPATH": os.path.dirname(str(Path(__file__).parent.parent)),
    }
    done = subprocess.run(
        ["bash", "-c", f'exec "{sys.executable}" -m scaffold 8>&1 >/dev/null'],
        env=variables,
        capture_output=True,
        text=True,
        check=True,
    )
    return done.stdout.split("\n")


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("ros2-scaffold upd", ["update"]),
        ("ros2-scaffold new talker --build-type ament_p", ["ament_python"]),
        (
            "ros2-scaffold new talker --message-type sensor_msgs/msg/LaserS",
            ["sensor_msgs/msg/LaserScan"],
        ),
        ("ros2-scaffold new talker --message-type LaserS", ["LaserScan"]),
        ("ros2-scaffold new talker --qos sensor", ["sensor_data"]),
        ("ros2-scaffold new talker --add cpp_dequ", ["cpp_deque:"]),
        ("ros2-scaffold new talker --add 'timer:x r", ["timer:x rate="]),
        (
            "ros2-scaffold new talker --add 'publisher:x rate=5 message_type=LaserS",
            ["publisher:x rate=5 message_type=LaserScan"],
        ),
        ("ros2-scaffold new talker --extras dev", ["devcontainer"]),
        ("ros2-scaffold add cpp_dequ", ["cpp_deque"]),
        ("ros2-scaffold interfaces std_srvs/srv/Tri", ["std_srvs/srv/Trigger"]),
        ("ros2-scaffold rules import-und", ["import-undeclared"]),
        ("ros2-scaffold check --select PX,import-und", ["PX,import-undeclared"]),
        ("ros2-scaffold cache cl", ["clean"]),
        ("ros2-scaffold templates copy serial", ["serial_driver"]),
        ("ros2-scaffold new talker --content /nowhere --topi", ["--topic"]),
    ],
)
def test_completions(line: str, expected: list[str]) -> None:
    assert [word.strip() for word in completions(line)] == expected


def test_user_templates_are_completed_after_content_flag(tmp_path: Path) -> None:
    extra = tmp_path / "team" / "templates" / "extras" / "citation"
    extra.mkdir(parents=True)
    (extra / "template.yaml").write_text(
        "summary: A citation\nquestions:\n  year_of_paper: { default: 2026, help: when }\n"
    )
    team = tmp_path / "team"
    assert completions(f"ros2-scaffold new talker --content {tmp_path}/te") == [f"{team}/"]
    assert completions(f"ros2-scaffold templates list {tmp_path}/te") == [f"{team}/"]
    for words in (f"new talker --content {team} --extras cit", f"add --content {team} cit"):
        assert [word.strip() for word in completions(f"ros2-scaffold {words}")] == ["citation"]
    flag = completions(f"ros2-scaffold add citation --content={team} --year")
    assert [word.strip() for word in flag] == ["--year-of-paper"]


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_code_is_valid_in_each_shell(
    shell: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["completion", shell]) == 0
    code = capsys.readouterr().out
    assert "ros2-scaffold" in code
    program = shutil.which(shell)
    if program is None:
        pytest.skip(f"{shell} is not installed")
    script = tmp_path / "code"
    script.write_text(code)
    done = subprocess.run([program, "-n", str(script)], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
