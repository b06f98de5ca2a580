"""LF060: launch files and xacro files are read in their own format."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, LaunchRule, Location
from scaffold.api.launch import LaunchCall, LaunchFile

_ENDINGS: Mapping[str, tuple[str, ...]] = {
    "PythonLaunchDescriptionSource": (".launch.xml", ".launch.yaml", ".launch.yml", ".xml"),
    "XMLLaunchDescriptionSource": (".py", ".yaml", ".yml"),
    "YAMLLaunchDescriptionSource": (".py", ".xml"),
}
_LAUNCH = (
    "from launch import LaunchDescription\nfrom launch.actions import IncludeLaunchDescription\n"
    "from launch.launch_description_sources import PythonLaunchDescriptionSource\n"
    "from launch.substitutions import PathJoinSubstitution\n"
    "from launch_ros.substitutions import FindPackageShare\n\n\n"
    "def generate_launch_description():\n"
    "    path = PathJoinSubstitution([FindPackageShare('talker'), 'launch', '{}'])\n"
    "    return LaunchDescription([\n"
    "        IncludeLaunchDescription(PythonLaunchDescriptionSource(path)),\n    ])\n"
)
_LAUNCH_XACRO = (
    "import os\n\nfrom ament_index_python.packages import get_package_share_directory\n"
    "from launch import LaunchDescription\nfrom launch.substitutions import Command\n"
    "from launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    path = os.path.join(get_package_share_directory('talker'), 'urdf', 'robot.{}')\n"
    "    description = {}\n"
    "    return LaunchDescription([\n"
    "        Node(package='robot_state_publisher', executable='robot_state_publisher',\n"
    "             parameters=[{{'robot_description': description}}]),\n    ])\n"
)


class FileOfOtherKind(LaunchRule):
    """A launch file reads another file in the wrong format.

    **Why.** ``ros2 launch`` stops: ``InvalidLaunchFileError``, with ``invalid syntax`` if XML is
    read as Python. If a xacro file is read as URDF, its macros are not expanded:
    robot_state_publisher finds no links, or fails with ``Failed to parse robot description``.

    **Fix.** Use ``AnyLaunchDescriptionSource``, which reads all three formats; for xacro,
    ``ParameterValue(Command(['xacro ', path]), value_type=str)``.

    **Source.** ``launch/launch_description_sources``; xacro, README; ROS 2 documentation, "Using
    Xacro to clean up your code".
    """

    code = "LF060"
    name = "file-of-other-kind"
    examples = (
        Example("Python", {"launch/a.launch.py": _LAUNCH.format("b.launch.py")}),
        Example(
            "XML read as Python",
            {"launch/a.launch.py": _LAUNCH.format("b.launch.xml")},
            "11:34: PythonLaunchDescriptionSource cannot read b.launch.xml: write "
            "AnyLaunchDescriptionSource",
        ),
        Example(
            "URDF; a file that is written",
            {
                "launch/a.launch.py": _LAUNCH_XACRO.format("urdf", "open(path).read()"),
                "launch/b.launch.py": _LAUNCH_XACRO.format("xacro", "open(path, 'w').write('')"),
            },
        ),
        Example(
            "processed by xacro",
            {"launch/a.launch.py": _LAUNCH_XACRO.format("xacro", "Command(['xacro ', path])")},
        ),
        Example(
            "xacro read without processing",
            {
                "launch/a.launch.py": _LAUNCH_XACRO.format("urdf.xacro", "open(path).read()"),
                "launch/b.launch.py": _LAUNCH_XACRO.format("xacro", "Command(['cat ', path])"),
            },
            "launch/a.launch.py:11:19: a xacro file is read without expanding its macros: the "
            "URDF is invalid; run xacro in a Command",
            "launch/b.launch.py:11:28: a xacro file is read without expanding its macros: the "
            "URDF is invalid; run xacro in a Command",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for at in _places_reading(launch):
            message = (
                "a xacro file is read without expanding its macros: the URDF is invalid; "
                "run xacro in a Command"
            )
            yield self.report(at, message)
        for kind, endings in _ENDINGS.items():
            for source in launch.find(kind):
                for path in _paths(launch, source):
                    if path.endswith(endings):
                        name = path.rpartition("/")[2]
                        advice = "write AnyLaunchDescriptionSource"
                        yield self.report(source, f"{kind} cannot read {name}: {advice}")
                        break


def _paths(launch: LaunchFile, source: LaunchCall) -> Iterator[str]:
    """Yield the paths that a source reads, in each call of the function around it."""
    for case in launch.cases(source.call) or (None,):
        with launch.evaluator.bound(case.values if case is not None else {}):
            path = launch.text(source, "launch_file_path")
        if isinstance(path, str):
            yield path


def _places_reading(launch: LaunchFile) -> Iterator[Location]:
    """Yield the places that read the text of a xacro file."""
    module = launch.module
    if module.mentions("xacro.process", "xacro.parse", "import xacro"):
        return
    for call in module.walk(ast.Call):
        match call:
            case ast.Call(
                func=ast.Name(id="open"), args=[path] | [path, ast.Constant(value="r")]
            ) if _is_xacro(launch, path):
                yield launch.location(call)
    for program, node in launch.programs:
        call_node = module.parent(node)
        texts = ast.walk(call_node) if call_node is not None else iter(())
        if program == "cat" and any(
            isinstance(item, ast.expr) and _is_xacro(launch, item) for item in texts
        ):
            yield launch.location(node)


def _is_xacro(launch: LaunchFile, node: ast.expr) -> bool:
    text = launch.evaluator.joined_text(node)
    return isinstance(text, str) and text.endswith(".xacro")
