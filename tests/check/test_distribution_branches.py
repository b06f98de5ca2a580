"""Branches for other distributions: their code is not checked for the target."""

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
    """Return code, line and distributions of findings about removed names."""
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
        ("int(os.environ.get('ROS_VERSION', 2)) == 1", [13]),
        ("os.getenv('ROS_VERSION') == '2'", [11]),
        ("self.ros_version < 2", [13]),
        ("str(ROS_VERSION) != '1'", [11]),
        ("callable(getattr(self.get_logger(), 'warn', None))", []),
        ("'warn' in dir(self.get_logger())", []),
        ("'port' in dir(self)", [11, 13]),
    ],
)
def test_conditions_in_python(
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
    "a substitution of launch": (
        (
            "from launch.substitutions import EnvironmentVariable as V\nE = V('ROS_DISTRO')\n"
            "if E.perform(context) == 'humble':\n    {}\nelse:\n    {}\n"
        ),
        [10],
    ),
    "another substitution of launch": (
        (
            "from launch.substitutions import EnvironmentVariable as V\nE = V('HOME')\n"
            "if E.perform(context) == 'humble':\n    {}\n"
        ),
        [8],
    ),
    "the environment of a launch context": (
        (
            "def setup(context):\n    if context.environment['ROS_DISTRO'] == 'jazzy': {}\n"
            "    env = context.environment\n    if env.get('ROS_DISTRO', '') in ('lyrical',): {}\n"
            "    if context.environment.get('HOME') == 'jazzy': {}\n"
        ),
        [8, 9],
    ),
    "the environment under a name": (
        "E = os.environ\nif E['ROS_DISTRO'] == 'jazzy' or E.get('ROS_DISTRO') < 'k':\n    {}\n",
        [],
    ),
    "a claim": (
        (
            "def test_a():\n    assert D == 'jazzy'\n    {}\n"
            "def test_b():\n    assert D == 'lyrical'\n    {}\n"
        ),
        [10],
    ),
    "a function that asks for the name": (
        "def is_old(logger):\n    return 'warn' in dir(logger)\nif is_old(L):\n    {}\n",
        [],
    ),
    "an attribute that says whether there is the name": (
        (
            "class A:\n    def __init__(self):\n        self.old = hasattr(L, 'warn')\n"
            "    def f(self):\n        if self.old: {}\n        if self.new: {}\n"
        ),
        [10],
    ),
    "a name of itself": ("def talk():\n    D = D.lower()\n    if D == 'jazzy':\n        {}\n", [8]),
}


@pytest.mark.parametrize("name", _FORMS)
def test_kinds_of_branches_in_python(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], name: str
) -> None:
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
def test_imports_guarded_by_a_check_of_the_module(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], code: str, lines: list[int]
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    (tmp_path / "talker.py").write_text(_MODULE + code)
    assert found(capsys, tmp_path, "lyrical") == [("IM050", line, ["lyrical"]) for line in lines]


def test_if_chain_for_several_distributions(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    path = tmp_path / "talker.py"
    path.write_text(_NODE.format("distro == 'jazzy'", "elif distro == 'rolling':"))
    assert found(capsys, tmp_path, "jazzy,lyrical") == []
    assert found(capsys, tmp_path, "jazzy,rolling") == [("IM050", 13, ["rolling"])]


def test_suppression_in_another_branch_is_not_unused(
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
        ('"$ENV{ROS_DISTRO}" MATCHES "^(humble|jazzy)$"', [(3, 3)]),
        ('"$ENV{ROS_DISTRO}" STRLESS "kilted"', [(3, 3)]),
        ('"$ENV{ROS_DISTRO}" STRGREATER_EQUAL "kilted"', [(5, 5), (7, 7)]),
        ('NOT ("jazzy" STRGREATER_EQUAL "$ENV{ROS_DISTRO}")', [(5, 5), (7, 7)]),
        ("rclcpp_VERSION VERSION_LESS 29", [(3, 3)]),
        ('"${rclcpp_VERSION}" VERSION_GREATER_EQUAL "28.1.5"', [(5, 5), (7, 7)]),
        ("ament_cmake_VERSION VERSION_LESS 2.8.0", [(3, 3)]),
        ("ament_cmake_VERSION VERSION_GREATER_EQUAL 2.8", [(5, 5), (7, 7)]),
        ("ament_cmake_VERSION VERSION_LESS 2.8.9", []),
        ("rclcpp_VERSION_MAJOR LESS 28", [(3, 3)]),
        ("OpenCV_VERSION VERSION_LESS 4.0", []),
        ("WIN32 AND rclcpp_VERSION VERSION_LESS 29", [(3, 3)]),
        ("rclcpp_VERSION VERSION_LESS ${minimum}", []),
    ],
)
def test_conditions_in_cmake(condition: str, lines: list[tuple[int, int]]) -> None:
    package = Package.of({"CMakeLists.txt": _LISTS.format(condition)})
    with targeting(named("lyrical")):
        assert list(lines_not_run(package.cmake)) == lines


