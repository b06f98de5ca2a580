"""LF015: files that launch files use are installed."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity, ViewError
from scaffold.api.launch import (
    LaunchFile,
    NamedPath,
    has_similar_file,
    is_given_as_parameters,
    is_left_to_the_user,
    is_of_unread_argument,
    missing_in,
    named_paths,
    why_missing,
)

_LAUNCH = (
    "import os\n\nfrom ament_index_python.packages import get_package_share_directory\n"
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    share = get_package_share_directory('talker')\n"
    "    return LaunchDescription([\n"
    "        Node(package='talker', executable='talk',\n"
    "             parameters=[os.path.join(share, {})]),\n    ])\n"
)
_IMPORTS = (
    "\nfrom launch.actions import DeclareLaunchArgument, LogInfo\n"
    "from launch.substitutions import LaunchConfiguration\nfrom launch_ros"
)
_NODE = (
    "import os\n\nfrom ament_index_python.packages import get_package_share_directory\n\n"
    "share = get_package_share_directory('talker')\n"
    "with open(os.path.join(share, 'config', '{}')) as stream:\n"
    "    words = stream.read()\n"
)
_FILES = {
    "package.xml": '<package format="3"><name>talker</name>'
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from glob import glob\n\nfrom setuptools import setup\n\nsetup(\n"
    "    name='talker',\n    data_files=[\n"
    "        ('share/talker/config', glob('config/*.yaml')),\n    ],\n)\n",
    "config/talker.yaml": "",
    "config/other.json": "",
}
_NEXT_TO = (
    "from launch import LaunchDescription\nfrom launch.actions import IncludeLaunchDescription\n"
    "from launch.substitutions import ThisLaunchFileDir\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        IncludeLaunchDescription([ThisLaunchFileDir(), '/b.launch.py'])])\n"
)


class SharePathMissing(Rule):
    """A launch file or a node uses a file of a share directory that is not installed.

    **Why.** ``ros2 launch`` stops with ``No such file or directory``; for a parameter file it
    only warns, and the node runs with its defaults. A node ends with ``FileNotFoundError``.

    **Fix.** Use the path that the build file installs to, or install the file.

    **Source.** ROS 2 documentation, "Using ROS 2 launch for large projects".
    """

    code = "LF015"
    name = "share-path-missing"
    other_severities = {
        Severity.WARNING: "its directory contains only a README or .gitkeep; it is the default of "
        "a launch argument that nothing reads; or it is a parameter file that does not exist"
    }
    examples = (
        Example(
            "installed", {**_FILES, "launch/a.launch.py": _LAUNCH.format("'config', 'talker.yaml'")}
        ),
        Example(
            "in a directory for files of the user",
            {
                **_FILES,
                "models/README.md": "Put best.pt here.\n",
                "launch/a.launch.py": _LAUNCH.format("'models', 'best.pt'"),
            },
            Report(
                "launch/a.launch.py:12:26",
                "share/talker/models/best.pt does not exist: talker has no such file",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "the default of an argument that nothing reads, and of one that a node reads",
            {
                **_FILES,
                **{
                    f"launch/{name}.launch.py": _LAUNCH.format("'config', 'talker.yaml'")
                    .replace(
                        "    return LaunchDescription([",
                        "    config = os.path.join(share, 'config', 'talk.yaml')\n"
                        "    return LaunchDescription([\n"
                        f"        DeclareLaunchArgument('{name}_file', default_value=config),"
                        + read,
                    )
                    .replace("\nfrom launch_ros", _IMPORTS)
                    for name, read in {
                        "talk": "",
                        "hear": "\n        LogInfo(msg=LaunchConfiguration('hear_file')),",
                    }.items()
                },
            },
            "launch/hear.launch.py:12:14: share/talker/config/talk.yaml does not exist: talker "
            "has no such file; did you mean config/talker.yaml?",
            Report(
                "launch/talk.launch.py:12:14",
                "share/talker/config/talk.yaml does not exist: talker has no such "
                "file; did you mean config/talker.yaml?",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a world, with options for Gazebo",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'talker.yaml -r'"),
            },
        ),
        Example(
            "next to a launch file that is started from its source",
            {
                **_FILES,
                "examples/a.launch.py": _NEXT_TO,
                "examples/b.launch.py": "",
            },
            "examples/a.launch.py:8:35: share/talker/examples does not exist: setup.py of talker "
            "does not install examples/",
        ),
        Example(
            "next to a launch file, of a directory that is installed under a shorter path",
            {
                "package.xml": _FILES["package.xml"].replace("_python", "_cmake"),
                "CMakeLists.txt": "install(DIRECTORY bringup/launch DESTINATION share/talker)\n",
                "bringup/launch/a.launch.py": _NEXT_TO,
                "bringup/launch/b.launch.py": "",
            },
            "bringup/launch/a.launch.py:8:35: share/talker/bringup/launch does not exist: "
            "CMakeLists.txt of talker does not install bringup/launch/",
        ),
        Example(
            "a generated file that git ignores",
            {
                **_FILES,
                ".gitignore": "*.pyc\ntalk.yaml\n",
                "launch/a.launch.py": _LAUNCH.format("'config', 'talk.yaml'"),
            },
        ),
        Example(
            "in a directory that another tool builds",
            {
                "package.xml": _FILES["package.xml"].replace("_python", "_cmake"),
                ".gitignore": "dist/\n",
                "CMakeLists.txt": "install(DIRECTORY web/dist/ DESTINATION share/talker/www)\n",
                "web/public/page.html": "",
                "launch/a.launch.py": _LAUNCH.format("'www', 'page.html'"),
            },
        ),
        Example(
            "passed to an unknown function",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'talker.yaml'").replace(
                    "    return",
                    "    read = getattr(load('lib.py'), 'read')\n"
                    "    read(os.path.join(share, 'config', 'of_user.yaml'))\n    return",
                ),
            },
        ),
        Example(
            "a pattern; a file that the launch file creates",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', '*.yml'"),
                "launch/b.launch.py": _LAUNCH.format("'config', 'talker.yaml'").replace(
                    "    return",
                    "    made = os.path.join(share, 'config', 'made.urdf')\n"
                    "    if os.path.isfile(made):\n        os.remove(made)\n    return",
                ),
            },
        ),
        Example(
            "a path that is never used",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'talker.yaml'").replace(
                    "    return",
                    "    config = os.path.join(share, 'config', 'lights.yaml')\n"
                    "    config = ParameterFile(param_file=config, allow_substs=True)\n"
                    "    lights = Node(package='talker', executable='light',\n"
                    "                  parameters=[config])\n    return",
                ),
            },
        ),
        Example(
            "a path that is only printed",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'talker.yaml'").replace(
                    "    return",
                    "    print(os.path.join(share, 'config', 'lights.yaml'))\n    return",
                ),
            },
        ),
        Example(
            "a path that is read while the launch file is loaded",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'talker.yaml'").replace(
                    "    return",
                    "    path = os.path.join(share, 'config', 'lights.yaml')\n"
                    "    lights = open(path).read()\n    return",
                ),
            },
            "launch/a.launch.py:10:12: share/talker/config/lights.yaml does not exist: talker has "
            "no such file",
        ),
        Example(
            "a file that the node writes",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'talker.yaml'").replace(
                    "    return",
                    "    made = {'output_file': os.path.join(share, 'config', 'made.yaml')}\n"
                    "    return",
                ),
            },
        ),
        Example(
            "a file that a function of the launch file writes and returns",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'talker.yaml'")
                .replace(
                    "def generate",
                    "def make_lights(share, number):\n"
                    "    path = Path(share) / 'config' / 'lights.json'\n"
                    "    path.write_text(str(number))\n    return path\n\n\ndef generate",
                )
                .replace("import os\n", "import os\nfrom pathlib import Path\n")
                .replace("    return L", "    lights = make_lights(share, 3)\n    return L")
                .replace("'talk',", "'talk', arguments=[str(lights)],"),
            },
        ),
        Example(
            "a file of this name that it writes somewhere else",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'talker.yaml'").replace(
                    "    return",
                    "    lights = open(os.path.join(share, 'config', 'lights.txt')).read()\n"
                    "    with open('lights.txt', 'w') as stream:\n"
                    "        stream.write(lights)\n    return",
                ),
            },
            "launch/a.launch.py:10:19: share/talker/config/lights.txt does not exist: talker has "
            "no such file",
        ),
        Example(
            "a file of a nested package whose directory is installed",
            {
                "package.xml": '<package format="3"><name>talker</name>'
                "<export><build_type>ament_cmake</build_type></export></package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "install(DIRECTORY launch robots/arm/launch DESTINATION share/talker)\n"
                "ament_package()\n",
                "launch/a.launch.py": _LAUNCH.format("'launch', 'arm.yaml'"),
                "robots/arm/package.xml": '<package format="3"><name>arm</name></package>\n',
                "robots/arm/launch/arm.yaml": "",
            },
        ),
        Example(
            "a file that a shell command writes; a format string",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'talker.yaml'").replace(
                    "    return",
                    "    words = os.path.join(share, 'config', 'talk{}.yaml')\n"
                    "    write = Node(package='talker', executable='talk',\n"
                    "                 arguments=[words.format('er')], prefix=[\n"
                    "        'date > ', os.path.join(share, 'config', 'date.txt')])\n"
                    "    return LaunchDescription([write])\n    return",
                ),
            },
        ),
        Example(
            "a database, which is created when it is opened",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'map.db'")
                .replace("[os.path", "[{'database_path': os.path")
                .replace("')])", "')}])"),
            },
        ),
        Example(
            "a parameter file that does not exist, nor one with a similar name; with substitutions",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'lights.yaml'"),
                "launch/c.launch.py": _LAUNCH.format("'config', 'lights.yaml'")
                .replace(
                    "    return",
                    "    path = os.path.join(share, 'config', 'lights.yaml')\n"
                    "    path = [path]\n    return",
                )
                .replace("[os.path.join(share, 'config', 'lights.yaml')]", "path"),
                "launch/b.launch.py": _LAUNCH.format("'config', 'lights.yaml'")
                .replace("parameters=[", "parameters=[ParameterFile(")
                .replace("yaml')]", "yaml'), allow_substs=True)]")
                .replace(
                    "Node\n",
                    "Node\nfrom launch_ros.parameter_descriptions import ParameterFile\n",
                    1,
                ),
            },
            Report(
                "launch/a.launch.py:12:26",
                "share/talker/config/lights.yaml does not exist: talker has no such file",
                severity=Severity.WARNING,
            ),
            "launch/b.launch.py:13:40: share/talker/config/lights.yaml does not exist: talker has "
            "no such file",
            Report(
                "launch/c.launch.py:10:12",
                "share/talker/config/lights.yaml does not exist: talker has no such file",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a multi-line string, in a directory that is not installed",
            {
                **_FILES,
                "tests/a.test": "",
                "launch/a.launch.py": _LAUNCH.format("'tests', 'a.test'").replace(
                    "os.path.join(share, 'tests', 'a.test')", "share + '/tests/a.test \\n'"
                ),
            },
            "launch/a.launch.py:12:26: share/talker/tests/a.test does not exist: setup.py of "
            "talker does not install tests/a.test",
        ),
        Example(
            "a node that reads an installed file and creates another one",
            {
                **_FILES,
                "talker/talk.py": _NODE.format("talker.yaml")
                + "with open(os.path.join(share, 'config', 'made.yaml'), 'w') as stream:\n"
                "    stream.write(words)\n",
            },
        ),
        Example(
            "a node",
            {**_FILES, "talker/talk.py": _NODE.format("talk.yaml")},
            "talker/talk.py:6:11: share/talker/config/talk.yaml does not exist: talker has no "
            "such file; did you mean config/talker.yaml?",
        ),
        Example(
            "a file and a directory of the sources, which a node does not read itself",
            {
                **_FILES,
                "sounds/horn.wav": "",
                "talker/talk.py": "import os\n\n"
                "from ament_index_python.packages import get_package_share_directory\n\n"
                "SHARE = get_package_share_directory('talker')\n"
                "SOUNDS = os.path.join(SHARE, 'sounds')\nCONFIG = os.path.join(SHARE, 'config')\n"
                "MADE = os.path.join(SHARE, 'made')\n\n\n"
                "def words():\n    return os.path.join(SHARE, 'config', 'other.json')\n",
            },
            "talker/talk.py:6:10: share/talker/sounds does not exist: setup.py of talker does not "
            "install sounds/",
            "talker/talk.py:12:12: share/talker/config/other.json does not exist: setup.py of "
            "talker does not install config/other.json",
        ),
        Example(
            "the image of a map, and the one of another map",
            {
                **_FILES,
                "config/hall.yaml": "image: hall.pgm\nresolution: 0.05\n",
                "config/hall.pgm": "",
                "config/room.yaml": "image: talker.yaml\nresolution: 0.05\n",
            },
            "config/hall.yaml:1:8: share/talker/config/hall.pgm does not exist: setup.py of "
            "talker does not install config/hall.pgm",
        ),
        Example(
            "files of the sources whose existence a node tests",
            {
                **_FILES,
                "talker/talk.py": "from pathlib import Path\n\n"
                "from ament_index_python.packages import get_package_share_directory\n\n"
                "WORDS = Path(get_package_share_directory('talker')) / 'config' / 'other.json'\n"
                "TEXT = WORDS.read_text() if WORDS.exists() else ''\n",
            },
        ),
        Example(
            "the default of a parameter, and the argument of a helper",
            {
                **_FILES,
                "talker/talk.py": "import os\n\n"
                "from ament_index_python.packages import get_package_share_directory\n"
                "from rclpy.node import Node\nfrom talker.words import load\n\n\n"
                "class Talk(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('talk')\n"
                "        self.declare_parameter('file', 'other.json')\n"
                "        share = get_package_share_directory('talker')\n"
                "        name = self.get_parameter('file').value\n"
                "        with open(os.path.join(share, 'config', name)) as stream:\n"
                "            self.words = stream.read()\n"
                "        self.other = [load(), load('talk.yaml')]\n",
                "talker/words.py": "import os\n\n"
                "from ament_index_python.packages import get_package_share_directory\n\n\n"
                "def load(name='talker.yaml'):\n"
                "    share = get_package_share_directory('talker')\n"
                "    with open(os.path.join(share, 'config', name)) as stream:\n"
                "        return stream.read()\n",
            },
            "talker/talk.py:14:19: share/talker/config/other.json does not exist: setup.py of "
            "talker does not install config/other.json",
            "talker/talk.py:16:36: share/talker/config/talk.yaml does not exist: talker has no "
            "such file; did you mean config/talker.yaml?",
        ),
        Example(
            "another name; another directory; not installed",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'talk.yaml'"),
                "launch/b.launch.py": _LAUNCH.format("'talker.yaml'"),
                "launch/c.launch.py": _LAUNCH.format("'config', 'other.json'"),
            },
            "launch/a.launch.py:12:26: share/talker/config/talk.yaml does not exist: talker has "
            "no such file; did you mean config/talker.yaml?",
            "launch/b.launch.py:12:26: share/talker/talker.yaml does not exist: it is installed "
            "as share/talker/config/talker.yaml",
            "launch/c.launch.py:12:26: share/talker/config/other.json does not exist: setup.py of "
            "talker does not install config/other.json",
        ),
        Example(
            "the first of several files that exists",
            {
                **_FILES,
                "launch/a.launch.py": _LAUNCH.format("'config', 'talker.yaml'").replace(
                    "    return",
                    "    for path in (\n        os.path.join(share, 'config', 'first.yaml'),\n"
                    "        os.path.join(share, 'config', 'second.yaml'),\n    ):\n"
                    "        if os.path.isfile(path):\n            print(path)\n    return",
                ),
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in named_paths(package):
            why = why_missing(package, path)
            if why is not None:
                message = f"share/{path.package}/{path.path} does not exist: {why}"
                is_harmless = is_left_to_the_user(package, path)
                is_harmless = is_harmless or is_of_unread_argument(package, path.location)
                is_harmless = is_harmless or _is_only_warned_of(package, path)
                severity = Severity.WARNING if is_harmless else Severity.ERROR
                cause = missing_in(package, path)
                yield self.report(path.location, message, severity=severity, cause=cause)


def _is_only_warned_of(package: Package, named: NamedPath) -> bool:
    """Return whether a path is a parameter file that was never there, without which a node starts.

    If a file is not installed, or has another name, the node runs without the values that it has.
    """
    try:
        return (
            named.location.path.endswith(".py")
            and not has_similar_file(package, named)
            and is_given_as_parameters(LaunchFile.of(package, named.location.path), named.location)
        )
    except ViewError:
        return False
