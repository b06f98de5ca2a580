"""CM018: launch files and their data are installed."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.cmake import installs_directory
from scaffold.api.launch import DATA_DIRECTORIES, data_files, is_named, launch_files

_LISTS = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}ament_package()\n"
_LAUNCH = "def generate_launch_description():\n    pass\n"


class ShareDirectoryNotInstalled(Rule):
    """A directory of launch files, or of files read at run time, is not installed.

    **Why.** ``ros2 launch`` does not find the file; a missing parameter file is a warning among
    others, and nodes run with defaults.

    **Fix.** ``install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})``.

    **Source.** ROS 2 documentation, "Developing a ROS 2 package".
    """

    code = "CM018"
    name = "share-directory-not-installed"
    other_severities = {Severity.WARNING: "nothing in the package names the directory"}
    examples = (
        Example(
            "installed",
            {
                "CMakeLists.txt": _LISTS.format(
                    "install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\n"
                ),
                "launch/talk.launch.py": _LAUNCH,
            },
        ),
        Example(
            "forgotten",
            {
                "CMakeLists.txt": _LISTS.format(""),
                "launch/talk.launch.py": _LAUNCH,
                "config/talker.yaml": "",
            },
            Report(
                "CMakeLists.txt:3:1",
                "config/ is not installed, so config/talker.yaml is not found at run time",
                severity=Severity.WARNING,
            ),
            Report(
                "CMakeLists.txt:3:1",
                "launch/ is not installed, so launch/talk.launch.py is not found at run time",
            ),
        ),
        Example(
            "a file of that name, of this package and of another one",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "CMakeLists.txt": _LISTS.format(
                    "install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\n"
                ),
                "launch/talk.launch.py": "import os\n"
                "from ament_index_python.packages import get_package_share_directory\n\n\n"
                "def generate_launch_description():\n"
                "    own = get_package_share_directory('talker')\n"
                "    other = get_package_share_directory('robot')\n"
                "    return [os.path.join(own, 'config', 'talker.yaml'),\n"
                "            os.path.join(other, 'maps', 'floor.yaml')]\n",
                "config/talker.yaml": "",
                "maps/floor.yaml": "",
            },
            Report(
                "CMakeLists.txt:4:1",
                "config/ is not installed, so config/talker.yaml is not found at run time",
            ),
            Report(
                "CMakeLists.txt:4:1",
                "maps/ is not installed, so maps/floor.yaml is not found at run time",
                severity=Severity.WARNING,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        calls = cmake.find("ament_package")
        if not calls:
            return
        first: dict[str, str] = {}
        for path in launch_files(package):
            first.setdefault(path.partition("/")[0], path)
        for directory in DATA_DIRECTORIES:
            for path in data_files(package, directory)[:1]:
                first.setdefault(directory, path)
        for directory, path in first.items():
            named = any(
                directory in value for command in cmake.commands for value in command.values
            )
            if named or installs_directory(package, directory) is not False:
                continue
            message = f"{directory}/ is not installed, so {path} is not found at run time"
            is_used = directory == "launch" or is_named(package, directory)
            severity = Severity.ERROR if is_used else Severity.WARNING
            yield self.report(calls[-1].name_location, message, severity=severity)
