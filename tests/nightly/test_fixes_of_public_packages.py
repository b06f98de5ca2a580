"""Public packages after ``check --fix``: no fixes left, no new ament findings, all files parse.

``SCAFFOLD_FIX_BASES`` names directories of packages, separated by ``:``; they are copied first.
"""

from __future__ import annotations

import os
import shutil
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

from scaffold.check.fixes.soundness import reader_of
from scaffold.cli.main import main
from scaffold.errors import ScaffoldError
from scaffold.files.disk import Disk
from scaffold.model.discovery import colcon
from scaffold.source import ViewError
from tests import oracles
from tests.oracles import Finding

pytestmark = pytest.mark.nightly

BASES = [base for base in os.environ.get("SCAFFOLD_FIX_BASES", "").split(os.pathsep) if base]
LINTERS: tuple[Callable[[Path], set[Finding]], ...] = (
    oracles.ament_flake8,
    oracles.ament_pep257,
    oracles.ament_lint_cmake,
    oracles.ament_xmllint,
)


@pytest.mark.skipif(not BASES, reason="SCAFFOLD_FIX_BASES names no packages")
@pytest.mark.parametrize("base", BASES)
@pytest.mark.parametrize("flags", [(), ("--unsafe-fixes",)], ids=["safe", "unsafe"])
def test_fix(tmp_path: Path, base: str, flags: tuple[str, ...]) -> None:
    root = tmp_path / "copy"
    shutil.copytree(base, root, symlinks=True, ignore=shutil.ignore_patterns(".git"))
    readable = {path for path in files(root) if is_readable(root, path)}
    before = findings(root)
    assert main(["check", "--fix", *flags, str(root)]) in {0, 1}
    after_once = content(root)
    assert readable - {path for path in files(root) if is_readable(root, path)} == set()
    grown = findings(root) - before
    assert grown == Counter()
    main(["check", "--fix", *flags, str(root)])
    after_twice = content(root)
    assert {path for path in after_once if after_twice.get(path) != after_once[path]} == set()


def findings(root: Path) -> Counter[tuple[str, str]]:
    """Count the findings of the linters by linter and file."""
    result: Counter[tuple[str, str]] = Counter()
    for directory in map(Path, colcon.package_directories(Disk(), str(root))):
        for linter in LINTERS:
            below = os.path.relpath(directory, root)
            result.update(
                (linter.__name__, f"{below}/{finding.path}") for finding in linter(directory)
            )
    return result


def files(root: Path) -> list[str]:
    """Return the readable files with a suffix."""
    paths = (path for path in root.rglob("*") if path.is_file())
    return [name for name in (str(path.relative_to(root)) for path in paths) if reader_of(name)]


def is_readable(root: Path, path: str) -> bool:
    """Return whether a file can be parsed."""
    read = reader_of(path)
    assert read
    try:
        read(path, (root / path).read_bytes().decode())
    except (SyntaxError, ValueError, RecursionError, ScaffoldError, ViewError):
        return False
    return True


def content(root: Path) -> dict[str, tuple[bytes, int]]:
    """Return all files with their modes."""
    paths = [path for path in root.rglob("*") if path.is_file()]
    return {str(path): (path.read_bytes(), path.stat().st_mode) for path in paths}
