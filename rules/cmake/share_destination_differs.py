"""CM101: what launch files look for is installed in the directory of the package."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.cmake import Install
from scaffold.api.launch import DATA_DIRECTORIES

DIRECTORIES = ("launch", *DATA_DIRECTORIES)
_WANTED = "share/${PROJECT_NAME}"
_LISTS = "project(talker)\ninstall(DIRECTORY launch DESTINATION {})\n"
_FILES = {"launch/talk.launch.py": ""}


class ShareDestinationDiffers(Rule):
    """Launch files or their data are installed outside of ``share/<package>``.

    **Why.** ``ros2 launch`` and ``get_package_share_directory`` look in ``share/<package>`` only:
    ``file 'talk.launch.py' was not found in the share directory of package 'talker'``.

    **Fix.** ``DESTINATION share/${PROJECT_NAME}``.

    **Source.** ``ros2launch/api/api.py``; ROS 2 documentation, "Launch files".
    """

    code = "CM101"
    name = "share-destination-differs"
    examples = (
        Example("right", {"CMakeLists.txt": _LISTS.format(_WANTED), **_FILES}),
        Example(
            "without the package",
            {"CMakeLists.txt": _LISTS.format("share"), **_FILES},
            Report(
                "CMakeLists.txt:2:38",
                "installs to share/; `ros2 launch` and launch files look in share/talker/",
                fix="install to share/${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS.format(_WANTED)},
        ),
        Example(
            "with the programs",
            {"CMakeLists.txt": _LISTS.format("lib/${PROJECT_NAME}"), **_FILES},
            Report(
                "CMakeLists.txt:2:38",
                "installs to lib/talker/; `ros2 launch` and launch files look in share/talker/",
                fix="install to share/${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS.format(_WANTED)},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        right = f"share/{cmake.project_name}"
        placed = {
            item.path
            for install in cmake.installs
            for item in install.items
            if (install.destination or "").startswith(right)
        }
        for install in cmake.installs:
            argument = install.destination_argument
            given = (install.destination or "").rstrip("/")
            if install.kind != "DIRECTORY" or argument is None or not given:
                continue
            if given.startswith((right, "/", "$", ".")) or not self._holds_data(install, placed):
                continue
            edit = Edit("CMakeLists.txt", argument.start, argument.end, _WANTED)
            message = f"installs to {given}/; `ros2 launch` and launch files look in {right}/"
            yield self.report(argument, message, Fix(f"install to {_WANTED}", (edit,)))

    def _holds_data(self, install: Install, placed: set[str | None]) -> bool:
        """Tell whether all that is installed is data for launching, and installed only here."""
        paths = [item.path for item in install.items]
        return bool(paths) and all(path in DIRECTORIES and path not in placed for path in paths)
