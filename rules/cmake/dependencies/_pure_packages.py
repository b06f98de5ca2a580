"""Packages that install no CMake files."""

from __future__ import annotations

PURE_PACKAGES = frozenset(
    """
    ament_copyright ament_flake8 ament_index_python ament_lint ament_mypy ament_pep257
    ament_python demo_nodes_py joint_state_publisher launch launch_pytest launch_ros
    launch_testing launch_testing_ros launch_xml launch_yaml nav2_simple_commander numpy pytest
    ros2bag ros2cli ros2launch ros2node ros2param ros2pkg ros2run ros2service ros2topic
    rosidl_runtime_py sensor_msgs_py setuptools teleop_twist_keyboard tf2_ros_py
    tf_transformations topic_monitor yaml
    """.split()  # noqa: SIM905  a column of quoted names would hide them
)
