"""Exit codes and their one-line messages, with real processes and devices."""

from __future__ import annotations

import ast
import os
import re
import shutil
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


def test_documentation_lists_every_exit_code() -> None:
    table = (ROOT / "docs" / "exit-codes.md").read_text()
    documented = {int(code) for code in re.findall(r"^\| (\d+) \|", table, re.MULTILINE)}

    assert documented == {value for name, value in vars(exit_codes).items() if name.isupper()}


def test_exit_codes_are_defined_in_one_module() -> None:
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
def test_full_device_is_reported(package: Path, words: Sequence[str], unbuffered: str) -> None:
    run = shell(
        'tool "$@" > /dev/full', package, *words, variables={"PYTHONUNBUFFERED": unbuffered}
    )

    errors = [line for line in run.stderr.splitlines() if line.startswith("ros2-scaffold:")]
    assert errors == [f"ros2-scaffold: error: standard output: {NO_SPACE}"]
    assert run.returncode == exit_codes.USAGE_ERROR
    assert "Exception" not in run.stderr


def test_closed_output_is_reported_before_writing_files(package: Path, tmp_path: Path) -> None:
    for words in (["check", str(package)], ["new", "made"], ["rules"], ["--version"]):
        run = shell('tool "$@" >&-', tmp_path, *words)

        assert run.returncode == exit_codes.USAGE_ERROR
        assert run.stderr == (
            "ros2-scaffold: error: standard output is closed: redirect it to /dev/null instead\n"
        )
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("where", ["2>&-", "2>/dev/full", ">&- 2>&-", "<&- >&- 2>&-"])
def test_exit_code_is_kept_when_stderr_is_closed(tmp_path: Path, where: str) -> None:
    assert shell(f"tool check nowhere {where}", tmp_path).returncode == exit_codes.USAGE_ERROR
    assert shell(f"tool check --no-flag {where}", tmp_path).returncode == exit_codes.USAGE_ERROR


@pytest.mark.parametrize("where", ["2>&-", "2>/dev/full", "<&-"])
def test_exit_code_does_not_depend_on_stdin_and_stderr(package: Path, where: str) -> None:
    run = shell(f"tool check . {where}", package)

    assert run.returncode == exit_codes.FINDINGS
    assert "PX001" in run.stdout


def test_no_file_takes_the_descriptor_of_a_closed_stream(tmp_path: Path) -> None:
    run = shell("tool new made <&- 2>&-", tmp_path)

    assert run.returncode == exit_codes.CLEAN
    assert shell("tool check made", tmp_path).returncode == exit_codes.CLEAN


@pytest.mark.parametrize("unbuffered", ["", "1"])
@pytest.mark.parametrize(
    "words",
    [["check", "."], ["rules"], ["interfaces"], ["--help"], ["new", "made", "--dry-run"]],
    ids=" ".join,
)
def test_broken_pipe_is_never_exit_code_0(
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
def test_removed_current_directory_is_reported(tmp_path: Path, verb: str) -> None:
    script = 'mkdir gone && cd gone && rmdir ../gone && tool "$@"'
    more = {"add": ["timer", "x"], "migrate": ["--to", "lyrical"], "new": ["made"]}.get(verb, [])
    run = shell(script, tmp_path, verb, *more)

    assert run.stderr == ("ros2-scaffold: error: the current directory no longer exists\n")
    assert run.returncode == exit_codes.USAGE_ERROR


@pytest.mark.parametrize("home", [None, "/nonexistent", "/dev/null", ""])
def test_unusable_home_is_silent(package: Path, home: str | None) -> None:
    variables = {"HOME": home, "XDG_CACHE_HOME": None, "XDG_CONFIG_HOME": None}
    run = shell("tool check .", package, variables=variables)

    assert (run.returncode, run.stderr) == (exit_codes.FINDINGS, "")


def test_missing_temporary_directory_is_at_most_one_line(package: Path) -> None:
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
def test_read_only_file_system_is_reported(
    words: Sequence[str], package: Path, tmp_path: Path
) -> None:
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
    assert "no findings" not in run.stdout
    assert "Traceback" not in run.stderr
    assert run.returncode == exit_codes.USAGE_ERROR


def test_output_encoding_without_some_characters(tmp_path: Path) -> None:
    run = shell("tool check t\u00e4lker", tmp_path, variables={"PYTHONIOENCODING": "ascii"})

    assert run.stderr == "ros2-scaffold: error: t\\xe4lker: no such file or directory\n"
    assert run.returncode == exit_codes.USAGE_ERROR


def test_control_c_ends_the_run_with_one_line(tmp_path: Path) -> None:
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


def run_with_signal(
    at: str, number: signal.Signals, where: Path, **variables: str
) -> subprocess.CompletedProcess[str]:
    (where / "sitecustomize.py").write_text(SIGNALS_ITSELF)
    return subprocess.run(
        [*TOOL, "check", "."],
        cwd=where,
        env={
            **os.environ,
            "PYTHONPATH": os.pathsep.join([str(where / "."), str(ROOT)]),
            "AT_MODULE": at,
            "SIGNAL": str(int(number)),
            **variables,
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
    run = run_with_signal(module, signal.SIGINT, tmp_path)

    assert (run.stdout, run.stderr) == ("", "ros2-scaffold: interrupted\n")
    assert run.returncode == exit_codes.INTERRUPTED


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_other_signals_end_the_run_silently(number: signal.Signals, tmp_path: Path) -> None:
    run = run_with_signal(IMPORTED[0], number, tmp_path)

    assert (run.returncode, run.stdout, run.stderr) == (-number, "", "")


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
def test_other_signals_leave_no_temporary_files(
    number: signal.Signals, package: Path, tmp_path: Path
) -> None:
    scratch = tmp_path / "scratch"
    scratch.mkdir()
    shutil.copytree(package, tmp_path / "talker")

    # The type checker has its files by then.
    run = run_with_signal("scaffold.ament.xml.xmllint", number, tmp_path, TMPDIR=str(scratch))

    assert (run.returncode, run.stdout, run.stderr) == (-number, "", "")
    assert [*scratch.iterdir()] == []


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
