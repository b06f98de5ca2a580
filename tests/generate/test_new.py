"""`ros2-scaffold new`: rendering, rejected answers, written files."""

from __future__ import annotations

import ast
import itertools
import os
import subprocess
from pathlib import Path
from textwrap import dedent
from typing import Any

import pytest
from lxml import etree

from scaffold.check.rules.rule import Rule
from scaffold.cli.main import main
from scaffold.configuration import content, trust
from scaffold.errors import ContentError, InputError
from scaffold.generate import checking, draft, examples, payload
from scaffold.generate.questions import answer_types, names
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.qos import qos
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import filters, licenses, loading, template

ROOTS = content.roots("templates")
TEMPLATES = loading.load(ROOTS)
BUILD_TYPES = ("ament_cmake", "ament_python")
COMMENTS = ("brief", "tutorial")
TYPES = (
    *("Bool", "Byte", "Char", "Float32", "Float64", "Header", "String"),
    *(f"{sign}Int{bits}" for sign in ("", "U") for bits in (8, 16, 32, 64)),
)
COMBINATIONS = list(itertools.product(BUILD_TYPES, COMMENTS, TYPES))
EXAMPLES = [
    pytest.param(example.answers, id=f"{name}-{example.title}")
    for name, item in TEMPLATES.items()
    for example in examples.of(item, TEMPLATES)
]

COMMON_FILES = {
    "CHANGELOG.rst",
    "LICENSE",
    "README.md",
    "package.xml",
    "talker/__init__.py",
    "talker/minimal_publisher.py",
    "test/conftest.py",
    "test/test_minimal_publisher.py",
}
FILES = {
    "ament_cmake": COMMON_FILES | {"CMakeLists.txt"},
    "ament_python": COMMON_FILES
    | {"setup.py", "setup.cfg", "resource/talker"}
    | {f"test/test_{linter}.py" for linter in ("copyright", "flake8", "pep257")},
}


@pytest.fixture(autouse=True)
def _isolated_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Isolate tests from the user's settings."""
    home = tmp_path / "home"
    home.mkdir()
    monkeypatch.setenv("HOME", str(home))
    monkeypatch.setenv("XDG_CONFIG_HOME", str(home / ".config"))
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(home / ".gitconfig"))
    monkeypatch.setenv("GIT_CONFIG_SYSTEM", os.devnull)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1760000000")
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    (home / ".gitconfig").write_text("[user]\nname = Ada Lovelace\nemail = ada@example.com\n")
    work = tmp_path / "work"
    work.mkdir()
    monkeypatch.chdir(work)


def make(**answers: object) -> draft.Draft:
    """Render a package."""
    given = {"package": "talker", **answers}
    asked = {name: Given(value, f"--{name}") for name, value in given.items()}
    return draft.draft(ROOTS, TEMPLATES, asked, User("."))


def files_of(**answers: object) -> dict[str, str]:
    return dict(make(**answers).rendered.files)


# -- every combination


@pytest.mark.parametrize(("build_type", "comments", "name"), COMBINATIONS)
def test_every_combination_is_tidy(build_type: str, comments: str, name: str) -> None:
    made = make(build_type=build_type, comments=comments, message_type=f"std_msgs/msg/{name}")
    files = made.rendered.files
    assert set(files) == FILES[build_type]
    assert made.rendered.executable == {"talker/minimal_publisher.py"}
    for path, text in files.items():
        assert_tidy(path, text)
    for path in filter(lambda path: path.endswith(".py"), files):
        ast.parse(files[path], path)
    node = files["talker/minimal_publisher.py"]
    filled = payload.payload(f"std_msgs/msg/{name}")
    assert node.startswith("#!/usr/bin/env python3\n# Copyright 2025 Ada Lovelace\n")
    assert f"\nfrom std_msgs.msg import {name}\n" in node
    assert "self.declare_parameter('rate', 2.0, ParameterDescriptor(" in node
    assert ("frame_id" in node) == (name == "Header")
    for statement in filled.statements:
        assert f"        {statement}\n" in node
    comment_lines = [line for line in node.splitlines() if line.startswith("        # ")]
    assert bool(comment_lines) == (comments == "tutorial")
    readme = files["README.md"]
    assert f"| `/example_topic` | `std_msgs/msg/{name}` | published |" in readme
    executable = "minimal_publisher.py" if build_type == "ament_cmake" else "minimal_publisher"
    assert made.executables == (executable,)
    assert f"\nros2 run talker {executable}\n" in readme


def assert_tidy(path: str, text: str) -> None:
    assert "\t" not in text or path == "LICENSE", path
    assert "{{" not in text, path
    assert "{%" not in text, path
    assert "#:" not in text, path
    assert not text or text.endswith("\n"), path
    assert not text.endswith("\n\n"), path
    assert "\n\n\n" not in text or path.endswith((".py", "LICENSE")), path
    for line in text.splitlines():
        assert line == line.rstrip(), path


def test_brief_node_equals_the_tutorial() -> None:
    node = files_of()["talker/minimal_publisher.py"]
    assert node.partition("# limitations under the License.\n")[2] == dedent('''
        """
        Publish std_msgs/msg/String messages at a fixed rate.

        Publishes:
            /example_topic (std_msgs/msg/String)
                a greeting with a counter
        Subscribes to:
            nothing
        """

        import signal
        import time

        from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
        import rclpy
        from rclpy.exceptions import ParameterException
        from rclpy.executors import ExternalShutdownException
        from rclpy.logging import get_logger
        from rclpy.node import Node
        from std_msgs.msg import String


        class MinimalPublisher(Node):
            """Publish a greeting with a counter."""

            def __init__(self) -> None:
                """Declare the parameters, then create the publisher and its timer."""
                super().__init__('minimal_publisher')
                rate = self.declare_parameter('rate', 2.0, ParameterDescriptor(
                    description='messages per second', read_only=True, floating_point_range=[
                        FloatingPointRange(from_value=0.1, to_value=1000.0)])).value
                self.publisher = self.create_publisher(String, 'example_topic', 10)
                self.timer = self.create_timer(1.0 / rate, self.publish_message)
                self.count = 0  # messages published so far

            def publish_message(self) -> None:
                """Log the next message and publish it."""
                msg = String()
                msg.data = f'Hello World: {self.count}'
                self.get_logger().info(f'Publishing: {msg.data}')
                self.publisher.publish(msg)
                self.count += 1


        def main(args: list[str] | None = None) -> None:
            """Run the node until Ctrl+C (SIGINT) or SIGTERM."""
            signal.signal(signal.SIGTERM, signal.default_int_handler)  # rclpy alone may miss it
            rclpy.init(args=args)
            node = None
            try:
                node = MinimalPublisher()
                rclpy.spin(node)
            except (KeyboardInterrupt, ExternalShutdownException):
                pass
            except ParameterException as error:
                get_logger('minimal_publisher').fatal(str(error))
                raise SystemExit(1) from None
            except RuntimeError:
                time.sleep(0.5)  # after a signal, rclpy takes a moment to shut down
                if rclpy.ok():  # if not, the signal came while the node was working
                    raise
            finally:
                if node is not None:
                    node.destroy_node()
                rclpy.try_shutdown()


        if __name__ == '__main__':
            main()
        ''')


