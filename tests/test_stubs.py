"""Stubs of interfaces and libraries, held against the code that they describe."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from scaffold.errors import InputError
from scaffold.model.discovery import targets as discovery
from scaffold.model.interfaces.definitions import Definitions
from scaffold.model.workspace.workspace import Workspace
from scaffold.types.stubs import interface_stub_files, library_stubs, stub_files, write_stubs

MANIFEST = """<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>0.0.0</version>
  <description>Interfaces</description>
  <maintainer email="me@example.org">Me</maintainer>
  <license>MIT</license>
  <member_of_group>rosidl_interface_packages</member_of_group>
</package>
"""
CMAKE = """cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
rosidl_generate_interfaces(${{PROJECT_NAME}} {files})
ament_package()
"""


@pytest.fixture(scope="module")
def bundled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a directory with the stubs of the distribution and of the bundle."""
    directory = tmp_path_factory.mktemp("stubs")
    write_stubs(str(directory), stub_files("jazzy", Definitions.around(prefixes=[])))
    return directory


def definitions_of(directory: Path, files: dict[str, str]) -> Definitions:
    name = "robot_interfaces"
    interfaces = " ".join(path for path in files if not path.endswith(".idl"))
    contents = {
        "package.xml": MANIFEST.format(name=name),
        "CMakeLists.txt": CMAKE.format(name=name, files=interfaces),
        **files,
    }
    for path, text in contents.items():
        target = directory / name / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)
    workspace = Workspace(target.package for target in discovery.find([str(directory)]))
    return Definitions.around(workspace, [])


Check = Callable[[str], list[int]]


@pytest.fixture
def errors(bundled: Path, tmp_path: Path) -> Check:
    """Return what tells the lines of a program that mypy reports."""

    def lines(program: str) -> list[int]:
        file = tmp_path / "program.py"
        file.write_text(program)
        arguments = ["--check-untyped-defs", "--no-error-summary", "--show-error-codes"]
        result = subprocess.run(
            [sys.executable, "-m", "mypy", "--config-file=", *arguments, str(file)],
            env={"MYPYPATH": str(bundled), "MYPY_CACHE_DIR": str(bundled.parent / "mypy_cache")},
            capture_output=True,
            text=True,
            check=False,
            cwd=tmp_path,
        )
        reports = [line for line in result.stdout.splitlines() if ": error:" in line]
        assert all(line.startswith("program.py:") for line in reports), result.stdout
        return sorted({int(line.split(":")[1]) for line in reports})

    return lines


def marked(program: str) -> list[int]:
    """Return the lines of a program that say that they are wrong."""
    lines = enumerate(program.splitlines(), 1)
    return [number for number, line in lines if line.endswith("# wrong")]


MESSAGES = """
import numpy as np
from sensor_msgs.msg import JointState, LaserScan
from std_msgs.msg import Header, String
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Pose, PoseArray, PoseWithCovariance

String('hello')  # wrong
String(data='hello')
String(text='hello')  # wrong
scan = LaserScan(header=Header(frame_id='laser'), ranges=[1.0, 2])
scan.ranges = np.zeros(360)
scan.ranges = (1.0, np.float32(2))
scan.ranges = ['1.0']  # wrong
scan.ranges = 1.0  # wrong
scan.ranges.append(3.0)
scan.ranges.sort()  # wrong
scan.range = []  # wrong
scan.header.stamp = 3.5  # wrong
state = JointState(name=['arm'])
state.name = 'arm'  # wrong
state.name = ('arm', 'hand')
state.name.append('hand')
status = DiagnosticStatus(level=DiagnosticStatus.WARN)
status.level = 1  # wrong
pose = PoseWithCovariance()
pose.covariance = [0.0] * 36
pose.covariance[0] = 1.0
pose.covariance.append(1.0)  # wrong
poses = PoseArray(poses=[Pose()])
poses.poses.append(Pose())
poses.poses = Pose()  # wrong
"""


def test_messages_take_what_generated_code_takes(errors: Check) -> None:
    assert errors(MESSAGES) == marked(MESSAGES)


