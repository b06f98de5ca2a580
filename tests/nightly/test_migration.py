"""Packages that use names removed in Lyrical: migrated, they still run on Jazzy."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from typing import Any

import pytest

from scaffold.cli.main import main
from tests.smoke.smoke_runs import NEEDS_ROS

pytestmark = [pytest.mark.nightly, NEEDS_ROS, pytest.mark.timeout(0)]

_MANIFEST = """\
<?xml version="1.0"?>
<?xml-model
    href="http://download.ros.org/schema/package_format3.xsd"
    schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>Uses what Lyrical does not have any more</description>
  <maintainer email="ada@example.org">Ada</maintainer>
  <license>Apache-2.0</license>

{depends}

  <export>
    <build_type>{kind}</build_type>
  </export>
</package>
"""
_OF_PYTHON = (
    *("geometry_msgs", "launch", "launch_ros", "lifecycle_msgs", "python3-numpy", "rclpy"),
    *("std_msgs", "std_srvs", "test_msgs", "tf2_ros"),
)
_NODE = '''\
"""A node that uses twenty things which are not the same on Lyrical."""

import pipes

from geometry_msgs.msg import Pose2D
from lifecycle_msgs.msg import TransitionEvent
import numpy as np
import rclpy
from rclpy.action import ActionServer
from rclpy.action import get_action_names_and_types
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import ROSClock
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, HistoryPolicy, LivelinessPolicy
from rclpy.qos import QoSProfile, QoSReliabilityPolicy
from rclpy.qos_event import QoSEventHandler, SubscriptionEventCallbacks
from rclpy.topic_endpoint_info import TopicEndpointInfo
from std_msgs.msg import String
from std_srvs.srv import Trigger
from test_msgs.action import Fibonacci


class Twenty(Node):
    """Publishes what it says."""

    def __init__(self):
        super().__init__('twenty')
        profile = QoSProfile(
            depth=1,
            history=HistoryPolicy.RMW_QOS_POLICY_HISTORY_KEEP_LAST,  # one is enough
            reliability=QoSReliabilityPolicy.RMW_QOS_POLICY_RELIABILITY_RELIABLE,
            durability=DurabilityPolicy.RMW_QOS_POLICY_DURABILITY_VOLATILE,
            liveliness=LivelinessPolicy.RMW_QOS_POLICY_LIVELINESS_AUTOMATIC,
        )
        group = ReentrantCallbackGroup()
        self.log = self.get_logger()
        self.publisher = self.create_publisher(String, 'talk', profile)
        self.server = ActionServer(self, Fibonacci, 'count', self.count)
        self.client = self.create_client(Trigger, 'switch', callback_group=group)
        self.timer = self.create_timer(0.2, self.talk)
        self.create_subscription(TransitionEvent, 'events', self.hear, 1)
        self.ros_clock = ROSClock()
        self.names = get_action_names_and_types(self)
        self.kinds = (QoSEventHandler, SubscriptionEventCallbacks, pipes.quote)

    def talk(self):
        """Publish, and complain."""
        try:
            self.get_logger().warn('talking')  # a comment
            self.log.warn(f'{self.ros_clock.now()} {self.names} {self.kinds}', once=True)
            self.publisher.publish(String(data='hello'))
        except Exception as error:
            self.log.error(str(error))
            raise

    def count(self, handle):
        """Reach every goal."""
        handle.succeed()
        return Fibonacci.Result()

    def ask(self):
        """Wait a second for an answer."""
        return self.client.call(Trigger.Request(), timeout_sec=1.0)

    def hear(self, event):
        """Log when a node has changed its state."""
        self.log.info(f'{event.timestamp}')

    def place(self):
        """Return where the robot is."""
        pose = Pose2D()
        return np.float_(pose.x), np.NaN

    def infos(self) -> list[TopicEndpointInfo]:
        """Return who publishes."""
        return self.get_publishers_info_by_topic('talk')


def main():
    """Run the node."""
    rclpy.init()
    node = Twenty()
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
'''
_LAUNCH = '''\
"""Starts the node, and says where its sensor is."""

from launch import LaunchDescription
from launch.actions.log_info import LogInfo
from launch_ros.actions import Node


def generate_launch_description():
    """Return what is started."""
    return LaunchDescription([
        LogInfo(msg='hello'),
        Node(package='twenty', executable='twenty'),
        Node(
            package='tf2_ros',
            executable='static_transform_publisher',
            arguments=['1', '0', '0', '0', '0', '0', 'base', 'laser'],
        ),
    ])
'''
_SETUP = """\
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
    zip_safe=True,
    maintainer='Ada',
    maintainer_email='ada@example.org',
    description='Uses what Lyrical does not have any more',
    license='Apache-2.0',
    tests_require=['pytest'],
    entry_points={
        'console_scripts': [
            'twenty = twenty.node:main',
        ],
    },
)
"""
_LISTS = """\
cmake_minimum_required(VERSION 3.4)
project(listed)

