"""What a move to another distribution reports, fixes and leaves."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import Any

import pytest

from scaffold.cli.main import main

_MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>Uses what Lyrical removes</description>
  <maintainer email="ada@example.org">Ada</maintainer>
  <license>Apache-2.0</license>
  {depends}
  <export><build_type>{kind}</build_type></export>
</package>
"""
_PYTHON = (
    "rclpy geometry_msgs lifecycle_msgs std_msgs example_interfaces python3-numpy launch "
    "launch_ros tf2_ros"
)
NODE = """\
import pipes

from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import Pose2D
from lifecycle_msgs.msg import TransitionEvent
import numpy as np
from rclpy.action import ActionServer
from rclpy.action import get_action_names_and_types
from rclpy.clock import ROSClock
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSHistoryPolicy, QoSProfile, QoSReliabilityPolicy
from rclpy.qos_event import QoSEventHandler, SubscriptionEventCallbacks  # events
from rclpy.topic_endpoint_info import TopicEndpointInfo
from std_msgs.msg import String


class Twenty(Node):

    def __init__(self):
        super().__init__('twenty')
        profile = QoSProfile(
            depth=1,
            history=QoSHistoryPolicy.RMW_QOS_POLICY_HISTORY_KEEP_LAST,
            reliability=QoSReliabilityPolicy.RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT,
            durability=DurabilityPolicy.RMW_QOS_POLICY_DURABILITY_VOLATILE,
        )
        self.create_subscription(String, 'chatter', self.hear, profile)
        self.server = ActionServer(self, Fibonacci, 'count', self.count)
        self.client = self.create_client(AddTwoInts, 'add')
        self.log = self.get_logger()
        self.ros_clock = ROSClock()
        self.names = get_action_names_and_types(self)

    def hear(self, message):
        self.get_logger().warn('heard')  # a comment
        self.log.warn('heard again')
        pose = Pose2D()
        event = TransitionEvent()
        event.timestamp = 3
        value = np.float_(pose.x)
        self.log.info(f'{value} {np.NaN} {pipes} {event} {message}')

    def count(self, handle):
        handle.succeed()
        answer = self.client.call(AddTwoInts.Request(), timeout_sec=1.0)
        self.log.info(f'{answer} {QoSEventHandler} {SubscriptionEventCallbacks}')
        return Fibonacci.Result()

    def infos(self) -> TopicEndpointInfo:
        return self.get_publishers_info_by_topic('chatter')[0]
"""
LAUNCH = """\
from launch import LaunchDescription
from launch.actions.log_info import LogInfo
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        LogInfo(msg='hello'),
        Node(package='tf2_ros', executable='static_transform_publisher',
             arguments=['1', '0', '0', '0', '0', '0', 'base', 'laser']),
    ])
"""
SETUP = """\
from glob import glob

from setuptools import setup

setup(
    name='twenty',
    version='0.0.0',
    packages=['twenty'],
    data_files=[
        ('share/ament_index/resource_index/packages', ['resource/twenty']),
        ('share/twenty', ['package.xml']),
        ('share/twenty/launch', glob('launch/*')),
    ],
    install_requires=['setuptools'],
    tests_require=['pytest'],
)
"""
LISTS = """\
cmake_minimum_required(VERSION 3.4)
project(listed)

find_package(ament_cmake REQUIRED)
find_package(rclcpp REQUIRED)
find_package(std_msgs REQUIRED)

add_executable(node src/node.cpp)
# what it uses
ament_target_dependencies(node
  rclcpp  # the node
  std_msgs)
install(TARGETS node DESTINATION lib/${PROJECT_NAME})

ament_package()
"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a workspace whose packages use what later distributions removed or changed."""
    depends = "".join(f"<exec_depend>{name}</exec_depend>" for name in _PYTHON.split())
    compiled = "<buildtool_depend>ament_cmake</buildtool_depend>"
    compiled += "<depend>rclcpp</depend><depend>std_msgs</depend>"
    files = {
        "twenty/package.xml": _MANIFEST.format(name="twenty", depends=depends, kind="ament_python"),
        "twenty/setup.py": SETUP,
        "twenty/setup.cfg": "[develop]\nscript-dir=$base/lib/twenty\n"
        "[install]\ninstall-scripts=$base/lib/twenty\n",
        "twenty/resource/twenty": "",
        "twenty/twenty/__init__.py": "",
        "twenty/twenty/node.py": NODE,
        "twenty/launch/a.launch.py": LAUNCH,
        "listed/package.xml": _MANIFEST.format(name="listed", depends=compiled, kind="ament_cmake"),
        "listed/CMakeLists.txt": LISTS,
        "listed/src/node.cpp": "int main() { return 0; }\n",
    }
    for path, text in files.items():
        (tmp_path / "ws" / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "ws" / path).write_text(text)
    monkeypatch.chdir(tmp_path / "ws")
    return tmp_path / "ws"


