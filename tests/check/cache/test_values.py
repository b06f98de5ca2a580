"""The caches of values by key, such as style findings, stay small."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold.ament.backend import StyleCheck
from scaffold.files import cache, values
from scaffold.files.tree import MemoryTree
from scaffold.model.package import Package


def test_style_findings_of_old_files_are_dropped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    monkeypatch.delenv(cache.SWITCH, raising=False)
    monkeypatch.setattr(values, "MAX_ENTRIES", 8)
    files = {f"talker/part_{number}.py": f"PART = {number}\n" for number in range(10)}
    package = Package(
        MemoryTree({"package.xml": "<package><name>talker</name></package>\n", **files})
    )
    StyleCheck([package]).diagnostics(package)
    assert len([*tmp_path.rglob("styles/*")]) == 6
