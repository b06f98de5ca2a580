"""Exit codes and the one line that goes with them, with real processes and real devices."""

from __future__ import annotations

import ast
import os
import re
import signal
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

import pytest

from scaffold.check.parallel import WORTH_WORKERS
from scaffold.cli import exit_codes
from scaffold.cli.verbs import VERBS
from tests import PATIENCE

ROOT = Path(__file__).resolve().parents[2]
TOOL = [sys.executable, "-m", "scaffold"]
NO_SPACE = "No space left on device"


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A package in which `check` finds something."""
    top = tmp_path_factory.mktemp("exit_codes")
    subprocess.run([*TOOL, "new", "talker"], cwd=top, check=True, capture_output=True)
    manifest = top / "talker" / "package.xml"
    manifest.write_text(manifest.read_text().replace("Apache-2.0", "TODO"))
    return top / "talker"


def shell(
    script: str, where: Path, *words: str, variables: Mapping[str, str | None] | None = None
) -> subprocess.CompletedProcess[str]:
    """Run a line of bash in which ``tool`` is the tool, and ``$1`` ... are words."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    for name, value in (variables or {}).items():
        if value is None:
            environment.pop(name, None)
        else:
            environment[name] = value
    tool = f'tool() {{ {sys.executable} -m scaffold "$@"; }}\n'
    return subprocess.run(
        ["bash", "-c", tool + script, "bash", *words],
        cwd=where,
        env=environment,
        check=False,
        capture_output=True,
        encoding="utf-8",
        timeout=PATIENCE,
    )


def test_the_table_of_the_docs_has_every_code() -> None:
    table = (ROOT / "docs" / "exit-codes.md").read_text()
    documented = {int(code) for code in re.findall(r"^\| (\d+) \|", table, re.MULTILINE)}

    assert documented == {value for name, value in vars(exit_codes).items() if name.isupper()}


def test_the_codes_are_numbers_in_one_module_only() -> None:
    tree = [ast.parse(path.read_text()) for path in (ROOT / "scaffold" / "cli").glob("*.py")]
    returned = [
        node.value.value
        for module in tree
        for node in ast.walk(module)
        if isinstance(node, ast.Return) and isinstance(node.value, ast.Constant)
    ]

    assert not {1, 2, 3} & {value for value in returned if type(value) is int}


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize(
    "words",
    [
        ["check", "."],
        ["check", "--format", "json", "."],
        ["check", "--fix", "--select", "PX001", "."],
        ["rules"],
        ["rules", "PX001"],
        ["templates"],
        ["interfaces"],
        ["completion", "bash"],
        ["update", "--dry-run", "."],
        ["add", "timer", "ticker", "--diff"],
        ["new", "other", "--dry-run", "--destination-directory", ".."],
        ["--version"],
        ["--help"],
        ["check", "--help"],
    ],
    ids=" ".join,
)
def test_a_full_device(package: Path, words: Sequence[str], unbuffered: str) -> None:
    run = shell(
        'tool "$@" > /dev/full', package, *words, variables={"PYTHONUNBUFFERED": unbuffered}
    )

    errors = [line for line in run.stderr.splitlines() if line.startswith("ros2-scaffold:")]
    assert errors == [f"ros2-scaffold: error: standard output: {NO_SPACE}"]
    assert run.returncode == exit_codes.USAGE_ERROR
    assert "Exception" not in run.stderr


def test_a_closed_output_is_said_before_anything_is_written(package: Path, tmp_path: Path) -> None:
    for words in (["check", str(package)], ["new", "made"], ["rules"], ["--version"]):
        run = shell('tool "$@" >&-', tmp_path, *words)

        assert run.returncode == exit_codes.USAGE_ERROR
        assert run.stderr == (
            "ros2-scaffold: error: standard output is closed: redirect it to /dev/null instead\n"
        )
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("where", ["2>&-", "2>/dev/full", ">&- 2>&-", "<&- >&- 2>&-"])
def test_an_error_that_nobody_can_read_keeps_its_code(tmp_path: Path, where: str) -> None:
    assert shell(f"tool check nowhere {where}", tmp_path).returncode == exit_codes.USAGE_ERROR
    assert shell(f"tool check --no-flag {where}", tmp_path).returncode == exit_codes.USAGE_ERROR


