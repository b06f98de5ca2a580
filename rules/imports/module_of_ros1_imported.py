"""IM044: ROS 2 packages import modules of ROS 2."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, ViewError
from scaffold.api.cmake import programs
from scaffold.api.python import imports_by_path, rospack_lookups

_NEW = {
    "actionlib": "rclpy.action",
    "dynamic_reconfigure": "parameters of the node",
    "ros_numpy": "sensor_msgs_py",
    "roslib": "ament_index_python",
    "rospy": "rclpy",
    "tf": "tf2_ros",
}
_WITHOUT_PYTHON = {"rclcpp": "rclpy", "rclcpp_action": "rclpy.action", "tf2": "tf2_ros"}
"""Libraries of ROS 2 for C++ only."""
_MANIFEST = (
    "<package format='3'><name>talker</name><export><build_type>ament_cmake</build_type></export>"
    "</package>\n"
)


class ModuleOfRos1Imported(Rule):
    """A module of ROS 1 is imported, or a ROS 2 module that exists only for C++.

    **Why.** ``ModuleNotFoundError: No module named 'rospy'`` when the node is started. ``rospkg``
    can be installed, but searches ``ROS_PACKAGE_PATH``, which ROS 2 does not set:
    ``ResourceNotFound``.

    **Fix.** Use its successor.

    **Source.** ROS 2 documentation, "Migrating a Python package example".
    """

    code = "IM044"
    name = "module-of-ros1-imported"
    examples = (
        Example("modules of ROS 2", {"package.xml": _MANIFEST, "talker/node.py": "import rclpy\n"}),
        Example(
            "a package for C++",
            {
                "package.xml": _MANIFEST,
                "talker/node.py": "import rclpy\nfrom tf2 import LookupException\n",
            },
            "talker/node.py:2:1: 'tf2' has no Python module: ModuleNotFoundError; use tf2_ros",
        ),
        Example(
            "modules of ROS 1",
            {"package.xml": _MANIFEST, "talker/node.py": "import rclpy\nimport rospy\n"},
            "talker/node.py:2:1: 'rospy' is a module of ROS 1: ModuleNotFoundError; use rclpy",
        ),
        Example(
            "of ROS 1, in a program",
            {
                "package.xml": _MANIFEST.replace("ament_cmake", "ament_python"),
                "setup.py": "from setuptools import setup\n\nsetup(\n    name='talker',\n"
                "    packages=['talker'],\n"
                "    entry_points={'console_scripts': ['node = talker.node:main']},\n)\n",
                "talker/__init__.py": "",
                "talker/node.py": "import rospy\nimport tf\n\n\ndef main():\n"
                "    rospy.init_node('talker')\n",
                "talker/past.py": "import rospy\n",
            },
            "talker/node.py:1:1: 'rospy' is a module of ROS 1: ModuleNotFoundError; use rclpy",
        ),
        Example(
            "of ROS 1, in a program that is only installed for ROS 1",
            {
                "package.xml": _MANIFEST.replace(
                    "<export>", "<depend condition='$ROS_VERSION == 1'>rospy</depend><export>"
                ),
                "CMakeLists.txt": "project(talker)\n"
                "install(PROGRAMS talker/node.py DESTINATION lib/${PROJECT_NAME})\n",
                "talker/node.py": "import rospy\n",
            },
        ),
        Example(
            "rospkg, used only for what works in ROS 2",
            {
                "package.xml": _MANIFEST,
                "talker/node.py": "import rclpy\nimport rospkg\n\nprint(rospkg.__version__)\n",
            },
        ),
        Example(
            "rospkg, used to find a package",
            {
                "package.xml": _MANIFEST,
                "talker/node.py": "import rclpy\nfrom rospkg import RosPack\n\n"
                "print(RosPack().get_path('talker'))\n",
            },
            "talker/node.py:4:7: rospkg only finds ROS 1 packages: ResourceNotFound; use "
            "get_package_share_directory() from ament_index_python",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if not (package.manifest.build_type or "").startswith("ament"):
            return
        started = _started(package)
        for path, imports in imports_by_path(package):
            is_of_ros1 = all(item.root != "rclpy" or item.in_tests for item in imports)
            if is_of_ros1 and path not in started:
                continue
            cause = "programs of ROS 1" if is_of_ros1 else ""
            for item in imports:
                root = item.root
                if is_of_ros1 and root != "rospy":
                    continue  # not reached
                is_known = root in _NEW or root in _WITHOUT_PYTHON
                if not is_known or item.guarded or item.conditional or package.has_directory(root):
                    continue
                message = (
                    f"{root!r} is a module of ROS 1: ModuleNotFoundError; use {_NEW[root]}"
                    if root in _NEW
                    else f"{root!r} has no Python module: ModuleNotFoundError; use "
                    f"{_WITHOUT_PYTHON[root]}"
                )
                yield self.report(item, message, cause=cause)
            for at in rospack_lookups(package, path):
                message = (
                    "rospkg only finds ROS 1 packages: ResourceNotFound; use "
                    "get_package_share_directory() from ament_index_python"
                )
                yield self.report(at, message)


def _started(package: Package) -> set[str]:
    """Return the files of programs, unless some may be meant for ROS 1."""
    if "ROS_VERSION" in package.source("package.xml").text:
        return set()
    try:
        if package.build_type == "ament_python":
            modules = {script.module for script in package.setup_py.console_scripts}
            return {f"{module.replace('.', '/')}.py" for module in modules}
        return {program.path for program in programs(package)}
    except ViewError:
        return set()