def test_cmake_sections_in_the_order_of_the_tutorial() -> None:
    lists = files_of()["CMakeLists.txt"]
    commands = [
        line.partition("(")[0] for line in lists.splitlines() if line[:1].isalpha() and "(" in line
    ]
    assert commands == [
        "cmake_minimum_required",
        "project",
        "find_package",
        "find_package",
        "ament_python_install_package",
        "install",
        "if",
        "endif",
        "ament_package",
    ]
    assert "rclcpp" not in lists
    assert "include" not in lists


@pytest.mark.parametrize(
    ("build_type", "expected"),
    [
        (
            "ament_cmake",
            {
                "buildtool_depend": ["ament_cmake", "ament_cmake_python"],
                "exec_depend": [
                    "python3-numpy",
                    "rcl_interfaces",
                    "rclpy",
                    "sensor_msgs",
                    "std_msgs",
                ],
                "test_depend": [
                    "ament_cmake_pytest",
                    "ament_index_python",
                    "ament_lint_auto",
                    "ament_lint_common",
                    "domain_coordinator",
                ],
            },
        ),
        (
            "ament_python",
            {
                "exec_depend": [
                    "python3-numpy",
                    "rcl_interfaces",
                    "rclpy",
                    "sensor_msgs",
                    "std_msgs",
                ],
                "test_depend": [
                    "ament_copyright",
                    "ament_flake8",
                    "ament_index_python",
                    "ament_pep257",
                    "domain_coordinator",
                    "python3-pytest",
                ],
            },
        ),
    ],
)
def test_dependencies_of_the_manifest(build_type: str, expected: dict[str, list[str]]) -> None:
    wanted = ["std_msgs", "sensor_msgs", "python3-numpy", "sensor_msgs"]
    manifest = etree.fromstring(
        files_of(build_type=build_type, dependencies=wanted)["package.xml"].encode()
    )
    result: dict[str, list[str]] = {}
    for element in manifest:
        if element.tag.endswith("_depend"):
            result.setdefault(element.tag, []).append(element.text or "")
    assert result == expected
    assert manifest.findtext("export/build_type") == build_type


def test_user_dependency_replaces_test_dependency() -> None:
    manifest = files_of(dependencies="ament_index_python")["package.xml"]
    assert "<exec_depend>ament_index_python<" in manifest
    assert "<test_depend>ament_index_python<" not in manifest


def test_private_topics_frames_and_qos_profiles() -> None:
    files = files_of(
        node_name="node", topic="~/beat", message_type="std_msgs/Header", qos="sensor_data"
    )
    node = files["talker/node.py"]
    assert "class NodeNode(Node):" in node
    assert "    node = NodeNode()\n" in node
    assert "    /node/beat (std_msgs/msg/Header)\n" in node
    assert "self.create_publisher(Header, '~/beat', qos_profile_sensor_data)" in node
    assert "msg.frame_id = self.frame_id" in node
    assert "self.count" not in node
    test = files["test/test_node.py"]
    assert "TOPIC = '/node/beat'\n" in test
    assert "QOS = qos_profile_sensor_data\n" in test
    assert names.class_name("header", ["Header"]) == "HeaderNode"
    assert names.class_name("action_client") == "ActionClientNode"
    assert [names.class_name(node) for node in ("i", "o", "l")] == ["INode", "ONode", "L"]


@pytest.mark.parametrize("given", EXAMPLES)
@pytest.mark.parametrize("comments", COMMENTS)
def test_examples_pass_every_rule(given: dict[str, Any], comments: str) -> None:
    made = make(**{"comments": comments, **given})
    assert checking.defects(made, rules()) == []


@pytest.mark.parametrize("license_", licenses.names(ROOTS))
def test_every_license_passes_every_rule(license_: str) -> None:
    for build_type in BUILD_TYPES:
        made = make(build_type=build_type, license=license_)
        assert checking.defects(made, rules()) == []


@pytest.mark.parametrize("build_type", BUILD_TYPES)
def test_the_longest_names_pass_every_rule(build_type: str) -> None:
    made = make(
        package="p" * names.MAX_LENGTH,
        node_name="n" * names.MAX_LENGTH,
        build_type=build_type,
        comments="tutorial",
        topic="t" * (names.MAX_TOPIC - 1),
        message_type="std_msgs/msg/Float64",
        qos="action_status_default",
        description="word " * 200 + "w" * 300,
        maintainer_name="M" * answer_types.MAX_PERSON,
        maintainer_email="m" * (answer_types.MAX_PERSON - 12) + "@example.com",
    )
    assert checking.defects(made, rules()) == []


def rules() -> list[type[Rule]]:
    from scaffold.check.rules import registry

    return registry.load(content.roots("rules"))


# -- text that must survive

HOSTILE = [
    'Bob\'s "robot"',
    "a & b <c> &amp; ]]>",
    "{{ package }} {% raw %} {# x #}",
    "${PROJECT_NAME} $(pwd) `id` %s \\n \\",
    "*bold* _it_ [x](y) | # 1. > -",
    "- starts like a list",
    "1. starts like a list",
    "Grüße, 日本語, \U0001f916, a\u00adb\u200bc",
    "'''\"\"\"",
    "#: not a comment",
    "x" * 400,
    "it's " * 60,
    '"quoted" and it\'s ' * 20,
]