@pytest.mark.parametrize("where", ["2>&-", "2>/dev/full", "<&-"])
def test_a_verdict_does_not_depend_on_other_streams(package: Path, where: str) -> None:
    run = shell(f"tool check . {where}", package)

    assert run.returncode == exit_codes.FINDINGS
    assert "PX001" in run.stdout


def test_no_file_is_opened_in_place_of_a_closed_stream(tmp_path: Path) -> None:
    run = shell("tool new made <&- 2>&-", tmp_path)

    assert run.returncode == exit_codes.CLEAN
    assert shell("tool check made", tmp_path).returncode == exit_codes.CLEAN


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize(
    "words",
    [["check", "."], ["rules"], ["interfaces"], ["--help"], ["new", "made", "--dry-run"]],
    ids=" ".join,
)
def test_a_broken_pipe_is_never_a_clean_end(
    package: Path, tmp_path: Path, words: Sequence[str], unbuffered: str
) -> None:
    os.mkfifo(tmp_path / "pipe")
    # The reader is there when the writer opens the pipe, and gone before anything is written.
    script = 'exec 3<>"$1"; exec 4>"$1"; exec 3<&-; shift; tool "$@" >&4; echo $? >&2'
    where = package if words[0] == "check" else tmp_path
    variables = {"PYTHONUNBUFFERED": unbuffered}
    run = shell(script, where, str(tmp_path / "pipe"), *words, variables=variables)

    *notes, code = run.stderr.splitlines()
    assert code == str(exit_codes.BROKEN_PIPE)
    assert all(line.startswith("note: ") for line in notes)


@pytest.mark.parametrize("verb", sorted({*VERBS} - {"completion"}))
def test_a_removed_directory(tmp_path: Path, verb: str) -> None:
    script = 'mkdir gone && cd gone && rmdir ../gone && tool "$@"'
    more = {"add": ["timer", "x"], "migrate": ["--to", "lyrical"], "new": ["made"]}.get(verb, [])
    run = shell(script, tmp_path, verb, *more)

    assert run.stderr == ("ros2-scaffold: error: the current directory no longer exists\n")
    assert run.returncode == exit_codes.USAGE_ERROR


@pytest.mark.parametrize("home", [None, "/nonexistent", "/dev/null", ""])
def test_a_home_that_cannot_be_used(package: Path, home: str | None) -> None:
    variables = {"HOME": home, "XDG_CACHE_HOME": None, "XDG_CONFIG_HOME": None}
    run = shell("tool check .", package, variables=variables)

    assert (run.returncode, run.stderr) == (exit_codes.FINDINGS, "")


def test_no_place_for_scratch_files_is_one_line_at_most(package: Path) -> None:
    run = shell("tool check .", package, variables={"TMPDIR": "/nonexistent"})

    assert (run.returncode, run.stderr) == (exit_codes.FINDINGS, "")


@pytest.mark.parametrize(
    "words",
    [
        ("check", "--fix", "talker"),
        ("add", "timer", "beat", "--package-directory", "talker"),
        ("new", "listener"),
    ],
)
def test_a_read_only_file_system(words: Sequence[str], package: Path, tmp_path: Path) -> None:
    namespace = ["unshare", "--map-root-user", "--mount"]
    try:
        subprocess.run([*namespace, "mount", "-t", "tmpfs", "x", tmp_path], check=True)
    except (OSError, subprocess.CalledProcessError):
        pytest.skip("needs to mount a file system")
    script = (
        'mount -t tmpfs x "$1" && cp -r "$2" "$1" && mount -o remount,ro "$1" && cd "$1" && '
        'shift 2 && exec "$@"'
    )
    (package / "talker" / "untidy.py").write_text("X = 1 \n")
    run = subprocess.run(
        [*namespace, "bash", "-c", script, "bash", tmp_path, package, *TOOL, *words],
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        check=False,
        capture_output=True,
        encoding="utf-8",
        timeout=PATIENCE,
    )
    (package / "talker" / "untidy.py").unlink()

    (line,) = [line for line in run.stderr.splitlines() if "error: " in line]
    assert line.endswith(" cannot be written: Read-only file system; nothing was written")
    assert "Traceback" not in run.stderr
    assert run.returncode == exit_codes.USAGE_ERROR


