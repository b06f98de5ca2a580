"""Launch files and parameter files, read without running them."""

from __future__ import annotations

import random
import subprocess
import sys
from contextlib import suppress
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from scaffold.check import runner
from scaffold.check.rules import registry
from scaffold.configuration import content
from scaffold.files.tree import MemoryTree
from scaffold.formats import yaml as yaml_tree
from scaffold.formats.yaml import Mapping, Scalar
from scaffold.model.install.share import share_of
from scaffold.model.launch.evaluation.evaluator import share_path
from scaffold.model.launch.python_file import LaunchFile
from scaffold.model.launch.started.nodes import started_nodes
from scaffold.model.package import Package
from scaffold.model.parameters import files as parameter_files
from scaffold.model.programs.executables import nodes_of, programs_of
from scaffold.model.python.evaluation.returns import may_end, returned
from scaffold.model.workspace.workspace import Workspace
from scaffold.source import ParseError, Source
from tests import PATIENCE

LAUNCH = """\
import os
from pathlib import Path

import launch_ros.actions as actions
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    share = get_package_share_directory('demo')
    name = 'talker'
    config = os.path.join(share, 'config', 'demo.yaml')
    return LaunchDescription([
        DeclareLaunchArgument('rate', default_value='10'),
        Node(package='demo', executable='talk', name=name, namespace='/left',
             parameters=[config, {'rate': LaunchConfiguration('rate'), 'text': 'a'}]),
        actions.Node(package=LaunchConfiguration('who'), executable='talk', **dict(os.environ)),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource([FindPackageShare('other'), '/launch/x.launch.py']),
        ),
        IncludeLaunchDescription(PathJoinSubstitution(
            [FindPackageShare('other'), 'launch', '..', 'y.launch.py'])),
        IncludeLaunchDescription(str(Path(share) / 'launch' / 'z.launch.py')),
    ])
"""
MANIFEST = '<package format="3"><name>demo</name></package>\n'
RULES = [rule for rule in registry.load(content.roots("rules")) if rule.code[:2] in {"LF", "PF"}]
ORACLE = """\
import sys, rclpy
from rclpy.node import Node
rclpy.init(args=['--ros-args', '--params-file', sys.argv[1]])
node = Node('talker', automatically_declare_parameters_from_overrides=True)
for index in range(int(sys.argv[2])):
    print(node.get_parameter(f'p{index}').type_.name.lower())
"""
WORDS = [
    *("1", "-1", "+1", "0", "00", "07", "08", "0x1F", "-0x2", "0b11", "0o7", "1_000", "12a"),
    *("1.0", "-1.", ".5", "+.5", "1e3", "1E-3", "1e", "1e400", "inf", "-Infinity", "nan", "NaN"),
    *(".inf", "-.INF", ".nan", ".NaN", ".Nan", "1:30", "2024-01-01", "1.0.0", "0x1p3", "-0x.8p1"),
    *("9223372036854775807", "9223372036854775808"),
    *("y", "Y", "n", "N", "yes", "Yes", "YES", "yEs", "no", "on", "ON", "oN"),
    *("off", "Off", "true", "True", "TRUE", "tRue", "false", "t", "f", "~", "null", "hello", "a b"),
    *("'1'", '"on"', "'1.0'", "!!str 1", '!!int "1"', "!own 1", "|-\n      5", ">-\n      on"),
]


def launch_of(text: str, **files: str) -> tuple[Package, LaunchFile]:
    package = Package.of({"package.xml": MANIFEST, "launch/a.launch.py": text, **files})
    return package, LaunchFile.of(package, "launch/a.launch.py")


def test_nodes_and_arguments() -> None:
    package, launch = launch_of(LAUNCH)
    first, second = started_nodes(package)
    assert (first.package, first.executable) == ("demo", "talk")
    assert first.full_name(package) == "/left/talker"
    assert [path for path, _ in first.parameter_files] == ["config/demo.yaml"]
    assert [given.name for given in first.parameters] == ["rate", "text"]
    assert second.full_name(package) is None
    assert not second.is_certain
    assert list(launch.declared) == ["rate"]
    configuration = launch.find("LaunchConfiguration")[0]
    assert launch.default_of(configuration.call) == "10"


def test_paths_below_share_directories() -> None:
    _, launch = launch_of(LAUNCH)
    result = [(path.package, path.path, path.location.line) for path in launch.share_paths]
    assert result == [
        ("demo", "config/demo.yaml", 17),
        ("other", "launch/x.launch.py", 24),
        ("other", "y.launch.py", 26),
        ("demo", "launch/z.launch.py", 28),
    ]
    assert [(use.name, use.action is not None) for use in launch.package_uses] == [
        ("demo", False),
        ("demo", True),
        ("other", False),
        ("other", False),
    ]


def test_path_above_a_share_directory_is_rejected() -> None:
    assert share_path("/<share>/demo/../other") is None
    assert share_path("/<share>/demo") is None
    assert share_path("/etc/x") is None


