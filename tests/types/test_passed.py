"""Types of arguments passed from one module of a package to another."""

from __future__ import annotations

import ast
import os
from collections.abc import Sequence
from pathlib import Path

import pytest

from scaffold.files.tree import MemoryTree
from scaffold.model.package import Package
from scaffold.types import passed_types, ty
from scaffold.types.rewriting.arguments import with_arguments
from scaffold.types.rewriting.passed import Passed, own_names, places
from scaffold.types.sources import Source
from scaffold.types.ty import TyDiagnostic
from tests.check.test_type_check import Check, check, make_package, source

__all__ = ["check", "source"]

TALK = """from rclpy.node import Node
from std_msgs.msg import String

{}


class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.pub = self.create_publisher(String, 'chatter', 10)
        {}


if __name__ == '__main__':
    Talker()
"""
UTIL = """def name_of(node):
    return 'node ' + node.{0}()


class Arm:
    def __init__(self, node, name='arm'):
        self.node = node
        self.name = name
        self.clock = self.node.{1}()

    def move(self, message):
        print(message.{2})
"""
RIGHT = ("get_name", "get_clock", "data")


@pytest.mark.parametrize(
    ("import_", "statement", "wrong", "found"),
    [
        ("from .util import name_of", "name_of(self)", 0, 2),
        ("from .util import name_of as n", "self.n = n(self)", 0, 2),
        ("from talker.util import (\n    Arm,\n    name_of,\n)", "print(name_of(self))", 0, 2),
        ("from . import util", "util.name_of(self)", 0, 2),
        ("from .util import name_of", "later = lambda: name_of(self)", 0, 2),
        ("from talker import util as u", "u.name_of(node=self)", 0, 2),
        ("import talker.util", "talker.util.name_of(self)", 0, 2),
        ("from .util import Arm", "self.arm = Arm(self)", 1, 9),
        ("from .util import Arm", "self.arm = Arm(self)\n        self.arm.move(String())", 2, 12),
        ("from . import util", "arm = util.Arm(self)\n        arm.move(String())", 2, 12),
    ],
)
def test_argument_types_are_known_in_the_other_module(
    check: Check, source: Path, import_: str, statement: str, wrong: int, found: int
) -> None:
    files = {"talker/talk.py": TALK.format(import_, statement)}
    files["talker/util.py"] = UTIL.format(*RIGHT)
    package = make_package(source, "talker", files)
    assert check("talker") == []
    names = [*RIGHT]
    names[wrong] = "wrong"
    (package / "talker/util.py").write_text(UTIL.format(*names))
    assert check("talker") == [f"talker/talker/util.py:{found}:TY003"]


@pytest.mark.parametrize(
    ("import_", "statement"),
    [
        ("from .util import name_of", "name_of(*[self])"),
        ("from .util import name_of", "name_of(self)\n        name_of(3)"),
        ("from util import name_of", "name_of(self)"),
        ("from .util import Arm", "self.name_of(self)"),
    ],
)
def test_unknown_argument_types(check: Check, source: Path, import_: str, statement: str) -> None:
    files = {"talker/talk.py": TALK.format(import_, statement)}
    files["talker/util.py"] = UTIL.format("wrong", "get_clock", "data")
    make_package(source, "talker", files)
    assert [item for item in check("talker") if "util" in item] == []


def test_argument_of_one_call_does_not_affect_other_cases(check: Check, source: Path) -> None:
    util = (
        "def read(message, kind):\n    if kind == 'text':\n        return message.data\n"
        "    return message.pose\n\n\n"
        "def show(message, prefix):\n    if prefix is None:\n        return ''\n"
        "    return message.words\n"
    )
    call = "read(String(), 'text')\n        show(String(), 'x')"
    files = {"talker/talk.py": TALK.format("from .util import read, show", call)}
    make_package(source, "talker", {**files, "talker/util.py": util})
    assert check("talker") == ["talker/talker/util.py:10:TY003"]


def test_edited_call_changes_the_findings(check: Check, source: Path) -> None:
    files = {
        "talker/talk.py": TALK.format("from .util import name_of", "name_of(self)"),
        "talker/util.py": UTIL.format(*RIGHT),
        "talker/more.py": "import rclpy\n",
        "talker/other.py": "import rclpy\n",
    }
    package = make_package(source, "talker", files)
    assert check("talker") == []
    wrong = "from std_msgs.msg import String\n\nfrom .util import name_of\n\nname_of(String())\n"
    (package / "talker/talk.py").write_text(wrong)
    assert check("talker") == ["talker/talker/util.py:2:TY003"]
    (package / "talker/talk.py").write_text("import rclpy\n")
    assert check("talker") == []
    (package / "talker/more.py").write_text(wrong)  # called nothing before
    assert check("talker") == ["talker/talker/util.py:2:TY003"]
    (package / "talker/other.py").write_text("import rclpy  # edited\n")
    assert check("talker") == ["talker/talker/util.py:2:TY003"]
    (package / "talker/more.py").write_text(f"{wrong}name_of(rclpy.create_node('a'))\n")
    assert check("talker") == []


