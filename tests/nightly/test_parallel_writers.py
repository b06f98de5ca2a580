"""Parallel runs in one package, and edits by another process during a run."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import time
from pathlib import Path
from random import Random

import pytest

from scaffold.cli.main import main
from scaffold.writing.transaction import RECORD
from tests import PATIENCE

pytestmark = [pytest.mark.nightly, pytest.mark.timeout(0)]

TOOL = [sys.executable, "-m", "scaffold"]
PERSON = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.com")
EDITS = int(os.environ.get("SCAFFOLD_EDITS", "40"))
SEED = int(os.environ.get("SCAFFOLD_EDIT_SEED", "1"))


@pytest.fixture
def package(tmp_path: Path) -> Path:
    assert main(["new", "talker", "--destination-directory", str(tmp_path), *PERSON]) == 0
    return tmp_path / "talker"


@pytest.mark.parametrize("_", range(3))
def test_twenty_parallel_adds(_: int, package: Path) -> None:
    names = [f"beat_{number}" for number in range(20)]
    command = [*TOOL, "add", "timer"]
    processes = [
        subprocess.Popen(
            [*command, name, "--package-directory", str(package)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        for name in names
    ]
    errors = [process.communicate(timeout=PATIENCE)[1] for process in processes]
    assert [process.returncode for process in processes] == [0] * len(names), errors
    for path in ("CMakeLists.txt", "README.md", RECORD):
        text = (package / path).read_text()
        assert [name for name in names if name not in text] == []
    assert {f"{name}.py" for name in names} <= {path.name for path in package.rglob("*.py")}
    subprocess.run([*TOOL, "check", package], check=True, stdout=subprocess.DEVNULL)


def test_edits_during_a_fix_are_kept(package: Path, tmp_path: Path) -> None:
    for number in range(8):
        (package / "talker" / f"untidy_{number}.py").write_text("X = 1 \nY = 2 \n")
    started = time.monotonic()
    place = tmp_path / "place" / "talker"
    shutil.copytree(package, place)
    subprocess.run([*TOOL, "check", "--fix", place], check=False, capture_output=True)
    length = time.monotonic() - started
    chosen = Random(SEED)  # noqa: S311  it must be repeatable
    lost: list[str] = []
    codes: set[int] = set()
    for number in range(EDITS):
        shutil.rmtree(place)
        shutil.copytree(package, place)
        process = subprocess.Popen(
            [*TOOL, "check", "--fix", place], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        pause = chosen.uniform(0, length)
        time.sleep(pause)
        path = chosen.choice(sorted(place.rglob("untidy_*.py")))
        edit = f"EDIT_{number} = 3\n"
        with path.open("a") as file:
            file.write(edit)
        codes.add(process.wait(timeout=PATIENCE))
        if edit not in path.read_text():
            lost.append(f"{path.name} after {pause:.3f} s")
    assert not lost, f"seed {SEED}"
    assert codes <= {0, 1, 2}
