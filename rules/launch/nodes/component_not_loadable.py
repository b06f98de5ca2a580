"""LF066: component containers load C++ components only."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, LaunchRule, Package
from scaffold.api.launch import LaunchFile

_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import ComposableNodeContainer\n"
    "from launch_ros.descriptions import ComposableNode\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([ComposableNodeContainer(\n"
    "        name='container', namespace='', package='rclcpp_components',\n"
    "        executable='component_container', composable_node_descriptions=[\n"
    "            ComposableNode(package='{}', plugin='talker::Talker')])])\n"
)
_MANIFEST = (
    '<package format="3"><name>talker</name>'
    "<export><build_type>ament_python</build_type></export></package>\n"
)


class ComponentNotLoadable(LaunchRule):
    """A launch file loads a component from a package without C++ code.

    **Why.** A component is a class in a shared library, so Python nodes cannot be loaded: ``Failed
    to find class with the requested plugin name``, and the node is not started.

    **Fix.** Start it with ``Node(package='talker', executable='talk')``.

    **Source.** ROS 2 documentation, "Composing multiple nodes in a single process".
    """

    code = "LF066"
    name = "component-not-loadable"
    examples = (
        Example(
            "a component of another package",
            {"package.xml": _MANIFEST, "launch/a.launch.py": _LAUNCH.format("image_proc")},
        ),
        Example(
            "a C++ component",
            {
                "package.xml": _MANIFEST.replace("ament_python", "ament_cmake"),
                "src/talker.cpp": "RCLCPP_COMPONENTS_REGISTER_NODE(talker::Talker)\n",
                "launch/a.launch.py": _LAUNCH.format("talker"),
            },
        ),
        Example(
            "a Python node",
            {"package.xml": _MANIFEST, "launch/a.launch.py": _LAUNCH.format("talker")},
            "launch/a.launch.py:10:36: 'talker' has no C++ components: the container does not "
            "find the plugin; start Python nodes with Node(...)",
        ),
    )

    def check_in(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        for call in launch.find("ComposableNode"):
            name = launch.text(call, "package")
            owner = None
            if isinstance(name, str):
                owner = package if name == package.name else package.workspace.get(name)
            if owner is None or any(path.endswith(_SOURCES) for path in owner.files):
                continue
            if owner.build_type == "ament_python" or owner.python_files:
                message = (
                    f"{name!r} has no C++ components: the container does not find the plugin; "
                    f"start Python nodes with Node(...)"
                )
                yield self.report(launch.location(call.given["package"]), message)


_SOURCES = (".cpp", ".cc", ".cxx", ".hpp", ".h", ".rs")
