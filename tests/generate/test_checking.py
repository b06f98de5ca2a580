"""The check of a draft, with rules loaded ahead in a second process and without."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from scaffold.check.rules import registry
from scaffold.configuration import content
from scaffold.generate import checking, draft
from scaffold.generate.checking import Check, RuleProcess
from scaffold.generate.draft import Draft
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import loading
from scaffold.generate.templates.render import Rendered


@pytest.fixture
def process() -> Iterator[RuleProcess]:
    """Return a process that loads the rules."""
    process = RuleProcess()
    yield process
    process.close()


def made(*, is_faulty: bool = False, distro: str = "jazzy") -> Draft:
    """Return a draft; a faulty one has a style finding and a rule finding."""
    roots = content.roots("templates")
    answers = {"maintainer_name": "Ada", "maintainer_email": "ada@example.com"}
    answers |= {"package": "pack", "distro": distro}
    given = {name: Given(value, "test") for name, value in answers.items()}
    result = draft.draft(roots, loading.load(roots), given, User("."))
    if not is_faulty:
        return result
    faults = {"String()": "String( )", "super().__init__(": "super().__init__()  # ("}
    files = dict(result.rendered.files)
    for right, wrong in faults.items():
        files = {path: text.replace(right, wrong) for path, text in files.items()}
    rendered = Rendered(files, result.rendered.executable, result.rendered.notes)
    return result._replace(rendered=rendered)


def test_good_draft_has_no_findings(process: RuleProcess) -> None:
    assert Check(made(), process).end() == []


@pytest.mark.parametrize("distro", ["jazzy", "humble,jazzy"])
def test_findings_equal_those_of_a_single_process(process: RuleProcess, distro: str) -> None:
    faulty = made(is_faulty=True, distro=distro)
    alone = checking.defects(faulty, registry.load(content.roots("rules")))
    together = Check(faulty, process).end()
    assert together == alone
    assert {item.code[:2] for item in alone} >= {"E2", "ND"}


def test_killed_rule_process_does_not_change_findings(process: RuleProcess) -> None:
    faulty = made(is_faulty=True)
    expected = Check(faulty).end()
    check = Check(faulty, process)
    os.kill(process.number, signal.SIGKILL)
    assert check.end() == expected != []


def test_no_process_is_forked_while_threads_run(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("threading.active_count", lambda: 2)
    with checking.ahead() as process:
        assert process is None


@pytest.mark.parametrize("words", [["pack"], ["no good name"], ["--unknown"]])
def test_new_leaves_no_process_running(tmp_path: Path, words: list[str]) -> None:
    command = [sys.executable, "-m", "scaffold", "new", *words, "--maintainer-name", "Ada"]
    command += ["--maintainer-email", "ada@example.com"]
    with subprocess.Popen(
        command,
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        start_new_session=True,
    ) as run:
        assert run.stdout is not None
        run.stdout.read()  # until the last process has closed it
        run.wait()
    with pytest.raises(ProcessLookupError):
        os.killpg(run.pid, 0)


def test_interrupted_new_leaves_no_process_running(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "scaffold", "new", "pack"]
    with subprocess.Popen(command, cwd=tmp_path, start_new_session=True) as run:
        time.sleep(0.1)
        run.send_signal(signal.SIGTERM)
        run.wait()
    deadline = time.monotonic() + 30
    while time.monotonic() < deadline:
        try:
            os.killpg(run.pid, 0)
        except ProcessLookupError:
            return
        time.sleep(0.01)
    pytest.fail("a process is left")