_D = '"$ENV{ROS_DISTRO}"'
_FORMS_OF_CMAKE = {
    "a list": (
        f"set(OLD humble jazzy)\nif({_D} IN_LIST OLD)\n  HERE\nelse()\n  there()\nendif()\n",
        [4],
    ),
    "a list that grows": (
        (
            "set(OLD humble)\nlist(APPEND OLD lyrical)\n"
            f"if({_D} IN_LIST OLD)\n  here()\nelse()\n  HERE\nendif()\n"
        ),
        [7],
    ),
    "a list that nobody knows": (
        f"set(OLD ${{RELEASES}})\nif({_D} IN_LIST OLD)\n  a()\nelse()\n  b()\nendif()\n",
        [],
    ),
    "a copy": (
        (
            "if(DEFINED ENV{ROS_DISTRO})\n  set(distro $ENV{ROS_DISTRO})\nelse()\n  HERE\nendif()\n"
            'if(${distro} STREQUAL "humble")\n  HERE\nendif()\n'
        ),
        [5, 8],
    ),
    "a comparison": (
        f'string(COMPARE EQUAL {_D} "jazzy" is_old)\nif(is_old)\n  HERE\nendif()\n',
        [4],
    ),
    "a comparison with what nobody knows": (
        f"string(COMPARE EQUAL {_D} ${{CHOSEN}} is_old)\nif(is_old)\n  here()\nendif()\n",
        [],
    ),
    "lower case": (
        f"string(TOLOWER {_D} name)\nif(NOT name STREQUAL lyrical)\n  HERE\nendif()\n",
        [4],
    ),
    "a switch": (
        f"if({_D} STREQUAL jazzy)\n  set(OLD TRUE)\nendif()\nif(OLD)\n  HERE\nendif()\n",
        [3, 6],
    ),
    "a switch that others set": (
        (
            f"if({_D} STREQUAL jazzy)\n  set(OLD TRUE)\nendif()\n"
            "if(WIN32)\n  set(OLD ON)\nendif()\nif(OLD)\n  here()\nendif()\n"
        ),
        [3],
    ),
    "an option": ("option(OLD ON)\nset(NEW OFF)\nif(OLD OR NEW)\n  here()\nendif()\n", []),
    "an early return": (
        f"if({_D} STRGREATER k)\n  return()\nendif()\nHERE\nHERE\n",
        [*range(4, 8)],
    ),
    "an early return for others": (f"if({_D} STRLESS k)\n  HERE\nendif()\nhere()\n", [3]),
    "a return that nobody knows": (
        f"if({_D} STRGREATER k AND WIN32)\n  return()\nendif()\nhere()\n",
        [],
    ),
    "a return of a function": (
        (
            f"function(do)\n  if({_D} STRGREATER k)\n    return()\n  endif()\n  HERE\n"
            "endfunction()\nhere()\n"
        ),
        [5, 6],
    ),
    "the end of the configuration": (
        f"if(NOT {_D} STREQUAL jazzy)\n  message(FATAL_ERROR no)\nendif()\nHERE\n",
        [4, 5, 6],
    ),
    "a macro and a function that only other distributions call": (
        (
            "function(inner)\n  HERE\nendfunction()\nmacro(outer)\n  inner()\nendmacro()\n"
            "macro(both)\n  here()\nendmacro()\nmacro(uncalled)\n  here()\nendmacro()\nboth()\n"
            f"if({_D} STREQUAL jazzy)\n  outer()\n  both()\nendif()\n"
        ),
        [16, 17, 6, 3],
    ),
    "a return in a loop": (
        f"foreach(a ${{b}})\n  if({_D} STRGREATER k)\n    return()\n  endif()\nendforeach()\nx()\n",
        [],
    ),
}


@pytest.mark.parametrize("name", _FORMS_OF_CMAKE)
def test_kinds_of_branches_in_cmake(name: str) -> None:
    form, lines = _FORMS_OF_CMAKE[name]
    text = "project(talker)\n" + form.replace("HERE", "here()")
    with targeting(named("lyrical")):
        result = lines_not_run(Package.of({"CMakeLists.txt": text}).cmake)
        assert [line for first, last in result for line in range(first, last + 1)] == lines


