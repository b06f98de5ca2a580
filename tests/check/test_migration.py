"""`migrate`: what the move to another distribution reports, fixes and leaves."""

from __future__ import annotations

import json
import shutil
import subprocess
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
    """Return the reported codes by kind, and all findings."""
    capsys.readouterr()
    main(["migrate", "--to", "lyrical", "--format", "json", *words])
    data = json.loads(capsys.readouterr().out)
    kinds = ("breaks", "changes", "deprecated")
    result = {
        kind: sorted(item["code"] for package in data["packages"] for item in package[kind])
        for kind in kinds
    }
    return result, [
        entry for package in data["packages"] for kind in kinds for entry in package[kind]
    ]


@pytest.mark.usefixtures("workspace")
def test_report_of_breaks_changes_and_deprecations(
    capsys: pytest.CaptureFixture[str],
) -> None:
    result, everything = migrate(capsys)
    assert result["breaks"] == sorted(
        ["CM005", "CM110", "LF080", "SP012", "TY001", "TY002", "MS002", *["IM050"] * 10]
    )
    assert result["changes"] == ["IM052", "IM052"]
    assert result["deprecated"] == ["IM050", "IM050", "IM050", "SP005", "SP005"]
    assert all(item["distributions"] == ["lyrical"] for item in everything)
    assert main(["migrate", "--to", "lyrical"]) == 1
    *lines, summary = capsys.readouterr().out.splitlines()
    assert summary.startswith(
        "2 packages from Jazzy to Lyrical: 17 break, 2 change silently, 5 deprecated; "
    )
    assert lines[0] == "listed:"
    assert "  breaks:" in lines


