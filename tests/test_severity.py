"""Whether a diagnostic is an error depends on what breaks; examples of rules cannot say it."""

from __future__ import annotations

import pytest

from scaffold import content
from scaffold.check import registry, runner
from scaffold.check.diagnostic import Severity
from scaffold.model.package import Package

RULES = {rule.code: rule() for rule in registry.load(content.roots("rules"))}
ERROR, WARNING = Severity.ERROR, Severity.WARNING
_NAMED = '<package format="3">\n  <name>{}</name>\n{}</package>\n'
_TWICE = "  <{0}>std_msgs</{0}>\n  <{0}>std_msgs</{0}>\n"
_CMAKE = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}ament_package()\n"
_GENERATED = _CMAKE.format("rosidl_generate_interfaces(${PROJECT_NAME} msg/Beat.msg)\n")
_BEATS = {"CMakeLists.txt": _GENERATED, "msg/Beat.msg": "int32 a\n", "msg/Old.msg": "int32 a\n"}
_BUILD = (
    "  <buildtool_depend>rosidl_default_generators</buildtool_depend>\n"
    "  <member_of_group>rosidl_interface_packages</member_of_group>\n"
)
_STD = "  <depend>std_msgs</depend>\n"
_FORGOTTEN = {"CMakeLists.txt": _CMAKE.format(""), "config/talker.yaml": ""}
_PYTHON = "  <export><build_type>ament_python</build_type></export>\n"
_UNLISTED = {
    "package.xml": _NAMED.format("talker", _PYTHON),
    "setup.py": "from setuptools import setup\n\nsetup(name='talker', data_files=[])\n",
    "config/talker.yaml": "",
}


@pytest.mark.parametrize(
    ("code", "files", "severity"),
    [
        ("PX025", {"package.xml": _NAMED.format("a", _TWICE.format("depend"))}, ERROR),
        ("PX025", {"package.xml": _NAMED.format("a", _TWICE.format("exec_depend"))}, WARNING),
        ("PX067", {"package.xml": _NAMED.format("Talker", "")}, ERROR),
        ("PX067", {"package.xml": _NAMED.format("the-talker", "")}, WARNING),
        ("PX067", {"package.xml": _NAMED.format("the-msgs", ""), "msg/Beat.msg": ""}, ERROR),
        ("CM060", {**_BEATS, "talker.py": "from talker.msg import Old\n"}, ERROR),
        ("PX040", {**_BEATS, "package.xml": _NAMED.format("talker", _BUILD)}, ERROR),
        ("PX040", {**_BEATS, "package.xml": _NAMED.format("talker", _BUILD + _STD)}, WARNING),
        ("CM060", {**_BEATS, "talker.py": "from other.msg import Old\n"}, WARNING),
        ("CM060", _BEATS, WARNING),
        ("CM018", {**_FORGOTTEN, "launch.py": "path = 'talker.yaml'\n"}, ERROR),
        ("CM018", _FORGOTTEN, WARNING),
        ("SP010", {**_UNLISTED, "launch.py": "path = 'talker.yaml'\n"}, ERROR),
        ("SP010", _UNLISTED, WARNING),
    ],
)
def test_an_error_is_what_breaks(code: str, files: dict[str, str], severity: Severity) -> None:
    package = Package.of({"package.xml": _NAMED.format("talker", ""), **files})
    found = runner.check(package, [RULES[code]])
    assert [one.severity for one in found] == [severity]
