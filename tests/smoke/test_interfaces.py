"""Interface packages missing from the ROS wheels: generated from the bundle, built, cached."""

from __future__ import annotations

import asyncio
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from scaffold.model.package import Package
from scaffold.smoke.embedded import interfaces
from scaffold.smoke.embedded.sources import Bundle
from scaffold.smoke.environment import Environment
from scaffold.smoke.processes.process import Origin
from tests.smoke.smoke_packages import python_package, talker
from tests.smoke.smoke_runs import NEEDS_ROS, ROOT, command_line, variables

INCLUDES = ROOT / "scaffold" / "smoke" / "embedded" / "includes.cmake"
HAS_GENERATORS = os.path.exists(os.path.join(sys.prefix, "share", "rosidl_generator_py"))
COMMON = (
    "action_msgs",
    "builtin_interfaces",
    "geometry_msgs",
    "std_msgs",
    "unique_identifier_msgs",
)


def test_dependency_closure_of_missing_packages() -> None:
    bundle = Bundle()
    assert bundle.closure(["ackermann_msgs", "rclpy"], ["std_msgs"]) == ["ackermann_msgs"]
    assert bundle.closure(["ackermann_msgs"], ["ackermann_msgs"]) == []
    needed = bundle.closure(["nav2_msgs"], COMMON)
    assert {"nav2_msgs", "nav_msgs"} <= set(needed)
    assert set(COMMON).isdisjoint(needed)


def test_generated_sources_of_an_interface_package(tmp_path: Path) -> None:
    Bundle().write("example_interfaces", tmp_path / "example_interfaces", complete=True)
    package = Package.at(str(tmp_path / "example_interfaces"))
    assert package.name == "example_interfaces"
    assert package.manifest.declared_names >= {"action_msgs", "rosidl_default_generators"}
    text = (tmp_path / "example_interfaces" / "CMakeLists.txt").read_text()
    assert '  "srv/AddTwoInts.srv"\n' in text
    assert package.source("srv/AddTwoInts.srv").text.startswith("int64 a\nint64 b\n---\nint64 sum")


def package_depending_on(*names: str) -> Package:
    depends = "".join(f"<depend>{name}</depend>" for name in names)
    return Package.of({"package.xml": f"<package><name>demo</name>{depends}</package>"})


def provided(
    environment: Environment, package: Package, scratch: Path, *more: Package
) -> tuple[Environment, list[str]]:
    announced: list[str] = []
    result = asyncio.run(
        interfaces.provide(
            environment,
            [package, *more],
            scratch,
            origin=Origin("test"),
            timeout=1.0,
            tell=pytest.fail,
            announce=announced.append,
        )
    )
    return result, announced


def wheels(prefix: Path, kind: str = "wheels") -> Environment:
    names = {"PATH": os.defpath, "AMENT_PREFIX_PATH": str(prefix)}
    return Environment(kind, str(prefix), "rmw", "/nowhere/python3", "/nowhere/colcon", names)


def test_interfaces_are_only_built_for_wheels(tmp_path: Path) -> None:
    environment = wheels(tmp_path, "sourced")
    assert provided(environment, package_depending_on("nav2_msgs"), tmp_path) == (environment, [])


def test_nothing_is_built_without_missing_interfaces(tmp_path: Path) -> None:
    index = tmp_path / "share/ament_index/resource_index/packages"
    index.mkdir(parents=True)
    (index / "std_msgs").touch()
    environment = wheels(tmp_path)
    assert provided(environment, package_depending_on("std_msgs", "rclpy"), tmp_path) == (
        environment,
        [],
    )


def test_missing_generators_are_reported_with_a_fix(tmp_path: Path) -> None:
    (tmp_path / "share/ament_index/resource_index/packages").mkdir(parents=True)
    for name in (*COMMON, "service_msgs"):
        (tmp_path / "share/ament_index/resource_index/packages" / name).touch()
    _, (line,) = provided(wheels(tmp_path), package_depending_on("ackermann_msgs"), tmp_path)
    assert line.startswith(
        "ackermann_msgs: not among the ROS wheels, and not built: the interface generators are "
        "missing; run: "
    )