NODE = """
from typing import Any
from std_msgs.msg import Int32, String
from std_srvs.srv import SetBool
from example_interfaces.action import Fibonacci
from rclpy.action import ActionClient, ActionServer
from rclpy.action.server import ServerGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time


class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.group = ReentrantCallbackGroup()
        self.publisher = self.create_publisher(String, 'chatter', 10)
        self.publisher.publish('hello')  # wrong
        self.publisher.publish(String(data='hello'))
        self.create_publisher(String(), 'chatter', 10)  # wrong
        self.create_subscription(String, 'chatter', self.listen, 10)
        self.create_subscription(String, 'chatter', self.listen_with_info, 10)
        self.create_subscription(Int32, 'chatter', self.listen, 10)  # wrong
        self.create_subscription(String, 'chatter', self.tick, 10)  # wrong
        self.create_subscription(String, 'chatter', self.listen_raw, 10, raw=True)
        self.create_timer(1.0, self.tick, ReentrantCallbackGroup)  # wrong
        self.create_timer(1.0, self.tick, self.group)
        self.create_timer(1.0, self.listen)  # wrong
        self.create_service(SetBool, 'set', self.set)
        self.create_service(SetBool, 'set', self.tick)  # wrong
        self.client = self.create_client(SetBool, 'set')
        self.client.call(SetBool.Request()).sucess  # wrong
        self.client.call_async(SetBool.Request()).result().success
        self.client.call_async(SetBool.Response())  # wrong
        self.server = ActionServer(self, Fibonacci, 'fibonacci', self.execute)
        self.actions = ActionClient(self, Fibonacci, 'fibonacci')
        self.actions.cancel_all_goals()  # wrong
        handle = self.actions.send_goal_async(Fibonacci.Goal(order=3)).result()
        handle.get_result_async().result().result.sequence
        handle.get_result_async().result().sequence  # wrong
        self.declare_parameter('rate', 1.0).value + 1
        self.get_logger().info('%d', 3)  # wrong
        self.get_logger().info('now', throttle_duration_sec=1.0)
        since = self.get_clock().now() - Time()
        since > 0.5  # wrong
        since > Duration(seconds=0.5)
        since.to_sec()  # wrong
        self.get_clock().now() - 0.5  # wrong
        self.get_clock().now() - self.get_clock().now().to_msg()  # wrong
        self.get_clock().now().seconds  # wrong

    def listen(self, message: String) -> None: ...
    def listen_with_info(self, message: String, info: Any) -> None: ...
    def listen_raw(self, message: bytes) -> None: ...
    def tick(self) -> None: ...
    def set(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        response.success = request.data
        return response

    async def execute(self, goal: ServerGoalHandle) -> Fibonacci.Result:
        goal.succeed()
        goal.publish_feedback(Fibonacci.Feedback())
        return Fibonacci.Result()
"""


def test_nodes_are_judged_by_the_classes_they_name(errors: Check) -> None:
    assert errors(NODE) == marked(NODE)


def test_interfaces_of_the_workspace_come_along(tmp_path: Path) -> None:
    definitions = definitions_of(
        tmp_path, {"msg/Level.msg": "uint8 LOW=1\nuint8 level\nstd_msgs/Header header\n"}
    )
    files = stub_files("jazzy", definitions)
    assert "LOW: Final = 1" in files["robot_interfaces/msg/_level.pyi"]
    assert "header: Header" in files["robot_interfaces/msg/_level.pyi"]
    assert "import Level" in files["robot_interfaces/msg/__init__.pyi"]


def test_a_package_alone_imports_what_its_messages_hold(tmp_path: Path) -> None:
    definitions_of(tmp_path, {"msg/Level.msg": "map_msgs/Tile[] tiles\nLow low\n"})
    (target,) = discovery.find([str(tmp_path)])
    module = interface_stub_files(target.package)["robot_interfaces/msg/_level.pyi"]
    assert "from map_msgs.msg._tile import Tile" in module
    assert "low: Any" in module
    assert "robot_interfaces" not in "".join(stub_files("jazzy"))


def test_what_cannot_be_read_may_be_anything(tmp_path: Path) -> None:
    definitions = definitions_of(tmp_path, {"msg/Level.msg": "uint8 level\n", "msg/Raw.idl": ""})
    module = stub_files("jazzy", definitions)["robot_interfaces/msg/__init__.pyi"]
    assert "Raw: Any" in module or "def __getattr__" in module


def test_an_unknown_distribution_is_refused() -> None:
    with pytest.raises(InputError, match="no stubs for distribution 'noetic'"):
        library_stubs("noetic")