def test_versions_of_rolling_may_be_newer_than_known() -> None:
    text = "if(rclcpp_VERSION VERSION_LESS {})\n  here()\nendif()\n"
    for version, lines in (("29", [(2, 2)]), ("40", [])):
        package = Package.of({"CMakeLists.txt": text.format(version)})
        with targeting(named("rolling")):
            assert list(lines_not_run(package.cmake)) == lines


def test_cmake_command_in_a_branch_for_older_distributions(
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


_LAUNCH = """\
import os
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, SetLaunchConfiguration
from launch.conditions import (
    IfCondition, LaunchConfigurationEquals, LaunchConfigurationNotEquals, UnlessCondition)
from launch.substitutions import (
    AndSubstitution, AnySubstitution, EnvironmentVariable, EqualsSubstitution, LaunchConfiguration,
    NotEqualsSubstitution, NotSubstitution, OrSubstitution, PythonExpression)
from launch_ros.actions import Node

D = EnvironmentVariable('ROS_DISTRO')


def generate_launch_description():
    simulated = LaunchConfiguration('simulated')
    return LaunchDescription([
        DeclareLaunchArgument('simulated', default_value='false'),
        DeclareLaunchArgument('distro', default_value=EnvironmentVariable('ROS_DISTRO')),
        Node(package='tf2_ros', executable='static_transform_publisher',
             arguments=['1', '0', '0', '0', '0', '0', 'base', 'laser'],
             condition={}),
    ])
"""


@pytest.mark.parametrize(
    ("condition", "runs"),
    [
        ("IfCondition(PythonExpression([\"'\", D, \"' == 'jazzy'\"]))", False),
        ("IfCondition(PythonExpression([\"'\", D, \"' in ('jazzy', 'lyrical')\"]))", True),
        ("UnlessCondition(PythonExpression([\"'\", D, \"' > 'k'\"]))", False),
        ("IfCondition(EqualsSubstitution(EnvironmentVariable('ROS_DISTRO'), 'jazzy'))", False),
        ("IfCondition(EqualsSubstitution(EnvironmentVariable('HOME'), 'jazzy'))", True),
        ("IfCondition(NotEqualsSubstitution(D, 'lyrical'))", False),
        ("UnlessCondition(NotEqualsSubstitution(D, 'lyrical'))", True),
        ("IfCondition(NotSubstitution(EqualsSubstitution(D, 'lyrical')))", False),
        ("IfCondition(AndSubstitution(simulated, EqualsSubstitution(D, 'jazzy')))", False),
        ("IfCondition(OrSubstitution(simulated, EqualsSubstitution(D, 'jazzy')))", True),
        ("IfCondition(AnySubstitution(EqualsSubstitution(D, 'humble')))", False),
        ("IfCondition(simulated)", True),
        ("UnlessCondition('true')", True),
        ("IfCondition(LaunchConfiguration('distro'))", True),
        ("LaunchConfigurationEquals('distro', 'jazzy')", False),
        ("LaunchConfigurationNotEquals('distro', 'jazzy')", True),
        ("LaunchConfigurationEquals('simulated', 'jazzy')", True),
        ("IfCondition(str(os.environ['ROS_DISTRO'] == 'jazzy'))", False),
        ("IfCondition('true' if os.environ.get('ROS_DISTRO') == 'jazzy' else 'false')", False),
        ("IfCondition(PythonExpression([simulated, \" and '\", D, \"' == 'jazzy'\"]))", False),
        ("IfCondition(PythonExpression([simulated, \" or '\", D, \"' == 'jazzy'\"]))", True),
        ("IfCondition(PythonExpression(\"os.environ['ROS_DISTRO'] < 'k'\", ['os']))", False),
        ('IfCondition(PythonExpression(["\'", D, "\' == \'", simulated, "\'"]))', True),
        ("IfCondition(PythonExpression(['not a $ condition', D]))", True),
    ],
)
def test_conditions_in_launch_files(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], condition: str, *, runs: bool
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    (tmp_path / "launch").mkdir()
    (tmp_path / "launch" / "a.launch.py").write_text(_LAUNCH.replace("{}", condition))
    assert found_in_launch(capsys, tmp_path) == ([20] if runs else [])


def found_in_launch(capsys: pytest.CaptureFixture[str], package: Path) -> list[int]:
    """Return the lines of transforms with arguments that Lyrical rejects."""
    main(["check", str(package), "--distro", "lyrical", "--format", "json", "--select", "LF080"])
    return [item["line"] for item in json.loads(capsys.readouterr().out)["diagnostics"]]


def test_launch_group_with_a_condition(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    (tmp_path / "launch").mkdir()
    node = _LAUNCH.partition("        Node(")[2].partition(",\n             condition")[0]
    text = (
        _LAUNCH.partition("    return")[0]
        + f"""\
    first = Node({node})
    shared = Node({node})
    group = GroupAction(
        [first, shared, Node({node})],
        condition=IfCondition(EqualsSubstitution(D, 'jazzy')))
    return LaunchDescription([group, shared])
"""
    )
    (tmp_path / "launch" / "a.launch.py").write_text(text)
    assert found_in_launch(capsys, tmp_path) == [19]


_ARGUMENTS = "1 0 0 0 0 0 base laser"
_MARKUP = [
    ("""if="$(eval '\\'$(env ROS_DISTRO)\\' == \\'jazzy\\'')\"""", False),
    ("""if="$(eval &quot;'$(env ROS_DISTRO)' == 'jazzy'&quot;)\"""", False),
    ("""if="$(eval &quot;'$(env ROS_DISTRO)' in ['jazzy', 'lyrical']&quot;)\"""", True),
    ("""unless="$(eval &quot;'$(env ROS_DISTRO)' > 'k'&quot;)\"""", False),
    ("""if="$(equals $(env ROS_DISTRO) jazzy)\"""", False),
    ("""if="$(equals $(env HOME) jazzy)\"""", True),
    ("""unless="$(not-equals $(env ROS_DISTRO '') jazzy)\"""", False),
    ("""if="$(and $(var simulated) $(equals $(env ROS_DISTRO) jazzy))\"""", False),
    ("""if="$(or $(var simulated) $(equals $(env ROS_DISTRO) jazzy))\"""", True),
    ("""if="$(not $(equals $(env ROS_DISTRO) lyrical))\"""", False),
    ("""if="$(var simulated)\"""", True),
    ("""if="$(equals $(var distro) jazzy)\"""", False),
    ("""if="$(equals $(var simulated) jazzy)\"""", True),
    ("""if="$(var is_old)\"""", False),
    ("""if="$(equals $(env ROS_DISTRO\"""", True),
    ('if="false"', True),
]


@pytest.mark.parametrize("place", ["node", "group"])
@pytest.mark.parametrize(("condition", "runs"), _MARKUP)
def test_conditions_in_xml_launch_files(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], condition: str, place: str, *, runs: bool
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    (tmp_path / "launch").mkdir()
    of_group, of_node = (condition, "") if place == "group" else ("", condition)
    (tmp_path / "launch" / "a.launch.xml").write_text(
        "<launch>\n"
        '<arg name="simulated" default="false"/>\n'
        '<arg name="distro" default="$(env ROS_DISTRO)"/>\n'
        '<let name="is_old" value="$(equals $(var distro) humble)"/>\n'
        f"<group {of_group}>\n"
        f'<node pkg="tf2_ros" exec="static_transform_publisher" args="{_ARGUMENTS}" {of_node}/>\n'
        "</group>\n</launch>\n"
    )
    assert found_in_launch(capsys, tmp_path) == ([6] if runs else [])


@pytest.mark.parametrize(
    ("condition", "runs"),
    [
        ("""if: '$(eval "''$(env ROS_DISTRO)'' == ''jazzy''")'""", False),
        ("""if: $(equals $(env ROS_DISTRO) jazzy)""", False),
        ("""unless: $(equals $(env ROS_DISTRO) lyrical)""", False),
        ("""if: $(equals $(var distro) lyrical)""", True),
        ("""if: $(var simulated)""", True),
        ("""if: false""", True),
    ],
)
def test_conditions_in_yaml_launch_files(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], condition: str, *, runs: bool
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>talker</name></package>\n")
    (tmp_path / "launch").mkdir()
    node = f'pkg: tf2_ros\n    exec: static_transform_publisher\n    args: "{_ARGUMENTS}"\n'
    (tmp_path / "launch" / "a.launch.yaml").write_text(
        "launch:\n- arg: {name: simulated, default: 'false'}\n"
        "- let: {name: distro, value: $(env ROS_DISTRO)}\n"
        f"- node:\n    {node}    {condition}\n"
        f"- group:\n  - node:\n      {node.replace('    ', '      ')}"
    )
    lines = found_in_launch(capsys, tmp_path)
    assert len(lines) == 1 + runs


def test_style_is_checked_in_all_branches(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    (tmp_path / "package.xml").write_text("<package><name>rover</name></package>\n")
    (tmp_path / "CMakeLists.txt").write_text(
        'if($ENV{ROS_DISTRO} STREQUAL "humble")\n\tfind_package(rclcpp REQUIRED)\nendif()\n'
    )
    main(["check", str(tmp_path), "--distro", "jazzy", "--format", "json", "--select", "CM"])
    diagnostics = json.loads(capsys.readouterr().out)["diagnostics"]
    assert [(item["code"], item["line"]) for item in diagnostics] == [("CM073", 2)]
