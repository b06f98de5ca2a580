"""IM044: ROS 2 packages import modules of ROS 2."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
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
"""Libraries of ROS 2 for C++ alone."""
_MANIFEST = (
    "<package format='3'><name>talker</name><export><build_type>ament_cmake</build_type></export>"
    "</package>\n"
)


class ModuleOfRos1Imported(Rule):
    """A module of ROS 1 is imported, or a ROS 2 module that exists only for C++.

    **Why.** ``ModuleNotFoundError: No module named 'rospy'`` when the node is started. ``rospkg``
    can be installed, but looks in ``ROS_PACKAGE_PATH``, which ROS 2 does not set:
    ``ResourceNotFound``.

    **Fix.** Use its successor.

    **Source.** ROS 2 documentation, "Migrating a Python package example".
    """

    code = "IM044"
    name = "module-of-ros1-imported"
    examples = (
        Example("of ROS 2", {"package.xml": _MANIFEST, "talker/node.py": "import rclpy\n"}),
        Example(
            "of C++",
            {
                "package.xml": _MANIFEST,
                "talker/node.py": "import rclpy\nfrom tf2 import LookupException\n",
            },
            "talker/node.py:2:1: 'tf2' has no Python module; use tf2_ros",
        ),
        Example(
            "of ROS 1",
            {"package.xml": _MANIFEST, "talker/node.py": "import rclpy\nimport rospy\n"},
            "talker/node.py:2:1: 'rospy' belongs to ROS 1; use rclpy",
        ),
        Example(
            "rospkg, of which nothing is asked that ROS 2 does not know",
            {
                "package.xml": _MANIFEST,
                "talker/node.py": "import rclpy\nimport rospkg\n\nprint(rospkg.__version__)\n",
            },
        ),
        Example(
            "rospkg, asked for a package",
            {
                "package.xml": _MANIFEST,
                "talker/node.py": "import rclpy\nfrom rospkg import RosPack\n\n"
                "print(RosPack().get_path('talker'))\n",
            },
            "talker/node.py:4:7: rospkg only finds packages of ROS 1: ResourceNotFound; use "
            "get_package_share_directory() of ament_index_python",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if not (package.manifest.build_type or "").startswith("ament"):
            return
        for path, imports in imports_by_path(package):
            if all(item.root != "rclpy" or item.in_tests for item in imports):
                continue
            for item in imports:
                root = item.root
                is_known = root in _NEW or root in _WITHOUT_PYTHON
                if not is_known or item.guarded or item.conditional or package.has_directory(root):
                    continue
                message = (
                    f"{root!r} belongs to ROS 1; use {_NEW[root]}"
                    if root in _NEW
                    else f"{root!r} has no Python module; use {_WITHOUT_PYTHON[root]}"
                )
                yield self.report(item, message)
            for at in rospack_lookups(package, path):
                message = (
                    "rospkg only finds packages of ROS 1: ResourceNotFound; use "
                    "get_package_share_directory() of ament_index_python"
                )
                yield self.report(at, message)
