"""Errors in code that nobody runs are warnings."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scaffold.cli.main import main

MANIFEST = """<?xml version="1.0"?>
<package format="3">
  <name>talker</name>
  <version>0.1.0</version>
  <description>An example</description>
  <maintainer email="ann@example.com">Ann</maintainer>
  <license>Apache-2.0</license>
  <exec_depend>std_msgs</exec_depend>
{}  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""
SETUP = """from setuptools import find_packages, setup

setup(name='talker', version='0.1.0', packages=find_packages(exclude=['test']))
"""
MISTAKE = "from std_msgs.msg import String\n\nString().text\n"
UNDEFINED = "print(undefined)\n"


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    for path, text in {
        "package.xml": MANIFEST.format(""),
        "setup.py": SETUP,
        "talker/__init__.py": "",
    }.items():
        write(tmp_path / path, text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def write(path: Path, text: str) -> None:
    path.parent.mkdir(exist_ok=True)
    path.write_text(text)


def severities(capsys: pytest.CaptureFixture[str], code: str) -> dict[str, str]:
    main(["check", "--no-types", "--format", "json", "--select", code])
    found = json.loads(capsys.readouterr().out)["diagnostics"]
    return {item["path"]: item["severity"] for item in found}


@pytest.mark.parametrize("name", ["node_old.py", "node copy.py", "old_node.py", "node.bak.py"])
def test_a_copy_of_old_code(package: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    for path in (name, "node.py", "threshold.py"):
        write(package / "talker" / path, MISTAKE)
    assert severities(capsys, "MS002") == {
        f"talker/{name}": "warning",
        "talker/node.py": "error",
        "talker/threshold.py": "error",
    }


@pytest.mark.parametrize(
    ("path", "text"),
    [("talker/main.py", "from talker import node_old\n"), ("run.sh", "python3 node_old.py\n")],
)
def test_a_copy_that_something_names_is_in_use(
    package: Path, capsys: pytest.CaptureFixture[str], path: str, text: str
) -> None:
    write(package / "talker" / "node_old.py", MISTAKE)
    write(package / path, text)
    assert severities(capsys, "MS002") == {"talker/node_old.py": "error"}


def test_files_that_are_not_installed(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path in ("scratch.py", "notes/plot.py", "talker/node.py", "test/test_node.py"):
        write(package / path, UNDEFINED)
    assert severities(capsys, "F821") == {
        "scratch.py": "warning",
        "notes/plot.py": "warning",
        "talker/node.py": "error",
        "test/test_node.py": "error",
    }


def test_a_linter_of_the_package_looks_at_all_files(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(package / "scratch.py", UNDEFINED)
    depend = "  <test_depend>ament_flake8</test_depend>\n"
    write(package / "package.xml", MANIFEST.format(depend))
    test = "from ament_flake8.main import main\n\n\ndef test_flake8():\n    assert main([]) == 0\n"
    write(package / "test" / "test_flake8.py", test)
    assert severities(capsys, "F821") == {"scratch.py": "error"}


def test_what_the_configuration_says_counts(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(package / "scratch.py", UNDEFINED)
    write(package / "ros2-scaffold.toml", "[check.severity]\nF821 = 'info'\n")
    assert severities(capsys, "F821") == {"scratch.py": "info"}
