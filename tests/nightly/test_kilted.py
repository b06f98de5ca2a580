"""Packages of each kind on ROS 2 Kilted, from wheels: ``nox --session kilted``.

The wheels of two distributions cannot be in one environment, so this runs in one of its own.
"""

from __future__ import annotations

import json
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest

from scaffold.cli.main import main
from scaffold.configuration import content
from scaffold.generate.templates import loading, template
from scaffold.generate.templates.template import Role
from scaffold.programs import wheels

DISTRO = "kilted"
TEMPLATES = loading.load(content.roots("templates"))
LACKING = ("cv_bridge", "diagnostic_updater", "message_filters", "nav2_simple_commander", "tf2_ros")
"""What no wheel has, of Jazzy neither; the kinds of nodes that need it are left out."""
KINDS = [
    kind
    for kind in template.of_role(TEMPLATES, Role.NODE)
    if not {*LACKING} & {*TEMPLATES[kind].depends.get("exec", ())}
]
PERSON = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.com")

pytestmark = [
    pytest.mark.nightly,
    pytest.mark.timeout(0),
    pytest.mark.skipif(
        wheels.of(sys.prefix) != DISTRO,
        reason="not in an environment with the wheels of Kilted; `nox --session kilted` makes one",
    ),
]


def new(package: str, *arguments: str) -> None:
    assert main(["new", package, "--distro", DISTRO, *PERSON, *arguments]) == 0


def parts(*kinds: str) -> list[str]:
    return [word for kind in kinds for word in ("--add", f"{kind}:{kind}_node")]


def smoke_report(*arguments: str) -> Any:  # noqa: ANN401  as JSON has it
    """Run ``smoke`` on the packages in the current directory; return the report."""
    main(["smoke", *arguments, "--format", "json", "--output-file", "report.json"])
    return json.loads(Path("report.json").read_text())


@pytest.mark.parametrize("name", LACKING)
def test_omitted_libraries_are_not_installed(name: str) -> None:
    assert find_spec(name) is None


@pytest.mark.parametrize("build_type", ["ament_python", "ament_cmake"])
def test_nodes_of_every_kind_run(
    build_type: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    new("nodes", "--build-type", build_type, *parts(*KINDS))
    report = smoke_report("nodes", "--signal", "both")
    assert report["ok"], json.dumps(report, indent=2)
    assert report["environment"]["distribution"] == DISTRO
    (package,) = report["packages"]
    assert len(package["executables"]) == len(KINDS)


def test_interfaces_and_programs_build_and_the_tests_of_a_package_pass(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    new("things", "--add", "message:Speed", "--add", "service:Switch", "--add", "action:Drive")
    new("maps", "--add", "cpp_maps:maps")
    new("talker", "--build-type", "ament_python")
    report = smoke_report(".", "--test")
    assert report["ok"], json.dumps(report, indent=2)


def test_other_distribution_is_rejected_with_a_fix(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    new("talker")
    assert main(["smoke", "talker", "--distro", "lyrical"]) == 2
    message = capsys.readouterr().err
    assert "is ROS 2 Kilted" in message
    assert "docker run" in message
