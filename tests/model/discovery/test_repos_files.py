"""Packages fetched by ``vcs import`` are known names."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scaffold.cli.main import main

REPOS = "repositories:\n  core/ue_msgs:\n    type: git\n    url: https://example.org/x.git\n"


@pytest.mark.parametrize(
    ("repos", "expected"),
    [("arm.repos", 0), (".github/arm.jazzy.repos", 0), ("arm.yaml", 2), ("docs/arm.repos", 2)],
)
def test_packages_in_repos_files_are_known(
    repos: str, expected: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = {
        ".git/HEAD": "",
        repos: REPOS,
        "arm/package.xml": "<package format='3'><name>arm</name><depend>ue_msgs</depend></package>",
        "arm/CMakeLists.txt": "find_package(ue_msgs REQUIRED)\n",
    }
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    main(["check", str(tmp_path / "arm"), "--select", "PX022,CM023", "--format", "json"])
    assert len(json.loads(capsys.readouterr().out)["diagnostics"]) == expected
