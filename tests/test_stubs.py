"""Stubs of interfaces and libraries, compared with the code that they describe."""

from __future__ import annotations

import ast
import importlib.util
import json
import os
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.distributions import JAZZY
from scaffold.model.discovery import targets as discovery
from scaffold.model.interfaces.definitions import Definitions
from scaffold.model.workspace.definitions import definitions_for
from scaffold.model.workspace.workspace import Workspace
from scaffold.types.stubs.interface_stubs import package_stubs
from scaffold.types.stubs.libraries import (
    interface_stub_files,
    library_stubs,
    stub_files,
)

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


def write_stubs(directory: Path, files: dict[str, str]) -> None:
    for name, text in files.items():
        path = directory / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


@pytest.fixture(scope="module")
def bundled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a directory with the stubs of the distribution and of the bundle."""
    directory = tmp_path_factory.mktemp("stubs")
    write_stubs(directory, stub_files(JAZZY, definitions_for(prefixes=[])))
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
    return definitions_for(workspace, [])


CHECKERS = {
    "mypy": ["--config-file=", "--check-untyped-defs", "--no-error-summary"],
    "ty": ["check", "--python-version=3.12", "--output-format=concise"],
    "basedpyright": [],  # pyright with everything it needs in its wheel
}
Check = Callable[[str], list[int]]


@pytest.fixture(params=CHECKERS)
def errors(request: pytest.FixtureRequest, bundled: Path, tmp_path: Path) -> Check:
    """Return a function for the lines of a program in which a type checker reports an error."""
    checker = request.param

    def lines(program: str) -> list[int]:
        (tmp_path / "program.py").write_text(program)
        (tmp_path / "pyrightconfig.json").write_text(
            json.dumps({"stubPath": str(bundled), "typeCheckingMode": "standard"})
        )
        arguments = [*CHECKERS[checker], "program.py"]
        if checker == "ty":
            arguments.append(f"--extra-search-path={bundled}")
        cache = bundled.parent / "mypy_cache"
        result = subprocess.run(
            [sys.executable, "-m", checker, *arguments],
            env={**os.environ, "MYPYPATH": str(bundled), "MYPY_CACHE_DIR": str(cache)},
            capture_output=True,
            text=True,
            check=False,
            cwd=tmp_path,
        )
        assert result.returncode in {0, 1}, result.stderr
        places = re.findall(r"(\w+\.pyi?):(\d+):.*\berror\b", result.stdout)
        assert {name for name, _ in places} <= {"program.py"}, result.stdout
        return sorted({int(line) for _, line in places})

    return lines


def wrong_lines(program: str) -> list[int]:
    """Return the lines of a program that end in ``# wrong``."""
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


def test_message_stubs_accept_what_generated_code_accepts(errors: Check) -> None:
    assert errors(MESSAGES) == wrong_lines(MESSAGES)


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


def test_errors_in_a_node(errors: Check) -> None:
    assert errors(NODE) == wrong_lines(NODE)


LAUNCH = """
from pathlib import Path
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription, RegisterEventHandler
from launch.actions import EmitEvent, GroupAction, OpaqueFunction, TimerAction
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node, PushRosNamespace
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    share = FindPackageShare('talker')
    node = Node(
        package='talker',
        executable='talker',
        parameters=[{'rate': 2.0, 'text': ParameterValue('5', value_type=str)}, 'file.yaml'],
        remappings=[('chatter', '/chatter')],
        arguments=['--ros-args', '--log-level', LaunchConfiguration('level')],
        condition=IfCondition(LaunchConfiguration('start')),
        respawn=True,
    )
    Node(package='talker', executable='talker', paramaters=[])  # wrong
    Node(package='talker', node_executable='talker')  # wrong
    Node(package='talker', executable='talker', parameters={'rate': 2.0})  # wrong
    Node(package='talker', executable='talker', arguments='--verbose')  # wrong
    Node(package='talker', executable='talker', respawn_delay='2')  # wrong
    DeclareLaunchArgument('start', default_value=True)  # wrong
    DeclareLaunchArgument('file', default_value=Path('file.yaml'))
    IfCondition(True)  # wrong
    PathJoinSubstitution('launch/a.py')  # wrong
    source = PythonLaunchDescriptionSource(PathJoinSubstitution([share, 'launch', 'a.py']))
    IncludeLaunchDescription(source, launch_arguments={'rate': '1'})  # wrong
    IncludeLaunchDescription(source, launch_arguments={'rate': True}.items())  # wrong
    IncludeLaunchDescription(source, launch_arguments={'rate': '1'}.items())
    RegisterEventHandler(OnProcessExit(target_action='talker', on_exit=[]))  # wrong
    leave = EmitEvent(event=Shutdown(reason='done'))
    return LaunchDescription([
        DeclareLaunchArgument('start', default_value='true'),
        GroupAction([PushRosNamespace('robot'), node]),
        OpaqueFunction(function=lambda context: [node]),
        TimerAction(period=5.0, actions=[node]),
        RegisterEventHandler(OnProcessExit(target_action=node, on_exit=leave)),
        RegisterEventHandler(OnProcessExit(on_exit=lambda event, context: [leave])),
    ])
"""