@pytest.mark.parametrize("description", HOSTILE)
@pytest.mark.parametrize("build_type", BUILD_TYPES)
def test_description_is_escaped_in_every_file(description: str, build_type: str) -> None:
    expected = " ".join(description.split())
    made = make(description=description, build_type=build_type)
    files = made.rendered.files
    manifest = etree.fromstring(files["package.xml"].encode())
    assert manifest.findtext("description") == expected
    assert filters.markdown(expected) in files["README.md"].splitlines()
    if build_type == "ament_python":
        assert setup_arguments(files["setup.py"])["description"] == expected
        assert max(map(len, files["setup.py"].splitlines())) <= filters.MAX_COLUMNS
    assert checking.defects(made, rules()) == []


def test_line_breaks_in_a_description_are_folded() -> None:
    files = files_of(description="one\r\ntwo\n\n  three\t", build_type="ament_python")
    assert "<description>one two three</description>" in files["package.xml"]
    assert "    description='one two three',\n" in files["setup.py"]


@pytest.mark.parametrize(
    ("description", "message"),
    [
        (" \n", "must not be empty"),
        ("a\0b", r"contains the character U\+0000"),
        ("a\x1b[1mb", r"contains the character U\+001B"),
        ("a\udcffb", r"contains the character U\+DCFF"),
        ("TODO: say it", "is a placeholder"),
    ],
)
def test_invalid_descriptions_are_rejected(description: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        make(description=description)


def test_metadata_of_manifest_and_setup_agree() -> None:
    files = files_of(build_type="ament_python", maintainer_name="Seán O'Brien & Co", license="MIT")
    manifest = etree.fromstring(files["package.xml"].encode())
    setup = setup_arguments(files["setup.py"])
    maintainer = manifest.find("maintainer")
    assert maintainer is not None
    assert setup["version"] == manifest.findtext("version")
    assert setup["description"] == manifest.findtext("description")
    assert setup["license"] == manifest.findtext("license") == "MIT"
    assert setup["maintainer"] == maintainer.text == "Seán O'Brien & Co"
    assert setup["maintainer_email"] == maintainer.get("email") == "ada@example.com"
    assert '    maintainer="Seán O\'Brien & Co",\n' in files["setup.py"]
    assert "Copyright (c) 2025 Seán O'Brien & Co" in files["LICENSE"]
    assert "setup.py" not in files_of()


def setup_arguments(text: str) -> dict[str, Any]:
    """Return the literal keyword arguments of ``setup()``."""
    call = next(
        node
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "setup"
    )
    result: dict[str, Any] = {}
    for keyword in call.keywords:
        if keyword.arg and isinstance(keyword.value, ast.Constant):
            result[keyword.arg] = keyword.value.value
    return result


# -- names


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("Bad Name", "underscores, starting with a letter, such as bad_name$"),
        ("my-robot", "such as my_robot$"),
        ("MyRobot", "such as my_robot$"),
        ("my__robot", "such as my_robot$"),
        ("robot_", "such as robot$"),
        ("9lives", "such as lives$"),
        ("größe", "such as gr_e$"),
        ("../evil", "such as evil$"),
        ("", "'' has 0 characters; it must have 2 to 48$"),
        ("a", "'a' has 1 character; it must have 2 to 48$"),
        ("a" * 49, "has 49 characters; it must have 2 to 48$"),
        ("class", "'class' is a keyword of Python; choose another one$"),
        ("test", "'test' is the name of a CMake target; choose another one$"),
        ("install", "is the name of a CMake target"),
        ("src", "is the name of a directory in workspaces and packages"),
        ("resource", "is the name of a directory"),
        ("logging", "is a module of the Python standard library"),
        ("rclpy", "is an existing ROS package"),
        ("std_msgs", "is an existing ROS package"),
        ("nav2_msgs", "is an existing ROS package"),
        ("numpy", "is an existing Python package"),
    ],
)
def test_invalid_package_names_are_rejected(name: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        make(package=name)


def test_name_of_an_installed_package_is_rejected(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    index = tmp_path / "opt" / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    (index / "our_robot").touch()
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/nowhere:{tmp_path / 'opt'}")
    with pytest.raises(InputError, match=r"'our_robot' is a package installed in .*/opt"):
        make(package="our_robot")
    make(package="our_robots")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("talker", "--node-name: 'talker' is the name of the package"),
        ("random", "would shadow the Python module random"),
        ("rclpy", "would shadow the Python module rclpy"),
        ("yaml", "would shadow the Python module yaml"),
        ("import", "is a keyword of Python"),
        ("test_node", "is the name of a test file for pytest"),
        ("node_test", "is the name of a test file for pytest"),
        ("flake8", "would shadow the Python module flake8"),
        ("copyright", "is the name of a test file"),
        ("my-node", "such as my_node$"),
        ("MinimalPublisher", "such as minimal_publisher$"),
        ("n" * 49, "has 49 characters"),
    ],
)
def test_invalid_node_names_are_rejected(name: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        make(node_name=name)


@pytest.mark.parametrize(
    ("topic", "message"),
    [
        ("a//b", "must be words of letters"),
        ("/", "must be words of letters"),
        ("", "must be words of letters"),
        ("~", "must be words of letters"),
        ("~x", "must be words of letters"),
        ("x/", "must be words of letters"),
        ("a b", "must be words of letters"),
        ("a/1b", "none starting with a digit"),
        ("{node}/x", "must be words of letters"),
        ("a'b", "must be words of letters"),
        ("a__b", "a double underscore"),
        ("rosout", "used by ROS itself"),
        ("/parameter_events", "used by ROS itself"),
        ("t" * 65, "has 65 characters; the limit is 64"),
        ("~/" + "t" * 62, "'/minimal_publisher/t*' in full, 81 characters long"),
    ],
)
def test_invalid_topics_are_rejected(topic: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        make(topic=topic)


@pytest.mark.parametrize("topic", ["x", "/x", "~/x", "a/b_c/D1", "/a/b", "_hidden"])
def test_valid_topics_are_accepted(topic: str) -> None:
    node = files_of(topic=topic)["talker/minimal_publisher.py"]
    assert f"self.create_publisher(String, '{topic}', 10)" in node


# -- numbers and types


@pytest.mark.parametrize(
    ("rate", "written"), [("2", "2.0"), (10, "10.0"), ("0.001", "0.001"), ("1e4", "10000.0")]
)
def test_valid_rates_are_accepted(rate: object, written: str) -> None:
    files = files_of(rate=rate)
    assert f"('rate', {written}, " in files["talker/minimal_publisher.py"]
    assert f"their rate: {written} Hz" in files["README.md"]


@pytest.mark.parametrize("rate", ["0", "-1", "nan", "inf", "1e9", "0.0001"])
def test_rates_out_of_range_are_rejected(rate: str) -> None:
    with pytest.raises(InputError, match=f"--rate: {rate} Hz is not between 0.001 and 10000 Hz"):
        make(rate=rate)


def test_rate_that_is_no_number_is_rejected() -> None:
    for rate in ("fast", "", True, [2]):
        with pytest.raises(InputError, match="--rate: "):
            make(rate=rate)


@pytest.mark.parametrize(
    ("name", "statements"),
    [
        ("String", ("msg.data = f'Hello World: {self.count}'",)),
        ("Bool", ("msg.data = self.count % 2 == 0",)),
        ("Byte", ("msg.data = bytes([self.count % 256])",)),
        ("Char", ("msg.data = self.count % 256",)),
        ("Int8", ("msg.data = self.count % 128",)),
        ("UInt16", ("msg.data = self.count % 65536",)),
        ("Int32", ("msg.data = self.count % 2**31",)),
        ("UInt64", ("msg.data = self.count",)),
        ("Float32", ("msg.data = math.sin(self.count / 10.0)",)),
        (
            "Header",
            ("msg.stamp = self.get_clock().now().to_msg()", "msg.frame_id = self.frame_id"),
        ),
    ],
)
def test_payload_of_message_types(name: str, statements: tuple[str, ...]) -> None:
    assert payload.payload(f"std_msgs/{name}").statements == statements


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("std_msgs/msg/Sting", "did you mean std_msgs/msg/String"),
        ("Sting", "did you mean std_msgs/msg/String"),
        ("std_msgs/msg/string", "did you mean std_msgs/msg/String"),
        ("std_msgs/msg/Int9", "did you mean std_msgs/msg/Int"),
        ("geometry_msgs/msg/Twits", "did you mean geometry_msgs/msg/Twist"),
        ("", "unknown message type ''"),
        ("std_srvs/srv/Empty", "'std_srvs/srv/Empty' is a type of services, not of messages"),
    ],
)
def test_unknown_message_types_are_rejected(name: str, message: str) -> None:
    with pytest.raises(InputError, match=f"--message_type: .*{message}"):
        make(message_type=name)


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("todo", "is a placeholder"),
        ("a@b", "is not an email address"),
        ("a b@example.com", "is not an email address"),
        ("ada@exämple.com", "is not an email address"),
        ("root@todo.todo", "is a placeholder"),
        ("a" * 60 + "@example.com", "has more than 60 characters"),
    ],
)
def test_invalid_email_addresses_are_rejected(address: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        make(maintainer_email=address)


@pytest.mark.parametrize("name", ["", 'A "B" C', "a\\b", "x" * 61, "TODO"])
def test_invalid_maintainer_names_are_rejected(name: str) -> None:
    with pytest.raises(InputError, match="--maintainer_name: "):
        make(maintainer_name=name)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("talker", "--dependencies: talker is the package itself"),
        ("ament_cmake", "--dependencies: ament_cmake is a build tool"),
        ("a b;c", "the dependency 'b;c' is not the name of a package"),
        (7, "the dependency '7' is not the name"),
    ],
)
def test_invalid_dependencies_are_rejected(given: object, message: str) -> None:
    with pytest.raises(InputError, match=message):
        make(dependencies=given)


