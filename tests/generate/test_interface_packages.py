"""Interface packages: generated ones build, and Python can import them."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import sysconfig
from importlib.util import find_spec
from pathlib import Path

import pytest

from scaffold.check.rules import registry
from scaffold.configuration import content
from scaffold.errors import InputError
from scaffold.generate import checking, draft
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.fields import fields
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import loading
from scaffold.smoke import environment
from scaffold.writing.plan import WritePlan

ROOTS = content.roots("templates")
TEMPLATES = loading.load(ROOTS)


def make(**answers: object) -> draft.Draft:
    """Return a package in memory that passes every rule."""
    given = {"maintainer_name": "Ada", "maintainer_email": "ada@example.com", **answers}
    asked = {name: Given(value, f"--{name}") for name, value in given.items()}
    made = draft.draft(ROOTS, TEMPLATES, asked, User("."))
    assert checking.defects(made, registry.load(content.roots("rules"))) == []
    return made


def test_fields_give_definition_and_dependencies() -> None:
    files = make(
        package="robot_interfaces",
        add=[
            {"kind": "message", "name": "Leg", "fields": ["geometry_msgs/Pose end", "string name"]},
            {"kind": "message", "name": "Route", "fields": "Leg[<=8] legs\nuint8 MOST=8"},
            {"kind": "service", "name": "Plan", "request": [], "response": "Route route"},
        ],
    ).rendered.files
    assert files["msg/Leg.msg"] == "geometry_msgs/Pose end\nstring name\n"
    assert files["msg/Route.msg"] == "Leg[<=8] legs\nuint8 MOST=8\n"
    assert files["srv/Plan.srv"] == "---\nRoute route\n"
    assert "  DEPENDENCIES geometry_msgs\n" in files["CMakeLists.txt"]
    assert "  <depend>geometry_msgs</depend>\n" in files["package.xml"]
    assert "<member_of_group>rosidl_interface_packages</member_of_group>" in files["package.xml"]
    assert not [path for path in files if path.endswith(".py")]


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("float64", "'float64': "),
        ("float distance", "'float distance': "),
        ("float64 Distance", "'float64 Distance': "),
        ("std_msgs/Heder header", "there is no interface 'std_msgs/msg/Heder'; did you mean std"),
        ("int32 a, int32 b", "quote each field separately"),
        ("int32 a; int32 b", "quote each field separately"),
        (7, "7 is not a field such as 'float64 distance'"),
    ],
)
def test_invalid_fields_are_rejected(line: object, message: str) -> None:
    with pytest.raises(InputError, match=re.escape(message)):
        fields(["string name", line])


def test_types_of_unknown_packages_are_accepted() -> None:
    assert fields("wheel_msgs/Speeds speeds").packages == ("wheel_msgs",)


def test_unknown_type_of_known_package_is_rejected() -> None:
    given = {"kind": "message", "name": "Scan", "fields": "Header header"}
    with pytest.raises(InputError, match=r"has no message 'Header'.*std_msgs/msg/Header"):
        make(package="scan_interfaces", add=[given])


def test_recursive_message_is_rejected() -> None:
    tree = {"kind": "message", "name": "Tree", "fields": "Tree[] branches"}
    with pytest.raises(InputError, match=r"the message 'Tree' would contain itself$"):
        make(package="plants", add=[tree])
    leaf = {"kind": "message", "name": "Leaf", "fields": "Tree tree"}
    tree["fields"] = "Leaf[] leaves"
    with pytest.raises(InputError, match=r"would contain itself, inside another one$"):
        make(package="plants", add=[tree, leaf])


def test_interfaces_and_python_nodes_in_one_package_are_rejected() -> None:
    with pytest.raises(InputError, match="one of their own, such as talker_interfaces"):
        make(package="talker", add=["message:Status", "publisher:speaker"])


@pytest.fixture(scope="module")
def wheels() -> environment.Environment:
    """Return ROS 2 with exported targets that name this machine's Python.

    Those of the wheels name the directories of the machine that built them. CMake refuses
    directories that are not there, and reads them only for packages with interfaces.
    """
    ros = environment.select(os.environ)
    include = sysconfig.get_paths()["include"]
    for path in Path(sys.prefix, "share").glob("*/cmake/*.cmake"):
        text = path.read_text()
        mended = re.sub(r"/opt/python/cp\d+-cp\d+/include/python3\.\d+", include, text)
        mended = re.sub(r"/opt/python/[^;\"]*/numpy/_core/include", include, mended)
        if mended != text:
            path.write_text(mended)
    return ros


@pytest.mark.build
@pytest.mark.skipif(find_spec("rosidl_generator_py") is None, reason="no generators of interfaces")
@pytest.mark.skipif(shutil.which("c++") is None, reason="no C++ compiler")
def test_interfaces_build_and_python_imports_them(
    wheels: environment.Environment, tmp_path: Path
) -> None:
    made = make(package="robot_interfaces", add=["message", "service", "action"])
    WritePlan.of(tmp_path / "src" / made.name, made.rendered.files).write()
    done = subprocess.run(
        [wheels.colcon, "build", "--cmake-args", "-DBUILD_TESTING=OFF"],
        cwd=tmp_path,
        env=dict(wheels.variables),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    use = (
        "from robot_interfaces.action import Drive\n"
        "from robot_interfaces.msg import Status\n"
        "from robot_interfaces.srv import SetMode\n"
        "from rclpy.serialization import deserialize_message, serialize_message\n"
        "sent = Status(value=1.5)\n"
        "print(deserialize_message(serialize_message(sent), Status).value)\n"
        "print(SetMode.Request(mode='fast').mode, Drive.Feedback(remaining=2.0).remaining)\n"
    )
    command = f'source "{tmp_path}/install/setup.bash" && exec "$0" -c "$1"'
    variables = {key: value for key, value in os.environ.items() if "BOOTSTRAP" not in key}
    done = subprocess.run(
        ["bash", "-c", command, sys.executable, use],
        env=variables,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout == "1.5\nfast 2.0\n", done.stderr