@pytest.mark.parametrize(
    ("body", "count", "reaches_end"),
    [
        ("return 1", 1, False),
        ("if x:\n  return 1", 1, True),
        ("if x:\n  return 1\n else:\n  raise E", 1, False),
        ("try:\n  return x()\n except E:\n  pass", 1, True),
        ("try:\n  x()\n finally:\n  return 1", 1, False),
        ("with x:\n  return 1", 1, False),
        ("while True:\n  x()", 0, False),
        ("def inner():\n  return 1", 0, True),
        ("sys.exit()", 0, False),
    ],
)
def test_returned_values_of_a_function(body: str, count: int, *, reaches_end: bool) -> None:
    package = Package.of({"a.py": f"def f():\n {body}\n"})
    function = package.module("a.py").functions["f"].node
    assert (len(returned(function)), may_end(function)) == (count, reaches_end)


def test_share_directory_of_both_build_types() -> None:
    files = {"config/a.yaml": "", "config/deep/b.yaml": "", "launch/c.launch.py": ""}
    cmake = Package.of(
        {
            **files,
            "package.xml": MANIFEST,
            "CMakeLists.txt": "project(demo)\ninstall(DIRECTORY config DESTINATION"
            " share/${PROJECT_NAME})\ninstall(DIRECTORY launch/ DESTINATION share/demo/go)\n",
        }
    )
    share = share_of(cmake)
    assert share.complete
    assert set(share.files) == {
        *("package.xml", "config/a.yaml", "config/deep/b.yaml", "go/c.launch.py"),
    }
    assert share.has("config/deep")
    python = Package.of(
        {
            **files,
            "package.xml": MANIFEST,
            "setup.py": "from glob import glob\nfrom setuptools import setup\nsetup(data_files=["
            "('share/demo/config', glob('config/*.yaml'))])\n",
        }
    )
    assert share_of(python).files == {"config/a.yaml": "config/a.yaml"}


@pytest.mark.parametrize(
    ("commands", "names", "complete"),
    [
        ("add_executable(a a.cpp)\ninstall(TARGETS a DESTINATION lib/demo)", {"a"}, True),
        (
            "foreach(x a b)\ninstall(TARGETS ${x} DESTINATION lib/demo)\nendforeach()",
            {"a", "b"},
            True,
        ),
        ("rclcpp_components_register_node(c PLUGIN P EXECUTABLE d)", {"d"}, True),
        ("install(PROGRAMS demo/e.py DESTINATION lib/demo)", {"e.py"}, True),
        ("ament_auto_add_executable(f f.cpp)\nament_auto_package()", {"f"}, True),
        (
            "macro(g x)\ninstall(TARGETS ${x} DESTINATION lib/demo)\nendmacro()\ng(h)\ng(i)",
            {"h", "i"},
            True,
        ),
        ("install(PROGRAMS demo/e.py DESTINATION bin)", set(), True),
        ("install(TARGETS ${SOME} DESTINATION lib/demo)", set(), False),
        ("make_programs()", set(), False),
        ("add_subdirectory(src)", set(), False),
    ],
)
def test_programs_of_cmake(commands: str, names: set[str], *, complete: bool) -> None:
    lists = f"project(demo)\nfind_package(ament_cmake)\n{commands}\nament_package()\n"
    files = {"package.xml": MANIFEST, "CMakeLists.txt": lists, "demo/e.py": ""}
    result = programs_of(Package.of(files))
    assert (set(result.sources), result.complete) == (names, complete)


# -- parameter files


def test_sections_and_entries_of_a_parameter_file() -> None:
    text = (
        "left:\n  talker:\n    ros__parameters:\n      a: {b: 1, c: 2.0}\n"
        "/**:\n  ros__parameters:\n    d: [x]\nnot: here\n"
    )
    package = Package.of({"a.yaml": text})
    file = parameter_files.parameter_file(package, "a.yaml")
    assert file is not None
    assert [section.node for section in file.sections] == ["/left/talker", "/**"]
    names = [[entry.name for entry in section.entries] for section in file.sections]
    assert sorted(names[0]) == ["a.b", "a.c"]
    assert names[1] == ["d"]
    assert [item.key.text for item in file.misplaced] == ["not"]


@pytest.mark.parametrize(
    ("key", "name", "fits"),
    [
        ("talker", "/talker", True),
        ("/talker", "/talker", True),
        ("talker", "/left/talker", False),
        ("/**", "/left/talker", True),
        ("/*", "/talker", True),
        ("/*", "/left/talker", False),
        ("/*/talker", "/left/talker", True),
        ("/*/talker", "/talker", False),
        ("/**/talker", "/talker", True),
        ("/**/talker", "/a/b/talker", True),
        ("left/talker", "/left/talker", True),
        ("talk.r", "/talker", False),
    ],
)
def test_wildcards_in_node_names(key: str, name: str, *, fits: bool) -> None:
    package = Package.of({"a.yaml": f'"{key}":\n  ros__parameters:\n    a: 1\n'})
    file = parameter_files.parameter_file(package, "a.yaml")
    assert file is not None
    assert file.sections[0].fits(name) is fits