@pytest.mark.parametrize(
    ("given", "near"),
    [("mit", "MIT or MIT-0"), ("Apache 2.0", "Apache-2.0"), ("GPLv3", "GPL-3.0"), ("BSD", "BSD")],
)
def test_unknown_licenses_are_rejected(given: str, near: str) -> None:
    message = f"--license: '{given}' is not one of Apache-2.0, .*; did you mean .*{near}"
    with pytest.raises(InputError, match=message):
        make(license=given)


def test_header_that_grants_more_than_the_license_is_noted() -> None:
    (remark,) = make(license="GPL-3.0-only").remarks
    assert remark.startswith("the header that ament_copyright accepts for GPL-3.0-only grants")
    assert make(license="GPL-3.0-or-later").remarks == ()


# -- text for languages


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("plain", "'plain'"),
        ("it's", '"it\'s"'),
        ('say "x"', "'say \"x\"'"),
        ('it\'s "x"', "'it\\'s \"x\"'"),
        ("back\\slash", "'back\\\\slash'"),
        ("a\u00adb", "'a\\xadb'"),
    ],
)
def test_string_literals(text: str, written: str) -> None:
    assert filters.literal(text) == written
    assert ast.literal_eval(written) == text


def test_long_string_literals_break_after_spaces() -> None:
    assert filters.literal("word " * 30, column=16, indent=8) == (
        "(\n        '" + "word " * 17 + "'\n        '" + "word " * 13 + "'\n    )"
    )


def test_import_order_of_ament_flake8() -> None:
    lines = [
        "from std_msgs.msg import String",
        "import rclpy",
        "from rclpy.node import Node  # base",
        "import sys",
        "from pathlib import Path",
        "from Xlib import X",
        "import rclpy",
    ]
    assert filters.import_block(lines).splitlines() == [
        "from pathlib import Path",
        "import sys",
        "",
        "import rclpy",
        "from rclpy.node import Node  # base",
        "from std_msgs.msg import String",
        "from Xlib import X",
    ]


# -- where answers come from


