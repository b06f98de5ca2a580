"""Dependencies of released packages, and how they are read from recipes."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold.distributions import named, targeting
from scaffold.model.released import (
    dependencies,
    has_rosdep_rule,
    is_released,
    is_rosdep_key,
    transitive_dependencies,
)
from scripts import bundle_dependencies, bundle_rosdep

RECIPE = """ROS_CN = "talker"
ROS_BPN = "{name}"
ROS_BUILD_DEPENDS = " \\
    rclcpp \\
"
ROS_EXPORT_DEPENDS = ""
ROS_BUILDTOOL_EXPORT_DEPENDS = " \\
    rosidl-default-generators-native \\
"
ROS_EXEC_DEPENDS = " \\
    {depends} \\
"
"""


def test_metapackage_brings_transitive_dependencies() -> None:
    assert {"joint_state_broadcaster", "controller_interface"} <= transitive_dependencies(
        {"ros2_controllers"}
    )


@pytest.mark.parametrize(("distribution", "is_brought"), [("humble", False), ("jazzy", True)])
def test_a_distribution_has_its_own_dependencies(distribution: str, is_brought: bool) -> None:
    with targeting(named(distribution)):
        assert ("service_msgs" in transitive_dependencies({"rclpy"})) is is_brought


def test_unreleased_package_brings_nothing() -> None:
    assert not is_released("my_talker")
    assert list(dependencies("my_talker")) == []


def test_recipes_give_rosdep_keys_by_distribution(tmp_path: Path) -> None:
    (tmp_path / "rosdep").mkdir()
    (tmp_path / "rosdep" / "python.yaml").write_text(
        "python3-yaml:\n  openembedded: [python3-pyyaml@openembedded-core]\n"
        "python-yaml:\n  openembedded: [python-pyyaml@meta-python]\n"
    )
    keys = bundle_dependencies.python_keys(tmp_path)
    texts = {
        "humble": {"talker_py": "python3-pyyaml"},
        "jazzy": {"talker_py": "talker-msgs", "talker_msgs": "", "rosidl_default_generators": ""},
    }
    every = {}
    for distribution, packages in texts.items():
        for name, depends in packages.items():
            path = tmp_path / distribution / "talker" / f"{name}_1.0.bb"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(RECIPE.format(name=name, depends=depends))
        every[distribution] = bundle_dependencies.released(tmp_path / distribution, keys)
    assert list(bundle_dependencies.lines(every)) == [
        "rosidl_default_generators:\n",
        "talker_msgs: rosidl_default_generators\n",
        "talker_py: python3-yaml\n",
        "talker_py jazzy: rosidl_default_generators talker_msgs\n",
    ]


@pytest.mark.parametrize(("distribution", "has_rule"), [("humble", True), ("rolling", False)])
def test_a_library_may_lack_a_rule_for_newer_systems(distribution: str, has_rule: bool) -> None:
    assert is_rosdep_key("ignition-gazebo6")
    assert not is_rosdep_key("my_talker")
    with targeting(named(distribution)):
        assert has_rosdep_rule("ignition-gazebo6") is has_rule


def test_names_that_rosdep_resolves(tmp_path: Path) -> None:
    (tmp_path / "rosdep").mkdir()
    (tmp_path / "rosdep" / "base.yaml").write_text(
        "eigen:\n  ubuntu: [libeigen3-dev]\n"
        "gazebo:\n  ubuntu:\n    jammy: [gazebo]\n"
        "omniorb:\n  fedora: [omniORB]\n"
        "protobuf:\n  ubuntu:\n    '*': [libprotobuf32]\n    jammy: null\n"
    )
    (tmp_path / "rosdep" / "python.yaml").write_text(
        "python3-tree-pip:\n  ubuntu:\n    pip: {packages: [tree]}\n"
    )
    (tmp_path / "rosdep" / "ruby.yaml").write_text("ruby: {ubuntu: [ruby]}\n")
    for name in ("humble", "jazzy", "kilted", "lyrical"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "distribution.yaml").write_text(
            "repositories:\n"
            "  talk: {release: {packages: [talker, listener], version: 1.0.0-1}}\n"
            + ("  walk: {release: {version: 1.0.0-1}}\n" if name == "humble" else "")
            + "  planned: {release: {packages: [planner]}}\n"
        )
    assert [*bundle_rosdep.lines(bundle_rosdep.lacking(tmp_path))] == [
        "eigen\n",
        "gazebo: jazzy kilted lyrical\n",
        "omniorb\n",
        "protobuf: humble\n",
        "python3-tree-pip\n",
        "ruby\n",
        "walk: jazzy kilted lyrical\n",
    ]