def test_an_encoding_that_lacks_letters(tmp_path: Path) -> None:
    run = shell("tool check t\u00e4lker", tmp_path, variables={"PYTHONIOENCODING": "ascii"})

    assert run.stderr == "ros2-scaffold: error: t\\xe4lker: no such file or directory\n"
    assert run.returncode == exit_codes.USAGE_ERROR


def test_control_c(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "answers.yaml")
    run = subprocess.Popen(
        [*TOOL, "new", "made", "--answers", "answers.yaml"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        stderr=subprocess.PIPE,
        encoding="utf-8",
    )
    with open(tmp_path / "answers.yaml", "w", encoding="utf-8"):
        run.send_signal(signal.SIGINT)
        _, error = run.communicate(timeout=PATIENCE)

    assert error == "ros2-scaffold: interrupted\n"
    assert run.returncode == exit_codes.INTERRUPTED
    assert not (tmp_path / "made").exists()


SIGNALS_ITSELF = """
import os, signal, sys

class Finder:
    def find_spec(self, name, path=None, target=None):
        if name == os.environ["AT_MODULE"]:
            del sys.meta_path[0]
            os.kill(os.getpid(), int(os.environ["SIGNAL"]))

sys.meta_path.insert(0, Finder())
"""
"""What Python imports at its start: it gets a signal when a certain module is imported."""


def signaled(at: str, number: signal.Signals, where: Path) -> subprocess.CompletedProcess[str]:
    (where / "sitecustomize.py").write_text(SIGNALS_ITSELF)
    return subprocess.run(
        [*TOOL, "check", "."],
        cwd=where,
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join([str(where / "."), str(ROOT)]),
            "AT_MODULE": at,
            "SIGNAL": str(int(number)),
        },
        check=False,
        capture_output=True,
        encoding="utf-8",
        timeout=PATIENCE,
    )


IMPORTED = (
    "scaffold.cli.main",
    "scaffold.check.cache.runs",
    "scaffold.cli.terminal",
    "scaffold.cli.parser",
    "scaffold.cli.verbs.check",
    "scaffold.check.rules.registry",
)
"""Modules of a run of `check`, from the first one on."""


@pytest.mark.parametrize("module", IMPORTED)
def test_control_c_while_modules_are_imported(module: str, tmp_path: Path) -> None:
    run = signaled(module, signal.SIGINT, tmp_path)

    assert (run.stdout, run.stderr) == ("", "ros2-scaffold: interrupted\n")
    assert run.returncode == exit_codes.INTERRUPTED


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_other_signals_end_it_without_a_word(number: signal.Signals, tmp_path: Path) -> None:
    run = signaled(IMPORTED[0], number, tmp_path)

    assert (run.returncode, run.stdout, run.stderr) == (-number, "", "")


INTERRUPTING_RULE = """
import os, signal
from scaffold.api import Example, Rule

class Interrupting(Rule):
    \"\"\"Somebody presses Ctrl-C: every process of the terminal gets it.\"\"\"

    code = "XX900"
    name = "interrupting"
    examples = (Example("none", {"package.xml": ""}),)

    def check(self, package):
        if os.getpid() != os.getpgrp():  # in a worker
            os.killpg(0, signal.SIGINT)
        yield from ()
"""


@pytest.mark.skipif(len(os.sched_getaffinity(0)) == 1, reason="needs two processors")
def test_control_c_in_a_workspace_is_one_line(tmp_path: Path) -> None:
    for number in range(40):
        (tmp_path / "src" / f"p{number}").mkdir(parents=True)
        (tmp_path / "src" / f"p{number}" / "package.xml").write_text(
            f'<package format="3"><name>p{number}</name></package>\n'
        )
        (tmp_path / "src" / f"p{number}" / "large.py").write_text("#\n" * (WORTH_WORKERS // 40))
    (tmp_path / "own" / "rules" / "area").mkdir(parents=True)
    (tmp_path / "own" / "rules" / "area" / "interrupting.py").write_text(INTERRUPTING_RULE)
    run = subprocess.run(
        [*TOOL, "check", "--content", "own", "--select", "XX900", "src"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        check=False,
        capture_output=True,
        encoding="utf-8",
        timeout=PATIENCE,
        start_new_session=True,
    )

    assert (run.stdout, run.stderr) == ("", "ros2-scaffold: interrupted\n")
    assert run.returncode == exit_codes.INTERRUPTED