def test_precedence_of_answer_sources(tmp_path: Path) -> None:
    config = tmp_path / "home" / ".config" / "ros2-scaffold" / "config.toml"
    config.parent.mkdir(parents=True)
    config.write_text(
        '[new]\nlicense = "MIT"\nmaintainer-email = "conf@example.com"\nrate = 5\nqos = 3\n'
    )
    (tmp_path / "work" / "answers.yaml").write_text("rate: 7\nqos: 4\ntopic: a/b\n")
    assert main(["new", "talker", "--answers", "answers.yaml", "--qos", "9"]) == 0
    node = (tmp_path / "work/talker/talker/minimal_publisher.py").read_text()
    manifest = (tmp_path / "work/talker/package.xml").read_text()
    assert "'a/b', 9)" in node  # flag
    assert "('rate', 7.0, " in node  # answers file
    assert "<license>MIT</license>" in manifest  # configuration
    assert '<maintainer email="conf@example.com">Ada Lovelace</maintainer>' in manifest  # git
    assert "('rate', 2.0, " in files_of()["talker/minimal_publisher.py"]  # template


def test_git_settings_of_the_destination_are_used(tmp_path: Path) -> None:
    repository = tmp_path / "repository"
    subprocess.run(["git", "init", "-q", repository], check=True)
    subprocess.run(["git", "-C", repository, "config", "user.email", "work@b.org"], check=True)
    given = {"package": Given("talker", "PACKAGE")}
    made = draft.draft(ROOTS, TEMPLATES, given, User(str(repository / "src" / "new")))
    assert 'email="work@b.org">Ada Lovelace<' in made.rendered.files["package.xml"]


def test_login_name_is_used_without_git_settings(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "home" / ".gitconfig").unlink()
    assert main(["new", "talker"]) == 0
    errors = capsys.readouterr().err
    assert errors.startswith("note: the maintainer is ")
    assert errors.count("\n") == 1
    manifest = etree.parse(tmp_path / "work/talker/package.xml").getroot()
    maintainer = manifest.find("maintainer")
    assert maintainer is not None
    assert maintainer.text
    assert answer_types.address(maintainer.get("email"))


def test_new_works_without_git(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    made = draft.draft(
        ROOTS, TEMPLATES, {"package": Given("talker", "PACKAGE")}, User(str(tmp_path))
    )
    assert "the maintainer is" in made.remarks[0]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("rte: 2\n", "answers.yaml: 'rte' is not a question of the templates; did you mean rate?"),
        (
            "zzz: 2\n",
            "answers.yaml: 'zzz' is not a question of the templates; see ",
        ),
        ("- a\n", "answers.yaml: must be a mapping of questions to answers, such as 'rate: 2.0'"),
        ("a: [\n", "answers.yaml:2: invalid YAML: "),
        ("rate: 0\n", "answers.yaml: rate: 0 Hz is not between"),
        ("comments: loud\n", "answers.yaml: comments: 'loud' is not one of brief, tutorial"),
        ("topic: yes\n", "answers.yaml: topic: True is not text"),
    ],
)
def test_invalid_answers_files_are_rejected(
    text: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "work" / "answers.yaml").write_text(text)
    assert_refused(capsys, ["new", "talker", "--answers", "answers.yaml"], message)


def test_missing_answers_file_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    message = "nowhere.yaml: No such file or directory"
    assert_refused(capsys, ["new", "talker", "--answers", "nowhere.yaml"], message)


def test_unknown_configuration_key_is_an_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "work" / "ros2-scaffold.toml").write_text('[new]\nlicence = "MIT"\n')
    message = "[new]: 'licence' is not a question of the templates; did you mean license?"
    assert_refused(capsys, ["new", "talker"], message)


def test_source_date_epoch_sets_the_date(monkeypatch: pytest.MonkeyPatch) -> None:
    first = files_of()
    assert files_of() == first
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "yesterday")
    with pytest.raises(InputError, match="SOURCE_DATE_EPOCH: 'yesterday' is not a number"):
        make()


# -- the command


