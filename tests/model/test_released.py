"""Dependencies of released packages, and how they are read from recipes."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold.distributions import named, targeting
from scaffold.model.released import dependencies, is_released, transitive_dependencies
from scripts import bundle_dependencies

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
