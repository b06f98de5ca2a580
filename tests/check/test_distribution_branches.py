"""Branches for other distributions: what is in them is right where it runs."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.distributions import named, targeting
from scaffold.model.cmake.distribution_branches import lines_not_run
from scaffold.model.package import Package

_NODE = """\
import os

from rclpy.node import Node

distro = os.environ.get('ROS_DISTRO', '').lower()


class Talker(Node):
    def talk(self):
        if {}:
            self.get_logger().warn('here')
        {}
            self.get_logger().warn('there')
"""


def found(
    capsys: pytest.CaptureFixture[str], package: Path, distro: str
) -> list[tuple[str, int, list[str]]]:
    """Return code, line and distributions of what was removed."""
    main(["check", str(package), "--distro", distro, "--format", "json", "--select", "IM050,CM110"])
    diagnostics = json.loads(capsys.readouterr().out)["diagnostics"]
    return [(item["code"], item["line"], item["distributions"]) for item in diagnostics]


@pytest.mark.parametrize(
    ("condition", "lines"),
    [
        ("distro == 'jazzy'", [13]),
        ("'lyrical' == os.environ['ROS_DISTRO']", [11]),
        ("distro in ('humble', 'jazzy') or distro == 'iron'", [13]),
        ("os.getenv('ROS_DISTRO') not in ['humble', 'jazzy']", [11]),
        ("'ROS_DISTRO' in os.environ and not distro == 'humble'", [11]),
        ("self.is_old and distro != 'lyrical'", [13]),
        ("self.is_old or distro == 'humble'", []),
        ("self.is_old", [11, 13]),
    ],
)
def test_python(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], condition: str, lines: list[int]
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    (tmp_path / "talker.py").write_text(_NODE.format(condition, "else:"))
    expected = [("IM050", line, ["lyrical"]) for line in lines]
    assert found(capsys, tmp_path, "lyrical") == expected


def test_several_distributions_and_a_chain(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    path = tmp_path / "talker.py"
    path.write_text(_NODE.format("distro == 'jazzy'", "elif distro == 'rolling':"))
    assert found(capsys, tmp_path, "jazzy,lyrical") == []
    assert found(capsys, tmp_path, "jazzy,rolling") == [("IM050", 13, ["rolling"])]


def test_a_suppression_in_another_branch_is_not_unused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    text = _NODE.format("distro == 'jazzy'", "else:")
    (tmp_path / "talker.py").write_text(text.replace("'here')", "'here')  # noqa: IM050"))
    arguments = ["check", str(tmp_path), "--select", "SC003,IM050", "--format", "json"]
    for distro, count in (("jazzy", 1), ("lyrical", 0), ("jazzy,lyrical", 0)):
        main([*arguments, "--distro", distro])
        codes = [item["code"] for item in json.loads(capsys.readouterr().out)["diagnostics"]]
        assert codes.count("SC003") == count


_LISTS = """\
project(talker)
if({})
  one()
elseif(WIN32)
  two()
else()
  three()
endif()
"""


@pytest.mark.parametrize(
    ("condition", "lines"),
    [
        ('$ENV{ROS_DISTRO} STREQUAL "jazzy"', [(3, 3)]),
        ('"$ENV{ROS_DISTRO}" STREQUAL lyrical', [(5, 5), (7, 7)]),
        ("$ENV{ROS_DISTRO} MATCHES humble OR ($ENV{ROS_DISTRO} MATCHES jazzy)", [(3, 3)]),
        ('DEFINED ENV{ROS_DISTRO} AND NOT $ENV{ROS_DISTRO} MATCHES "^l"', [(3, 3)]),
        ('WIN32 AND "$ENV{ROS_DISTRO}" STREQUAL "jazzy"', [(3, 3)]),
        ('WIN32 OR "$ENV{ROS_DISTRO}" STREQUAL "jazzy"', []),
        ('$ENV{ROS_DISTRO} MATCHES "*"', []),
    ],
)
def test_cmake(condition: str, lines: list[tuple[int, int]]) -> None:
    package = Package.of({"CMakeLists.txt": _LISTS.format(condition)})
    with targeting(named("lyrical")):
        assert list(lines_not_run(package.cmake)) == lines


def test_a_command_in_a_branch_for_older_distributions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    (tmp_path / "CMakeLists.txt").write_text(
        "project(talker)\n"
        "if($ENV{ROS_DISTRO} STREQUAL jazzy)\n"
        "  ament_target_dependencies(talker rclcpp)\n"
        "else()\n"
        "  ament_target_dependencies(talker std_msgs)\n"
        "endif()\n"
        "add_subdirectory(src)\n"
    )
    (tmp_path / "src").mkdir()
    text = (tmp_path / "CMakeLists.txt").read_text()
    (tmp_path / "src" / "CMakeLists.txt").write_text(f"# the same, a line below\n{text}")
    removed = [("CM110", line, ["lyrical"]) for line in (5, 6)]
    assert found(capsys, tmp_path, "lyrical") == removed