def test_help_lists_every_flag(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stop:
        main(["new", "--help"])
    assert stop.value.code == 0
    output = capsys.readouterr().out
    for flag in (
        "--build-type {ament_cmake,ament_python}",
        "--description",
        "--license",
        "--maintainer-name",
        "--maintainer-email",
        "--destination-directory",
        "--dependencies",
        "--node-name",
        "--topic",
        "--message-type",
        "--rate",
        "--qos",
        "--comments {brief,tutorial}",
        "--dry-run",
        "--force",
        "--answers",
    ):
        assert flag in output


def test_output_of_new(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    source = tmp_path / "ws" / "src"
    source.mkdir(parents=True)
    assert main(["new", "talker", "--destination-directory", str(source)]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    assert captured.out == dedent(f"""\
        talker/
            .gitattributes                 how git merges the two .ros2-scaffold files
            .ros2-scaffold.bases           the rendered templates, for `ros2-scaffold update`
            .ros2-scaffold.json            answers and hashes, for `ros2-scaffold update`
            CHANGELOG.rst                  what changed in each release
            CMakeLists.txt                 what is installed and tested
            LICENSE                        the full text of the license
            README.md                      how to build, run, inspect and test it
            package.xml                    name, license, dependencies
            talker/
                __init__.py                makes the directory a Python package
                minimal_publisher.py       the node
            test/
                conftest.py                fixtures shared by the tests of all nodes
                test_minimal_publisher.py  starts the node, receives messages, stops it

        Next:
            ros2-scaffold check {source}/talker
            cd {tmp_path}/ws && colcon build --packages-select talker
            source install/setup.bash
            ros2 run talker minimal_publisher.py
        """)
    assert os.access(source / "talker" / "talker" / "minimal_publisher.py", os.X_OK)


def test_output_names_the_launch_command(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["new", "rover", "--destination-directory", str(tmp_path), "--extras", "description"]
    assert main(command) == 0
    assert capsys.readouterr().out.endswith("    ros2 launch rover description.launch.py\n")


def test_diff_writes_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "talker", "--diff"]) == 0
    output = capsys.readouterr().out
    assert "--- /dev/null\n+++ b/talker/.ros2-scaffold.json\n" in output
    assert "+++ b/talker/talker/minimal_publisher.py\n" in output
    assert os.listdir() == []
    assert main(["new", "talker"]) == 0
    (tmp_path / "work" / "talker" / "LICENSE").unlink()
    capsys.readouterr()
    assert main(["new", "talker", "--diff", "--force"]) == 0
    assert capsys.readouterr().out.startswith("diff --git a/talker/LICENSE b/talker/LICENSE\n")


def test_dry_run_writes_nothing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["new", "talker", "--dry-run"]) == 0
    output = capsys.readouterr().out
    assert output.startswith("talker/\n")
    assert output.endswith("\n\nNothing was written (--dry-run).\n")
    assert os.listdir(tmp_path / "work") == []


def test_existing_package_is_not_overwritten(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["new", "talker"]) == 0
    node = tmp_path / "work" / "talker" / "talker" / "minimal_publisher.py"
    node.write_text("mine\n")
    capsys.readouterr()
    message = "talker already exists; --force overwrites the files that differ"
    assert_refused(capsys, ["new", "talker"], message, untouched=False)
    assert node.read_text() == "mine\n"

    assert main(["new", "talker", "--force", "--dry-run"]) == 0
    output = capsys.readouterr().out
    assert "the node, overwritten\n" in output
    assert "\n-mine\n+#!/usr/bin/env python3\n" in output
    assert node.read_text() == "mine\n"

    assert main(["new", "talker", "--force"]) == 0
    assert node.read_text() == files_of()["talker/minimal_publisher.py"]
    assert os.access(node, os.X_OK)
    assert "LICENSE                        the full text of the license, unchanged" in (
        capsys.readouterr().out
    )


def test_invalid_destinations_are_rejected(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    work = tmp_path / "work"
    (work / "file").write_text("")
    (work / "link").mkdir()
    (work / "link" / "talker").symlink_to(tmp_path / "home")
    (work / "outer" / "deep").mkdir(parents=True)
    (work / "outer" / "package.xml").write_text("<package><name>outer</name></package>\n")
    (work / "ws" / "src" / "group" / "folder").mkdir(parents=True)
    other = work / "ws" / "src" / "group" / "folder" / "package.xml"
    other.write_text("<package><name>talker</name></package>\n")
    (work / "ws" / "src" / "mine").mkdir()
    for place, message in (
        ("file", "/file is not a directory"),
        ("file/below", "/file is not a directory"),
        ("link", "link/talker is a link to "),
        (
            "outer/deep",
            "/outer is a package, and colcon does not search for packages inside of packages",
        ),
        ("ws/src/mine", "/folder is already a package named 'talker'"),
        ("ws", "/folder is already a package named 'talker'"),
    ):
        before = sorted(work.rglob("*"))
        command = ["new", "talker", "--destination-directory", place]
        assert_refused(capsys, command, message, untouched=False)
        assert sorted(work.rglob("*")) == before
    message = "/proc/talker cannot be written: No such file or directory; nothing was written"
    assert_refused(capsys, ["new", "talker", "--destination-directory", "/proc"], message)
    assert main(["new", "talker", "--destination-directory", "new/ws/src"]) == 0
    assert (work / "new/ws/src/talker/package.xml").is_file()


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (["--rate", "0"], "--rate: 0 Hz is not between 0.001 and 10000 Hz"),
        (["--build-type", "ament_pyhton"], "did you mean ament_python?"),
        (["--comments", "loud"], "--comments: 'loud' is not one of brief, tutorial"),
        (["--message-type", "std_msgs/Sting"], "--message-type: unknown message type"),
    ],
)
def test_invalid_flags_are_rejected(
    flags: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert_refused(capsys, ["new", "talker", *flags], message)


def assert_refused(
    capsys: pytest.CaptureFixture[str], command: list[str], message: str, *, untouched: bool = True
) -> None:
    """Fail unless a command ends with 2 and one error line, and writes nothing."""
    before = os.listdir()
    assert main(command) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("ros2-scaffold: error: ")
    assert message in captured.err
    assert captured.err.count("\n") == 1
    assert not untouched or os.listdir() == before


# -- templates of a team


@pytest.fixture
def team(tmp_path: Path) -> Path:
    """A content directory with an additional kind of node."""
    kind = tmp_path / "team" / "templates" / "nodes" / "blinker"
    (kind / "{{ package }}").mkdir(parents=True)
    (kind / "template.yaml").write_text(
        "summary: blinks\n"
        "questions:\n"
        "  node_name: {type: node, default: blinker, help: its name}\n"
        "  lamp: {default: red, help: which lamp}\n"
        'include: {"extra/*": "node.lamp == \'blue\'"}\n'
        'executable: ["{{ package }}/*.py"]\n'
    )
    (kind / "{{ package }}" / "{{ node.module }}.py.jinja").write_text(
        "#: for learners\nLAMP = {{ node.lamp | literal }}\n"
    )
    (kind / "test").mkdir()
    (kind / "test" / "test_{{ node.module }}.py.jinja").write_text(
        "{{ header }}\n\n\ndef test_lamp():\n    assert True\n"
    )
    (kind / "extra").mkdir()
    (kind / "extra" / "x.jinja").write_text("")
    (kind / "_readme.md.jinja").write_text(
        "{% macro run(node) %}run\n{% endmacro %}{% macro look(node) %}{% endmacro %}"
        "{% macro topics(node) %}{% endmacro %}{% macro parameters(node) %}{% endmacro %}"
    )
    return tmp_path / "team" / "templates"


def test_user_template_is_rendered(team: Path) -> None:
    roots = [*ROOTS, str(team)]
    templates = loading.load(roots)
    asked = {"package": "talker", "node_kind": "blinker", "lamp": "it's blue"}
    given = {name: Given(value, f"--{name}") for name, value in asked.items()}
    files = draft.draft(roots, templates, given, User(".")).rendered.files
    assert files["talker/blinker.py"] == 'LAMP = "it\'s blue"\n'
    assert "extra/x" not in files
    given["lamp"] = Given("blue", "--lamp")
    given["comments"] = Given("tutorial", "--comments")
    files = draft.draft(roots, templates, given, User(".")).rendered.files
    assert files["talker/blinker.py"] == "# for learners\nLAMP = 'blue'\n"
    assert files["extra/x"] == ""
    given["rate"] = Given("2", "--rate")
    with pytest.raises(InputError, match="--rate: does not apply to ament_cmake and blinker"):
        draft.draft(roots, templates, given, User("."))


def test_content_flag_adds_user_templates(team: Path, tmp_path: Path) -> None:
    (tmp_path / "work" / "answers.yaml").write_text("node_kind: blinker\nlamp: green\n")
    (team / "nodes" / "blinker" / "{{ package }}" / "{{ node.module }}.py.jinja").write_text(
        "#!/usr/bin/env python3\n{{ header }}\n\nLAMP = {{ node.lamp | literal }}\n"
    )
    (team / "_licenses" / "Ours-1.0").mkdir(parents=True)
    (team / "_licenses" / "Ours-1.0" / "header.jinja").write_text("Copyright {{ year }} us\n")
    (team / "_licenses" / "Ours-1.0" / "LICENSE.jinja").write_text("All rights are ours.\n")
    command = ["new", "talker", "--content", str(team.parent), "--answers", "answers.yaml"]
    assert main([*command, "--license", "MIT"]) == 0
    assert "LAMP = 'green'" in (tmp_path / "work/talker/talker/blinker.py").read_text()
    roots = [*ROOTS, str(team)]
    given = {"package": Given("p2", ""), "license": Given("Ours-1.0", "")}
    files = draft.draft(roots, loading.load(roots), given, User(".")).rendered.files
    assert files["LICENSE"] == "All rights are ours.\n"
    assert "\n# Copyright 2025 us\n" in files["p2/minimal_publisher.py"]


@pytest.mark.parametrize(
    ("path", "text", "message"),
    [
        ("{{ package }}/a.py.jinja", "{{ nobody }}", "'nobody' is undefined"),
        ("a.jinja", "{% if %}", "a.jinja:1: Expected an expression"),
        ("a.jinja", "{{ ''.__class__.__mro__ }}", "SecurityError"),
        ("a.jinja", "{% include '../../x' %}", "a.jinja:1: no template has the file '../../x'"),
        (
            "{{ package | upper }}.jinja",
            "",
            "a path holds only {{ names }} that are defined",
        ),
        ("{{ nobody }}.jinja", "", "a path holds only {{ names }} that are defined"),
        ("README.md.jinja", "", "README.md is rendered twice"),
        ("setup.py", "", "setup.py: must end in .jinja"),
    ],
)
def test_template_errors_are_reported(team: Path, path: str, text: str, message: str) -> None:
    file = team / "nodes" / "blinker" / path
    file.parent.mkdir(exist_ok=True)
    file.write_text(text)
    roots = [*ROOTS, str(team)]
    given = {
        "package": Given("talker", "PACKAGE"),
        "node_kind": Given("blinker", "--node-kind"),
    }
    with pytest.raises(ContentError) as raised:
        draft.draft(roots, loading.load(roots), given, User("."))
    assert message in str(raised.value)
    assert "\n" not in str(raised.value)


def test_invalid_dependencies_of_a_template_are_rejected(team: Path) -> None:
    extra = team / "extras" / "listing"
    extra.mkdir(parents=True)
    extra.joinpath("template.yaml").write_text(
        "summary: x\ndepends: { exec: ['{{ extras }}', \"{{ extras | join(' ') }} std-msgs\"] }\n"
    )
    roots = [*ROOTS, str(team)]
    given = {"package": Given("talker", "PACKAGE"), "extras": Given("listing", "--extras")}
    with pytest.raises(ContentError) as raised:
        draft.draft(roots, loading.load(roots), given, User("."))
    assert str(raised.value) == (
        f"{extra / 'template.yaml'}: depends: exec: '{{{{ extras }}}}' is \"('listing',)\", "
        "not names separated by spaces; a list needs join(' ')"
    )


@pytest.mark.parametrize(
    ("manifest", "message"),
    [
        ("[", "template.yaml:2: invalid YAML"),
        ("- a", "must be a mapping with the keys summary, questions"),
        ("groups: []", "the key 'summary' is missing"),
        ("summary: x\nrole: node", "unknown key 'role'"),
        ("summary: x\nfiles: []", "unknown key 'files'"),
        ("summary: x\ninclude: []", "include must be a mapping"),
        (
            "summary: x\ndepends: {run: [a]}",
            "depends must map buildtool, build, build_export, depend, exec, test",
        ),
        ("summary: x\nquestions: {a: 1}", "the question 'a' must be a mapping"),
        (
            "summary: x\nquestions: {a: {help: x, typ: text}}",
            "a has an unknown key 'typ'",
        ),
        (
            "summary: x\nquestions: {a: {help: x, type: txt}}",
            "a has the unknown type 'txt'",
        ),
        (
            (
                "summary: x\nquestions: {node_name: {help: x, type: node}, "
                "a: {help: x, choices: none}}"
            ),
            "a must have a list of choices, or a role",
        ),
        (
            (
                "summary: x\nquestions: {node_name: {help: x, type: node}, "
                "topic: {help: x, type: rate}}"
            ),
            "topic has the type topic, but rate in",
        ),
    ],
)
def test_invalid_template_yaml_is_rejected(team: Path, manifest: str, message: str) -> None:
    (team / "nodes" / "blinker" / "template.yaml").write_text(manifest)
    with pytest.raises(ContentError) as raised:
        loading.load([*ROOTS, str(team)])
    assert message in str(raised.value)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    ("place", "message"),
    [
        ("lamp", "lamp: a template must be in build_types, nodes, interfaces"),
        ("node/lamp", "node/lamp: a template must be in build_types, nodes, interfaces"),
        ("extras/blinker", "nodes/blinker: {team}/extras/blinker has the same name"),
    ],
)
def test_templates_outside_of_a_role_directory_are_rejected(
    team: Path, place: str, message: str
) -> None:
    (team / place).mkdir(parents=True)
    (team / place / "template.yaml").write_text("summary: x\n")
    with pytest.raises(ContentError) as raised:
        loading.load([*ROOTS, str(team)])
    assert message.format(team=team) in str(raised.value)