def test_only_safe_fixes_are_applied(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
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


def test_unsafe_fixes_are_applied_on_request(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lists = workspace / "listed" / "CMakeLists.txt"
    lists.write_text(LISTS.replace("std_msgs)", "std_msgs shapes)"))
    main(["migrate", "listed", "--to", "lyrical", "--fix"])
    assert capsys.readouterr().out.endswith("; 1 fixable with --fix --unsafe-fixes\n")
    main(["migrate", "listed", "--to", "lyrical", "--fix", "--unsafe-fixes"])
    assert "${std_msgs_TARGETS} ${shapes_TARGETS})" in lists.read_text()


def test_fixes_keep_code_valid_on_kept_distributions(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["migrate", "--to", "lyrical", "--keep", "jazzy", "--fix"])
    node = (workspace / "twenty" / "twenty" / "node.py").read_text()
    assert "from rclpy.topic_endpoint_info import" in node
    capsys.readouterr()
    module = workspace / "twenty" / "twenty" / "node.py"
    module.write_text(NODE)
    main(["migrate", "--to", "lyrical", "--keep", "jazzy"])
    assert capsys.readouterr().out.endswith("; 8 fixable with --fix\n")
    main(["migrate", "--to", "lyrical", "--keep", "jazzy", "--fix"])
    assert "\n8 fixes applied\n" in capsys.readouterr().err
    assert module.read_text() == node
    _, everything = migrate(capsys, "--keep", "jazzy")
    (left,) = [item["message"] for item in everything if "topic_endpoint_info" in item["message"]]
    assert "new in Lyrical: nothing suits Jazzy as well, so write a branch" in left
    rules = "CM,IM,LF,MS,ND,SP,TY"
    assert main(["check", "--distro", "jazzy", "--select", rules]) == 0


def test_deprecated_executable_without_successor_on_kept_distribution(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = tmp_path / "twenty"
    (package / "launch").mkdir(parents=True)
    manifest = _MANIFEST.format(
        name="twenty", depends="<exec_depend>rclcpp_components</exec_depend>", kind="ament_cmake"
    )
    (package / "package.xml").write_text(manifest)
    (package / "launch" / "a.launch.xml").write_text(
        "<launch>\n  <node pkg='rclcpp_components' exec='component_container_mt'/>\n</launch>\n"
    )
    main(["migrate", str(package), "--to", "lyrical", "--keep", "jazzy"])
    out = capsys.readouterr().out
    assert "new in Lyrical: nothing suits Jazzy as well, so write a branch" in out


def test_kept_distribution_is_checked_and_recorded_when_nothing_breaks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    person = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.org")
    for name in ("plain", "newer"):
        assert main(["new", name, "--distro", "jazzy", *person]) == 0
    module = Path("newer/newer/events.py")
    module.write_text("from rclpy.event_handler import EventHandler\n\nKIND = EventHandler\n")
    flags = ("migrate", "--to", "lyrical", "--keep", "humble,kilted")
    capsys.readouterr()
    assert main([*flags]) == 1
    lines = capsys.readouterr().out.splitlines()
    (line,) = (item for item in lines if "events.py" in item)
    assert "has no module 'rclpy.event_handler': ModuleNotFoundError (humble)" in line
    assert lines[-1].endswith("1 break, 0 change silently, 0 deprecated")
    assert main([*flags, "--fix"]) == 1
    shown = capsys.readouterr().err
    assert "newer: not recorded for Humble, Kilted and Lyrical until the remaining" in shown
    records = {name: Path(name, ".ros2-scaffold.json") for name in ("plain", "newer")}
    recorded = {
        name: json.loads(path.read_text())["answers"]["distro"] for name, path in records.items()
    }
    assert recorded["plain"] == ["humble", "kilted", "lyrical"]
    assert recorded["newer"] == ["jazzy"]
    module.unlink()
    assert main([*flags, "--fix"]) == 0
    assert '"distro": ["humble", "kilted", "lyrical"]' in records["newer"].read_text()


@pytest.mark.usefixtures("workspace")
def test_move_to_the_same_distribution_is_rejected(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["migrate", "--to", "jazzy"]) == 2
    error = capsys.readouterr().err
    assert "listed, twenty: not migrated: the current distribution is neither recorded" in error
    assert "and the default is Jazzy; set it with --from" in error
    assert main(["migrate", "--to", "kited"]) == 2
    assert "--to: no distribution 'kited'; did you mean 'kilted'?" in capsys.readouterr().err
    assert main(["migrate", "--to", "jazzy,lyrical"]) == 2
    assert "use --to for the distribution to migrate to" in capsys.readouterr().err


def test_move_to_an_older_distribution_reports_only_breaks(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    node = workspace / "twenty" / "twenty" / "node.py"
    silent = "pose = Pose2D()  # noqa: TY002, IM050"
    node.write_text(NODE.replace("pose = Pose2D()", silent))
    flags = ("--from", "lyrical", "--to", "jazzy")
    assert main(["migrate", *flags]) == 0
    assert capsys.readouterr().out == "2 packages from Lyrical to Jazzy: nothing changes\n"
    assert main(["migrate", *flags, "--fix"]) == 0
    assert capsys.readouterr().err.startswith("0 fixes applied\n")
    assert silent in node.read_text()
    main(["migrate", "--from", "lyrical", "--to", "humble"])
    out = capsys.readouterr().out
    assert "call() has no argument 'timeout_sec'" in out
    assert out.endswith(
        "2 packages from Lyrical to Humble: 1 break, 0 change silently, 0 deprecated\n"
    )


def test_record_names_the_new_distribution(
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


def test_origin_of_a_package_is_in_its_record(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    person = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.org")
    for name, distro in (("a", "humble"), ("b", "jazzy"), ("c", "lyrical"), ("d", "humble,jazzy")):
        assert main(["new", f"talker_{name}", "--distro", distro, *person]) == 0
    records = {name: Path(f"talker_{name}/.ros2-scaffold.json") for name in "abcd"}
    untouched = records["c"].stat().st_mtime_ns
    node = Path("talker_b/talker_b/minimal_publisher.py")
    node.write_text(node.read_text().replace("get_logger().info", "get_logger().warn"))
    capsys.readouterr()
    main(["migrate", "--to", "lyrical", "--format", "json"])
    report = json.loads(capsys.readouterr().out)
    assert report["from"] == ["humble", "jazzy"]
    assert [item["from"] for item in report["packages"]] == ["humble", "jazzy", "humble"]
    assert [len(item["breaks"]) for item in report["packages"]] == [0, 1, 0]
    assert main(["migrate", "--to", "lyrical", "--fix"]) == 0
    shown = capsys.readouterr()
    assert shown.out == (
        "2 packages from Humble and 1 from Jazzy to Lyrical: nothing changes; "
        "1 is for Lyrical already\n"
    )
    done, *notes = shown.err.splitlines()
    assert done == "1 fix applied; 3 packages recorded for Lyrical"
    for name, left, flag in (
        ("a", "Humble", "humble"),
        ("d", "Humble and Jazzy", "humble,jazzy"),
        ("b", "Jazzy", "jazzy"),
    ):
        assert notes.pop(0).startswith(
            f"note: talker_{name}: recorded as a package for Lyrical, no longer for {left} "
            f"(without --keep {flag}); "
        )
    assert not notes
    assert records["c"].stat().st_mtime_ns == untouched
    assert main(["migrate", "--to", "lyrical", "--fix"]) == 0
    shown = capsys.readouterr()
    assert shown.out.startswith("the packages are for Lyrical already: nothing to migrate; ")
    assert shown.err == "0 fixes applied\n"
    flags = ("migrate", "talker_c", "--to", "lyrical", "--keep", "kilted", "--fix")
    assert main([*flags, "--keep", "jazzy"]) == 1
    report = capsys.readouterr().out
    assert "ND005 rclpy.init() is not a context manager on Jazzy" in report
    assert "1 package from Jazzy to Lyrical: 1 break" in report
    assert main([*flags]) == 0
    assert json.loads(records["c"].read_text())["answers"]["distro"] == ["kilted", "lyrical"]


def test_packages_without_a_record_use_the_configuration(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    main(["migrate", "listed", "--to", "lyrical", "--fix"])
    assert "set check.distribution in the configuration" in capsys.readouterr().err
    configuration = workspace / "ros2-scaffold.toml"
    configuration.write_text('[check]\ndistribution = "jazzy"\n')
    main(["migrate", "listed", "--to", "lyrical", "--fix"])
    assert f"as set by check.distribution in {configuration};" in capsys.readouterr().err
    configuration.write_text('[check]\ndistribution = "lyrical"\n')
    main(["migrate", "listed", "--to", "lyrical", "--from", "jazzy", "--fix"])
    assert "check.distribution" not in capsys.readouterr().err


def test_unknown_field_keyword_breaks_where_it_was_ignored(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    module = workspace / "twenty" / "twenty" / "sent.py"
    module.write_text("from std_msgs.msg import String\n\nMESSAGE = String(dta='hello')\n")
    for origin, target, effect in (
        ("jazzy", "lyrical", "TypeError"),
        ("humble", "lyrical", ""),
        ("lyrical", "humble", ""),
        ("humble", "jazzy", "the value is silently dropped"),
    ):
        capsys.readouterr()
        main(["migrate", "twenty", "--from", origin, "--to", target])
        lines = [line for line in capsys.readouterr().out.splitlines() if "'dta'" in line]
        assert len(lines) == bool(effect)
        assert all(f"has no field 'dta': {effect};" in line for line in lines)


@pytest.mark.parametrize(
    "body",
    [
        "if {asked}:\n    return ActionServer({args})\nreturn ActionServer({args})",
        "if {asked}:\n    return ActionServer({args})\nelse:\n    return ActionServer({args})",
        "return ActionServer({args}) if {asked} else ActionServer({args})",
    ],
)
def test_call_in_a_branch_for_one_distribution_is_no_change(
    workspace: Path, capsys: pytest.CaptureFixture[str], body: str
) -> None:
    module = workspace / "twenty" / "twenty" / "node.py"
    asked = "os.environ['ROS_DISTRO'] in ('lyrical', 'rolling')"
    for condition, count in ((asked, 0), (f"not {asked}", 0), ("args", 2)):
        code = body.format(asked=condition, args="*args")
        lines = "\n".join(f"    {line}" for line in code.splitlines())
        start = "import os\n\nfrom rclpy.action import ActionServer\n\n\ndef serve(*args):\n"
        module.write_text(f"{start}{lines}\n")
        result, _ = migrate(capsys)
        assert result["changes"] == ["IM052"] * count


def test_branch_for_the_target_is_no_change(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    module = workspace / "twenty" / "twenty" / "node.py"
    module.write_text(
        "import os\n\nimport rclpy\nfrom rclpy.node import Node\n\n"
        "IS_NEW = os.environ.get('ROS_DISTRO', '') >= 'lyrical'\n\n\n"
        "def main():\n    rclpy.init()\n    node = Node('talker')\n"
        "    if IS_NEW:\n        rclpy.spin(node)\n"
    )
    result, _ = migrate(capsys)
    assert result["changes"] == []


def test_sorted_imports_stay_sorted(workspace: Path) -> None:
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


@pytest.mark.parametrize(
    ("comment", "is_moved"), [("keep", True), ("noqa: F401", True), ("after the node", False)]
)
def test_import_is_moved_with_its_comment(workspace: Path, comment: str, is_moved: bool) -> None:
    module = workspace / "twenty" / "twenty" / "ordered.py"
    node = "from rclpy.node import (\n    Node,  # base\n)\n"
    name = "SubscriptionEventCallbacks"
    module.write_text(f"{node}from rclpy.qos_event import {name}  # {comment}\n")
    main(["migrate", "--to", "lyrical", "--keep", "jazzy", "--fix"])
    callbacks = f"from rclpy.event_handler import {name}  # {comment}\n"
    assert module.read_text() == (callbacks + node if is_moved else node + callbacks)


def test_fixes_cause_no_unsorted_imports(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    _new("talker")
    module = Path("talker/talker/events.py")
    module.write_text(
        "from rclpy.node import Node\nfrom rclpy.clock import Clock\n"
        "from rclpy.parameter import Parameter\nfrom rclpy.qos_event import QoSEventHandler\n\n"
        "USED = (Node, Clock, Parameter, QoSEventHandler)\n"
    )
    main(["migrate", "--to", "lyrical", "--fix"])
    assert main(["check", "--select", "I100"]) == 0
    assert "rclpy.event_handler" in module.read_text()


def test_patch_equals_written_changes(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    _new("talker", "plain")
    ordered = "from rclpy.node import Node\nfrom rclpy.qos_event import QoSEventHandler\n"
    Path("talker/talker/ordered.py").write_text(ordered)
    applied = workspace.parent / "applied"
    capsys.readouterr()
    assert main(["migrate", "--to", "lyrical", "--diff"]) == 1
    shown = capsys.readouterr()
    shutil.copytree(workspace, applied)
    patch = shown.out
    subprocess.run(["git", "apply", "-"], input=patch, text=True, check=True, cwd=applied)
    main(["migrate", "--to", "lyrical", "--fix"])
    (done,) = (line for line in capsys.readouterr().err.splitlines() if " applied" in line)
    assert "; 2 packages recorded for Lyrical" in done
    assert shown.err.splitlines()[-1] == done.replace("recorded", "would be recorded").replace(
        "applied", "would be applied"
    )
    for path in (path for path in workspace.rglob("*") if path.is_file()):
        assert (applied / path.relative_to(workspace)).read_bytes() == path.read_bytes()
    assert "rclpy.qos_event" not in Path("talker/talker/ordered.py").read_text()


def test_kept_distribution_is_checked_for_packages_of_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    _new("talker")
    text = "from rclpy.endpoint_info import TopicEndpointInfo\n\n\ndef main():\n    pass\n"
    Path("talker/talker/infos.py").write_text(text)
    for kept, code in (("", 0), ("jazzy", 1), ("kilted", 1)):
        capsys.readouterr()
        flags = ("--keep", kept) if kept else ()
        assert main(["migrate", "--from", "jazzy", "--to", "lyrical", *flags]) == code
        assert ("no module 'rclpy.endpoint_info'" in capsys.readouterr().out) == code


def test_findings_in_files_that_are_not_built_do_not_block(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    _new("talker")
    for name in ("COLCON_IGNORE", "AMENT_IGNORE"):
        Path(f"talker/{name}_here/below").mkdir(parents=True)
        Path(f"talker/{name}_here/{name}").touch()
        Path(f"talker/{name}_here/below/open.py").write_text("def g(x:\n")
    capsys.readouterr()
    assert main(["migrate", "--to", "lyrical", "--fix"]) == 0
    assert capsys.readouterr().out == "1 package from Jazzy to Lyrical: nothing changes\n"
    assert _recorded("talker") == ["lyrical"]


def test_record_with_unsupported_distribution_does_not_stop_a_check(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    _new("talker", "listener")
    _new("newer", distro="kilted")
    record = Path("talker/.ros2-scaffold.json")
    record.write_text(record.read_text().replace('["jazzy"]', '["foxy"]'))
    for paths, titles in (
        (("talker", "listener"), "1 package, 12 files for Jazzy: "),
        (("talker", "newer"), "1 package, 12 files for Kilted: "),
        ((), "2 packages, 24 files for Jazzy and Kilted: "),
    ):
        for _ in range(2):
            capsys.readouterr()
            assert main(["check", *paths]) == 2
            shown = capsys.readouterr()
            assert "talker/.ros2-scaffold.json: 'foxy' has reached its end of life; " in shown.err
            assert shown.out.splitlines()[-1].startswith(titles)


def test_assumed_origin_is_noted(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    shutil.rmtree(workspace / "twenty")
    for flags, is_named in (((), True), (("--from", "jazzy"), False)):
        capsys.readouterr()
        main(["migrate", "--to", "lyrical", *flags])
        sentence = "listed: the current distribution is neither recorded nor configured: assuming"
        assert (sentence in capsys.readouterr().err) == is_named


def test_call_with_too_many_arguments_is_one_finding(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (workspace / "twenty" / "twenty" / "node.py").write_text(
        "from rclpy.subscription import Subscription\n\n\ndef hear(handle, kind):\n"
        "    return Subscription(handle, kind, 't', print, None, 10, False, None)\n"
    )
    _, everything = migrate(capsys, "twenty")
    (message,) = [item["message"] for item in everything if item["path"].endswith("node.py")]
    assert message.startswith("Subscription() takes 6 positional arguments at most, not 8")


def test_equal_messages_are_grouped(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
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


def test_move_to_an_alias_of_the_same_distribution_is_noted(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["migrate", str(workspace), "--from", "lyrical", "--to", "rolling"]) == 2
    assert "already, which is the same as Rolling for Python packages" in capsys.readouterr().err


def _new(*names: str, distro: str = "jazzy") -> None:
    person = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.org")
    for name in names:
        assert main(["new", name, "--distro", distro, *person]) == 0


def _recorded(name: str) -> object:
    return json.loads(Path(name, ".ros2-scaffold.json").read_text())["answers"]["distro"]


def test_unreadable_files_are_noted_and_nothing_is_recorded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    _new("talker", "whole")
    files = {
        "talker/talker/open.py": b"def g(x:\n",
        "talker/talker/two.py": b"print 'hello'\n",
        "talker/talker/latin.py": b"X = '\xe9'\n",
        "talker/talker/marked.py": b"<<<<<<< ours\nX = 1\n=======\nX = 2\n>>>>>>> theirs\n",
        "talker/launch/open.launch.xml": b"<launch><node",
        "talker/launch/open.launch.yaml": b"launch: [\n",
        "talker/setup.cfg": b"[develop\n",
    }
    for path, content in files.items():
        Path(path).parent.mkdir(exist_ok=True)
        Path(path).write_bytes(content)
    capsys.readouterr()
    assert main(["migrate", "--to", "lyrical", "--fix"]) == 1
    shown = capsys.readouterr()
    for path in files:
        assert f"    {path}:" in shown.out
    assert "breaks:" not in shown.out
    assert shown.out.endswith(
        "2 packages from Jazzy to Lyrical: nothing changes in the examined files; "
        "7 files not examined\n"
    )
    assert "talker: not recorded for Lyrical until the remaining findings are fixed" in shown.err
    assert (_recorded("talker"), _recorded("whole")) == (["jazzy"], ["lyrical"])
    main(["migrate", "talker", "--to", "lyrical", "--format", "json"])
    (package,) = json.loads(capsys.readouterr().out)["packages"]
    assert {item["path"] for item in package["unexamined"]} == {*files}
    assert not package["breaks"]


_SERVED = """\
from rclpy.action import ActionServer
from rclpy.node import Node
from test_msgs.action import Fibonacci


class Server(Node):

    def __init__(self):
        super().__init__('server')
        self.server = ActionServer(self, Fibonacci, 'count', self.count){}

    def count(self, handle):
        handle.succeed()
        return Fibonacci.Result()
"""


def test_package_is_recorded_when_no_finding_is_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    _new("talker")
    module = Path("talker/talker/old.py")
    module.write_text("import cgi\n\nPAGE = cgi\n")
    for _ in range(2):
        capsys.readouterr()
        assert main(["migrate", "talker", "--to", "lyrical", "--fix"]) == 1
        shown = capsys.readouterr()
        assert "no module 'cgi'" in shown.out
        assert "recorded for Lyrical\n" not in shown.err
        assert _recorded("talker") == ["jazzy"]
    module.write_text(_SERVED.format(""))
    assert main(["migrate", "talker", "--to", "lyrical", "--fix"]) == 1
    assert "1 change silently" in capsys.readouterr().out
    module.write_text(_SERVED.format("  # noqa: IM052"))
    assert main(["migrate", "talker", "--to", "lyrical", "--fix"]) == 0
    assert _recorded("talker") == ["lyrical"]
    assert main(["check", "talker", "--select", "IM,SC"]) == 0


def test_syntax_and_annotations_unsupported_by_older_python_break(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    _new("talker", distro="lyrical")
    Path("talker/talker/syntax.py").write_text(
        'def f(x):\n    try:\n        return f"{x["a"]}"\n    except ValueError, TypeError:\n'
        "        return None\n"
    )
    Path("talker/talker/later.py").write_text(
        "class A:\n    def f(self, x: Later): ...\n\n\nclass Later: ...\n"
    )
    capsys.readouterr()
    assert main(["migrate", "--to", "jazzy", "--format", "json"]) == 1
    (package,) = json.loads(capsys.readouterr().out)["packages"]
    result = {item["path"]: item["code"] for item in package["breaks"]}
    assert result["talker/talker/later.py"] == "F821"
    assert result["talker/talker/syntax.py"] == "E999"


def test_paths_outside_of_packages_are_rejected(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    for name in ("loose.txt", "loose.py"):
        Path(name).write_text("")
        assert main(["migrate", name, "--to", "lyrical"]) == 2
        assert f"{name}: not in a ROS 2 package" in capsys.readouterr().err


def test_distutils_provided_by_setuptools_is_a_break(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (workspace / "twenty" / "twenty" / "node.py").write_text("from distutils import util\n")
    capsys.readouterr()
    main(["migrate", "twenty", "--from", "humble", "--to", "jazzy", "--format", "json"])
    (package,) = json.loads(capsys.readouterr().out)["packages"]
    assert "TY001" in {item["code"] for item in package["breaks"]}


def test_packages_of_unknown_origin_are_noted(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.rmtree(workspace / "twenty")
    _new("talker", distro="humble")
    capsys.readouterr()
    assert main(["migrate", "--to", "jazzy"]) == 0
    shown = capsys.readouterr()
    assert shown.out == "1 package from Humble to Jazzy: nothing changes\n"
    assert shown.err.startswith(
        "note: listed: not migrated: the current distribution is neither recorded "
    )


@pytest.mark.parametrize(
    ("names", "flags", "origin"),
    [
        (["foxy"], (), "Humble"),
        (["foxy", "jazzy"], (), "Jazzy"),
        (["foxy"], ("--from", "jazzy"), "Jazzy"),
    ],
)
def test_record_with_unsupported_distribution_can_move(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    names: list[str],
    flags: tuple[str, ...],
    origin: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    _new("talker")
    record = Path("talker/.ros2-scaffold.json")
    record.write_text(record.read_text().replace('["jazzy"]', json.dumps(names)))
    capsys.readouterr()
    assert main(["check", "talker"]) == 2
    assert "migrate the package with `ros2-scaffold migrate talker --to NAME --fix`" in (
        capsys.readouterr().err
    )
    assert main(["migrate", "--to", "lyrical", "--fix", *flags]) == 0
    shown = capsys.readouterr()
    assert shown.out == f"1 package from {origin} to Lyrical: nothing changes\n"
    is_succeeded = (
        "packages recorded for Foxy, which has reached its end of life, are migrated from Humble"
    )
    assert (is_succeeded in shown.err) is (origin == "Humble")
    assert "no longer for Foxy" in shown.err
    assert "--keep foxy" not in shown.err
    assert _recorded("talker") == ["lyrical"]
    assert main(["check", "talker"]) == 0
    record.write_text(record.read_text().replace('["lyrical"]', '["foxy", "humble"]'))
    assert main(["migrate", "--to", "humble", "--fix"]) == 0
    assert _recorded("talker") == ["humble"]


@pytest.mark.parametrize(
    "words",
    [
        ["migrate", "--to", "lyrical"],
        ["check", "--distro", "lyrical"],
        ["check", "--distro", "jazzy,lyrical"],
    ],
)
def test_patch_notes_unreadable_files(
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: list[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    _new("talker", "whole")
    Path("talker/talker/open.py").write_text("def g(x:\n")
    Path("talker/launch").mkdir(exist_ok=True)
    Path("talker/launch/open.launch.xml").write_text("<launch><node")
    capsys.readouterr()
    assert main([*words, "--diff"]) == 1
    note = "note: 2 files not examined: talker/launch/open.launch.xml, talker/talker/open.py\n"
    assert capsys.readouterr().err.endswith(note)


def test_ros1_package_is_not_examined(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    depends = "<buildtool_depend>catkin</buildtool_depend><depend>rospy</depend>"
    (workspace / "listed" / "package.xml").write_text(
        _MANIFEST.format(name="listed", depends=depends, kind="catkin")
    )
    (workspace / "listed" / "CMakeLists.txt").write_text("find_package(catkin REQUIRED)\n")
    assert main(["migrate", "listed", "--to", "lyrical"]) == 1
    out = capsys.readouterr().out
    assert "  not examined:\n    listed/package.xml:8:" in out
    assert "SC007" in out
    assert out.endswith("nothing changes in the examined files; 1 file not examined\n")
