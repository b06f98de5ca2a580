"""Errors in unused code are warnings."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scaffold.cli.main import main

MANIFEST = """<?xml version="1.0"?>
<package format="3">
  <name>talker</name>
  <version>0.1.0</version>
  <description>An example</description>
  <maintainer email="ann@example.com">Ann</maintainer>
  <license>Apache-2.0</license>
  <exec_depend>std_msgs</exec_depend>
{}  <export>
    <build_type>ament_python</build_type>
  </export>
</package>
"""
SETUP = """from setuptools import find_packages, setup

setup(name='talker', version='0.1.0', packages=find_packages(exclude=['test']))
"""
CONSOLE_SCRIPT = SETUP.replace(
    ", packages", ", entry_points={'console_scripts': ['talk = talker.node:main']}, packages"
)
TESTED = SETUP.replace(", packages", ", tests_require=['pytest'], packages")
MISTAKE = "from std_msgs.msg import String\n\nString().text\n"
UNDEFINED = "print(undefined)\n"
NODE = """import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from talker.speaker import Speaker


class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.create_timer(10, self.say)  # nothing

    def say(self):
        pass

    def tell(self):
        return String().text


def main():
    rclpy.init()
    rclpy.spin(Talker())
"""


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    home = tmp_path / "talker"  # apart from the packages of other tests
    home.mkdir()
    for path, text in {
        "package.xml": MANIFEST.format(""),
        "setup.py": SETUP,
        "talker/__init__.py": "",
    }.items():
        write(home / path, text)
    monkeypatch.chdir(home)
    return home


def write(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)


def severities(capsys: pytest.CaptureFixture[str], code: str) -> dict[str, str]:
    main(["check", "--no-types", "--format", "json", "--select", code])
    findings = json.loads(capsys.readouterr().out)["diagnostics"]
    return {item["path"]: item["severity"] for item in findings}


def test_script_only_mentioned_in_a_comment(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / "setup.py").unlink()
    lists = "# install(PROGRAMS scripts/past.py DESTINATION lib/talker)\n"
    lists += "install(PROGRAMS\n  scripts/talk.py  # and scripts/soon.py\n"
    write(package / "CMakeLists.txt", f"project(talker)\n{lists}  DESTINATION lib/talker)\n")
    for name in ("past", "soon", "talk"):
        write(package / "scripts" / f"{name}.py", "print 'hello'\n")
    assert severities(capsys, "E999") == {
        "scripts/past.py": "warning",
        "scripts/soon.py": "warning",
        "scripts/talk.py": "error",
    }


@pytest.mark.parametrize(
    "name",
    [
        "node_old.py",
        "node copy.py",
        "old_node.py",
        "node.bak.py",
        "node (copy).py",
        "node (3rd copy).py",
        "node - Kopie.py",
        "(UNUSED)talker/nodes.py",
        "old/nodes.py",
        "temp/nodes.py",
        "untitled1.py",
        "node_obsolete.py",
    ],
)
def test_copy_of_a_file(package: Path, capsys: pytest.CaptureFixture[str], name: str) -> None:
    for path in (name, "node.py", "threshold.py"):
        write(package / "talker" / path, MISTAKE)
    assert severities(capsys, "MS002") == {
        f"talker/{name}": "warning",
        "talker/node.py": "error",
        "talker/threshold.py": "error",
    }


@pytest.mark.parametrize(
    ("other", "severity"), [("import cv2\n", "error"), ("# import cv2\n", "warning")]
)
def test_dependency_of_a_copy_and_of_used_code(
    package: Path, capsys: pytest.CaptureFixture[str], other: str, severity: str
) -> None:
    write(package / "talker" / "node (copy).py", "import cv2\n")
    write(package / "talker" / "node.py", other)
    assert severities(capsys, "PX020") == {"talker/node (copy).py": severity}


@pytest.mark.parametrize(
    ("imported", "severity"),
    [
        ("from talker.plot.axes import draw", "warning"),
        ("import talker.plot.axes as axes", "warning"),
        ("from talker.plot import plot", "error"),
        ("import talker.plot.plot as axes", "error"),
    ],
)
def test_module_named_like_its_directory(
    package: Path, capsys: pytest.CaptureFixture[str], imported: str, severity: str
) -> None:
    packages = "packages=['talker', 'talker' + '/plot']"
    write(
        package / "setup.py",
        CONSOLE_SCRIPT.replace("packages=find_packages(exclude=['test'])", packages),
    )
    write(package / "talker" / "node.py", f"{imported}\n\n\ndef main():\n    pass\n")
    for name in ("__init__", "axes"):
        write(package / "talker" / "plot" / f"{name}.py", "def draw():\n    pass\n")
    write(package / "talker" / "plot" / "plot.py", UNDEFINED + "\n\ndef main():\n    pass\n")
    assert severities(capsys, "F821") == {"talker/plot/plot.py": severity}


def test_program_named_like_its_directory(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    setup = CONSOLE_SCRIPT.replace("'talk = talker.node:main'", "f'talk = {NAME}.{NAME}:main'")
    write(package / "setup.py", setup.replace("\n\n", "\n\nNAME = 'talker'\n", 1))
    write(package / "talker" / "talker.py", UNDEFINED + "\n\ndef main():\n    pass\n")
    assert severities(capsys, "F821") == {"talker/talker.py": "error"}


@pytest.mark.parametrize(("marker", "severity"), [("", "error"), ("COLCON_IGNORE", "warning")])
def test_package_that_colcon_ignores(
    package: Path, capsys: pytest.CaptureFixture[str], marker: str, severity: str
) -> None:
    write(package / "talker" / "node.py", "import cv2\n")
    if marker:
        write(package / marker, "")
    assert severities(capsys, "PX020") == {"talker/node.py": severity}


@pytest.mark.parametrize("marker", ["", "COLCON_IGNORE"])
def test_program_of_a_package_that_colcon_ignores(
    package: Path, capsys: pytest.CaptureFixture[str], marker: str
) -> None:
    write(package / "talker" / "node.py", UNDEFINED)
    if marker:
        write(package / marker, "")
    assert severities(capsys, "F821") == {"talker/node.py": "error"}


def test_copy_of_a_parameter_file(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path in ("params/talk copy.yaml", "params/talk.yaml"):
        write(package / path, "talk:\n  ros__parameters:\n    rate:\n")
    expected = {"params/talk copy.yaml": "warning", "params/talk.yaml": "error"}
    assert severities(capsys, "PF007") == expected


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("talker/main.py", "from talker import node_old\n"),
        ("run.sh", "python3 node_old.py\n"),
        ("run.bash", "python3 node_old.py\n"),
    ],
)
def test_mentioned_copy_is_used(
    package: Path, capsys: pytest.CaptureFixture[str], path: str, text: str
) -> None:
    write(package / "talker" / "node_old.py", MISTAKE)
    write(package / path, text)
    assert severities(capsys, "MS002") == {"talker/node_old.py": "error"}


def test_file_that_is_not_installed(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path in ("scratch.py", "notes/plot.py", "talker/node.py", "test/test_node.py"):
        write(package / path, UNDEFINED)
    assert severities(capsys, "F821") == {
        "scratch.py": "warning",
        "notes/plot.py": "warning",
        "talker/node.py": "error",
        "test/test_node.py": "error",
    }


def test_linters_of_the_package_check_all_files(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(package / "scratch.py", UNDEFINED)
    write(package / "old_scratch.py", "print 'hello'\n")
    annotated = "def talk(text):\n    said: Undefined = text\n    print(said)\n"
    write(package / "talker" / "annotated.py", annotated)
    depend = "  <test_depend>ament_flake8</test_depend>\n"
    write(package / "package.xml", MANIFEST.format(depend))
    test = "from ament_flake8.main import main\n\n\ndef test_flake8():\n    assert main([]) == 0\n"
    write(package / "test" / "test_flake8.py", test)
    assert severities(capsys, "E999") == {"old_scratch.py": "error"}
    # What Python does not evaluate is a matter of style for that linter too.
    assert severities(capsys, "F821") == {"scratch.py": "warning", "talker/annotated.py": "warning"}


def test_configured_severity_takes_precedence(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(package / "scratch.py", UNDEFINED)
    write(package / "ros2-scaffold.toml", "[check.severity]\nF821 = 'info'\n")
    assert severities(capsys, "F821") == {"scratch.py": "info"}


def test_uncalled_function_of_a_launch_file(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    helper = "def load(path):\n    return undefined.read(path)\n\n\n"
    description = "def generate_launch_description():\n    return {}\n"
    write(package / "launch" / "a.launch.py", helper + description.format("None"))
    write(package / "launch" / "b.launch.py", helper + description.format("load('a')"))
    write(package / "launch" / "c.launch.py", description.format("undefined"))
    assert severities(capsys, "F821") == {
        "launch/a.launch.py": "warning",
        "launch/b.launch.py": "error",
        "launch/c.launch.py": "error",
    }


@pytest.mark.parametrize(
    ("severity", "caller"),
    [
        ("warning", "def load_all():\n    return load('a')\n\n\n"),
        ("error", "def load_all():\n    return load('a')\n\n\nload_all()\n"),
        ("error", "loaded = load('a')\n\n\n"),
        ("warning", "def load_all():\n    return [load, 'load']\n\n\n"),
        ("error", "@register\ndef load_all():\n    return load('a')\n\n\n"),
    ],
)
def test_function_of_a_launch_file_called_by_an_uncalled_one(
    package: Path, capsys: pytest.CaptureFixture[str], severity: str, caller: str
) -> None:
    helper = "def load(path):\n    return undefined.read(path)\n\n\n"
    description = "def generate_launch_description():\n    return None\n"
    imported = "from launch import register\n\n\n"
    write(package / "launch" / "a.launch.py", imported + helper + caller + description)
    assert severities(capsys, "F821") == {"launch/a.launch.py": severity}
    if severity == "warning":
        use = "path = 'a.launch.py'\nload_all = getattr(path, 'load_all')\n"
        write(package / "talker" / "use.py", use)
        assert severities(capsys, "F821") == {"launch/a.launch.py": "error"}


UNLAUNCHED = """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    node = Node(package='talker', executable='talk', name='a b')
    {}
    return LaunchDescription([node])