def test_errors_in_a_launch_file(errors: Check) -> None:
    assert errors(LAUNCH) == wrong_lines(LAUNCH)


LIBRARIES = """
import message_filters
import tf2_geometry_msgs
from cv_bridge import CvBridge
from geometry_msgs.msg import PoseStamped, TransformStamped
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.time import Time
from sensor_msgs.msg import CameraInfo, Image
from tf2_ros import Buffer, StaticTransformBroadcaster, TransformBroadcaster, TransformListener


class Follower(Node):
    def __init__(self):
        super().__init__('follower')
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        TransformListener(self, self.buffer)  # wrong
        TransformBroadcaster()  # wrong
        TransformBroadcaster(self).sendTransform(TransformStamped())
        StaticTransformBroadcaster(self).sendTransform([TransformStamped()])
        StaticTransformBroadcaster(self).sendTransform(PoseStamped())  # wrong
        found = self.buffer.lookup_transform('map', 'base_link', Time())
        found.transform.translation.x + 1.0
        found.translation  # wrong
        pose = PoseStamped()
        self.buffer.lookup_transform('map', 'base_link', pose.header.stamp)
        self.buffer.lookup_transform('map', 'base_link', Time(), 0.5)  # wrong
        self.buffer.lookup_transform('map', 'base_link', Time(), timeout=Duration(seconds=1))
        self.buffer.lookup_transform('map', 'base_link')  # wrong
        self.buffer.transform(pose, 'map').pose.position.x + 1.0
        tf2_geometry_msgs.do_transform_pose(pose, found)  # wrong
        images = message_filters.Subscriber(self, Image, 'image', qos_profile=5)
        infos = message_filters.Subscriber(self, CameraInfo, 'camera_info')
        message_filters.Subscriber('image', Image)  # wrong
        message_filters.TimeSynchronizer([images, infos])  # wrong
        both = message_filters.ApproximateTimeSynchronizer([images, infos], 10, 0.1)
        both.registerCallback(self.on_both)
        both.register_callback(self.on_both)  # wrong
        self.bridge = CvBridge()

    def on_both(self, image: Image, info: CameraInfo) -> None:
        picture = self.bridge.imgmsg_to_cv2(image, desired_encoding='bgr8')
        picture.shape
        self.bridge.cv2_to_imgmsg(picture, 'bgr8', info.header)
        self.bridge.imgmsg_to_cv2(image, encoding='bgr8')  # wrong
"""


def test_errors_in_calls_of_libraries(errors: Check) -> None:
    assert errors(LIBRARIES) == wrong_lines(LIBRARIES)


def test_stubs_include_interfaces_of_the_workspace(tmp_path: Path) -> None:
    definitions = definitions_of(
        tmp_path, {"msg/Level.msg": "uint8 LOW=1\nuint8 level\nstd_msgs/Header header\n"}
    )
    files = stub_files(JAZZY, definitions)
    assert "LOW: Final = 1" in files["robot_interfaces/msg/_level.pyi"]
    assert "header: Header" in files["robot_interfaces/msg/_level.pyi"]
    assert "import Level" in files["robot_interfaces/msg/__init__.pyi"]


def test_stubs_of_one_package_import_other_message_types(tmp_path: Path) -> None:
    definitions_of(tmp_path, {"msg/Level.msg": "map_msgs/Tile[] tiles\nLow low\n"})
    (target,) = discovery.find([str(tmp_path)])
    module = interface_stub_files(target.package)["robot_interfaces/msg/_level.pyi"]
    assert "from map_msgs.msg._tile import Tile" in module
    assert "low: Any" in module
    assert "robot_interfaces" not in "".join(stub_files(JAZZY))


