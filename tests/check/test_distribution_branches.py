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
import os, sys

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
        ("self.is_old or distro == 'humble'", [11, 13]),
        ("self.is_old", [11, 13]),
        ("distro > 'k'", [11]),
        ("distro.startswith(('h', 'j'))", [13]),
        ("distro[0] in 'hj'", [13]),
        ("(os.environ.get('ROS_DISTRO') or 'jazzy') == 'jazzy'", [13]),
        ("is_old(distro)", []),
        ("distro in RELEASES", []),
        ("RELEASES[distro]", []),
        ("distro == 'humble' and self.is_old", [13]),
        ("not (distro == 'lyrical' and self.is_old)", [11, 13]),
        ("distro != 'humble' and is_old(distro)", []),
        ("'humble' <= distro < 'lyrical'", [13]),
        ("sys.version_info >= (3, 12)", [11]),
        ("sys.version_info[:2] == (3, 10) and self.is_old", [13]),
        ("(3, 12) > sys.version_info", [13]),
        ("sys.version_info >= (3, 14, 0)", [11]),
        ("sys.version_info >= (3, 14, 2)", []),
        ("sys.version_info[-1] == 14", []),
        ("sys.version_info.minor < 14 or sys.version_info.major < 3", [13]),
        ("sys.hexversion >= 0x030c0000", [11]),
        ("sys.hexversion < 0x030e02f0", []),
        ("callable(getattr(self.get_logger(), 'warn', None))", []),
        ("'warn' in dir(self.get_logger())", []),
        ("'port' in dir(self)", [11, 13]),
    ],
)
def test_python(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], condition: str, lines: list[int]
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    (tmp_path / "talker.py").write_text(_NODE.format(condition, "else:"))
    expected = [("IM050", line, ["lyrical"]) for line in lines]
    assert found(capsys, tmp_path, "lyrical") == expected


