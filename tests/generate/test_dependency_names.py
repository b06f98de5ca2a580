"""Dependencies given by the user: misspelled ones are rejected before rendering."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.errors import InputError
from scaffold.generate.dependency_names import notes
from tests.model.workspace.test_rosdep import write_cache


@pytest.fixture(autouse=True)
def _no_ros_environment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    monkeypatch.setenv("ROS_HOME", str(tmp_path / "ros_home"))


def error_of(name: str, directory: Path) -> str:
    with pytest.raises(InputError) as caught:
        list(notes([name], "--dependencies", str(directory)))
    return str(caught.value)


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("rclpyy", "rclpy"),
        ("rclp", "rclpy"),
        ("tf3", "tf2"),
        ("python3-opencvv", "python3-opencv"),
        ("sensor-msgs", "sensor_msgs"),
        ("sensor_msg", "sensor_msgs"),
    ],
)
def test_misspelled_dependency_is_rejected(name: str, meant: str, tmp_path: Path) -> None:
    message = error_of(name, tmp_path)

    assert message.startswith(f"--dependencies: there is no package or rosdep key {name!r}; did")
    assert repr(meant) in message


@pytest.mark.parametrize("name", ["rclpy", "std_msgs", "python3-numpy", "cv_bridge"])
def test_known_dependencies_are_accepted(name: str, tmp_path: Path) -> None:
    assert list(notes([name], "--dependencies", str(tmp_path))) == []


@pytest.mark.parametrize("name", ["turtlebot4_msgs", "acme_tools", "python3-pip", "libxyz-dev"])
def test_unknown_dependency_is_noted(name: str, tmp_path: Path) -> None:
    (line,) = notes([name], "--dependencies", str(tmp_path))

    assert line.startswith(f"{name!r} is not a package of the workspace")


def test_ros_1_package_is_rejected_with_its_successor(tmp_path: Path) -> None:
    assert error_of("rospy", tmp_path).endswith("is from ROS 1; ROS 2 has rclpy instead")


def test_package_of_the_workspace_is_accepted(tmp_path: Path) -> None:
    assert main(["new", "rclpyy", "--destination-directory", str(tmp_path)]) == 0

    assert list(notes(["rclpyy"], "--dependencies", str(tmp_path))) == []
    words = ["new", "talker", "--dependencies", "rclpyy"]
    assert main([*words, "--destination-directory", str(tmp_path)]) == 0


def test_installed_package_is_accepted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    share = tmp_path / "install" / "share" / "rclpyy"
    share.mkdir(parents=True)
    (share / "package.xml").write_text("<package/>")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "install"))

    assert list(notes(["rclpyy"], "--dependencies", str(tmp_path))) == []


def test_rosdep_cache_takes_precedence(tmp_path: Path) -> None:
    write_cache(tmp_path / "ros_home")

    assert list(notes(["python3-serial"], "--dependencies", str(tmp_path))) == []
    assert "there is no package or rosdep key 'acme_tools'" in error_of("acme_tools", tmp_path)


def test_nothing_is_written_for_a_misspelled_dependency(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["new", "talker", "--dependencies", "rclpyy", "std_msgs"]

    assert main([*words, "--destination-directory", str(tmp_path)]) == 2

    assert capsys.readouterr().err == (
        "ros2-scaffold: error: --dependencies: there is no package or rosdep key 'rclpyy'; "
        "did you mean 'rclpy'?\n"
    )
    assert list(tmp_path.iterdir()) == []
