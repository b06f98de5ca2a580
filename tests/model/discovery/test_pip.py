"""Requirements files of a repository list what is installed with pip."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scaffold.cli.main import main

MANIFEST = (
    "<package format='3'><name>talker</name>"
    "<export><build_type>ament_python</build_type></export></package>\n"
)
NAME = "opencv-python-headless==4.8.0"
PROJECT = f'[project]\nname = "talker"\ndependencies = [\n    "numpy[extra]",\n    "{NAME}",\n]'


@pytest.mark.parametrize(
    ("requirements", "expected"),
    [
        ("requirements.txt", "warning"),
        (".devcontainer/requirements-dev.txt", "warning"),
        ("src/talker/python_requirements.txt", "warning"),
        ("src/talker/pyproject.toml", "warning"),
        ("docs/requirements.txt", "error"),
    ],
)
def test_requirements_of_the_repository(
    requirements: str, expected: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = tmp_path / "src" / "talker"
    files = {
        ".git/HEAD": "",
        requirements: f"{PROJECT if requirements.endswith('.toml') else NAME}\n",
        "src/talker/package.xml": MANIFEST,
        "src/talker/setup.py": "",
        "src/talker/talker/__init__.py": "",
        "src/talker/talker/node.py": "import cv2\n\nprint(cv2)\n",
    }
    for path, text in files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    main(["check", str(package), "--select", "PX020", "--format", "json"])
    (finding,) = json.loads(capsys.readouterr().out)["diagnostics"]
    assert finding["severity"] == expected