"""
AGAIN = "node = Node(package='talker', executable='talk')"


@pytest.mark.parametrize(
    ("severity", "changed", "into"),
    [
        ("warning", "", AGAIN),
        ("warning", "[node]", "[]"),
        ("error", "", "node = OnProcessExit(node)"),
        ("warning", "", f"print(node)\n    {AGAIN}"),
        ("error", "", f"repr(node)\n    {AGAIN}"),
        ("error", "", f"if LaunchDescription:\n        {AGAIN}"),
        ("error", "", f"late = lambda: node\n    {AGAIN}\n    late()"),
        ("error", "[node]", "list(locals().values())"),
        ("error", "", f"for _ in ():\n        pass\n    {AGAIN}"),
    ],
)
def test_action_that_is_never_launched(
    package: Path, capsys: pytest.CaptureFixture[str], severity: str, changed: str, into: str
) -> None:
    text = UNLAUNCHED.replace(changed, into).format("") if changed else UNLAUNCHED.format(into)
    write(package / "launch" / "a.launch.py", text)
    assert severities(capsys, "LF045") == {"launch/a.launch.py": severity}


@pytest.mark.parametrize(
    ("path", "severity"), [("a.launch.py", "warning"), ("common_launch.py", "error")]
)
def test_action_outside_of_functions(
    package: Path, capsys: pytest.CaptureFixture[str], path: str, severity: str
) -> None:
    action = "node = Node(package='talker', executable='talk', name='a b')"
    text = UNLAUNCHED.replace(f"    {action}\n", "").replace("[node]", "[]").format("")
    write(package / "launch" / path, text.replace("\n\n\n", f"\n\n{action}\n\n\n"))
    assert severities(capsys, "LF045") == {f"launch/{path}": severity}


def test_main_guard_of_a_launch_file(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    description = "def generate_launch_description():\n    return None\n\n\n"
    guard = "if __name__ == '__main__':\n    {}\n"
    write(package / "launch" / "a.launch.py", description + guard.format("main()"))
    service = "undefined(generate_launch_description(), LaunchService())"
    imported = "from launch import LaunchService\n\n\n"
    write(package / "launch" / "b.launch.py", imported + description + guard.format(service))
    assert severities(capsys, "F821") == {
        "launch/a.launch.py": "warning",
        "launch/b.launch.py": "error",
    }


@pytest.mark.parametrize(
    ("severity", "changed", "into"),
    [
        ("warning", "", ""),
        ("error", "10, self.say)", "10, self.tell)"),
        ("error", "self.say)", "getattr(self, prefix + 'll'))"),
        ("warning", "self.say)", "getattr(self, 'say'))"),
        ("error", "def tell", "def on_configure"),
        ("error", "def tell", "def destroy_node"),
        ("error", "(Node)", "(Node, Speaker)"),
        ("error", "    def tell", "    @cached\n    def tell"),
        ("warning", "    def tell", "    @property\n    def tell"),
        ("error", "def main", "def talk"),
        ("warning", "# nothing", "# tell"),
        ("warning", "# nothing", "\n        rclpy.tell()"),
        ("warning", "    def tell", "    def tell_all(self):\n        self.tell()\n\n    def tell"),
        ("error", "self.say)", "self.tell_all)\n\n    def tell_all(self):\n        self.tell()"),
        ("warning", "# nothing", "\n        print('node' in locals())"),
        ("error", "# nothing", "\n        print(locals()['node'])"),
    ],
)
def test_uncalled_method(
    package: Path,
    capsys: pytest.CaptureFixture[str],
    severity: str,
    changed: str,
    into: str,
) -> None:
    node = NODE.replace(changed, into) if changed else NODE
    if "on_configure" in node:
        node = node.replace("from rclpy.node import Node", "from rclpy.lifecycle import Node")
    write(package / "talker" / "talk.py", node)
    assert severities(capsys, "MS002") == {"talker/talk.py": severity}


@pytest.mark.parametrize(
    ("base", "severity"),
    [
        ("import abc\n\n\nclass Speaker(abc.ABC):\n    def tell(self):\n        pass\n", "warning"),
        ("class Speaker:\n    def say(self):\n        self.tell()\n", "error"),
        ("from voice import Voice\n\n\nclass Speaker(Voice):\n    pass\n", "error"),
        ("from talker.talk import Talker\n\n\nclass Speaker(Talker):\n    pass\n", "error"),
    ],
)
def test_uncalled_method_with_a_base_in_another_module(
    package: Path, capsys: pytest.CaptureFixture[str], base: str, severity: str
) -> None:
    write(package / "talker" / "talk.py", NODE.replace("(Node)", "(Node, Speaker)"))
    write(package / "talker" / "speaker.py", base)
    assert severities(capsys, "MS002") == {"talker/talk.py": severity}


def test_method_called_by_another_module(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(package / "talker" / "talk.py", NODE)
    write(package / "talker" / "copy_of_it.py", NODE.replace("String().text", "String().data"))
    assert severities(capsys, "MS002") == {"talker/talk.py": "warning"}
    write(package / "talker" / "use.py", "from talker.talk import Talker\n\nTalker().tell()\n")
    assert severities(capsys, "MS002") == {"talker/talk.py": "error"}


@pytest.mark.parametrize(
    ("path", "text", "severity"),
    [
        ("talker/other.py", "", "warning"),
        ("talker/other.py", "from talker.talk import Teller\n", "warning"),
        ("talker/other.py", "from talker.talk import Teller\n\nTeller()\n", "error"),
        ("plugin.xml", "<class type='talker.talk.Teller'/>\n", "error"),
        ("setup.py", CONSOLE_SCRIPT.replace("node:main", "talk:Teller"), "error"),
    ],
)
def test_class_that_is_never_used(
    package: Path, capsys: pytest.CaptureFixture[str], path: str, text: str, severity: str
) -> None:
    teller = "class Teller:\n    def __init__(self):\n        undefined(self)\n\n\n"
    write(package / "talker" / "talk.py", teller + "def main():\n    pass\n")
    write(package / path, text)
    assert severities(capsys, "F821") == {"talker/talk.py": severity}
    write(package / "talker" / "talk.py", teller + "def main():\n    Teller()\n")
    assert severities(capsys, "F821") == {"talker/talk.py": "error"}
    early = "class Teller(undefined):\n    name = undefined\n\n\ndef main():\n    pass\n"
    write(package / "talker" / "talk.py", early)
    assert severities(capsys, "F821") == {"talker/talk.py": "error"}


def test_code_after_spin(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    node = "import rclpy\n\n\ndef main():\n    rclpy.init()\n{}\n    rclpy.spin(node)\n{}\n"
    write(package / "talker" / "late.py", node.format("    node = 1", "    made.destroy()"))
    write(package / "talker" / "early.py", node.format("    node = made", "    node.destroy()"))
    assert severities(capsys, "F821") == {"talker/late.py": "warning", "talker/early.py": "error"}


def test_code_for_another_platform(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    keys = "import os\n\n\ndef key():\n    if {}:\n        return msvcrt.getch()\n\n\nkey()\n"
    write(package / "talker" / "keys.py", keys.format("os.name == 'nt'"))
    write(package / "talker" / "codes.py", keys.format("os.sep == '/'"))
    assert severities(capsys, "F821") == {"talker/codes.py": "error", "talker/keys.py": "warning"}


def test_example_in_the_documentation(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for path in ("doc/talk.py", "talker/talk.py"):
        write(package / path, MISTAKE)
    assert severities(capsys, "MS002") == {"doc/talk.py": "warning", "talker/talk.py": "error"}


def test_python_test_not_run_by_cmake(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (package / "setup.py").unlink()
    manifest = MANIFEST.format("").replace("ament_python", "ament_cmake")
    write(package / "package.xml", manifest)
    lists = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}ament_package()\n"
    write(package / "CMakeLists.txt", lists.format(""))
    write(package / "tests" / "idea.py", UNDEFINED)
    assert severities(capsys, "F821") == {"tests/idea.py": "warning"}
    write(package / "CMakeLists.txt", lists.format("ament_add_pytest_test(idea tests)\n"))
    assert severities(capsys, "F821") == {"tests/idea.py": "error"}


def test_python_test_next_to_one_run_by_cmake(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / "setup.py").unlink()
    manifest = MANIFEST.format("").replace("ament_python", "ament_cmake")
    write(package / "package.xml", manifest)
    lists = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}ament_package()\n"
    write(package / "test" / "test_a.py", MISTAKE)
    write(package / "test" / "test_b.py", MISTAKE)
    registered = "add_subdirectory(test)\nament_add_pytest_test(a test/test_a.py)  # not test_b\n"
    write(package / "CMakeLists.txt", lists.format(registered))
    assert severities(capsys, "MS002") == {"test/test_a.py": "error", "test/test_b.py": "warning"}
    write(package / "CMakeLists.txt", lists.format("ament_add_pytest_test(all test)\n"))
    assert severities(capsys, "MS002") == {"test/test_a.py": "error", "test/test_b.py": "error"}


def test_script_not_installed_by_cmake(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (package / "setup.py").unlink()
    manifest = MANIFEST.format("").replace("ament_python", "ament_cmake")
    write(package / "package.xml", manifest)
    lists = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}ament_package()\n"
    write(package / "scripts" / "relay.py", MISTAKE)
    write(package / "config" / "relay.yaml", "relay:\n  ros__parameters:\n    rate: 1.0\n")
    write(package / "CMakeLists.txt", lists.format("# install(PROGRAMS scripts/relay.py)\n"))
    assert severities(capsys, "MS002") == {"scripts/relay.py": "warning"}
    write(package / "README.md", "Start it: `python3 scripts/relay.py`\n")
    assert severities(capsys, "MS002") == {"scripts/relay.py": "error"}
    (package / "README.md").unlink()
    others = (
        "install(DIRECTORY\n  launch)\nfile(GLOB TALK scripts/*.cpp)\nfile(READ old/relay.py A)\n"
    )
    write(package / "CMakeLists.txt", lists.format(others))
    assert severities(capsys, "MS002") == {"scripts/relay.py": "warning"}
    write(package / "CMakeLists.txt", lists.format("install(PROGRAMS scripts/relay.py)\n"))
    assert severities(capsys, "MS002") == {"scripts/relay.py": "error"}


@pytest.mark.parametrize(
    ("command", "severity"),
    [
        ("install(PROGRAMS talker/talk.py DESTINATION lib/${PROJECT_NAME})", "warning"),
        ("install(PROGRAMS talker/node.py DESTINATION lib/${PROJECT_NAME})", "error"),
        ("install(DIRECTORY talker DESTINATION lib/${PROJECT_NAME})", "error"),
        ("install(DIRECTORY ${PROJECT_NAME}/ DESTINATION lib/${PROJECT_NAME})", "error"),
        ("ament_python_install_package(${PROJECT_NAME})", "error"),
        ("ament_python_install_package(talker)", "error"),
    ],
)
def test_module_of_a_package_that_cmake_does_not_install(
    package: Path, capsys: pytest.CaptureFixture[str], command: str, severity: str
) -> None:
    (package / "setup.py").unlink()
    manifest = MANIFEST.format("").replace("ament_python", "ament_cmake")
    write(package / "package.xml", manifest)
    write(package / "CMakeLists.txt", f"project(talker)\n{command}\nament_package()\n")
    write(package / "talker" / "talk.py", "")
    write(package / "talker" / "node.py", "import cv2\n" + MISTAKE)
    assert severities(capsys, "MS002,PX020") == {"talker/node.py": severity}


def test_python_of_ros_1_in_a_library(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    manifest = MANIFEST.format("").replace("ament_python", "ament_cmake")
    write(package / "package.xml", manifest)
    lists = (
        "project(talker)\nadd_library(${PROJECT_NAME}\n  src/talk.cpp)\n"
        "# install(DIRECTORY src/talker)\nament_add_gtest(talk test/talk.cpp)\n"
    )
    write(package / "CMakeLists.txt", lists)
    write(package / "src" / "talker" / "__init__.py", MISTAKE)
    write(package / "test" / "CMakeLists.txt", "catkin_add_nosetests(parser.py)\n")
    write(package / "test" / "parser.py", "from talker import talk\n" + MISTAKE)
    found = {"src/talker/__init__.py": "warning", "test/parser.py": "warning"}
    assert severities(capsys, "MS002") == found
    write(package / "CMakeLists.txt", f"{lists}add_subdirectory(test)\n")
    assert severities(capsys, "MS002") == dict.fromkeys(found, "error")


@pytest.mark.parametrize(
    ("condition", "later", "severity"),
    [
        ("self.mode == 'raw'", "pass", "warning"),
        ("not self.mode", "pass", "warning"),
        ("self.mode == 'raw' and self.count_subscribers('a')", "pass", "warning"),
        ("SHOWS", "pass", "warning"),
        ("self.mode == 'all'", "pass", "error"),
        ("self.mode == 'raw' or self.count_subscribers('a')", "pass", "error"),
        ("self.mode == 'raw'", "self.mode = 'raw'", "error"),
        ("self.mode == 'raw'", "setattr(self, 'mode', 'raw')", "error"),
    ],
)
def test_branch_that_a_constant_disables(
    package: Path, capsys: pytest.CaptureFixture[str], condition: str, later: str, severity: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    node = NODE.replace("from talker.speaker import Speaker\n\n", "\nSHOWS = False\n")
    node = node.replace("        self.create", "        self.mode = 'all'\n        self.create")
    node = node.replace("        return String().text\n", "        pass  # nothing\n")
    saying = f"        if {condition}:\n            String().text = 'a'\n        {later}\n"
    write(package / "talker" / "node.py", node.replace("        pass\n", saying))
    other = "class Other:\n    def __init__(self):\n        self.mode = 'raw'\n"
    write(package / "talker" / "other.py", other)
    assert severities(capsys, "MS002") == {"talker/node.py": severity}
    changing = "from talker.node import Talker\n\nTalker().mode = 'raw'\n"
    write(package / "talker" / "other.py", changing)
    is_of_file = condition == "SHOWS"
    severity = severity if is_of_file else "error"
    assert severities(capsys, "MS002") == {"talker/node.py": severity}


@pytest.mark.parametrize(("last", "severity"), [("raise", "warning"), ("pass", "error")])
def test_format_of_a_handled_exception(
    package: Path, capsys: pytest.CaptureFixture[str], last: str, severity: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    saying = (
        "        try:\n            print(1)\n        except OSError:\n"
        f"            print('{{}} {{}}'.format(1))\n            {last}\n"
    )
    write(package / "talker" / "node.py", NODE.replace("        pass\n", saying))
    assert severities(capsys, "F524") == {"talker/node.py": severity}


@pytest.mark.parametrize(("asked", "severity"), [("", "warning"), ("heard", "error")])
def test_fixture_that_no_test_asks_for(
    package: Path, capsys: pytest.CaptureFixture[str], asked: str, severity: str
) -> None:
    fixture = "import pytest\nfrom std_msgs.msg import String\n\n\n@pytest.fixture\n"
    fixture += f"def heard():\n    return String().text\n\n\ndef test_a({asked}):\n    pass\n"
    write(package / "test" / "test_a.py", fixture)
    assert severities(capsys, "MS002") == {"test/test_a.py": severity}


LAUNCH = """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package='talker', executable='talk', parameters=[{}])])
"""


@pytest.mark.parametrize(
    ("severity", "given"),
    [
        ("warning", "'other.yaml'"),
        ("error", "'params/talk.yaml'"),
        ("error", "name + '.yaml'"),
        ("error", "'ta' + 'lk.yaml'"),
        ("warning", "'other' + '.yaml'"),
        ("error", "f'params/{name}.yaml'"),
        ("error", "f'{name}lk.yaml'"),
        ("warning", "f'{name}_params.yaml'"),
        ("warning", "f'other_{name}.yaml'"),
        ("error", "['params/', name, '.yaml']"),
        ("error", "'params/%s.yaml' % name"),
    ],
)
def test_parameter_file_not_launched(
    package: Path, capsys: pytest.CaptureFixture[str], severity: str, given: str
) -> None:
    write(package / "params" / "talk.yaml", "talk:\n  ros__parameters:\n    rate:\n")
    assert severities(capsys, "PF007") == {"params/talk.yaml": "error"}  # passed by hand
    write(package / "launch" / "talk.launch.py", LAUNCH.format(given))
    assert severities(capsys, "PF007") == {"params/talk.yaml": severity}


@pytest.mark.parametrize(
    ("severity", "path", "text"),
    [
        ("warning", "talker/other.py", "# talk.yaml\n"),
        ("error", "talker/other.py", "NAME = 'talk.yaml'\n"),
        ("error", "README.md", "Pass it talk.yaml.\n"),
        ("warning", "params/past.yaml", "include: talk.yaml\n"),
        ("error", "params/other.yaml", "include: talk.yaml\n"),
        ("error", "docker.sh", "ros2 run talker talk --params-file talk.yaml\n"),
        (
            "warning",
            "launch/b.launch.py",
            LAUNCH.replace("    return", "    a = 'talk.yaml'\n    return"),
        ),
        (
            "error",
            "launch/b.launch.py",
            LAUNCH.replace("    return", "    use('talk.yaml')\n    return"),
        ),
        ("warning", "launch/b.launch.xml", "<launch>\n  <!-- talk.yaml -->\n</launch>\n"),
        (
            "error",
            "launch/b.launch.xml",
            "<launch>\n  <arg name='a' default='talk.yaml'/>\n</launch>\n",
        ),
        (
            "error",
            "launch/b.launch.xml",
            "<launch>\n  <let name='a' value='$(var b).yaml'/>\n</launch>\n",
        ),
    ],
)
def test_parameter_file_named_elsewhere(
    package: Path, capsys: pytest.CaptureFixture[str], severity: str, path: str, text: str
) -> None:
    write(package / "params" / "talk.yaml", "talk:\n  ros__parameters:\n    rate:\n")
    write(package / "launch" / "talk.launch.py", LAUNCH.format("'other.yaml'"))
    write(package / path, text.replace("[{}]", "[]"))
    assert severities(capsys, "PF007") == {"params/talk.yaml": severity}


@pytest.mark.parametrize(
    ("severity", "own", "text"),
    [
        ("error", "params/other.yaml", ""),
        ("warning", "params/talk.yaml", ""),
        ("warning", "params/talk.yaml", "# talker\n"),
        ("error", "params/talk.yaml", "share = 'talker'\n"),
    ],
)
def test_parameter_file_with_the_name_of_one_in_another_package(
    package: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    severity: str,
    own: str,
    text: str,
) -> None:
    write(package / "params" / "talk.yaml", "talk:\n  ros__parameters:\n    rate:\n")
    other = package.parent / "other"
    write(other / "package.xml", MANIFEST.format("").replace("talker", "other"))
    write(other / own, "")
    launch = LAUNCH.format("'params/talk.yaml'").replace("talker", "other")
    write(other / "launch" / "talk.launch.py", launch + text)
    write(other / "launch" / "all.launch.py", LAUNCH.format("'a.yaml'"))
    monkeypatch.chdir(package.parent)
    assert severities(capsys, "PF007")["talker/params/talk.yaml"] == severity


@pytest.mark.parametrize(
    ("severity", "used"),
    [
        ("warning", "print(wrench())"),
        ("error", "node.publish(wrench())"),
        ("error", "node.call_async(wrench())"),
    ],
)
def test_message_of_a_package_that_sends_none(
    package: Path, capsys: pytest.CaptureFixture[str], severity: str, used: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    code = "from geometry_msgs.msg import Vector3\n\n\ndef wrench():\n    return Vector3(x=1)\n"
    write(package / "talker" / "node.py", f"{code}\n\ndef main(node):\n    {used}\n")
    assert severities(capsys, "MS006") == {"talker/node.py": severity}


def test_robot_that_is_not_launched(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    mesh = "<mesh filename='package://talker/arm.stl'/>"
    link = f"<link name='arm'><visual><geometry>{mesh}</geometry></visual></link>"
    for name in ("arm", "hand"):
        write(package / "urdf" / f"{name}.urdf", f"<robot name='{name}'>{link}</robot>\n")
    data = ", data_files=[('share/talker/urdf', ['urdf/arm.urdf', 'urdf/hand.urdf'])])\n"
    write(package / "setup.py", SETUP.replace(")\n", data))
    write(package / "launch" / "talk.launch.py", LAUNCH.format("'urdf/arm.urdf'"))
    assert severities(capsys, "UR001") == {"urdf/arm.urdf": "error", "urdf/hand.urdf": "warning"}
    for name in ("arm", "hand"):
        write(package / "urdf" / f"{name}.urdf", "<!-- nothing -->\n")
    assert severities(capsys, "SC001,UR") == {"urdf/arm.urdf": "error", "urdf/hand.urdf": "warning"}


@pytest.mark.parametrize(
    ("severity", "path", "text"),
    [
        ("warning", "talker/other.py", "def tell():\n    pass\n"),
        ("error", "talker/other.py", "from talker.words import *\n\ntell()\n"),
        ("error", "src/talk.cpp", 'auto tell = words.attr("tell");\n'),
    ],
)
def test_uncalled_function_of_a_library(
    package: Path, capsys: pytest.CaptureFixture[str], severity: str, path: str, text: str
) -> None:
    write(package / "talker" / "words.py", "def tell():\n    return undefined\n")
    write(package / path, text)
    assert severities(capsys, "F821") == {"talker/words.py": "error"}  # a library for others
    entry = ", entry_points={'console_scripts': ['talk = talker.other:main']})\n"
    write(package / "setup.py", SETUP.replace(")\n", entry))
    assert severities(capsys, "F821") == {"talker/words.py": severity}


@pytest.mark.parametrize(
    ("severity", "name", "use"),
    [
        ("warning", "tell", "Words()"),
        ("error", "tell", "Words().tell()"),
        ("error", "write", "Words()"),
    ],
)
def test_uncalled_method_of_a_helper(
    package: Path, capsys: pytest.CaptureFixture[str], severity: str, name: str, use: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    words = f"class Words:\n    def {name}(self):\n        return undefined\n"
    write(package / "talker" / "words.py", words)
    node = f"from talker.words import Words\n\n\ndef main():\n    {use}\n"
    write(package / "talker" / "node.py", node)
    assert severities(capsys, "F821") == {"talker/words.py": severity}


@pytest.mark.parametrize(
    ("severity", "expression"),
    [("warning", "getattr(message, field)"), ("error", "getattr(sys.modules[__name__], field)")],
)
def test_uncalled_function_next_to_computed_attributes(
    package: Path, capsys: pytest.CaptureFixture[str], severity: str, expression: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    read = f"def read(message, field):\n    return {expression}\n"
    tell = "def tell():\n    return undefined\n"
    write(package / "talker" / "words.py", f"import sys\n\n\n{read}\n\n{tell}")
    write(package / "talker" / "node.py", "from talker.words import read\n")
    assert severities(capsys, "F821") == {"talker/words.py": severity}


def test_exception_that_is_no_exception(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(package / "talker" / "talk.py", "raise NotImplemented('later')\n")
    write(package / "talker" / "node.py", "raise NotThere('later')\n")
    assert severities(capsys, "F901") == {"talker/talk.py": "warning"}
    assert severities(capsys, "F821") == {"talker/node.py": "warning"}


def test_assertion_of_an_undefined_false(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(package / "talker" / "talk.py", "def talk():\n    assert false, 'not here'\n\n\ntalk()\n")
    write(package / "talker" / "node.py", "assert true\n")
    assert severities(capsys, "F821") == {"talker/talk.py": "warning", "talker/node.py": "error"}


@pytest.mark.parametrize(
    ("statement", "severity"),
    [
        ("globals().update({'word': 1})", "warning"),
        ("globals()['word'] = 1", "warning"),
        ("load('words', into=globals())", "warning"),
        ("print(eval('1', globals()))", "error"),
        ("print(globals()['word'])", "error"),
    ],
)
def test_name_added_to_globals(
    package: Path, capsys: pytest.CaptureFixture[str], statement: str, severity: str
) -> None:
    write(package / "talker" / "node.py", f"{statement}\nprint(word)\n")
    assert severities(capsys, "F821") == {"talker/node.py": severity}


def test_annotated_name_that_a_function_sets(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    talk = "word: str\n\n\ndef talk():\n    print(word)\n\n\ntalk()\n"
    write(package / "talker" / "node.py", talk)
    setting = "\n\n\ndef set_word():\n    global word\n    word = 'a'\n\n\nset_word()\n"
    write(package / "talker" / "talk.py", talk.replace("\n", setting, 1))
    assert severities(capsys, "F821") == {"talker/node.py": "error", "talker/talk.py": "warning"}


def test_uncalled_launch_helper(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    helper = LAUNCH.replace("generate_launch_description", "talk").replace("{}", "")
    write(package / "talker" / "parts.py", helper.replace("talk'", "nothing'"))
    assert severities(capsys, "LF006") == {"talker/parts.py": "warning"}
    use = "from talker.parts import talk\n\n\ndef generate_launch_description():\n"
    write(package / "launch" / "a.launch.py", f"{use}    return talk()\n")
    assert severities(capsys, "LF006") == {"talker/parts.py": "error"}


def test_script_not_installed_by_setup_py(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for path in ("relay.py", "scripts/relay.py", "talker/relay.py"):
        write(package / path, MISTAKE)
    assert severities(capsys, "MS002") == {
        "relay.py": "warning",
        "scripts/relay.py": "warning",
        "talker/relay.py": "error",
    }
    write(package / "setup.py", SETUP.replace(")\n", ", scripts=['scripts/relay.py'])\n"))
    assert severities(capsys, "MS002")["scripts/relay.py"] == "error"


@pytest.mark.parametrize(
    ("text", "severity"),
    [
        (MISTAKE, "warning"),
        ("from . import node\n" + MISTAKE + "if __name__ == '__main__':\n    node\n", "warning"),
        (MISTAKE + "if __name__ == '__main__':\n    print()\n", "warning"),
        (MISTAKE + "\n\ndef main():\n    print()\n", "warning"),
    ],
)
def test_module_that_nothing_imports_or_starts(
    package: Path, capsys: pytest.CaptureFixture[str], text: str, severity: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    write(package / "talker" / "node.py", NODE)
    write(package / "talker" / "plan.py", text)
    main(["check", "--format", "json", "--select", "TY003"])
    findings = json.loads(capsys.readouterr().out)["diagnostics"]
    assert {(item["path"], item["severity"]) for item in findings} == {
        ("talker/node.py", "warning"),  # in an uncalled method
        ("talker/plan.py", severity),
    }


@pytest.mark.parametrize(
    ("path", "text", "severity"),
    [
        ("talker/node.py", "def main():\n    pass\n", "warning"),
        ("talker/node.py", "import talker.routes.plan\n", "error"),
        ("talker/node.py", "from .routes import plan\n", "error"),
        ("test/test_plan.py", "from talker.routes import plan\n", "error"),
        ("talker/other.py", "from talker.routes import plan\n", "warning"),
        ("config/plugins.yaml", "plugins: [talker.routes.plan]\n", "warning"),
        ("params.yaml", "plugins: [talker.routes.plan]\n", "error"),
    ],
)
def test_module_only_imported_by_modules_that_nothing_imports(
    package: Path, capsys: pytest.CaptureFixture[str], path: str, text: str, severity: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    write(package / "talker" / "node.py", "def main():\n    pass\n")
    write(package / "talker" / "routes" / "__init__.py", "from . import plan\n")
    write(package / "talker" / "routes" / "plan.py", "from .way import *\n")
    write(package / "talker" / "routes" / "way.py", "from .plan import a\n" + UNDEFINED)
    write(package / path, text)
    assert severities(capsys, "F821") == {"talker/routes/way.py": severity}


@pytest.mark.parametrize(
    ("severity", "changed", "into"),
    [
        ("warning", "", ""),
        ("warning", "def report(teller):", 'def report(teller):\n    "Call it after tell()."'),
        ("warning", "main():", "main():\n    tell = print\n    tell()\n"),
        ("error", "main():", "main():\n    print().tell()\n"),
        ("error", "main():", "main():\n    print('tell')\n"),
        ("error", "main():", "main():\n    report(1)\n"),
        ("error", "def report", "report(1)\n\n\ndef report"),
        ("error", "def report", "@register\ndef report"),
    ],
)
def test_method_only_called_by_functions_that_nothing_calls(
    package: Path, capsys: pytest.CaptureFixture[str], severity: str, changed: str, into: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    words = "class Words:\n    def tell(self):\n        return undefined\n"
    write(package / "talker" / "words.py", words)
    node = "from talker.words import Words\n\n\ndef main():\n    Words()\n\n\n"
    node += "def report(teller):\n    teller.tell()\n    report(teller)\n"
    write(package / "talker" / "node.py", node.replace(changed, into, 1))
    found = severities(capsys, "F821")
    assert found["talker/words.py"] == severity


@pytest.mark.parametrize(
    ("path", "text", "severity"),
    [
        ("README.md", "Run plan.", "warning"),
        ("README.md", "Run `python3 talker/plan.py` with params/talk.yaml.", "error"),
        ("docker/start.sh", "python3 src/talker/talker/plan.py params/talk.yaml", "error"),
        ("other/start.sh", "python3 src/talker/talker/plan.py params/talk.yaml", "warning"),
    ],
)
def test_file_named_by_a_text_of_the_repository(
    package: Path, capsys: pytest.CaptureFixture[str], path: str, text: str, severity: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    write(package / "talker" / "node.py", "def main():\n    pass\n")
    write(package / "talker" / "plan.py", UNDEFINED)
    write(package / "params" / "talk.yaml", "talk:\n  ros__parameters:\n    rate:\n")
    write(package / "launch" / "talk.launch.py", LAUNCH.format("'other.yaml'"))
    write(package.parent / ".git" / "HEAD", "")
    write(package.parent / path, text)
    expected = {"talker/plan.py": severity, "params/talk.yaml": severity}
    assert severities(capsys, "F821,PF007") == expected


def test_script_of_another_interpreter(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for name, first in (("start", "/usr/bin/env bash"), ("stop", "/usr/bin/env python3")):
        write(package / "talker" / f"{name}.py", f"#!{first}\nfor item in *; do echo; done\n")
    assert severities(capsys, "E999") == {"talker/start.py": "warning", "talker/stop.py": "error"}


@pytest.mark.parametrize(
    ("path", "loading", "severity"),
    [
        ("talker/routes/__init__.py", "import_module(f'{__name__}.{name}')", "error"),
        ("talker/node.py", "import_module('talker.routes.' + name)", "error"),
        ("talker/node.py", "import_module(name, 'talker.routes')", "error"),
        ("talker/node.py", "import_module(name)", "error"),
        ("talker/node.py", "import_module('numpy')", "warning"),
        ("talker/node.py", "import_module('talker.hops.' + name)", "warning"),
    ],
)
def test_module_that_is_loaded_by_a_computed_name(
    package: Path, capsys: pytest.CaptureFixture[str], path: str, loading: str, severity: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    write(package / "talker" / "routes" / "__init__.py", "")
    write(package / "talker" / "routes" / "plan.py", f"class Plan:\n    {UNDEFINED}")
    write(package / "talker" / "node.py", "import talker.routes\n")
    load = f"from importlib import import_module\n\n\ndef main(name):\n    {loading}\n"
    write(package / path, load)
    route = "talker.routes.plan" if loading == "import_module(name)" else "walk"
    write(package / "config" / "routes.yaml", f"route: {route}\n")
    assert severities(capsys, "F821") == {"talker/routes/plan.py": severity}


@pytest.mark.parametrize(
    ("code", "methods"),
    [
        ("ND001", "    def _init_(self):\n        super().__init__('talker')\n"),
        (
            "ND066",
            "    def on_configure(self, state): ...\n\n    def on_activate(self, state): ...\n",
        ),
    ],
)
def test_method_that_should_be_called(
    package: Path, capsys: pytest.CaptureFixture[str], code: str, methods: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    node = f"import rclpy\nfrom rclpy.node import Node\n\n\nclass Talker(Node):\n{methods}\n\n"
    node += "def main():\n    rclpy.init()\n    rclpy.spin(Talker('talker'))\n"
    write(package / "talker" / "node.py", node)
    assert severities(capsys, code) == {"talker/node.py": "error"}


def test_undefined_name_in_the_first_line_of_an_uncalled_function(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    node = "def tell(text=undefined):\n    pass\n\n\ndef main():\n    pass\n"
    write(package / "talker" / "node.py", node)
    assert severities(capsys, "F821") == {"talker/node.py": "error"}


@pytest.mark.parametrize(
    ("text", "severity"),
    [
        ("plan = [1]\nprint(plan[0], f(plan).plan)\n", "warning"),
        ("from talker import plan\n", "error"),
        ("from talker import (\n    node,\n    plan as made,\n)\n", "error"),
        ("import importlib\n\nimportlib.import_module('talker.plan')\n", "error"),
        ("import runpy\n\nrunpy.run_path(f'{HERE}/plan.py')\n", "error"),
        ("NAMES = ['plan']\n", "error"),
    ],
)
def test_variable_with_the_name_of_a_module(
    package: Path, capsys: pytest.CaptureFixture[str], text: str, severity: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    write(package / "talker" / "node.py", text)
    write(package / "talker" / "plan.py", UNDEFINED)
    assert severities(capsys, "F821")["talker/plan.py"] == severity


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("README.md", "Start it: `python3 talker/plan.py`\n"),
        ("launch/plan.launch.py", "PLAN = 'plan.py'\n"),
        ("setup.py", CONSOLE_SCRIPT.replace("talker.node", "talker.plan")),
        ("setup.py", CONSOLE_SCRIPT.replace("['talk = talker.node:main']", "[*scripts]")),
        (
            "setup.py",
            CONSOLE_SCRIPT.replace(")\n", ", data_files=[('lib', glob('talker/*.py'))])\n"),
        ),
    ],
)
def test_module_that_may_be_started(
    package: Path, capsys: pytest.CaptureFixture[str], path: str, text: str
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    write(package / "talker" / "node.py", "")
    write(package / "talker" / "plan.py", UNDEFINED + "\n\ndef main():\n    pass\n")
    assert severities(capsys, "F821") == {"talker/plan.py": "warning"}
    write(package / path, text.replace("\n", "\nfrom glob import glob\n", 1))
    assert severities(capsys, "F821")["talker/plan.py"] == "error"


def test_dependency_of_an_uncalled_function(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    lazy = "def main():\n    pass\n\n\ndef show():\n    import cv2\n\n    cv2.imshow()\n"
    write(package / "talker" / "node.py", lazy)
    assert severities(capsys, "PX020") == {"talker/node.py": "warning"}
    write(package / "talker" / "node.py", lazy.replace("pass", "show()"))
    assert severities(capsys, "PX020") == {"talker/node.py": "error"}


def test_module_imported_by_another_package(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(package / "setup.py", CONSOLE_SCRIPT)
    write(package / "talker" / "node.py", "")
    write(package / "talker" / "plan.py", UNDEFINED)
    assert severities(capsys, "F821") == {"talker/plan.py": "warning"}
    user = package.parent / "user"
    write(user / "package.xml", MANIFEST.format("").replace("talker", "user"))
    write(user / "go.py", "from talker.plan import x\n")
    assert severities(capsys, "F821") == {"talker/plan.py": "error"}


def test_file_for_ros_1(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(package / "talker" / "node.py", "import rospy\n\nrospy.spin()\n" + UNDEFINED)
    assert severities(capsys, "F821") == {"talker/node.py": "warning"}
    write(package / "talker" / "node.py", "import rclpy\nimport rospy\n" + UNDEFINED)
    assert severities(capsys, "F821") == {"talker/node.py": "error"}


@pytest.mark.parametrize(
    ("severity", "path", "text"),
    [
        ("error", "test/test_talk.py", "from test.helper import help\n"),
        ("error", "talker/talk.py", "import cv2\n"),
        ("warning", "test/other.py", "import cv2\n"),
        ("warning", "test/test_talk.py", "# from test.helper import help\n"),
    ],
)
def test_dependency_of_test_helper(
    package: Path, capsys: pytest.CaptureFixture[str], severity: str, path: str, text: str
) -> None:
    write(package / "setup.py", TESTED)
    write(package / "test" / "__init__.py", "")
    write(package / "test" / "helper.py", "import cv2\n")
    write(package / path, text)
    assert [*severities(capsys, "PX020").values()] == [severity]


def test_dependency_of_conftest(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(package / "setup.py", TESTED)
    write(package / "test" / "conftest.py", "import cv2\n")
    assert severities(capsys, "PX020") == {"test/conftest.py": "warning"}
    write(package / "test" / "test_talk.py", "def test_talk():\n    pass\n")
    assert severities(capsys, "PX020") == {"test/conftest.py": "error"}


def test_script_only_in_setup_py_next_to_cmake(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(package / "setup.py", SETUP.replace(")\n", ", scripts=['scripts/aim.py'])\n"))
    manifest = MANIFEST.format("").replace("ament_python", "ament_cmake")
    write(package / "package.xml", manifest)
    lists = "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
    lists += "install(PROGRAMS scripts/talk.py DESTINATION lib/talker)\nament_package()\n"
    write(package / "CMakeLists.txt", lists)
    for name in ("aim", "talk"):
        write(package / "scripts" / f"{name}.py", MISTAKE)
    assert severities(capsys, "MS002") == {"scripts/aim.py": "warning", "scripts/talk.py": "error"}


def test_module_imported_as_attribute_of_its_package(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(package / "talker" / "__init__.py", "from .talk import *\n\ndel talk\ndel other\n")
    write(package / "talker" / "talk.py", "TOPIC = 'talk'\n")
    main(["check", str(package), "--format", "json", "--select", "F821"])
    findings = json.loads(capsys.readouterr().out)["diagnostics"]
    assert [(item["line"], item["severity"]) for item in findings] == [(3, "warning"), (4, "error")]


def test_unevaluated_annotation(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    function = "def talk(text: {}) -> None:\n    said: {} = text\n    print(said)\n"
    later = "from __future__ import annotations\n\n\n"
    write(package / "talker" / "local.py", function.format("str", "Undefined"))
    write(package / "talker" / "later.py", later + function.format("Undefined", "str"))
    write(package / "talker" / "now.py", function.format("Undefined", "str"))
    write(package / "talker" / "text.py", function.format("list['Undefined']", "str"))
    assert severities(capsys, "F821") == {
        "talker/local.py": "warning",
        "talker/later.py": "warning",
        "talker/now.py": "error",
        "talker/text.py": "warning",
    }


def test_too_large_file_may_mention_a_script(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write(package / "talker" / "talk_old.py", UNDEFINED)
    assert severities(capsys, "F821") == {"talker/talk_old.py": "warning"}
    write(package / "maps" / "map.yaml", "- 0\n" * 400_000)
    assert severities(capsys, "F821") == {"talker/talk_old.py": "warning"}
    write(package / "all.sh", "ls\n" * 400_000)
    assert severities(capsys, "F821") == {"talker/talk_old.py": "error"}


def test_module_only_used_by_a_script_that_is_not_installed(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / "setup.py").unlink()
    manifest = MANIFEST.format("").replace("ament_python", "ament_cmake")
    write(package / "package.xml", manifest)
    lists = "project(talker)\nfind_package(ament_cmake REQUIRED)\nament_package()\n"
    write(package / "CMakeLists.txt", lists)
    write(package / "scripts" / "talk.py", "import listen\nfrom bags import speech\n")
    write(package / "scripts" / "listen.py", f"import talk\n\n{UNDEFINED}")
    write(package / "scripts/bags" / "__init__.py", "")
    write(package / "scripts/bags" / "speech.py", UNDEFINED)
    left = {"scripts/listen.py": "warning", "scripts/bags/speech.py": "warning"}
    assert severities(capsys, "F821") == left
    installing = "install(PROGRAMS scripts/talk.py DESTINATION lib/talker)\n"
    write(package / "CMakeLists.txt", lists.replace("ament_package", f"{installing}ament_package"))
    assert severities(capsys, "F821") == dict.fromkeys(left, "error")


def test_main_guard_of_a_module_with_an_entry_point(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    entry = ", entry_points={'console_scripts': ['talk = talker.talk:main']})\n"
    write(package / "setup.py", SETUP.replace(")\n\n", ")\n").removesuffix(")\n") + entry)
    guard = "if __name__ == '__main__':\n    main(undefined)\n"
    write(package / "talker" / "talk.py", f"def main():\n    print('hello')\n\n\n{guard}")
    assert severities(capsys, "F821") == {"talker/talk.py": "warning"}
    write(package / "README.md", "Run `python3 talker/talk.py`.\n")
    assert severities(capsys, "F821") == {"talker/talk.py": "error"}


def test_uncalled_function_of_a_test(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    helper = "def check_all():\n    print(undefined)\n\n\n"
    write(package / "test" / "test_talk.py", f"{helper}def test_talk():\n    pass\n")
    write(package / "test" / "test_hear.py", f"{helper}def test_hear():\n    check_all()\n")
    write(package / "test" / "conftest.py", "def pytest_configure():\n    print(undefined)\n")
    assert severities(capsys, "F821") == {
        "test/test_talk.py": "warning",
        "test/test_hear.py": "error",
        "test/conftest.py": "error",
    }


@pytest.mark.parametrize(
    ("command", "severity"),
    [("ament_python_install_package(talker)", "warning"), ("add_test(s setup.py)", "error")],
)
def test_setup_py_next_to_cmake(
    package: Path, capsys: pytest.CaptureFixture[str], command: str, severity: str
) -> None:
    write(package / "setup.py", SETUP.replace("'talker'", "talker"))
    manifest = MANIFEST.format("").replace("ament_python", "ament_cmake")
    write(package / "package.xml", manifest)
    lists = "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
    write(package / "CMakeLists.txt", f"{lists}{command}\nament_package()\n")
    assert severities(capsys, "F821") == {"setup.py": severity}


def test_launch_file_started_by_its_path(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write(package / "launch" / "talk.launch.py", LAUNCH)
    write(package.parent / ".git" / "HEAD", "")
    write(package.parent / "README.md", "Run `ros2 launch talker talk.launch.py`.")
    assert severities(capsys, "SP010") == {"setup.py": "error"}
    write(package.parent / "README.md", "Run `ros2 launch src/talker/launch/talk.launch.py`.")
    assert severities(capsys, "SP010") == {"setup.py": "warning"}