def test_unreadable_definition_is_any(tmp_path: Path) -> None:
    definitions = definitions_of(tmp_path, {"msg/Level.msg": "uint8 level\n", "msg/Raw.idl": ""})
    module = stub_files(JAZZY, definitions)["robot_interfaces/msg/__init__.pyi"]
    assert "Raw: Any" in module or "def __getattr__" in module


def test_unknown_distribution_is_rejected(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["stubs", "--distro", "noetic", "--dry-run"]) == 2
    assert "'noetic' is a ROS 1 distribution; choose from humble," in capsys.readouterr().err


def test_stubs_have_no_type_errors(bundled: Path) -> None:
    packages = [f"--package={path.name}" for path in bundled.iterdir() if path.is_dir()]
    result = subprocess.run(
        [sys.executable, "-m", "mypy", "--config-file=", "--strict", *packages],
        env={**os.environ, "MYPYPATH": str(bundled)},
        capture_output=True,
        text=True,
        check=False,
        cwd=bundled.parent,
    )
    assert result.returncode == 0, result.stdout


# -- against the released source

SCRIPT = Path(__file__).parent.parent / "scripts" / "make_stubs.py"


def site_packages() -> Path:
    spec = importlib.util.find_spec("rclpy")
    assert spec is not None
    assert spec.origin is not None
    return Path(spec.origin).parent.parent


def test_generated_stubs_are_up_to_date() -> None:
    spec = importlib.util.spec_from_file_location("make_stubs", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    script = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(script)
    made = script.stubs(site_packages())
    stored = library_stubs(JAZZY)
    assert len(made) > 50
    assert {path: stored[path] for path in made} == made


def exported(text: str) -> set[str]:
    """Return the names that can be imported from a stub."""
    names: set[str] = set()
    for node in ast.parse(text).body:
        match node:
            case ast.ClassDef(name=name) | ast.FunctionDef(name=name):
                names.add(name)
            case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
                names.add(name)
            case ast.ImportFrom(names=aliases):
                names |= {alias.name for alias in aliases if alias.asname == alias.name}
    return names


def test_stubs_of_rclpy_have_every_public_class_and_function() -> None:
    stored = library_stubs(JAZZY)
    missing = []
    for path in sorted((site_packages() / "rclpy").rglob("*.py")):
        relative = path.relative_to(site_packages()).with_suffix(".pyi").as_posix()
        tree = ast.parse(path.read_text())
        public = {
            node.name
            for node in tree.body
            if isinstance(node, ast.ClassDef | ast.FunctionDef) and not node.name.startswith("_")
        }
        missing += [f"{relative}: {name}" for name in public - exported(stored[relative])]
    assert missing == []


ODD = {
    "msg/String.msg": "std_msgs/String own\nexample_interfaces/String[] others\n",
    "msg/Shadow.msg": "float64 float\nstring str\nint32[] int\nstring[] list\nbool bool\n"
    "float64 x\nstring[2] property\nfloat32[3] array\n",
    "msg/Limits.msg": 'float64 NOTHING=0.5\nstring NAME="it\'s"\nbyte B=3\nstring<=5[<=3] names\n',
    "srv/Empty.srv": "---\n",
    "action/Go.action": "String text\n---\n---\nShadow[] steps\n",
}
ODD_PROGRAM = """
from robot_interfaces.action import Go
from robot_interfaces.msg import Limits, Shadow, String
from robot_interfaces.srv import Empty
from example_interfaces.msg import String as Other
from std_msgs.msg import String as Standard

text = String(own=Standard(data='x'), others=[Other()])
text.own = Other()  # wrong
shadow = Shadow(float=1.0, str='x', int=[1], list=['a'], bool=True, x=2.0)
shadow.x = 'far'  # wrong
shadow.int = ['1']  # wrong
shadow.list.append('b')
shadow.property = ['a', 'b']
shadow.array = [1.0, 2.0, 3.0]
Limits(names=['a']).names.append(Limits.NAME)
Limits.B + b'x'
Empty.Response()
Go.Feedback(steps=[shadow]).steps[0].x + 1.0
Go.Feedback(steps=[text])  # wrong
Go.Goal(text=text)
"""


def test_fields_and_messages_with_odd_names_have_types(
    errors: Check, bundled: Path, tmp_path: Path
) -> None:
    (tmp_path / "workspace").mkdir()
    definitions = definitions_of(tmp_path / "workspace", ODD)
    stubs = package_stubs(definitions, "robot_interfaces")
    write_stubs(bundled, stubs)
    assert errors(ODD_PROGRAM) == wrong_lines(ODD_PROGRAM)
