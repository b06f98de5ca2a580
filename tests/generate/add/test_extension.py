"""`add` appends fields to an existing message, service or action."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from scaffold.cli.main import main


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Write a package with a message and a service, and work in it."""
    new = ["new", "rover_interfaces", "--add", 'message:Speed fields="float64 value  # m/s"']
    person = ["--maintainer-name", "Ada", "--maintainer-email", "ada@example.com"]
    where = ["--destination-directory", str(tmp_path)]
    assert main([*new, "--add", "service:SetSpeed", *person, *where]) == 0
    monkeypatch.chdir(tmp_path / "rover_interfaces")
    return Path()


def files(package: Path) -> dict[str, bytes]:
    """Return all files of a package."""
    return {str(path): path.read_bytes() for path in package.rglob("*") if path.is_file()}


def test_fields_and_constants_are_appended(package: Path) -> None:
    message = package / "msg" / "Speed.msg"
    message.write_text("# How fast\n\nfloat64 value  # m/s\n")
    wanted = ["geometry_msgs/Vector3 acceleration", "uint8 FAST=1"]
    assert main(["add", "message", "Speed", "--fields", *wanted]) == 0
    assert message.read_text().splitlines() == ["# How fast", "", "float64 value  # m/s", *wanted]
    assert "<depend>geometry_msgs</depend>" in (package / "package.xml").read_text()
    assert "  DEPENDENCIES geometry_msgs\n" in (package / "CMakeLists.txt").read_text()
    assert main(["check"]) == 0
    before = files(package)
    assert main(["add", "message", "Speed", "--fields", *reversed(wanted)]) == 0
    assert files(package) == before
    assert main(["update"]) == 0
    assert files(package) == before


def test_fields_are_appended_to_their_section_of_a_service(package: Path) -> None:
    service = package / "srv" / "SetSpeed.srv"
    request, _, response = service.read_text().partition("---\n")
    assert main(["add", "service", "SetSpeed", "--request", "float64 limit"]) == 0
    assert main(["add", "service", "SetSpeed", "--response", "float64 reached"]) == 0
    text = f"{request}float64 limit\n---\n{response}float64 reached\n"
    assert service.read_text() == text


def test_line_endings_are_kept(package: Path) -> None:
    message = package / "msg" / "Speed.msg"
    message.write_bytes(b"float64 value\r\n")
    assert main(["add", "message", "Speed", "--fields", "bool is_valid"]) == 0
    assert message.read_bytes() == b"float64 value\r\nbool is_valid\r\n"


@pytest.mark.parametrize("line", ["float32 value", "float64 value 1.0"])
def test_duplicate_field_is_rejected(
    package: Path, capsys: pytest.CaptureFixture[str], line: str
) -> None:
    before = files(package)
    assert main(["add", "message", "Speed", "--fields", line]) == 2
    assert "msg/Speed.msg has 'value' already, as 'float64 value" in capsys.readouterr().err
    assert files(package) == before


def test_extending_a_message_requires_fields(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = files(package)
    assert main(["add", "message", "Speed"]) == 2
    assert f"msg{os.sep}Speed.msg" in capsys.readouterr().err
    assert files(package) == before
