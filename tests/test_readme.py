"""The commands in the README print what the README shows.

A ``console`` block holds commands after ``$`` and their output, in which ``...`` stands for the
rest of a line, or alone for any lines. The blocks are one session: each command goes on where
those before it ended. Of what is measured only the form is compared.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

import pytest

from tests import PATIENCE

README = Path(__file__).parent.parent / "README.md"


class Step(NamedTuple):
    command: str
    output: str

    @property
    def is_slow(self) -> bool:
        return "ros2-scaffold smoke" in self.command


def read_steps(text: str) -> list[Step]:
    steps = []
    for block in re.findall(r"(?ms)^```console\n(.*?)^```$", text):
        for part in re.split(r"(?m)^\$ ", block)[1:]:
            command, _, output = part.partition("\n")
            steps.append(Step(command, output))
    return steps


STEPS = read_steps(README.read_text())


class Session:
    """A shell session in one directory; each step runs once, after all steps before it."""

    def __init__(self, directory: Path) -> None:
        self.directory = directory
        self.outputs: dict[int, str] = {}

    def output(self, wanted: int) -> str:
        """Return what a step prints; slow steps before it are skipped."""
        for index, step in enumerate(STEPS[: wanted + 1]):
            if index not in self.outputs and (index == wanted or not step.is_slow):
                self.outputs[index] = run(step.command, self.directory)
        return self.outputs[wanted]


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> Session:
    return Session(tmp_path_factory.mktemp("session"))


@pytest.mark.parametrize(
    "index",
    [
        pytest.param(index, id=step.command, marks=[pytest.mark.build] if step.is_slow else [])
        for index, step in enumerate(STEPS)
    ],
)
def test_output_of_step(index: int, session: Session) -> None:
    assert_same(session.output(index), STEPS[index])


def test_all_verbs_are_shown() -> None:
    shown = {step.command.split()[1] for step in STEPS if step.command.startswith("ros2-scaffold")}
    assert shown >= {"new", "add", "update", "check", "rules", "templates", "smoke"}


def run(command: str, directory: Path) -> str:
    """Return what a terminal of somebody whom git knows shows."""
    path = os.pathsep.join([os.path.join(sys.prefix, "bin"), os.environ["PATH"]])
    identity = {"user.name": "Ada Lovelace", "user.email": "ada@example.org"}
    git = {"GIT_CONFIG_COUNT": str(len(identity))}
    for index, (key, value) in enumerate(identity.items()):
        git |= {f"GIT_CONFIG_KEY_{index}": key, f"GIT_CONFIG_VALUE_{index}": value}
    done = subprocess.run(
        ["sh", "-c", command],
        cwd=directory,
        env={**os.environ, **git, "PATH": path, "PYTHONUNBUFFERED": "1", "LC_ALL": "C.UTF-8"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    return done.stdout


def assert_same(output: str, step: Step) -> None:
    text = without_figures(output) if step.is_slow else output
    shown = without_figures(step.output) if step.is_slow else step.output
    pattern = "".join(
        r"(?:.*\n)*" if line == "...\n" else re.escape(line).replace(r"\.\.\.", ".*")
        for line in shown.splitlines(keepends=True)
    )
    assert re.fullmatch(pattern, text), f"README.md shows:\n{step.output}\nbut it is:\n{output}"


def without_figures(text: str) -> str:
    return re.sub(r"\d+(?:\.\d+)?", "0", text)