def test_function_is_only_checked_again_if_argument_types_change(
    check: Check, source: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    call = "from std_msgs.msg import {0}\n\nfrom .util import read\n\nread({0}(), 3)\n"
    files = {
        "talker/talk.py": call.format("String"),
        "talker/util.py": "import numpy\n\n\ndef read(message, count):\n    return message.data\n",
        "talker/other.py": "import rclpy\n",
    }
    package = make_package(source, "talker", files)
    asked: list[str] = []
    start = ty.Run.__init__

    def spied(self: ty.Run, project: str, environment: str, files: Sequence[str]) -> None:
        asked.extend(os.path.basename(path) for path in files)
        start(self, project, environment, files)

    monkeypatch.setattr(ty.Run, "__init__", spied)
    assert check("talker") == []
    assert "_ros2_util.py" in asked
    asked.clear()
    (package / "talker/talk.py").write_text(f"import rclpy\n{call.format('String')}")
    assert check("talker") == []
    assert asked == ["talk.py", "_ros2types_talk.py"]
    (package / "talker/talk.py").write_text(call.format("Empty"))
    assert check("talker") == ["talker/talker/util.py:5:TY003"]
    asked.clear()
    (package / "talker/talk.py").write_text(call.format("String"))
    assert check("talker") == []
    assert asked == []


def test_incomplete_types_are_unknown() -> None:
    def known(type_: str, own: str = "") -> bool:
        reported = [TyDiagnostic("revealed-type", 1, 1, 1, 1, f"Revealed type: `{type_}`")]
        package = Package(MemoryTree({}))
        reached = {
            "lib/talker/talk.py": Source(package, "talk.py", "", "", own.encode()),
            "lib/arm_msgs/msg/_joint.pyi": Source(package, "", "", "", b""),
        }
        passed = [Passed("talker.util.read", "talker.talk", {"0": "_ros2_given_1"})]
        ((_, given),) = passed_types.types(passed, reported, reached)
        return bool(given)

    assert known("list[int]")
    assert known('list[Literal["Joint"] | None]')
    assert known("list[String·std_msgs·msg·_string | Unknown]")
    assert not known("list[Joint·arm_msgs·msg·_joint]")  # of the workspace
    assert not known("list[Talker]")
    assert not known("def read(message: int) -> str")
    assert not known("list[int]", "class int(str): pass\n")


def test_inserted_lines() -> None:
    names = own_names(b"from .arm import Arm, move\nfrom .msg import Beat\n", "robot.main")
    assert names == {"Arm": "robot.arm.Arm", "move": "robot.arm.move"}
    text = "arm = Arm(1)\narm.turn(angle)\nmove('a', b)\nBeat(1)\nremove(1)\n"
    assert [(item.function, item.start) for item in places(text, names)] == [
        ("robot.arm.Arm", 6),
        ("robot.arm.move", 29),
        ("robot.arm.Arm.turn", 13),
    ]
    text = f"from .arm import Arm, move\n{text}"
    passed = with_arguments(text.encode(), "robot.main").passed
    kept = "_ros2_given_robot_main_56_1", "_ros2_given_robot_main_40_0"
    assert [*passed] == [
        Passed("robot.arm.Arm", "robot.main", {"0": "1"}),
        Passed("robot.arm.move", "robot.main", {"0": "'a'", "1": kept[0]}),
        Passed("robot.arm.Arm.turn", "robot.main", {"0": kept[1]}),
    ]
    arm = "def move(name: str, by):\n    pass\n"
    text = with_arguments(arm.encode(), "robot.arm", passed).data.decode()
    ast.parse(text)
    assert text.split("\n")[:2] == [
        "def move(name     , by):",
        f"    from robot.main import {kept[0]}; name = (['a'])[0]; by = ({kept[0]})[0]",
    ]


@pytest.mark.parametrize(
    ("call", "functions"),
    [
        ("self.send('x')", ["talker.hub.Hub.send"]),
        ("super().__init__('x')", ["talker.hub.Hub"]),
        ("super().send('x')", ["talker.hub.Hub.send"]),
        ("super().own('x')", ["talker.hub.Hub.own"]),
        ("self.own('x')", []),
        ("self.create_timer(1.0, self.own)", []),
        ("self.stop()", []),
    ],
)
def test_calls_of_inherited_methods(call: str, functions: list[str]) -> None:
    text = (
        "from talker.hub import Hub\n\n\nclass Talker(Hub):\n    def own(self, text):\n"
        f"        {call}\n\n\nclass Other(Node):\n    def run(self):\n        self.send('y')\n"
    )
    names = own_names(text.encode(), "talker.talker")
    assert [place.function for place in places(text, names)] == functions
    mixed = text.replace("(Hub)", "(Node, Hub)")
    of_node = [name for name in functions if name != "talker.hub.Hub"]
    assert [place.function for place in places(mixed, names)] == of_node
