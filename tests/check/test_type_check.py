"""The type checker sees the files of the workspace and the stubs, and nothing else of the user."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from scaffold import distributions
from scaffold.check import type_findings
from scaffold.cli.main import main
from scaffold.files import cache
from scaffold.model.package import Package
from scaffold.programs import bundled
from scaffold.types import environment, ty
from scaffold.types.finding import TypeFinding
from scaffold.types.rewriting.added_lines import Extended, with_lines
from scaffold.types.ty import TyDiagnostic

MANIFEST = """<?xml version="1.0"?>
<package format="3">
  <name>{}</name>
  <version>0.1.0</version>
  <description>An example</description>
  <maintainer email="ann@example.com">Ann</maintainer>
  <license>Apache-2.0</license>
{}  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""
NODE = """import rclpy
from rclpy.node import Node


class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.create_guard_condition(callback=3, wait=True)
"""
FOUND = "talker/talk.py:8:TY004"


def make_package(root: Path, name: str, files: dict[str, str], dependencies: str = "") -> Path:
    texts = {"package.xml": MANIFEST.format(name, dependencies), f"{name}/__init__.py": "", **files}
    for path, text in texts.items():
        target = root / name / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)
    return root / name


Check = Callable[..., list[str]]


@pytest.fixture
def check(
    own_cache: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> Check:
    """Return a function that checks types and returns file, line and code of the findings."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    monkeypatch.delenv(cache.SWITCH, raising=False)
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    (tmp_path / "src").mkdir()
    monkeypatch.chdir(tmp_path / "src")

    def run(*words: str, code: int | None = None) -> list[str]:
        status = main(["check", "--select", "TY,SC", "--format", "json", *words])
        out, err = capsys.readouterr()
        if code is not None:
            assert (status, bool(err)) == (code, code > 1), err
        return [
            f"{item['path']}:{item['line']}:{item['code']}"
            for item in json.loads(out)["diagnostics"]
        ]

    return run


@pytest.fixture
def source(tmp_path: Path) -> Path:
    return tmp_path / "src"


def test_api_misuse_is_reported(check: Check, source: Path) -> None:
    make_package(source, "talker", {"talker/talk.py": NODE})
    assert check("talker", code=1) == [f"talker/{FOUND}"]
    assert check("talker", "--no-types", code=0) == []


def test_only_files_with_findings_are_checked_without_annotations(
    check: Check, source: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs: list[str] = []
    start = ty.Run.__init__

    def spied(self: ty.Run, project: str, environment: str, files: Sequence[str]) -> None:
        runs.append(os.path.basename(project))
        start(self, project, environment, files)

    monkeypatch.setattr(ty.Run, "__init__", spied)
    call = "self.create_guard_condition(callback=3, wait=True)"
    tried = f"try:\n            {call}\n        except TypeError:\n            pass"
    package = make_package(source, "talker", {"talker/talk.py": NODE.replace(call, tried)})
    assert check("talker") == []
    assert runs == ["project"]
    (package / "talker/talk.py").write_text(NODE)
    assert check("talker") == [f"talker/{FOUND}"]
    assert runs == ["project", "project"]  # there is no annotation to remove
    (package / "talker/talk.py").write_text(f"{NODE}\n\ncount: int = 1\n")
    assert check("talker") == [f"talker/{FOUND}"]
    assert runs == ["project", "project", "project", "unannotated"]


def test_types_reach_across_files_and_packages(check: Check, source: Path) -> None:
    base = "from rclpy.node import Node\n\n\nclass Base(Node):\n    pass\n"
    make_package(source, "base", {"base/node.py": base})
    own = "from .talk import Talker\n\nTalker().create_timer()\n"
    node = NODE.replace("rclpy.node import Node", "base.node import Base").replace(
        "(Node)", "(Base)"
    )
    make_package(source, "talker", {"talker/talk.py": node, "talker/more.py": own})
    assert check(".") == ["talker/talker/more.py:3:TY004", f"talker/{FOUND}"]


def test_batches_find_what_one_run_finds(
    check: Check, source: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(type_findings, "BATCH", 1)
    names = ("hall", "kitchen", "talker")
    for name in names:
        make_package(source, name, {f"{name}/talk.py": NODE})
    assert check(".", code=1) == [f"{name}/{name}/talk.py:8:TY004" for name in names]


def test_equal_module_names_of_packages_are_separate(check: Check, source: Path) -> None:
    make_package(
        source, "voice", {"voice/word.py": "class Word:\n    def __init__(self):\n        pass\n"}
    )
    use = "import rclpy\nfrom voice.word import Word\n\nrclpy.init()\nWord(3)\n"
    make_package(source, "robot", {"robot/use.py": use})
    assert check(".") == ["robot/robot/use.py:5:TY004"]
    own = "class Word:\n    def __init__(self, size):\n        self.size = size\n"
    files = {"voice/__init__.py": "", "voice/word.py": own}
    make_package(source, "robot", {"robot/use.py": use, **files})
    assert check(".") == []


def test_interfaces_of_the_workspace_have_types(check: Check, source: Path) -> None:
    lists = "project(my_msgs)\nrosidl_generate_interfaces(my_msgs msg/Beat.msg)\n"
    package = make_package(
        source, "my_msgs", {"CMakeLists.txt": lists, "msg/Beat.msg": "float64 rate\n"}
    )
    manifest = package / "package.xml"
    manifest.write_text(manifest.read_text().replace("ament_python", "ament_cmake"))
    uses = "from my_msgs.msg import Beat\n\nbeat = Beat()\nbeat.rate()\nprint(beat.rat)\n"
    make_package(source, "talker", {"talker/talk.py": uses})
    assert check("talker") == ["talker/talker/talk.py:4:TY008", "talker/talker/talk.py:5:TY003"]


def test_code_of_another_workspace_is_not_held_against_packages_of_this_one(
    check: Check, source: Path
) -> None:
    lists = "project(my_msgs)\nrosidl_generate_interfaces(my_msgs msg/{}.msg)\n"
    for side, message in (("robot", "Beat"), ("server", "Map")):
        files = {"CMakeLists.txt": lists.format(message), f"msg/{message}.msg": "float64 rate\n"}
        package = make_package(source / side, "my_msgs", files)
        manifest = package / "package.xml"
        manifest.write_text(manifest.read_text().replace("ament_python", "ament_cmake"))
        uses = f"from my_msgs.msg import {message}\n\nprint({message}().rates)\n"
        make_package(source / side, side, {f"{side}/use.py": uses})
    assert check(".") == ["robot/robot/robot/use.py:3:TY003"]


def test_callback_receives_the_subscribed_type(check: Check, source: Path) -> None:
    """Whatever its annotation, and whichever other class has a method of this name."""
    node = """from example_interfaces.action import Fibonacci
from rclpy.action import ActionServer
from rclpy.node import Node
from std_msgs.msg import Float64, Header, String
from std_srvs.srv import Trigger


class Listener(Node):
    def __init__(self):
        super().__init__('listener')
        self.create_subscription(String, self.name(('a', 'b')), self.on_message, 10)
        self.create_subscription(Header, 'times', self.on_header, qos_profile=1)
        self.create_service(Trigger, 'start', self.start)
        ActionServer(self, Fibonacci, 'count', execute_callback=self.count)

    def on_message(self, message):
        print(message.stamp)

    def on_header(self, header: String) -> None:
        print(header.stamp.sec, header.data)

    def start(self, request, response):
        response.succes = True
        return response

    async def count(self, goal_handle):
        goal_handle.succeed(Fibonacci.Result())


class Other(Node):
    def __init__(self):
        super().__init__('other')
        self.create_subscription(Float64, 'speeds', self.on_message, 10)
        self.create_subscription(Float64, 'more', self.on_any, 10)
        self.create_subscription(String, 'less', self.on_any, 10)

    def on_message(self, message):
        print(message.speed)

    def on_any(self, message):
        print(message.anything)
"""
    make_package(source, "listener", {"listener/node.py": node})
    findings = [line.removeprefix("listener/listener/node.py:") for line in check("listener")]
    assert findings == ["17:TY003", "20:TY003", "23:TY003", "27:TY004", "38:TY003"]


def test_parameter_with_conflicting_values_has_no_type(check: Check, source: Path) -> None:
    node = """from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from sensor_msgs.msg import LaserScan


class Mapper(Node):
    def __init__(self):
        super().__init__('mapper')
        self.publisher = self.create_publisher(OccupancyGrid, 'map', 1)
        self.create_subscription(LaserScan, 'scan', self.on_scan, 10)
        self.create_subscription(LaserScan, 'back', self.on_back, 10)
        self.create_subscription(LaserScan, 'left', self.on_left, 10)

    def on_scan(self, msg):
        print(msg.ranges)
        # no longer the scan
        msg = OccupancyGrid()
        msg.info.width = 2
        self.publisher.publish(msg)

    def on_back(self, msg: LaserScan):
        for msg in self.grids():
            print(msg.info)

    def on_left(self, msg):
        print(dict(
            msg=msg,
        ))
        print(msg.info)

    def grids(self):
        msg = 2
        return msg
"""
    make_package(source, "mapper", {"mapper/node.py": node})
    assert check("mapper") == ["mapper/mapper/node.py:29:TY003"]


def test_value_set_for_another_distribution_has_no_type(check: Check, source: Path) -> None:
    node = """import os

from geometry_msgs.msg import Twist, TwistStamped
from rclpy.node import Node


class Driver(Node):
    def __init__(self):
        super().__init__('driver')
        is_stamped = os.environ['ROS_DISTRO'] >= 'jazzy'
        if is_stamped:
            self.publisher = self.create_publisher(TwistStamped, 'cmd_vel', 1)
        else:
            self.publisher = self.create_publisher(Twist, 'cmd_vel', 1)
        if is_stamped:
            self.publisher.publish(TwistStamped())
        else:
            self.publisher.publish(Twist())
        self.create_guard_condition(callback=3, wait=True)
"""
    make_package(source, "driver", {"driver/node.py": node})
    for distribution in ("humble", "jazzy"):
        findings = check("driver", "--distro", distribution)
        assert findings == ["driver/driver/node.py:19:TY004"]


def test_another_finding_on_the_line_hides_nothing(check: Check, source: Path) -> None:
    node = """import tf2_geometry_msgs
from geometry_msgs.msg import PointStamped
from rclpy.node import Node
from tf2_ros import Buffer, TransformListener


class Follower(Node):
    def __init__(self):
        super().__init__('follower')
        self.buffer = Buffer()
        self.listener = TransformListener(self.buffer, self)
        self.create_subscription(PointStamped, 'point', self.on_point, 10)

    def on_point(self, point):
        self.point = self.buffer.transform(point, 'map', timeout=0.5)
        self.get_parameter('a', 'b')
"""
    make_package(source, "follower", {"follower/node.py": node})
    path = "follower/follower/node.py"
    findings = check("follower", "--select", "TY,ND110")
    assert findings == [f"{path}:15:ND110", f"{path}:15:TY005", f"{path}:16:TY004"]


def test_user_annotations_are_ignored(check: Check, source: Path) -> None:
    node = """from geometry_msgs.msg import TransformStamped
from rclpy.node import Node
from std_msgs.msg import String


def topic_of(name) -> String:
    return name.upper()


class Talker(Node):
    names: list[
        String
    ]

    def __init__(self, topic: String, pose: TransformStamped):
        super().__init__('talker')
        self.create_publisher(String, topic, 10)
        self.create_publisher(String, topic_of(topic), 10)
        pose = pose.transform
        print(pose.translation)
        self.text: String = 'é'; print(self.text.upper())
        self.last: String = String(); print(self.last.txt)
"""
    make_package(source, "talker", {"talker/node.py": node})
    assert check("talker") == ["talker/talker/node.py:22:TY003"]


# -- what is imported decides as well


def test_edited_import_changes_the_findings(check: Check, source: Path) -> None:
    package = make_package(
        source,
        "talker",
        {
            "talker/make.py": "from rclpy.duration import Duration\n\n\ndef make():\n"
            "    return Duration(seconds=1)\n",
            "talker/talk.py": "from talker.make import make\n\nprint(make() > make())\n",
        },
    )
    assert check("talker") == []
    (package / "talker/make.py").write_text("from rclpy.clock import Clock as make\n")
    warm = check("talker")
    assert warm == ["talker/talker/talk.py:3:TY006"]
    (package / "talker/make.py").write_text("make = 3.0 .__add__\n")
    assert check("talker") == []


def test_edit_in_another_package_changes_the_findings(check: Check, source: Path) -> None:
    """Both packages are large enough to be cached in parts."""
    many = {f"part_{number}.py": "VALUE = 1\n" for number in range(12)}
    maker = make_package(
        source,
        "maker",
        {
            **{f"maker/{path}": text for path, text in many.items()},
            "maker/make.py": "from rclpy.clock import Clock\n\nCLOCK = Clock()\n",
        },
    )
    files = {f"talker/{path}": text for path, text in many.items()}
    files["talker/talk.py"] = "from maker.make import CLOCK\n\nCLOCK.now()\n"
    make_package(source, "talker", files)
    assert check(".") == []
    (maker / "maker/make.py").write_text("from rclpy.node import Node\n\nCLOCK = Node('a')\n")
    assert check(".") == ["talker/talker/talk.py:3:TY003"]


def test_unchanged_file_is_not_checked_again(
    check: Check, source: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = {"talker/talk.py": NODE, "talker/more.py": "import rclpy\n"}
    package = make_package(source, "talker", files)
    before = check("talker")
    asked: list[list[str]] = []
    start = ty.Run.__init__

    def watched(run: ty.Run, project: str, environment: str, files: list[str]) -> None:
        asked.append([os.path.basename(path) for path in files])
        start(run, project, environment, files)

    monkeypatch.setattr(ty.Run, "__init__", watched)
    assert check("talker") == before
    (package / "talker/more.py").write_text("import rclpy\n\nrclpy.init()\n")
    assert check("talker") == before
    assert asked == [["more.py"]]


def test_edit_keeps_type_findings_of_other_files(
    check: Check, source: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    accepted = NODE.replace("wait=True)", "wait=True)  # noqa: TY004")
    files = {
        "talker/talk.py": NODE,
        "talker/quiet.py": accepted,
        "talker/more.py": "import rclpy\n",
    }
    package = make_package(source, "talker", files)
    before = check("talker")
    judged: list[str] = []
    start = TypeFinding.__init__

    def watched(finding: TypeFinding, package: Package, path: str, reported: TyDiagnostic) -> None:
        judged.append(path)
        start(finding, package, path, reported)

    monkeypatch.setattr(TypeFinding, "__init__", watched)
    (package / "talker/more.py").write_text("import rclpy\n\nrclpy.init()\n")
    assert check("talker") == before == [f"talker/{FOUND}"]
    assert set(judged) == {"talker/quiet.py"}  # whether a comment suppresses is asked each time
    (package / "talker/more.py").write_text("import rclpy\n\nrclpy.initialize()\n")
    assert check("talker") == ["talker/talker/more.py:3:TY003", *before]


@pytest.mark.parametrize("damage", ["clean", "edit", "remove"])
def test_damaged_stubs_are_written_again(
    check: Check,
    source: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    damage: str,
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))  # not shared with other tests
    make_package(source, "talker", {"talker/talk.py": NODE})
    assert check("talker") == [f"talker/{FOUND}"]
    (stub,) = (tmp_path / "cache").rglob("rclpy/node.pyi")
    if damage == "clean":
        main(["cache", "clean"])
        capsys.readouterr()
    elif damage == "edit":
        stub.write_text("")
    else:
        stub.unlink()
    make_package(source, "talker", {"talker/talk.py": NODE + "# changed\n"})
    assert check("talker") == [f"talker/{FOUND}"]


# -- nothing of the user's counts


def _fake_interpreter(path: Path, canary: Path) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\ntouch {canary}\n")
    path.chmod(0o755)


def _plant_configuration(top: Path, canary: Path) -> None:
    """Write configuration and environments that would disable checks or run code."""
    fake = top / ".venv" / "bin" / "python"
    for name in ("python", "python3", "python3.12"):
        _fake_interpreter(fake.with_name(name), canary)
    (top / ".venv/pyvenv.cfg").write_text("home = /usr/bin\nversion = 3.12\n")
    packages = top / ".venv/lib/python3.12/site-packages/rclpy"
    packages.mkdir(parents=True)
    (packages / "__init__.py").write_text("")
    (packages / "node.py").write_text("from typing import Any\nNode: Any\n")
    (packages / "py.typed").write_text("")
    for stubs in ("typings/rclpy", "stubs/rclpy", "rclpy-stubs"):
        (top / stubs).mkdir(parents=True)
        (top / stubs / "__init__.pyi").write_text("")
        (top / stubs / "node.pyi").write_text("from typing import Any\nNode: Any\n")
    (top / "ty.toml").write_text(f'[rules]\nall = "ignore"\n[environment]\npython = "{fake}"\n')
    (top / "pyrefly.toml").write_text(f'python-interpreter-path = "{fake}"\n')
    (top / "pyproject.toml").write_text(
        f'[tool.ty.rules]\nall = "ignore"\n[tool.ty.environment]\npython = "{fake}"\n'
        f'[tool.pyrefly]\npython-interpreter-path = "{fake}"\n'
    )
    (top / "mypy.ini").write_text(f"[mypy]\npython_executable = {fake}\n")
    (top / ".gitignore").write_text("*.py\n")


@pytest.mark.parametrize("above", [".", "talker", "talker/talker"])
def test_configuration_and_environments_are_ignored(
    check: Check, source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, above: str
) -> None:
    make_package(source, "talker", {"talker/talk.py": NODE})
    canary = tmp_path / "canary"
    _plant_configuration(source / above, canary)
    monkeypatch.chdir(source / above)
    (finding,) = check(str(source / "talker"))
    assert finding.endswith("talk.py:8:TY004")
    assert not canary.exists()


def test_variables_and_user_configuration_are_ignored(
    check: Check, source: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    make_package(source, "talker", {"talker/talk.py": NODE})
    home, canary = tmp_path / "home", tmp_path / "canary"
    _plant_configuration(home, canary)
    (home / ".config/ty").mkdir(parents=True)
    (home / ".config/ty/ty.toml").write_text('[rules]\nall = "ignore"\n')
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(home / ".config"))
    monkeypatch.setenv("VIRTUAL_ENV", str(home / ".venv"))
    monkeypatch.setenv("CONDA_PREFIX", str(home / ".venv"))
    monkeypatch.setenv("TY_CONFIG_FILE", str(home / "ty.toml"))
    monkeypatch.setenv("TY_OUTPUT_FORMAT", "concise")
    monkeypatch.setenv("PYTHONPATH", str(home / ".venv/lib/python3.12/site-packages"))
    assert check("talker") == [f"talker/{FOUND}"]
    assert not canary.exists()


# -- a type checker that is not there, or is another


def _replace(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, script: str) -> None:
    program = tmp_path / "ty"
    program.write_text(f"#!/bin/sh\n{script}\n")
    program.chmod(0o755)
    monkeypatch.setattr(ty, "executable", lambda: str(program))


VERSION = f'[ "$1" = --version ] && echo ty {ty.VERSION} && exit\n'
PANIC = json.dumps(
    [
        {
            "check_name": "panic",
            "description": "panic: too many cycles",
            "location": {
                "path": "",
                "positions": {"begin": {"line": 1, "column": 1}, "end": {"line": 1, "column": 1}},
            },
        }
    ]
)
"""What ty reports if it stumbles over a file; it leaves the others out, and exits with 0."""


@pytest.mark.parametrize(
    ("script", "why"),
    [
        ("echo ty 0.0.1", "version 0.0.1"),
        (f"{VERSION}exit 101", "exit status 101"),
        (f"{VERSION}kill -SEGV $$", "exit status -11"),
        (f"{VERSION}echo '{PANIC}'", "too many cycles"),
        (f"{VERSION}echo nonsense", "cannot be read"),
        (f"{VERSION}exec sleep 600", "did not finish"),
        (f"{VERSION}exec yes", "did not finish"),
    ],
    ids=[
        *("another version", "fails", "crashes", "panics", "says nonsense", "hangs"),
        "never stops writing",
    ],
)
def test_other_rules_run_without_the_type_checker(
    source: Path,
    check: Check,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    script: str,
    why: str,
) -> None:
    make_package(source, "talker", {"talker/talk.py": NODE + "import os\n"})
    monkeypatch.setattr(ty, "SECONDS", 1.0)
    _replace(monkeypatch, tmp_path, script)
    for _ in range(2):
        assert main(["check", "talker"]) == 2
        out, err = capsys.readouterr()
        assert "F401" in out
        assert err.count("\n") == 1
        assert "types are not checked" in err
        assert why in err
    assert main(["check", "--no-types", "talker"]) == 1
    assert capsys.readouterr().err == ""
    monkeypatch.undo()
    monkeypatch.chdir(source)
    assert f"talker/{FOUND}" in check("talker")


def test_missing_type_checker_is_noted(
    source: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    source.mkdir()
    make_package(source, "talker", {"talker/talk.py": NODE})
    monkeypatch.chdir(source)
    monkeypatch.setattr(ty, "_FOUND", {})
    monkeypatch.setattr(sys, "executable", "/nonexistent/python")
    monkeypatch.setattr(sys, "prefix", "/nonexistent")
    monkeypatch.setattr(bundled, "find", lambda _name: None)
    assert main(["check", "--select", "TY", "talker"]) == 2
    assert "ty is not installed; pip install" in capsys.readouterr().err


def test_unparsable_file_does_not_hide_others(check: Check, source: Path) -> None:
    make_package(source, "talker", {"talker/talk.py": NODE, "talker/bad.py": "def f(:\n"})
    assert check("talker") == [f"talker/{FOUND}"]


def test_unparsable_inserted_lines_hide_nothing(
    check: Check, source: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def with_arguments(data: bytes, *_: object) -> Extended:
        return with_lines(data.decode(), {0: ["x = ("]})

    monkeypatch.setattr("scaffold.types.project.with_arguments", with_arguments)
    make_package(source, "talker", {"talker/talk.py": NODE})
    assert check() == [f"talker/{FOUND}"]


def test_file_that_crashes_the_type_checker_does_not_hide_others(
    check: Check, source: Path
) -> None:
    deep = "import rclpy\n\nx = " + "[" * 9_000 + "]" * 9_000 + "\n"
    more = {f"talker/more_{number}.py": "import rclpy\n" for number in range(5)}
    make_package(source, "talker", {"talker/talk.py": NODE, "talker/deep.py": deep, **more})
    assert check("talker") == [f"talker/{FOUND}"]


# -- suppression


def test_noqa_suppresses_a_type_finding(check: Check, source: Path) -> None:
    accepted = NODE.replace("wait=True)", "wait=True)  # noqa: TY004")
    unused = "import rclpy  # noqa: TY003\n"
    make_package(source, "talker", {"talker/talk.py": accepted, "talker/more.py": unused})
    assert check("talker") == ["talker/talker/more.py:1:SC003"]
    assert check("talker", "--no-types") == []


def test_noqa_of_a_rule_covers_the_type_finding_at_the_same_place(
    check: Check, source: Path
) -> None:
    node = """import rclpy


def main():
    rclpy.init()
    node = rclpy.create_node('talker')
    node.get_logger().warn('up')
"""
    make_package(source, "talker", {"talker/talk.py": node}, "<depend>rclpy</depend>")
    flags = ("talker", "--distro", "lyrical", "--select", "IM,TY,SC")
    assert check(*flags) == ["talker/talker/talk.py:7:IM050"]
    accepted = node.replace("('up')", "('up')  # noqa: IM050")
    (source / "talker" / "talker" / "talk.py").write_text(accepted)
    assert check(*flags) == []
    assert check("talker", "--distro", "lyrical", "--select", "TY")


def test_stubs_written_by_another_process_are_kept(tmp_path: Path) -> None:
    place = tmp_path / "stubs"
    environment._write_aside(distributions.JAZZY, str(place))  # noqa: SLF001  as two processes do
    before = place.stat().st_ino
    environment._write_aside(distributions.JAZZY, str(place))  # noqa: SLF001
    assert place.stat().st_ino == before
    assert [*tmp_path.iterdir()] == [place]


def test_incomplete_stubs_are_written_again(tmp_path: Path) -> None:
    place = tmp_path / "stubs"
    environment._write_aside(distributions.JAZZY, str(place))  # noqa: SLF001
    (place / "pyvenv.cfg").unlink()
    environment._write_aside(distributions.JAZZY, str(place))  # noqa: SLF001
    assert (place / "pyvenv.cfg").is_file()


def test_world_readable_stubs_are_kept(tmp_path: Path) -> None:
    places = [tmp_path / str(number) for number in range(environment.KEPT + 2)]
    for place in places:
        place.mkdir()
    os.utime(places[0], (0, 0))
    environment.trim(str(tmp_path))
    assert sorted(tmp_path.iterdir()) == places[1:]