def test_findings_in_a_rendered_file_name_the_template(
    team: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "work" / "ros2-scaffold.toml").write_text(f'content = ["{team.parent}"]\n')
    trust.add(str(tmp_path / "work"))
    module = team / "nodes" / "blinker" / "{{ package }}" / "{{ node.module }}.py.jinja"
    module.write_text("import os\n")
    assert main(["new", "talker", "--node-kind", "blinker"]) == 2
    *lines, last = capsys.readouterr().err.splitlines()
    finding = "ros2-scaffold: error: talker/blinker.py:1:1: F401 'os' imported but unused"
    assert f"{finding} (rendered from {module})" in lines
    assert last == "note: nothing was written: the templates are at fault"
    assert os.listdir(tmp_path / "work") == ["ros2-scaffold.toml"]


def test_documentation_lists_variables_filters_and_keys() -> None:
    page = (Path(__file__).parents[2] / "docs" / "templates.md").read_text()
    context = set(package_variables())
    for word in {
        *loading._KEYS,  # noqa: SLF001  the page must not forget one
        *loading._QUESTION_KEYS,  # noqa: SLF001
        *answer_types.TYPES,
        *payload.Payload._fields,
        *qos("1")._fields,
        *context,
    }:
        assert f"`{word}`" in page or f"`{word}." in page, word