def migrate(
    capsys: pytest.CaptureFixture[str], *words: str
) -> tuple[dict[str, list[str]], list[dict[str, Any]]]:
    """Return what is reported: the codes of each kind, and all findings."""
    capsys.readouterr()
    main(["migrate", "--to", "lyrical", "--format", "json", *words])
    data = json.loads(capsys.readouterr().out)
    kinds = ("breaks", "changes", "deprecated")
    found = {
        kind: sorted(item["code"] for package in data["packages"] for item in package[kind])
        for kind in kinds
    }
    return found, [one for package in data["packages"] for kind in kinds for one in package[kind]]


@pytest.mark.usefixtures("workspace")
def test_a_move_reports_what_breaks_what_changes_and_what_is_deprecated(
    capsys: pytest.CaptureFixture[str],
) -> None:
    found, everything = migrate(capsys)
    assert found["breaks"] == sorted(
        ["CM005", "CM110", "LF080", "SP012", "TY001", "MS001", "MS002", *["IM050"] * 10]
    )
    assert found["changes"] == ["IM052", "IM052"]
    assert found["deprecated"] == ["IM051", "IM051", "IM051", "SP005", "SP005"]
    assert all(item["distributions"] == ["lyrical"] for item in everything)
    assert main(["migrate", "--to", "lyrical"]) == 1
    *lines, summary = capsys.readouterr().out.splitlines()
    assert summary.startswith(
        "2 packages from Jazzy to Lyrical: 17 break, 2 change silently, 5 deprecated; "
    )
    assert lines[0] == "listed:"
    assert "  breaks:" in lines


def test_fixes_repair_what_is_safe_and_nothing_else(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = workspace.parent / "before"
    shutil.copytree(workspace, before)
    assert main(["migrate", "--to", "lyrical", "--diff"]) == 1
    assert (workspace / "listed" / "CMakeLists.txt").read_text() == LISTS
    assert main(["migrate", "--to", "lyrical", "--fix"]) == 1
    lists = (workspace / "listed" / "CMakeLists.txt").read_text()
    assert lists == LISTS.replace("VERSION 3.4", "VERSION 3.10").replace(
        "ament_target_dependencies(node\n  rclcpp  # the node\n  std_msgs)",
        "target_link_libraries(node\n  ${rclcpp_TARGETS}  # the node\n  ${std_msgs_TARGETS})",
    )
    node = (workspace / "twenty" / "twenty" / "node.py").read_text()
    for line in (
        "self.get_logger().warning('heard')  # a comment",
        "self.log.warning('heard again')",
        "history=QoSHistoryPolicy.KEEP_LAST,",
        "reliability=QoSReliabilityPolicy.BEST_EFFORT,",
        "durability=DurabilityPolicy.VOLATILE,",
        "import EventHandler as QoSEventHandler, SubscriptionEventCallbacks  # events",
        "from rclpy.endpoint_info import TopicEndpointInfo",
        "value = np.float64(pose.x)",
    ):
        assert line in node
    written = {file.relative_to(workspace): file for file in workspace.rglob("*") if file.is_file()}
    changed = [
        path for path, file in written.items() if (before / path).read_bytes() != file.read_bytes()
    ]
    assert len(changed) == 5
    again = {file: file.read_bytes() for file in workspace.rglob("*") if file.is_file()}
    main(["migrate", "--to", "lyrical", "--fix"])
    assert again == {file: file.read_bytes() for file in workspace.rglob("*") if file.is_file()}
    capsys.readouterr()


def test_what_is_kept_still_runs(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["migrate", "--to", "lyrical", "--keep", "jazzy", "--fix"])
    node = (workspace / "twenty" / "twenty" / "node.py").read_text()
    assert "from rclpy.topic_endpoint_info import" in node
    _, everything = migrate(capsys, "--keep", "jazzy")
    (left,) = [item["message"] for item in everything if "topic_endpoint_info" in item["message"]]
    assert "new in Lyrical: nothing suits Jazzy as well, so write a branch" in left
    rules = "CM,IM,LF,MS,ND,SP,TY"
    assert main(["check", "--distro", "jazzy", "--select", rules]) == 0


@pytest.mark.usefixtures("workspace")
def test_a_move_to_the_same_distribution_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["migrate", "--to", "jazzy"]) == 2
    assert "the packages are for Jazzy already" in capsys.readouterr().err
    assert main(["migrate", "--to", "kited"]) == 2
    assert "--to: no distribution 'kited'; did you mean 'kilted'?" in capsys.readouterr().err


