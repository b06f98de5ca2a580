"""A package with findings of every kind, in a repository, as the tests of all formats see it."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from scaffold.cli.main import main
from tests.check.cache.test_results import make_package

ODD_NAME = "talker/a b,c%d:e.py"
"""A file whose name every format has to escape in its own way."""
FLAWED = '''"""Says hello."""

import os


def main():
    """Say it."""
    print("hällo")
'''


@pytest.fixture
def repository(own_cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a repository with ``src/talker``; it is the current directory."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    monkeypatch.delenv("GITHUB_STEP_SUMMARY", raising=False)
    top = tmp_path / "top"
    package = make_package(top / "src", "talker")
    (package / "talker" / "talk.py").write_text(FLAWED)
    (package / ODD_NAME).write_text('"""Odd."""\n\nimport os\n')
    (package / "resource" / "talker").unlink()
    subprocess.run(["git", "init", "-q", str(top)], check=True)
    monkeypatch.chdir(top)
    return top


@pytest.fixture
def check(repository: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., str]:
    """Return a function that checks the repository and returns what standard output gets."""

    def run(*words: str, code: int = 1) -> str:
        capsys.readouterr()
        assert main(["check", *(words or (str(repository),))]) == code
        return capsys.readouterr().out

    return run


@pytest.fixture
def diagnostics(check: Callable[..., str]) -> list[dict[str, Any]]:
    """Return the findings as the format ``json`` has them, which every other one has to hold."""
    result: list[dict[str, Any]] = json.loads(check("--format", "json"))["diagnostics"]
    return result