_FORMS = {
    "a name for a comparison": (
        "OLD = D in ('humble', 'jazzy')\nif OLD:\n    {}\nelse:\n    {}\n",
        [9],
    ),
    "a name for a name": (
        "OLD = D < 'k'\ndef talk():\n    new = not OLD\n    if new: {}\n    else: {}\n",
        [8],
    ),
    "a name that is set again": ("OLD = D < 'k'\nOLD = True\nif OLD:\n    {}\n", []),
    "ternary": ("{} if D == 'jazzy' else {}\n", [5]),
    "ternary on several lines": ("_ = ({}\n     if D == 'jazzy' else\n     {})\n", [7]),
    "and": ("D == 'jazzy' and {}\nD == 'lyrical' or {}\nD == 'jazzy' or {}\n", [7]),
    "while": ("while D == 'jazzy':\n    {}\nelse:\n    {}\n", [8]),
    "early return": (
        "def talk():\n    if D != 'lyrical':\n        {}\n        return\n    {}\n",
        [9],
    ),
    "early return of the target": (
        "def talk():\n    if D == 'lyrical':\n        return\n    {}\ndef speak():\n    {}\n",
        [10],
    ),
    "the end of the program": ("import sys\nif D == 'lyrical':\n    sys.exit(1)\n{}\n", []),
    "all branches leave": (
        "def do(a):\n    if D != 'jazzy':\n        if a: return\n        else: raise E\n    {}\n",
        [],
    ),
    "a branch that stays": (
        "def talk(a):\n    if D == 'jazzy':\n        return\n    elif a:\n        return\n    {}\n",
        [10],
    ),
    "return where nobody knows": ("def talk():\n    if old(D):\n        return\n    {}\n", []),
    "loop": ("for _ in D:\n    if D > 'k':\n        continue\n    {}\n{}\n", [9]),
    "match": (
        "match D:\n    case 'humble' | 'jazzy': {}\n    case 'lyrical': {}\n    case _: {}\n",
        [7],
    ),
    "match with a name": (
        "match D:\n    case 'jazzy':\n        {}\n    case other:\n        {}\n",
        [9],
    ),
    "match that nobody knows": (
        "match D:\n    case names.OLD:\n        {}\n    case _:\n        {}\n",
        [],
    ),
    "a function": (
        "def is_old():\n    return D < 'k'\nif is_old():\n    {}\nelse:\n    {}\n",
        [10],
    ),
    "attributes": (
        "class A:\n    A = D < 'k'\n    def f(self):\n        if self.A: {}\n        else: {}\n",
        [9],
    ),
    "an attribute that is set again": (
        "class C:\n    a = D < 'k'\n    def f(self):\n        self.a = b\n        if self.a: {}\n",
        [],
    ),
    "a test that is skipped": (
        (
            "@pytest.mark.skipif(D >= 'lyrical', reason='gone')\ndef test_a():\n    {}\n"
            "@pytest.mark.skipif(D < 'lyrical', reason='new')\ndef test_b():\n    {}\n"
        ),
        [10],
    ),
    "a mark with a name": (
        (
            "OLD = pytest.mark.skipif(D > 'k' and A, reason='gone')\n@OLD\ndef test_a():\n    {}\n"
            "NEW = pytest.mark.skipif(condition=D > 'k', reason='gone')\n@NEW\n"
            "def test_b():\n    {}\n"
        ),
        [8],
    ),
    "a mark that is not known": ("@pytest.mark.skipif(is_new(D))\ndef test_a():\n    {}\n", []),
    "a mark about something else": ("@pytest.mark.skipif(WINDOWS)\ndef test_a():\n    {}\n", [7]),
    "a mark in a text": (
        "@pytest.mark.skipif('sys.version_info > (3, 12)')\ndef test_a():\n    {}\n",
        [],
    ),
    "a mark that asks for the name": (
        "@pytest.mark.skipif(not hasattr(L, 'warn'), reason='')\ndef test_a():\n    {}\n",
        [],
    ),
    "a test that fails there": (
        "@pytest.mark.xfail(D > 'k', reason='')\ndef test_a():\n    {}\n",
        [],
    ),
    "the marks of a file": (
        (
            "pytestmark = [pytest.mark.slow, pytest.mark.skipif(D > 'k', reason='')]\n{}\n"
            "def test_a():\n    {}\n"
        ),
        [6],
    ),
    "the marks of a class": (
        (
            "class TestA:\n    pytestmark = pytest.mark.skipif(D > 'k', reason='')\n"
            "    def test_a(self):\n        {}\nclass TestB:\n    def test_b(self):\n        {}\n"
        ),
        [11],
    ),
    "a class that is skipped": (
        (
            "@unittest.skipIf(D > 'k', '')\nclass A(unittest.TestCase):\n    def test_a(self): {}\n"
            "@unittest.skipUnless(D > 'k', '')\nclass B(unittest.TestCase):\n"
            "    def test_b(self): {}\n"
        ),
        [10],
    ),
    "a test that skips itself": (
        (
            "def test_a():\n    if D > 'k':\n        pytest.skip('gone')\n    {}\n"
            "class A(unittest.TestCase):\n    def test_b(self):\n        if D > 'k':\n"
            "            self.skipTest('gone')\n        {}\n    def test_c(self):\n"
            "        if D < 'k':\n            self.skipTest('new')\n        {}\n"
        ),
        [17],
    ),
    "a test that asks for the name and skips itself": (
        "def test_a():\n    if not hasattr(L, 'warn'):\n        pytest.skip('gone')\n    {}\n",
        [],
    ),
    "a file that skips itself": (
        "{}\nif D > 'k':\n    pytest.skip('gone', allow_module_level=True)\n{}\n",
        [5],
    ),
    "an error that is expected": (
        (
            "def test_a(self):\n    with pytest.raises(AttributeError): {}\n"
            "    with self.assertRaises((TypeError, AttributeError)): {}\n"
            "    with pytest.raises(TypeError): {}\n"
        ),
        [8],
    ),
    "a name of itself": ("def talk():\n    D = D.lower()\n    if D == 'jazzy':\n        {}\n", [8]),
}


@pytest.mark.parametrize("name", _FORMS)
def test_forms_of_python(tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    form, lines = _FORMS[name]
    head = "import os, pytest, unittest\nfrom rclpy.logging import get_logger\n"
    head += "L = get_logger('talker')\nD = os.environ['ROS_DISTRO']\n"
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    (tmp_path / "talker.py").write_text(head + form.replace("{}", "L.warn('here')"))
    expected = [("IM050", line, ["lyrical"]) for line in lines]
    assert found(capsys, tmp_path, "lyrical") == expected


_MODULE = "import pytest\nfrom importlib.util import find_spec\nfrom typing import TYPE_CHECKING\n"


@pytest.mark.parametrize(
    ("code", "lines"),
    [
        ("import rclpy.qos_event\n", [4]),
        ("if TYPE_CHECKING:\n    import rclpy.qos_event\nelse:\n    import rclpy.qos_event\n", [7]),
        ("if find_spec('rclpy.qos_event') is not None:\n    import rclpy.qos_event\n", []),
        ("if find_spec('rclpy'):\n    import rclpy.qos_event\n", []),
        ("if find_spec('numpy'):\n    import rclpy.qos_event\n", [5]),
        ("pytest.importorskip('rclpy.qos_event')\nimport rclpy.qos_event\n", []),
        ("pytest.importorskip('rclpy.event_handler')\nimport rclpy.qos_event\n", [5]),
    ],
)
def test_modules_that_are_asked_for(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], code: str, lines: list[int]
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    (tmp_path / "talker.py").write_text(_MODULE + code)
    assert found(capsys, tmp_path, "lyrical") == [("IM050", line, ["lyrical"]) for line in lines]


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
