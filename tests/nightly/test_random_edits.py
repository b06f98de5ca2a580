"""A thousand random edits of real workspaces: cached results are never stale.

``SCAFFOLD_EDIT_BASES`` names directories of packages, separated by ``:``; they are copied first.
``SCAFFOLD_EDITS`` is the number of edits in each, ``SCAFFOLD_EDIT_SEED`` where they start.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from tests.check.cache.test_random_edits import Report, compare, make_workspace, report

__all__ = ["report"]

BASES = [base for base in os.environ.get("SCAFFOLD_EDIT_BASES", "").split(os.pathsep) if base]
COUNT = int(os.environ.get("SCAFFOLD_EDITS", "1000"))
SEED = int(os.environ.get("SCAFFOLD_EDIT_SEED", "1"))

pytestmark = [pytest.mark.nightly, pytest.mark.timeout(0)]


@pytest.mark.parametrize("base", BASES or [""])
def test_random_edits(
    tmp_path: Path,
    report: Report,
    base: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    top = tmp_path / "src"
    if base:
        shutil.copytree(base, top, symlinks=True, ignore=shutil.ignore_patterns(".git"))
    else:
        make_workspace(top)
    monkeypatch.chdir(top)
    assert compare(top, report, COUNT, SEED) > COUNT // 4
