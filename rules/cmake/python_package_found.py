"""CM096: only packages with CMake files are looked for."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.cmake import uses_ament

_PURE = frozenset(
    """
    ament_copyright ament_flake8 ament_index_python ament_lint ament_mypy ament_pep257
    ament_python demo_nodes_py joint_state_publisher launch launch_pytest launch_ros
    launch_testing launch_testing_ros launch_xml launch_yaml nav2_simple_commander numpy pytest
    ros2bag ros2cli ros2launch ros2node ros2param ros2pkg ros2run ros2service ros2topic
    rosidl_runtime_py sensor_msgs_py setuptools teleop_twist_keyboard tf2_ros_py
    tf_transformations topic_monitor yaml
    """.split()  # noqa: SIM905  a column of quoted names would hide them
)
_LISTS = "project(talker)\nfind_package({} REQUIRED)\n"


class PythonPackageFound(Rule):
    """``find_package`` looks for a package that is pure Python.

    **Why.** Packages of build type ament_python, and libraries of PyPI, install no files for
    CMake, which stops: ``By not providing "Findlaunch_ros.cmake" ...``.

    **Fix.** Remove the line; ``<exec_depend>`` in package.xml is enough.

    **Source.** The packages' ``setup.py``; CMake documentation, ``find_package``.
    """

    code = "CM096"
    name = "python-package-found"
    examples = (
        Example("one of CMake", {"CMakeLists.txt": _LISTS.format("rclpy")}),
        Example(
            "pure Python",
            {"CMakeLists.txt": _LISTS.format("launch_ros")},
            Report(
                "2:14",
                "'launch_ros' is a pure Python package without CMake files: CMake stops",
            ),
        ),
        Example(
            "a key of rosdep",
            {"CMakeLists.txt": _LISTS.format("python3-numpy")},
            Report(
                "2:14",
                "'python3-numpy' is a pure Python package without CMake files: CMake stops",
            ),
        ),
        Example(
            "of ROS 1",
            {"CMakeLists.txt": _LISTS.format("ament_cmake") + "find_package(catkin REQUIRED)\n"},
            Report("3:14", "'catkin' belongs to ROS 1: CMake stops; use ament_cmake"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for call in package.cmake.found_packages:
            if not call.required or package.workspace.get(call.name) is not None:
                continue
            if call.name.startswith(("python3-", "python-")) or call.name in _PURE:
                message = f"{call.name!r} is a pure Python package without CMake files: CMake stops"
                yield self.report(call, message)
            elif call.name == "catkin" and call.command.depth == 0 and uses_ament(package):
                yield self.report(call, "'catkin' belongs to ROS 1: CMake stops; use ament_cmake")
