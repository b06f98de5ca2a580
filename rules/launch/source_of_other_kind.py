"""LF060: the source of an include can read the kind of file that it is given."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, LaunchRule
from scaffold.api.launch import LaunchFile

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


class SourceOfOtherKind(LaunchRule):
    """A launch file is included with the source class of another file format.

    **Why.** ``ros2 launch`` stops: ``InvalidLaunchFileError``, with ``invalid syntax`` where Python
    reads XML.

    **Fix.** ``AnyLaunchDescriptionSource``, which reads all three kinds.

    **Source.** ``launch/launch_description_sources``.
    """

    code = "LF060"
    name = "source-of-other-kind"
    examples = (
        Example("Python", {"launch/a.launch.py": _LAUNCH.format("b.launch.py")}),
        Example(
            "XML for Python",
            {"launch/a.launch.py": _LAUNCH.format("b.launch.xml")},
            "11:34: PythonLaunchDescriptionSource cannot read b.launch.xml: write "
            "AnyLaunchDescriptionSource",
        ),
    )

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        for kind, endings in _ENDINGS.items():
            for source in launch.find(kind):
                path = launch.text(source, "launch_file_path")
                if isinstance(path, str) and path.endswith(endings):
                    name = path.rpartition("/")[2]
                    advice = "write AnyLaunchDescriptionSource"
                    yield self.report(source, f"{kind} cannot read {name}: {advice}")