def test_cached_build_is_reused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    index = tmp_path / "share/ament_index/resource_index/packages"
    index.mkdir(parents=True)
    for name in COMMON:
        (index / name).touch()
    place = interfaces._place(wheels(tmp_path), Bundle(), complete=False)  # noqa: SLF001
    assert place is not None
    modules = place / "ackermann_msgs/lib/python3.12/site-packages"
    modules.mkdir(parents=True)
    result, announced = provided(wheels(tmp_path), package_depending_on("ackermann_msgs"), tmp_path)
    assert announced == []
    assert result.variables["AMENT_PREFIX_PATH"] == f"{place}/ackermann_msgs:{tmp_path}"
    assert result.variables["LD_LIBRARY_PATH"] == f"{place}/ackermann_msgs/lib"
    assert result.variables["PYTHONPATH"] == str(modules)


def test_cpp_is_only_generated_for_dependencies_of_interfaces(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    index = tmp_path / "share/ament_index/resource_index/packages"
    index.mkdir(parents=True)
    for name in (*COMMON, "service_msgs"):
        (index / name).touch()
    for name, complete in (("ackermann_msgs", True), ("std_srvs", False)):
        place = interfaces._place(wheels(tmp_path), Bundle(), complete=complete)  # noqa: SLF001
        assert place is not None
        (place / name).mkdir(parents=True)
    manifest = "<package><name>made</name><depend>ackermann_msgs</depend></package>"
    made = Package.of({"package.xml": manifest, "msg/Made.msg": "bool it\n"})
    result, announced = provided(wheels(tmp_path), package_depending_on("std_srvs"), tmp_path, made)
    assert announced == []
    actual = result.variables["AMENT_PREFIX_PATH"].split(os.pathsep)
    assert [os.path.basename(prefix) for prefix in actual[:2]] == ["std_srvs", "ackermann_msgs"]


# -- CMake

PROJECT = """\
cmake_minimum_required(VERSION 3.21)
project(demo C)
add_library(imported INTERFACE IMPORTED)
set_property(
  TARGET imported PROPERTY INTERFACE_INCLUDE_DIRECTORIES "/opt/python/none/include;/usr/include")
file(WRITE ${CMAKE_BINARY_DIR}/demo.c "int demo;")
add_library(demo STATIC ${CMAKE_BINARY_DIR}/demo.c)
target_link_libraries(demo imported)
"""


@pytest.mark.skipif(not (shutil.which("cmake") and shutil.which("cc")), reason="no C compiler")
@pytest.mark.parametrize("is_included", [False, True])
def test_include_directories_of_another_machine_are_tolerated(
    tmp_path: Path, *, is_included: bool
) -> None:
    (tmp_path / "CMakeLists.txt").write_text(PROJECT)
    words = [f"-DCMAKE_PROJECT_INCLUDE={INCLUDES}"] if is_included else []
    done = subprocess.run(
        ["cmake", *words, "-S", tmp_path, "-B", tmp_path / "build"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode == 0) == is_included
    assert ("non-existent path" in done.stderr) != is_included


# -- a node


@pytest.mark.build
@NEEDS_ROS
@pytest.mark.skipif(not HAS_GENERATORS, reason="no generators of interfaces")
@pytest.mark.skipif(shutil.which("c++") is None, reason="no C++ compiler")
@pytest.mark.skipif(os.path.exists("/opt/ros"), reason="there is a ROS 2 installation")
def test_node_with_messages_missing_from_the_wheels(tmp_path: Path) -> None:
    source = (
        talker("/drive")
        .replace("from std_msgs.msg import String", "from ackermann_msgs.msg import AckermannDrive")
        .replace("String(data=f'number {self.count}')", "AckermannDrive(speed=1.5)")
        .replace("String,", "AckermannDrive,")
    )
    package = python_package(tmp_path / "src", "driver", {"driver": source})
    manifest = package / "package.xml"
    manifest.write_text(manifest.read_text().replace("std_msgs", "ackermann_msgs"))
    cache = tmp_path / "cache"
    built: list[float] = []
    for announced in ("ros2-scaffold: building ackermann_msgs, ", ""):
        done = subprocess.run(
            command_line(package, "--duration", "1", "--format", "json"),
            env=variables(tmp_path, XDG_CACHE_HOME=str(cache)),
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stderr
        assert done.stderr.startswith(announced)
        assert done.stderr.count("\n") == bool(announced)
        (driver,) = json.loads(done.stdout)["packages"][0]["executables"]
        (topic,) = driver["topics"]
        assert topic["type"] == "ackermann_msgs/msg/AckermannDrive"
        assert topic["messages"][0]["speed"] == 1.5
        (kept,) = cache.glob("ros2-scaffold/interfaces/*/ackermann_msgs")
        built.append(kept.stat().st_mtime)
    assert built[0] == built[1]
