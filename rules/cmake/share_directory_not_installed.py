"""CM018: launch files and their data are installed."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity
from scaffold.model.cmake_facts import installs_directory
from scaffold.model.launch_files import DATA_DIRECTORIES, data_files, is_named, launch_files

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
            at=("CMakeLists.txt:3", "CMakeLists.txt:3"),
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
            found = self.report(calls[-1].name_location, message)
            wanted = directory == "launch" or is_named(package, directory)
            yield found if wanted else found._replace(severity=Severity.WARNING)
