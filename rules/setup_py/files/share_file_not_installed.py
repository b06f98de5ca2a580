"""SP010: launch files and their data are installed."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, Severity
from scaffold.api.install import is_copy_of_old_code, names_above
from scaffold.api.launch import DATA_DIRECTORIES, data_files, is_named, launch_files, started_nodes
from scaffold.api.setup_py import installed_data

_MANIFEST = (
    "<package><name>talker</name><export><build_type>ament_python</build_type></export></package>\n"
)
_SETUP = (
    "from glob import glob\n\nfrom setuptools import setup\n\n"
    "setup(\n    name='talker',\n    data_files=[\n"
    "        ('share/talker', ['package.xml']),\n{}    ],\n)\n"
)
_LAUNCH = "def generate_launch_description():\n    pass\n"
_ROBOT = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    return LaunchDescription([Node(package='robot', executable='drive')])\n"
)


class ShareFileNotInstalled(Rule):
    """data_files do not install a launch file or a directory with data.

    **Why.** ``ros2 launch`` fails with ``file 'talk.launch.py' was not found in the share
    directory``; if a parameter file is missing, nodes run with their defaults. It is a warning if
    nothing in the workspace refers to the directory.

    **Fix.** Add a line such as ``('share/' + package_name + '/launch', glob('launch/*'))``.

    **Source.** ROS 2 documentation, "Integrating launch files into ROS 2 packages".
    """

    code = "SP010"
    name = "share-file-not-installed"
    effect = Effect.SPOILS_INSTALL
    other_severities = {
        Severity.WARNING: "nothing in the package refers to the directory, a text of the "
        "repository tells people to start the launch file by its path, or the launch file only "
        "starts nodes of a package that has a launch file of that name"
    }
    examples = (
        Example(
            "installed",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(
                    "        ('share/talker/launch', glob('launch/*.launch.py')),\n"
                ),
                "launch/talk.launch.py": _LAUNCH,
            },
        ),
        Example(
            "a copy of a launch file is not installed",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(
                    "        ('share/talker/launch', glob('launch/*.launch.py')),\n"
                ),
                "launch/talk.launch.py": _LAUNCH,
                "launch/talk_all_launch-Copy1.py": _LAUNCH,
            },
        ),
        Example(
            "a launch file and a parameter file are not installed",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(""),
                "launch/talk.launch.py": _LAUNCH,
                "config/talker.yaml": "",
            },
            "setup.py:7:16: data_files does not install launch/talk.launch.py: `ros2 launch` does "
            "not find it; add an entry",
            Report(
                "setup.py:7:16",
                "data_files installs no files from config/, such as "
                "config/talker.yaml: they are missing at run time",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a parameter file that is read from the source tree, and one that is installed",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(
                    "        ('share/talker/launch', glob('launch/*.launch.py')),\n"
                ),
                "launch/talk.launch.py": "CONFIG = 'src/talker/config/talker.yaml'\n"
                "RVIZ = 'my_view.rviz'\nopen('share/talker/maps/hall.pgm')\n" + _LAUNCH,
                "config/talker.yaml": "",
                "maps/hall.pgm": "",
                "worlds/hall.yaml": "model: hall.dae\n",
                "worlds/hall.dae": "",
                "rviz/view.rviz": "",
            },
            Report(
                "setup.py:7:16",
                "data_files installs no files from config/, such as "
                "config/talker.yaml: they are missing at run time",
                severity=Severity.WARNING,
            ),
            "setup.py:7:16: data_files installs no files from maps/, such as maps/hall.pgm: they "
            "are missing at run time",
            Report(
                "setup.py:7:16",
                "data_files installs no files from rviz/, such as rviz/view.rviz: they "
                "are missing at run time",
                severity=Severity.WARNING,
            ),
            Report(
                "setup.py:7:16",
                "data_files installs no files from worlds/, such as worlds/hall.dae: "
                "they are missing at run time",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a parameter file with the same name as one in another package",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(
                    "        ('share/talker/launch', glob('launch/*.launch.py')),\n"
                ),
                "launch/talk.launch.py": "CONFIG = '/home/ann/talker.yaml'\n" + _LAUNCH,
                "config/talker.yaml": "",
            },
            Report(
                "setup.py:7:16",
                "data_files installs no files from config/, such as "
                "config/talker.yaml: they are missing at run time",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a file in two packages, used by a third one",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(""),
                "config/talker.yaml": "",
            },
            Report(
                "setup.py:7:16",
                "data_files installs no files from config/, such as "
                "config/talker.yaml: they are missing at run time",
                severity=Severity.WARNING,
            ),
            neighbors={
                "other": {
                    "package.xml": _MANIFEST.replace("talker", "other"),
                    "config/talker.yaml": "",
                },
                "bringup": {
                    "package.xml": _MANIFEST.replace("talker", "bringup"),
                    "launch/all.launch.py": "FILE = 'talker.yaml'\n" + _LAUNCH,
                },
            },
        ),
        Example(
            "a copy of a launch file of the package whose nodes it starts",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(""),
                "launch/robot.launch.py": _ROBOT,
            },
            Report(
                "setup.py:7:16",
                "data_files does not install launch/robot.launch.py: `ros2 launch` "
                "does not find it; add an entry",
                severity=Severity.WARNING,
            ),
            neighbors={
                "robot": {
                    "package.xml": _MANIFEST.replace("talker", "robot"),
                    "launch/robot.launch.py": _ROBOT,
                },
            },
        ),
        Example(
            "a file name that the pattern does not match",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(
                    "        ('share/talker/launch', glob('launch/*.launch.py')),\n"
                ),
                "launch/talk.launch.py": _LAUNCH,
                "launch/talk_all.py": _LAUNCH,
            },
            "setup.py:7:16: data_files does not install launch/talk_all.py: `ros2 launch` does "
            "not find it; add an entry",
        ),
        Example(
            "installed by setup.cfg",
            {
                "setup.py": "from setuptools import setup\n\nsetup()\n",
                "setup.cfg": "[options.data_files]\nshare/talker/launch =\n    launch/*.py\n",
                "launch/talk.launch.py": "",
            },
        ),
        Example(
            "not installed by setup.cfg",
            {
                "setup.py": "from setuptools import setup\n\nsetup()\n",
                "setup.cfg": "[options.data_files]\nshare/talker/launch = launch/a*.py\n",
                "launch/talk.launch.py": "",
            },
            "setup.cfg:1:2: data_files does not install launch/talk.launch.py: `ros2 launch` does "
            "not find it; add an entry",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        installed = installed_data(package)
        if package.build_type != "ament_python" or installed is None:
            return
        at = package.setup_py.keywords.get("data_files", package.setup_py)
        stems = tuple(path.removesuffix(".py") for path in installed if path.endswith(".py"))
        for path in launch_files(package):
            if path in installed or _is_copy(path, stems):
                continue
            if not is_copy_of_old_code(package, path):
                message = (
                    f"data_files does not install {path}: `ros2 launch` does not find it; "
                    f"add an entry"
                )
                is_unused = names_above(package, path) or _is_of_another_package(package, path)
                severity = Severity.WARNING if is_unused else None
                cause = f"files in {path.rpartition('/')[0]}/"
                yield self.report(at, message, severity=severity, cause=cause)
        for directory in DATA_DIRECTORIES:
            files = data_files(package, directory)
            if files and not installed.intersection(files):
                message = (
                    f"data_files installs no files from {directory}/, such as {files[0]}: "
                    f"they are missing at run time"
                )
                is_used = is_named(package, directory)
                severity = Severity.ERROR if is_used else Severity.WARNING
                yield self.report(at, message, severity=severity)


def _is_of_another_package(package: Package, path: str) -> bool:
    """Return whether a launch file belongs to a package whose nodes it starts, and is there too."""
    started = {node.package for node in started_nodes(package) if node.launch == path}
    others = [
        owner
        for name in started
        if isinstance(name, str) and (owner := package.workspace.get(name)) is not None
    ]
    is_foreign = package.name not in started and all(isinstance(name, str) for name in started)
    return is_foreign and any(owner.has(path) for owner in others)


def _is_copy(path: str, stems: tuple[str, ...]) -> bool:
    """Return whether a file is a copy of an installed one: ``talk.launch_old.py``."""
    return not path.endswith((".launch.py", "_launch.py")) and path.startswith(stems)