def package_variables() -> list[str]:
    """Return the names that a template may use."""
    from scaffold.generate import context, parts
    from scaffold.generate.questions import questions
    from scaffold.generate.templates.render import Renderer

    given = {"package": Given("talker", "PACKAGE")}
    order = draft.choose(TEMPLATES, given)
    renderer = Renderer(ROOTS, TEMPLATES, is_tutorial=False)

    def answers(asked: list[template.Question]) -> dict[str, object]:
        return questions.resolve(
            asked,
            given,
            context={"contents": "a node"},
            render=renderer.text,
            fallback=User(".").answer,
        ).values

    publisher = TEMPLATES["publisher"]
    part = parts.Part(publisher, answers(list(publisher.questions)))
    of_publisher = {question.name for question in TEMPLATES["publisher"].questions}
    frame = answers(questions.unique(order.frame))
    made = context.package_context(frame, order.layers, [part], renderer, context.today())
    node = made["nodes"][0]
    return [*(set(made) - of_publisher), *(set(node) - of_publisher)]


# -- several parts


def test_several_nodes_in_one_package() -> None:
    made = make(package="conversation", add=["publisher:talker", "publisher:announcer"], rate=5)
    files = made.rendered.files
    assert checking.defects(made, rules()) == []
    assert made.executables == ("talker.py", "announcer.py")
    assert {"conversation/talker.py", "conversation/announcer.py"} < set(files)
    assert {"test/test_talker.py", "test/test_announcer.py"} < set(files)
    for name in ("talker", "announcer"):
        assert f"    ${{PROJECT_NAME}}/{name}.py\n" in files["CMakeLists.txt"]
        assert f"test_{name} test/test_{name}.py" in files["CMakeLists.txt"]
        assert f"ros2 run conversation {name}.py\n" in files["README.md"]
        assert "declare_parameter('rate', 5.0, " in files[f"conversation/{name}.py"]
    description = "with the publisher node talker and the publisher node announcer</description>"
    assert description in files["package.xml"]


def test_answers_for_one_node_of_several() -> None:
    made = make(
        package="conversation",
        topic="chatter",
        add=[{"kind": "publisher", "name": "fast", "rate": 50}, "publisher:slow"],
    )
    assert "('rate', 50.0, " in made.rendered.files["conversation/fast.py"]
    assert "('rate', 2.0, " in made.rendered.files["conversation/slow.py"]
    assert "'chatter', " in made.rendered.files["conversation/fast.py"]
    assert "'chatter', " in made.rendered.files["conversation/slow.py"]


def test_recorded_answers_give_the_same_package() -> None:
    made = make(package="conversation", add=["publisher:talker", "publisher:announcer"], rate=5)
    assert make(**made.answers).rendered == made.rendered


@pytest.mark.parametrize(
    ("add", "message"),
    [
        ("publsher:talker", "'publsher' is not one of "),
        ("publsher:talker", "did you mean publisher?"),
        ("publisher:", "'publisher:' is not KIND:NAME, such as publisher:talker"),
        ("publisher:Talker", "'Talker' must be lower-case words"),
        ("publisher:conversation", "is the name of the package"),
    ],
)
def test_invalid_parts_are_rejected(
    capsys: pytest.CaptureFixture[str], add: str, message: str
) -> None:
    assert_refused(capsys, ["new", "conversation", "--add", add], message)


def test_duplicate_node_names_are_rejected(capsys: pytest.CaptureFixture[str]) -> None:
    command = ["new", "conversation", "--add", "publisher:talker", "--add", "publisher:talker"]
    assert_refused(capsys, command, "the package has two parts named 'talker'")
    command = ["new", "conversation", "--add", "publisher:talker", "--node-name", "announcer"]
    assert_refused(capsys, command, "--node-name: cannot be combined with --add")


def test_parts_in_an_answers_file(capsys: pytest.CaptureFixture[str]) -> None:
    Path("answers.yaml").write_text(
        "add:\n- {kind: publisher, name: talker, rate: 7}\n- publisher:announcer\n"
    )
    assert main(["new", "conversation", "--answers", "answers.yaml"]) == 0
    assert "('rate', 7.0, " in Path("conversation/conversation/talker.py").read_text()
    capsys.readouterr()
    Path("answers.yaml").write_text("add: [{kind: publisher, colour: red}]\n")
    command = ["new", "another", "--answers", "answers.yaml"]
    assert_refused(capsys, command, "publisher has no option 'colour'; it has message_type")


@pytest.mark.parametrize(
    "words",
    [
        ("--node-kind", "tf2_static_broadcaster", "--child-frame", "base_link"),
        ("--node-kind", "tf2_listener", "--target-frame", "base_link"),
        ("--add", "tf2_listener:finder source_frame=map target_frame=map"),
    ],
)
def test_transform_from_a_frame_to_itself_is_rejected(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], words: tuple[str, ...]
) -> None:
    assert main(["new", "rover", "--destination-directory", str(tmp_path), *words]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert "no transform from a frame to itself" in line
    assert not (tmp_path / "rover").exists()