def test_the_record_of_a_package_says_what_it_has_moved_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    person = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.org")
    assert main(["new", "talker", "--distro", "humble", *person]) == 0
    record = tmp_path / "talker" / ".ros2-scaffold.json"
    before = record.read_text()
    capsys.readouterr()
    assert main(["migrate", "talker", "--to", "lyrical"]) == 0
    assert "from Humble to Lyrical" in capsys.readouterr().out
    assert record.read_text() == before
    for kept, names in (("jazzy", ["jazzy", "lyrical"]), ("", ["lyrical"]), ("", ["lyrical"])):
        flags = ("--keep", kept) if kept else ()
        assert main(["migrate", "talker", "--to", "lyrical", "--fix", *flags]) == 0
        written = record.read_text()
        assert json.loads(written)["answers"]["distro"] == names
        assert written == before.replace('["humble"]', json.dumps(names))
    capsys.readouterr()
    assert main(["check", "talker"]) == 0
    assert "for Lyrical: no findings" in capsys.readouterr().out
    assert main(["update", "talker"]) == 0
    assert "ROS 2 Lyrical" in (tmp_path / "talker" / "README.md").read_text()


def test_packages_without_a_record_are_checked_for_what_the_configuration_says(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["migrate", "listed", "--to", "lyrical", "--fix"])
    assert "set check.distribution of the configuration" in capsys.readouterr().err
    (workspace / "ros2-scaffold.toml").write_text('[check]\ndistribution = "lyrical"\n')
    main(["migrate", "listed", "--to", "lyrical", "--from", "jazzy", "--fix"])
    assert "check.distribution" not in capsys.readouterr().err


def test_imports_stay_in_order_where_they_were(workspace: Path) -> None:
    package = workspace / "twenty" / "twenty"
    ordered = "from rclpy.node import Node\nfrom rclpy.qos_event import QoSEventHandler\n"
    unordered = "from rclpy.qos_event import QoSEventHandler\nimport rclpy\n"
    (package / "ordered.py").write_text(ordered)
    (package / "unordered.py").write_text(unordered)
    main(["migrate", "--to", "lyrical", "--keep", "jazzy", "--fix"])
    handler = "from rclpy.event_handler import EventHandler as QoSEventHandler\n"
    node = "from rclpy.node import Node\n"
    assert (package / "ordered.py").read_text() == handler + node
    assert (package / "unordered.py").read_text() == handler + "import rclpy\n"


def test_a_message_is_printed_once_with_the_other_lines_below(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    node = workspace / "twenty" / "twenty" / "node.py"
    capsys.readouterr()
    main(["migrate", "--to", "lyrical"])
    lines = capsys.readouterr().out.splitlines()
    (at,) = (number for number, line in enumerate(lines) if "RcutilsLogger.warn was" in line)
    numbers = [
        number for number, line in enumerate(node.read_text().splitlines(), 1) if ".warn(" in line
    ]
    assert f"twenty/node.py:{numbers[0]}:" in lines[at]
    also = ", ".join(map(str, numbers[1:]))
    assert lines[at + 1].strip() == f"also twenty/twenty/node.py:{also}"


def test_a_move_to_the_same_under_another_name_says_so(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["migrate", str(workspace), "--from", "lyrical", "--to", "rolling"]) == 2
    assert "already, which is the same as Rolling for Python packages" in capsys.readouterr().err


def test_a_file_that_never_parsed_is_not_reported_after_fixes(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (workspace / "twenty" / "twenty" / "old.py").write_text("print 'hello'\n")
    main(["migrate", "--to", "lyrical", "--fix"])
    assert "old.py" not in capsys.readouterr().out