find_package(ament_cmake REQUIRED)
find_package(ament_cmake_python REQUIRED)
find_package(std_msgs REQUIRED)

set(DEPENDENCIES
  rcutils
  std_msgs
)
find_package(rcutils REQUIRED)

# what it sends
add_library(size SHARED src/size.cpp)
ament_target_dependencies(size
  ${DEPENDENCIES}
)
add_library(length SHARED src/length.cpp)
ament_target_dependencies(length std_msgs)  # one

install(TARGETS size length DESTINATION lib)
install(PROGRAMS scripts/talk DESTINATION lib/${PROJECT_NAME})
ament_package()
"""
_SOURCE = """\
#include <cstddef>

#include "std_msgs/msg/string.hpp"

std::size_t {name}()
{{
  std_msgs::msg::String message;
  message.data = "hello";
  return message.data.size();
}}
"""
_SCRIPT = """\
#!/usr/bin/env python3
\"\"\"Publishes, and complains.\"\"\"

import rclpy
from rclpy.executors import ExternalShutdownException
from std_msgs.msg import String


def main():
    \"\"\"Run the node.\"\"\"
    rclpy.init()
    node = rclpy.create_node('talk')
    publisher = node.create_publisher(String, 'talk', 1)

    def talk():
        node.get_logger().warn('talking')
        publisher.publish(String(data='hello'))

    node.create_timer(0.2, talk)
    try:
        rclpy.spin(node)
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
"""


def manifest(name: str, kind: str, **depends: tuple[str, ...]) -> str:
    lines = [f"  <{tag}>{item}</{tag}>" for tag, items in depends.items() for item in items]
    return _MANIFEST.format(name=name, kind=kind, depends="\n".join(lines))


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a workspace of packages that work on Jazzy."""
    listed = {
        "buildtool_depend": ("ament_cmake", "ament_cmake_python"),
        "depend": ("rcutils", "std_msgs"),
        "exec_depend": ("rclpy",),
    }
    files = {
        "twenty/package.xml": manifest("twenty", "ament_python", exec_depend=_OF_PYTHON),
        "twenty/setup.py": _SETUP,
        "twenty/setup.cfg": "[develop]\nscript-dir=$base/lib/twenty\n"
        "[install]\ninstall-scripts=$base/lib/twenty\n",
        "twenty/resource/twenty": "",
        "twenty/twenty/__init__.py": "",
        "twenty/twenty/node.py": _NODE,
        "twenty/launch/twenty.launch.py": _LAUNCH,
        "listed/package.xml": manifest("listed", "ament_cmake", **listed),
        "listed/CMakeLists.txt": _LISTS,
        "listed/src/size.cpp": _SOURCE.format(name="size"),
        "listed/src/length.cpp": _SOURCE.format(name="length"),
        "listed/scripts/talk": _SCRIPT,
    }
    for path, text in files.items():
        (tmp_path / "ws" / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "ws" / path).write_text(text)
    (tmp_path / "ws" / "listed" / "scripts" / "talk").chmod(0o755)
    monkeypatch.chdir(tmp_path / "ws")
    return tmp_path / "ws"


def reported(capsys: pytest.CaptureFixture[str], *words: str) -> Any:  # noqa: ANN401  as JSON has it
    capsys.readouterr()
    main(["migrate", "--to", "lyrical", "--format", "json", *words])
    return json.loads(capsys.readouterr().out)


def codes(report: Any, *kinds: str) -> dict[str, int]:  # noqa: ANN401  likewise
    items = [item for package in report["packages"] for kind in kinds for item in package[kind]]
    return dict(Counter(item["code"] for item in items))


def text_of(workspace: Path) -> dict[str, bytes]:
    return {str(path): path.read_bytes() for path in workspace.rglob("*") if path.is_file()}


def test_migrated_packages_still_build_run_and_are_clean_on_jazzy(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = reported(capsys)
    assert sum(codes(before, "breaks", "changes", "deprecated").values()) >= 20
    main(["migrate", "--to", "lyrical", "--keep", "jazzy", "--fix"])
    fixed = text_of(workspace)
    main(["migrate", "--to", "lyrical", "--keep", "jazzy", "--fix"])
    assert text_of(workspace) == fixed
    left = reported(capsys, "--keep", "jazzy")
    assert codes(left, "breaks") == {"IM050": 1, "TY002": 1, "MS002": 1, "TY001": 1}
    assert codes(left, "changes") == {"IM052": 2}
    assert codes(left, "deprecated") == {"IM050": 3}
    assert main(["check", "--distro", "jazzy", "."]) == 0, capsys.readouterr().out
    main(["smoke", ".", "--format", "json", "--output-file", "report.json"])
    report = json.loads(Path("report.json").read_text())
    assert report["ok"], json.dumps(report, indent=2)
    assert report["environment"]["distribution"] == "jazzy"
    executables = [item for package in report["packages"] for item in package["executables"]]
    assert len(executables) == 2
