"""CM018: launch files and their data are installed, in a directory of the same name."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from fnmatch import fnmatchcase

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity, ViewError
from scaffold.api.cmake import PACKAGE_COMMANDS, Install, installs_directory
from scaffold.api.launch import DATA_DIRECTORIES, data_files, is_named, launch_files

from ._globs import patterns_without_files

_LISTS = "project(talker)\nfind_package(ament_cmake REQUIRED)\n{}ament_package()\n"
_LAUNCH = "def generate_launch_description():\n    pass\n"
_LISTS_PATTERNS = (
    "project(talker)\ninstall(DIRECTORY config DESTINATION share/${{PROJECT_NAME}}{})\n"
    "ament_package()\n"
)
_FILES = {"config/talker.yaml": "talker:\n  ros__parameters:\n    rate: 1.0\n"}
_INSTALLS = re.compile(r"\binstall\s{0,9}\(([^()]{0,999})\)")
DIRECTORIES = ("launch", *DATA_DIRECTORIES)
_TEXTS = (".md", ".rst", ".sh", ".py", ".xml", ".yaml")
"""The endings of files that start launch files, or tell people to."""
_LISTS_PATHS = "project(talker)\ninstall(DIRECTORY {} DESTINATION share/${{PROJECT_NAME}}{})\n"
_FILES_PATHS = {"config/talker.yaml": ""}


class ShareDirectoryNotInstalled(Rule):
    """A directory with launch files or data is not installed, or under another name.

    **Why.** ``ros2 launch`` does not find the launch file; if a parameter file is missing, nodes
    run with their defaults. Patterns that match no file have the same effect, without an error.
    ``config/`` with a trailing slash installs the contents, ``config`` the directory itself: with
    the wrong one, files end up in ``share/<package>/`` or ``share/<package>/config/config/``.

    **Fix.** ``install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})``.

    **Source.** CMake documentation, ``install(DIRECTORY)``: ``FILES_MATCHING``, ``PATTERN``; ROS 2
    documentation, "Developing a ROS 2 package".
    """

    code = "CM018"
    name = "share-directory-not-installed"
    other_severities = {
        Severity.WARNING: "nothing in the package refers to the directory, such as one with "
        "test.launch.py, its files are installed in another one, or its installation is commented "
        "out"
    }
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
            "not installed",
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
            "CMakeLists.txt:3:1: launch/ is not installed, so launch/talk.launch.py is not found "
            "at run time",
        ),
        Example(
            "a launch file for tests that no text names",
            {"CMakeLists.txt": _LISTS.format(""), "launch/test.launch.py": _LAUNCH},
            Report(
                "CMakeLists.txt:3:1",
                "launch/ is not installed, so launch/test.launch.py is not found at run time",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a command to install it, commented out by the author",
            {
                "CMakeLists.txt": _LISTS.format(
                    "# Uncomment the install call below to install the example\n"
                    "# install(DIRECTORY\n#   models\n#   launch\n"
                    "#   DESTINATION share/${PROJECT_NAME})\n"
                ),
                "launch/talk.launch.py": _LAUNCH,
            },
            Report(
                "CMakeLists.txt:8:1",
                "launch/ is not installed, so launch/talk.launch.py is not found at run time",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "after a command of an unknown package, which may install it",
            {
                "CMakeLists.txt": _LISTS.format(
                    "find_package(can_bus REQUIRED)\ngenerate_buses(front)\n"
                ),
                "launch/talk.launch.py": _LAUNCH,
            },
        ),
        Example(
            "not installed, after a module of CMake and a command of Jazzy",
            {
                "CMakeLists.txt": _LISTS.format(
                    "include(GNUInstallDirs)\nfind_package(nav2_common REQUIRED)\nnav2_package()\n"
                ),
                "launch/talk.launch.py": _LAUNCH,
            },
            "CMakeLists.txt:6:1: launch/ is not installed, so launch/talk.launch.py is not found "
            "at run time",
        ),
        Example(
            "a file of that name in this package and in another one",
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
            "CMakeLists.txt:4:1: config/ is not installed, so config/talker.yaml is not found at "
            "run time",
            Report(
                "CMakeLists.txt:4:1",
                "maps/ is not installed, so maps/floor.yaml is not found at run time",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a copy of files that are installed from another directory",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "CMakeLists.txt": _LISTS.format(
                    "install(DIRECTORY launch map DESTINATION share/${PROJECT_NAME})\n"
                ),
                "launch/talk.launch.py": "import os\n"
                "from ament_index_python.packages import get_package_share_directory\n\n\n"
                "def generate_launch_description():\n"
                "    own = get_package_share_directory('talker')\n"
                "    return [os.path.join(own, 'map', 'floor.yaml')]\n",
                "map/floor.yaml": "",
                "maps/floor.yaml": "",
            },
            Report(
                "CMakeLists.txt:4:1",
                "maps/ is not installed, so maps/floor.yaml is not found at run time",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "patterns that match a file",
            {
                "CMakeLists.txt": _LISTS_PATTERNS.format(' FILES_MATCHING PATTERN "*.yaml"'),
                **_FILES,
            },
        ),
        Example(
            "a pattern for another extension, in a ROS 1 package",
            {
                "CMakeLists.txt": "if($ENV{ROS_VERSION} EQUAL 1)\n"
                + _LISTS_PATTERNS.format(' FILES_MATCHING PATTERN "*.launch"')
                + "endif()\n",
                **_FILES,
            },
        ),
        Example(
            "file(GLOB) with a pattern for another extension",
            {
                "CMakeLists.txt": "project(talker)\nfile(GLOB parameters config/*.yml)\n"
                "install(FILES ${parameters} DESTINATION share/${PROJECT_NAME}/config)\n"
                "ament_package()\n",
                **_FILES,
            },
            "CMakeLists.txt:2:22: the pattern matches none of the files in config/, such as "
            "config/talker.yaml: nothing is installed",
        ),
        Example(
            "file(GLOB) for one of several extensions",
            {
                "CMakeLists.txt": "project(talker)\nfile(GLOB first config/*.yml)\n"
                "file(GLOB second config/*.yaml)\n"
                "install(FILES ${first} DESTINATION share/${PROJECT_NAME}/config)\n"
                "install(FILES ${second} DESTINATION share/${PROJECT_NAME}/config)\n"
                "ament_package()\n",
                **_FILES,
            },
        ),
        Example(
            "a pattern for another extension",
            {"CMakeLists.txt": _LISTS_PATTERNS.format(' FILES_MATCHING PATTERN "*.yml"'), **_FILES},
            "CMakeLists.txt:2:19: the patterns match no file in config/, such as "
            "config/talker.yaml: nothing is installed",
        ),
        Example(
            "all files excluded",
            {"CMakeLists.txt": _LISTS_PATTERNS.format(' PATTERN "*.yaml" EXCLUDE'), **_FILES},
            "CMakeLists.txt:2:19: the patterns match no file in config/, such as "
            "config/talker.yaml: nothing is installed",
        ),
        Example(
            "both forms that keep the name",
            {
                **_FILES_PATHS,
                "CMakeLists.txt": _LISTS_PATHS.format("config", "")
                + _LISTS_PATHS.format("config/", "/config"),
            },
        ),
        Example(
            "files from which others are generated for the subdirectory",
            {
                **_FILES_PATHS,
                "CMakeLists.txt": _LISTS_PATHS.format("config/", "")
                + _LISTS_PATHS.format("${CMAKE_CURRENT_BINARY_DIR}/made", "/config"),
            },
        ),
        Example(
            "launch files, which `ros2 launch` finds in any subdirectory",
            {"launch/talk.launch.py": "", "CMakeLists.txt": _LISTS_PATHS.format("launch/", "")},
        ),
        Example(
            "the name dropped",
            {**_FILES_PATHS, "CMakeLists.txt": _LISTS_PATHS.format("config/", "")},
            Report(
                "CMakeLists.txt:2:19",
                "the files of config/ are installed to share/talker/, not to share/talker/config/",
                fix="Install to config/",
                severity=Severity.WARNING,
            ),
            fixed={"CMakeLists.txt": _LISTS_PATHS.format("config", "")},
        ),
        Example(
            "the name doubled",
            {**_FILES_PATHS, "CMakeLists.txt": _LISTS_PATHS.format("config", "/config")},
            Report(
                "CMakeLists.txt:2:19",
                "the files of config/ are installed to share/talker/config/config/, "
                "not to share/talker/config/",
                fix="Install to config/",
                severity=Severity.WARNING,
            ),
            fixed={"CMakeLists.txt": _LISTS_PATHS.format("config/", "/config")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_installed(package)
        yield from self._check_patterns(package)
        yield from self._check_globs(package)
        yield from self._check_paths(package)

    def _check_installed(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        calls = cmake.find(*PACKAGE_COMMANDS)
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
            is_launched = directory == "launch" and not _is_for_tests(package, directory)
            is_used = is_launched or is_named(package, directory)
            is_planned = is_used and not _is_commented_out(package, directory)
            severity = Severity.ERROR if is_planned else Severity.WARNING
            yield self.report(calls[-1].name_location, message, severity=severity)

    def _check_patterns(self, package: Package) -> Iterator[Diagnostic]:
        for install in package.cmake.installs:
            if install.kind != "DIRECTORY" or install.command.has("REGEX"):
                continue
            for item in install.items:
                path = item.path or ""
                files = [file for file in package.files if path and file.startswith(f"{path}/")]
                if files and not any(_is_taken(install, file) for file in files):
                    message = (
                        f"the patterns match no file in {path}/, such as {files[0]}: "
                        "nothing is installed"
                    )
                    yield self.report(item, message)

    def _check_globs(self, package: Package) -> Iterator[Diagnostic]:
        """Report patterns of ``file(GLOB)`` that match none of the files of a directory."""
        for install in package.cmake.installs:
            if install.kind not in {"FILES", "PROGRAMS"} or install.items:
                continue
            given = install.command.sections({install.kind, "DESTINATION"})[install.kind]
            for argument, pattern in patterns_without_files(package, given):
                directory = pattern.rpartition("/")[0]
                files = [file for file in package.files if file.startswith(f"{directory}/")]
                if directory and files and installs_directory(package, directory) is False:
                    message = (
                        f"the pattern matches none of the files in {directory}/, such as "
                        f"{files[0]}: nothing is installed"
                    )
                    yield self.report(argument, message)

    def _check_paths(self, package: Package) -> Iterator[Diagnostic]:
        name = package.cmake.project_name
        destinations = {
            (install.destination or "").rstrip("/") for install in package.cmake.installs
        }
        for install in package.cmake.installs:
            target = (install.destination or "").rstrip("/")
            if install.kind != "DIRECTORY" or install.command.name != "install":
                continue
            for item in install.items:
                written = item.argument.value
                directory = item.path or ""
                if directory not in DIRECTORIES or item.argument.quoted:
                    continue
                slash = written.endswith("/")
                if f"share/{name}/{directory}" in destinations - {target}:
                    continue  # where other files are, such as those that are generated from these
                if slash and target == f"share/{name}" and directory != "launch":
                    end = item.argument.end
                    edit = Edit(item.argument.path, end - 1, end, "")
                    lands = f"{target}/, not to {target}/{directory}/"
                elif not slash and target == f"share/{name}/{directory}":
                    end = item.argument.end
                    edit = Edit(item.argument.path, end, end, "/")
                    lands = f"{target}/{directory}/, not to {target}/"
                else:
                    continue
                message = f"the files of {directory}/ are installed to {lands}"
                fix = Fix(f"Install to {directory}/", (edit,))
                yield self.report(item, message, fix, severity=Severity.WARNING)


def _is_commented_out(package: Package, directory: str) -> bool:
    """Return whether a comment of CMakeLists.txt has the command that installs a directory."""
    cmake = package.cmake
    text = " ".join(cmake.text(comment) for comment in cmake.comments)
    return any(
        re.search(rf"(?<![\w./-]){re.escape(directory)}(?![\w.-])", command)
        for command in _INSTALLS.findall(text)
    )


def _is_for_tests(package: Package, directory: str) -> bool:
    """Return whether the launch files of a directory are named like tests, and no text names them.

    Their author starts them from the sources.
    """
    files = [path for path in launch_files(package) if path.startswith(f"{directory}/")]
    names = {path.rpartition("/")[2].encode() for path in files}
    if not all(name.startswith(b"test") for name in names):
        return False
    for path in package.files:
        if path.endswith(_TEXTS) and path not in files:
            with suppress(ViewError):
                if any(name in package.data(path) for name in names):
                    return False
    return True


def _is_taken(install: Install, path: str) -> bool:
    parts = path.split("/")
    if any(fnmatchcase(part, pattern) for part in parts for pattern in install.excludes):
        return False
    if not install.command.has("FILES_MATCHING"):
        return True
    return any(
        fnmatchcase(parts[-1], pattern) or fnmatchcase(path, f"*{pattern}")
        for pattern in install.patterns
    )
