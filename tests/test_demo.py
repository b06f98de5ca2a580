"""The commands of ``make demo`` on a minimal machine: no git, no CMake, no compiler."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests import PATIENCE

MAKEFILE = Path(__file__).parent.parent / "Makefile"
ABSENT = re.compile(
    r"git|cmake|ninja|colcon|ament|python|(.*-)?(cc|gcc|g\+\+|c\+\+|clang)(\W|\d|$)"
)


@pytest.mark.build
def test_demo_runs_without_optional_programs(tmp_path: Path) -> None:
    commands = re.findall(r"(?m)^\t\$\(RUN\) (.+)$", MAKEFILE.read_text())
    assert [command.split()[0] for command in commands] == ["new", "check", "smoke"]

    programs = tmp_path / "bin"
    link_programs(programs)
    output = [run(command.split(), tmp_path, programs) for command in commands]

    assert output[1].endswith("no findings\n")
    assert re.search(r"/chatter +std_msgs/msg/String +1 publisher +\d+\.\d+ Hz", output[2])
    assert "warning" not in output[2]
    assert "exit code 0" in output[2]


def link_programs(directory: Path) -> None:
    """Link the programs of the system into a directory, except those that may be missing."""
    directory.mkdir()
    for source in (Path("/bin"), Path("/usr/bin")):
        for program in source.iterdir():
            link = directory / program.name
            if not ABSENT.match(program.name) and not link.is_symlink():
                link.symlink_to(program)


def run(arguments: list[str], directory: Path, programs: Path) -> str:
    done = subprocess.run(
        [os.path.join(sys.prefix, "bin", "ros2-scaffold"), *arguments],
        cwd=directory,
        env={"HOME": str(directory), "PATH": str(programs)},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout
