"""Standard input replaces the content of a file, as editors check unsaved text."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests import PATIENCE

ROOT = Path(__file__).resolve().parents[2]
MANIFEST = """\
<package format="3">
  <name>talker</name>
  <exec_depend>rclpy</exec_depend>
</package>
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    root = tmp_path / "talker"
    (root / "talker").mkdir(parents=True)
    (root / "package.xml").write_text(MANIFEST)
    (root / "talker" / "__init__.py").touch()
    (root / "talker" / "node.py").write_text("import numpy\n")
    return root


def check(where: Path, text: str, *words: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, "-m", "scaffold", "check", *words],
        cwd=where,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        input=text,
        capture_output=True,
        check=False,
        encoding="utf-8",
        timeout=PATIENCE,
    )


def test_standard_input_replaces_the_file(package: Path) -> None:
    words = ("--stdin-filename", "talker/node.py", "--format", "json", "--select", "PX020,F401")
    run = check(package, "import std_msgs\n", *words, "-")
    findings = json.loads(run.stdout)["diagnostics"]
    assert {finding["path"] for finding in findings} == {"talker/node.py"}
    assert {finding["code"] for finding in findings} == {"PX020", "F401"}
    assert "std_msgs" in run.stdout
    assert "numpy" not in run.stdout
    assert run.returncode == 1
    assert (package / "talker" / "node.py").read_text() == "import numpy\n"


@pytest.mark.parametrize("name", ["talker/new.py", "package.xml", "../loose.py"])
def test_accepted_file_names(name: str, package: Path) -> None:
    text = MANIFEST.replace("rclpy", "rclpyy") if name == "package.xml" else "import os\n"
    run = check(package, text, "--stdin-filename", name)
    assert run.returncode == 1
    assert {line.partition(":")[0] for line in run.stdout.splitlines()[:-1]} == {name}


def test_fixed_text_goes_to_standard_output_alone(package: Path) -> None:
    before = {path: path.read_bytes() for path in package.rglob("*") if path.is_file()}
    text = "import os\nimport std_msgs.msg\n\nprint(std_msgs.msg.String) \n"
    run = check(package, text, "--fix", "--stdin-filename", "talker/node.py")
    assert run.stdout == "import std_msgs.msg\n\nprint(std_msgs.msg.String)\n"
    assert "PX020" in run.stderr
    assert run.returncode == 1
    assert {path: path.read_bytes() for path in package.rglob("*") if path.is_file()} == before


def test_text_without_fixes_is_printed_unchanged(package: Path) -> None:
    text = "x = '\u00e4'\r\n"
    run = subprocess.run(
        [sys.executable, "-m", "scaffold", "check", "--fix", "--stdin-filename", "a.py"],
        cwd=package,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        input=text.encode(),
        capture_output=True,
        check=False,
        timeout=PATIENCE,
    )
    assert run.stdout == text.encode()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("-",), "- means standard input: add --stdin-filename with the name of the file"),
        (("--stdin-filename", "a.py", "talker"), "--stdin-filename only works with standard input"),
        (("--stdin-filename", "a.py", "--diff"), "--diff cannot be combined with --stdin-filename"),
        (("--stdin-filename", "no/where.py"), "no/where.py: no such file or directory"),
        (("--stdin-filename", "talker"), "--stdin-filename talker: is a directory"),
        (("--stdin-filename", "/notes.txt"), "/notes.txt: belongs to no package and is not a Py"),
    ],
)
def test_invalid_usage_is_one_error_line(
    words: tuple[str, ...], message: str, package: Path
) -> None:
    run = check(package, "", *words)
    assert run.stderr.startswith(f"ros2-scaffold: error: {message}")
    assert run.stderr.count("\n") == 1
    assert run.returncode == 2