def test_parameter_types_equal_those_of_rcl(tmp_path: Path) -> None:
    pytest.importorskip("rclpy")
    path = tmp_path / "all.yaml"
    lines = "".join(f"    p{index}: {word}\n" for index, word in enumerate(WORDS))
    path.write_text(f"talker:\n  ros__parameters:\n{lines}")
    done = subprocess.run(
        [sys.executable, "-c", ORACLE, str(path), str(len(WORDS))],
        capture_output=True,
        text=True,
        check=True,
        timeout=PATIENCE,
    )
    file = parameter_files.parameter_file(Package.of({"a.yaml": path.read_text()}), "a.yaml")
    assert file is not None
    entries = file.sections[0].entries
    assert [entry.name for entry in entries] == [f"p{index}" for index in range(len(WORDS))]
    ours = [parameter_files.value_type(entry.value) for entry in entries]
    assert dict(zip(WORDS, ours, strict=True)) == dict(zip(WORDS, done.stdout.split(), strict=True))


@pytest.mark.parametrize(
    "text",
    [
        "a: " + "[" * 5000,
        "- " * 3000,
        "{" * 3000,
        "a: &a [x]\nb: &b [*a, *a]\nc: [*b, *b]\n" * 50,
        "\t",
        "\x00",
        "a: !!python/object/apply:os.system [x]\n",
        "\ufeffa: 1\n",
        "? [a]\n: 1\n",
        "a: 'x\n" * 100,
        "x" * 100_000,
    ],
)
def test_hostile_yaml_is_read_or_rejected(text: str) -> None:
    with suppress(ParseError):
        assert isinstance(yaml_tree.parse(Source("a.yaml", text)), list)


def test_locations_in_yaml() -> None:
    source = Source("a.yaml", "\ufeffa: 1\nb: 'ä'  # x\n")
    (root,) = yaml_tree.parse(source)
    assert isinstance(root, Mapping)
    for key, value in root.pairs:
        assert source.text[key.start : key.end] == key.text
        assert isinstance(value, Scalar)
    assert isinstance(root.pairs[1][1], Scalar)
    assert source.text[root.pairs[1][1].start : root.pairs[1][1].end] == "'ä'"


@settings(max_examples=150, deadline=None)
@given(st.randoms(use_true_random=False), st.sampled_from(["launch", "yaml", "xml"]))
def test_damaged_files_never_crash_a_rule(chance: random.Random, which: str) -> None:
    """Cut, repeat and swap parts of valid files: rules must not crash."""
    files = {
        "package.xml": MANIFEST,
        "launch/a.launch.py": LAUNCH,
        "launch/b.launch.xml": '<launch>\n  <node pkg="demo" exec="talk">\n'
        '    <param from="$(find-pkg-share demo)/config/demo.yaml"/>\n  </node>\n</launch>\n',
        "config/demo.yaml": "talker:\n  ros__parameters:\n    rate: 1\n    list: [1, 2.0]\n",
        "talk.py": "from rclpy.node import Node\n\n\nclass T(Node):\n    def __init__(self):\n"
        "        super().__init__('talker')\n        self.declare_parameter('rate', 2.0)\n",
    }
    names = {"launch": "launch/a.launch.py", "xml": "launch/b.launch.xml"}
    path = names.get(which, "config/demo.yaml")
    pieces = files[path].replace("(", "\0(\0").replace(":", "\0:\0").replace(",", "\0,\0")
    words = pieces.replace("\n", "\0\n\0").replace("'", "\0'\0").split("\0")
    for _ in range(chance.randint(1, 3)):
        at = chance.randrange(len(words))
        words[at : at + chance.randint(0, 3)] = chance.choices(words, k=chance.randint(0, 3))
    files[path] = "".join(words)
    diagnostics = runner.check(Package.of(files), [rule() for rule in RULES])
    assert [finding.message for finding in diagnostics if finding.code == "SC002"] == []


def test_nodes_created_in_other_packages_belong_to_the_program() -> None:
    manifest = "<package format='3'><name>{}</name><export><build_type>ament_python</build_type>"
    manifest += "</export></package>\n"
    setup = "from setuptools import setup\nsetup(name='talker', entry_points={'console_scripts': "
    setup += "['talk = talker.talk:main']})\n"
    talk = "import rclpy\nfrom helper.options import read\nfrom rclpy.node import Node\n\n\n"
    talk += "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n\n\n"
    talk += "def main():\n    rclpy.init()\n    read()\n    rclpy.spin(Talker())\n"
    options = "import rclpy\n\n\ndef read():\n    node = rclpy.create_node('options')\n"
    options += "    return node.declare_parameter('path', '').value\n"
    trees = [
        {"package.xml": manifest.format("talker"), "setup.py": setup, "talker/talk.py": talk},
        {"package.xml": manifest.format("helper"), "helper/options.py": options},
    ]
    alone = Package(MemoryTree(trees[0], ()))
    assert [node.name for node in nodes_of(alone, "talk")] == ["Talker"]
    workspace = Workspace[Package]()
    packages = [Package(MemoryTree(files, ()), workspace=workspace) for files in trees]
    for package in packages:
        workspace.add(package)
    assert [node.name for node in nodes_of(packages[0], "talk")] == ["Talker", "node"]
