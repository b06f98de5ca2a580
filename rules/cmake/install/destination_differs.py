"""CM010: programs, launch files and modules are installed where they are searched for."""

from __future__ import annotations

import re
from collections.abc import Container, Iterator

from scaffold.api import (
    Diagnostic,
    Edit,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Severity,
    listed_names,
)
from scaffold.api.cmake import Argument, CMakeLists, Command, Install
from scaffold.api.distributions import target
from scaffold.api.launch import DATA_DIRECTORIES, is_named

_LISTS = "project(talker)\ninstall(PROGRAMS talker/node.py DESTINATION {})\n"
_RIGHT = "lib/${PROJECT_NAME}"
DIRECTORIES = ("launch", *DATA_DIRECTORIES)
_WANTED = "share/${PROJECT_NAME}"
_LISTS_SHARE = "project(talker)\ninstall(DIRECTORY launch DESTINATION {})\n"
_FILES = {"launch/talk.launch.py": ""}
_LISTS_ABSOLUTE = "project(talker)\ninstall(DIRECTORY launch DESTINATION {})\n"
_LISTS_TARGET = (
    "project(talker)\nadd_executable(talk talk.cpp)\n"
    "target_link_libraries(talk rclcpp::rclcpp)\ninstall(TARGETS talk DESTINATION {})\n"
)
_LISTS_FUNCTION = (
    "project(talker)\nfunction(add_node name)\n  add_executable(${{name}} src/${{name}}.cpp)\n"
    "  ament_target_dependencies(${{name}} rclcpp)\n  install(TARGETS ${{name}} DESTINATION {})\n"
    "endfunction()\nadd_node(talk)\n"
)
_LISTS_PYTHON = "project(talker)\ninstall(DIRECTORY talker DESTINATION {})\n"


class DestinationDiffers(Rule):
    """``install`` puts files into a directory where ROS 2 or Python does not search.

    **Why.** ``ros2 run`` only searches ``lib/<package>``: ``No executable found``; ``ros2 launch``
    searches ``share/<package>``: ``file 'talk.launch.py' was not found in the share directory of
    package 'talker'``. Python does not import modules from the directory of another Python version.
    An absolute path is outside of the workspace: the build needs root permissions, and no Debian
    package can be built.

    **Fix.** Install programs to ``lib/${PROJECT_NAME}``, launch files and data to
    ``share/${PROJECT_NAME}``, and modules with ``ament_python_install_package(${PROJECT_NAME})``.

    **Source.** ``ros2pkg.api.get_executable_paths``; ``ros2launch/api/api.py``; CMake
    documentation, ``install``; ``ament_cmake_python``: ``PYTHON_INSTALL_DIR``.
    """

    code = "CM010"
    name = "destination-differs"
    other_severities = {
        Severity.WARNING: "the directory is that of the distribution's Python version"
    }
    examples = (
        Example(
            "programs in the directory that ros2 run searches",
            {"CMakeLists.txt": _LISTS.format(_RIGHT), "talker/node.py": "import rclpy\n"},
        ),
        Example(
            "programs in bin, for users without ROS",
            {"CMakeLists.txt": _LISTS.format("bin"), "talker/node.py": "import rclpy\n"},
            Report(
                "CMakeLists.txt:2:45",
                "installs to bin, but `ros2 run talker` searches lib/talker",
                fix="Install to lib/${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS.format(_RIGHT)},
        ),
        Example(
            "an executable that is no node, and a library",
            {
                "CMakeLists.txt": "project(talker)\nadd_executable(talk talk.cpp)\n"
                "add_library(talking talk.cpp)\nament_target_dependencies(talking rclcpp)\n"
                "install(TARGETS talk talking RUNTIME DESTINATION bin LIBRARY DESTINATION lib)\n",
                "talk.cpp": "",
            },
        ),
        Example(
            "an executable that is a node",
            {
                "CMakeLists.txt": _LISTS_TARGET.format("bin"),
                "talk.cpp": "",
            },
            Report(
                "CMakeLists.txt:4:1",
                "installs talk to bin, but `ros2 run talker` searches lib/talker",
                fix="Install to lib/${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS_TARGET.format(_RIGHT)},
        ),
        Example(
            "programs in a path without the braces",
            {
                "CMakeLists.txt": _LISTS.format("lib/PROJECT_NAME"),
                "talker/node.py": "import rclpy\n",
            },
            Report(
                "CMakeLists.txt:2:45",
                "installs to lib/PROJECT_NAME, but `ros2 run talker` searches lib/talker",
                fix="Install to lib/${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS.format(_RIGHT)},
        ),
        Example(
            "launch files below share", {"CMakeLists.txt": _LISTS_SHARE.format(_WANTED), **_FILES}
        ),
        Example(
            "launch files in share, without the package",
            {"CMakeLists.txt": _LISTS_SHARE.format("share"), **_FILES},
            Report(
                "CMakeLists.txt:2:38",
                "installs to share/, but `ros2 launch` searches share/talker/",
                fix="Install to share/${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS_SHARE.format(_WANTED)},
        ),
        Example(
            "launch files in the directory of the programs",
            {"CMakeLists.txt": _LISTS_SHARE.format("lib/${PROJECT_NAME}"), **_FILES},
            Report(
                "CMakeLists.txt:2:38",
                "installs to lib/talker/, but `ros2 launch` searches share/talker/",
                fix="Install to share/${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS_SHARE.format(_WANTED)},
        ),
        Example(
            "data that no code looks for in the share directory, and a launch file that does",
            {
                "CMakeLists.txt": "project(talker)\n"
                "install(DIRECTORY config DESTINATION lib/${PROJECT_NAME})\n"
                "install(DIRECTORY params DESTINATION lib/${PROJECT_NAME})\n"
                "install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\n",
                "package.xml": "<package><name>talker</name></package>\n",
                "config/states.yaml": "start: done\n",
                "params/talk.yaml": "talker: {ros__parameters: {rate: 1.0}}\n",
                "launch/talk.launch.py": "import os\n\n"
                "from ament_index_python.packages import get_package_share_directory\n\n\n"
                "def generate_launch_description():\n"
                "    share = get_package_share_directory('talker')\n"
                "    print(os.path.join(share, 'params', 'talk.yaml'))\n",
            },
            Report(
                "CMakeLists.txt:3:38",
                "installs to lib/talker/, but `ros2 launch` searches share/talker/",
                fix="Install to share/${PROJECT_NAME}",
            ),
            fixed={
                "CMakeLists.txt": "project(talker)\n"
                "install(DIRECTORY config DESTINATION lib/${PROJECT_NAME})\n"
                "install(DIRECTORY params DESTINATION share/${PROJECT_NAME})\n"
                "install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\n"
            },
        ),
        Example(
            "nodes that a function installs outside of the directory that is searched",
            {"CMakeLists.txt": _LISTS_FUNCTION.format("bin")},
            Report(
                "5:3",
                "installs talk to bin, but `ros2 run talker` searches lib/talker",
                fix="Install to lib/${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS_FUNCTION.format("lib/${PROJECT_NAME}")},
        ),
        Example("relative", {"CMakeLists.txt": _LISTS_ABSOLUTE.format("share/${PROJECT_NAME}")}),
        Example(
            "absolute only if an option is set",
            {
                "CMakeLists.txt": "project(talker)\nif(INSTALL_UDEV_RULES)\n"
                "  install(FILES talker.rules DESTINATION /etc/udev/rules.d)\nendif()\n"
            },
        ),
        Example(
            "absolute",
            {"CMakeLists.txt": _LISTS_ABSOLUTE.format("/opt/talker/share")},
            "2:38: installs to /opt/talker/share, outside of the workspace: the build "
            "needs root permissions; use a relative path",
        ),
        Example(
            "modules in PYTHON_INSTALL_DIR",
            {"CMakeLists.txt": _LISTS_PYTHON.format("${PYTHON_INSTALL_DIR}")},
        ),
        Example(
            "modules in the directory of another Python version",
            {"CMakeLists.txt": _LISTS_PYTHON.format("lib/python3.8/site-packages")},
            "2:38: installs Python modules to lib/python3.8/site-packages, which only that Python "
            "version searches",
        ),
        Example(
            "modules in the directory of the distribution's Python version",
            {"CMakeLists.txt": _LISTS_PYTHON.format("lib/python3.10/site-packages")},
            Report(
                "2:38",
                "installs Python modules to lib/python3.10/site-packages, which only "
                "that Python version searches",
                severity=Severity.WARNING,
            ),
            distro="humble",
        ),
        Example(
            "a directory with two slashes",
            {"CMakeLists.txt": _LISTS_TARGET.format("lib//${PROJECT_NAME}"), "talk.cpp": ""},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_programs(package)
        yield from self._check_targets(package)
        yield from self._check_share(package)
        yield from self._check_absolute(package)
        yield from self._check_python(package)

    def _check_programs(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        wanted = f"lib/{cmake.project_name}"
        for install in cmake.installs:
            argument = install.destination_argument
            if install.kind != "PROGRAMS" or install.destination is None or argument is None:
                continue
            given = install.destination.rstrip("/")
            if given == wanted or not self._is_meant_for_run(package, install, given):
                continue
            fix = _fix(install, argument, _RIGHT) if not given.startswith("/") else None
            message = f"installs to {given}, but `ros2 run {cmake.project_name}` searches {wanted}"
            yield self.report(argument, message, fix)

    def _check_targets(self, package: Package) -> Iterator[Diagnostic]:
        """Report executables of nodes that `ros2 run` does not find."""
        cmake = package.cmake
        wanted = f"lib/{cmake.project_name}"
        targets = [install for install in cmake.installs if install.kind == "TARGETS"]
        nodes = _linked_nodes(cmake)
        found = {
            item.value
            for install in targets
            for item in install.items
            if _runtime(install) in {None, wanted}
        }
        for install in targets:
            given, argument = _runtime(install), install.destination_argument
            names = [item.value or "" for item in install.items if item.value in nodes - found]
            if not names or given is None or argument is None:
                continue
            fix = None
            if install.command.values.count("DESTINATION") == 1:
                fix = _fix(install, argument, _RIGHT)
            message = (
                f"installs {listed_names(names, '')} to {given}, but "
                f"`ros2 run {cmake.project_name}` searches {wanted}"
            )
            yield self.report(install.command.name_location, message, fix)

    def _is_meant_for_run(self, package: Package, install: Install, given: str) -> bool:
        """Return whether a program is a node, not a helper such as an environment hook."""
        if given.startswith(("include", "etc", "/")) or "python" in given:
            return False
        paths = [item.path for item in install.items if item.path and package.has(item.path)]
        if given.startswith("share/") or (given.startswith("lib/") and given != "lib/PROJECT_NAME"):
            programs = bool(paths) and all(self._is_program(package, path) for path in paths)
            return programs or self._is_near(package, given)
        return any(self._is_node(package, path) for path in paths)

    def _is_program(self, package: Package, path: str) -> bool:
        """Return whether a file is a started node that is not installed elsewhere."""
        if not self._is_node(package, path):
            return False
        module = package.module(path)
        places = [
            install
            for install in package.cmake.installs
            for item in install.items
            if item.path == path
        ]
        is_node = "rclpy" in module.imports_by_root and module.is_script and module.has_main_guard
        return is_node and not module.in_tests and len(places) == 1

    def _is_near(self, package: Package, given: str) -> bool:
        name = given.removeprefix("lib/")
        return name.lower().replace("-", "_") == (package.cmake.project_name or "").lower()

    def _is_node(self, package: Package, path: str) -> bool:
        return path in package.python_files and "rclpy" in package.source(path).text

    def _check_share(self, package: Package) -> Iterator[Diagnostic]:
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
            if given.startswith((right, "/", "$", ".")) or not _holds_data(
                package, install, placed
            ):
                continue
            message = f"installs to {given}/, but `ros2 launch` searches {right}/"
            yield self.report(argument, message, _fix(install, argument, _WANTED))

    def _check_absolute(self, package: Package) -> Iterator[Diagnostic]:
        for install in package.cmake.installs:
            argument = install.destination_argument
            if argument is None or not (install.destination or "").startswith("/"):
                continue
            if package.build_type == "ament_cmake" and not _is_asked_for(install.command):
                message = (
                    f"installs to {install.destination}, outside of the workspace: the "
                    f"build needs root permissions; use a relative path"
                )
                yield self.report(argument, message)

    def _check_python(self, package: Package) -> Iterator[Diagnostic]:
        for install in package.cmake.installs:
            argument = install.destination_argument
            where = install.destination or ""
            if argument is None or not re.search(r"python\d[\d.]*/|(site|dist)-packages", where):
                continue
            if "$" not in argument.raw:
                message = (
                    f"installs Python modules to {where}, which only that Python version searches"
                )
                is_searched = f"python{target().python_version}/" in where
                severity = Severity.WARNING if is_searched else None
                yield self.report(argument, message, severity=severity)


def _fix(install: Install, argument: Argument, directory: str) -> Fix | None:
    around = {block.name for block in install.command.blocks}
    if "$" in argument.raw and not around.isdisjoint({"function", "macro"}):
        return None  # other calls may pass another directory
    edit = Edit(argument.path, argument.start, argument.end, directory)
    return Fix(f"Install to {directory}", (edit,))


def _runtime(install: Install) -> str | None:
    """Return the directory of installed executables; ``None`` if unknown."""
    destination = install.destinations.get("RUNTIME", install.destinations.get(""))
    return None if destination is None else destination.rstrip("/")


def _linked_nodes(cmake: CMakeLists) -> set[str | None]:
    """Return the executables that are linked with rclcpp."""
    executables = {
        cmake.expand(call.arguments[0], call, turn)
        for call in _calls(cmake, "add_executable")
        for turn in cmake.turns(call)
    }
    linked = {
        cmake.expand(call.arguments[0], call, turn)
        for call in _calls(cmake, "ament_target_dependencies", "target_link_libraries")
        for turn in cmake.turns(call)
        if "rclcpp" in " ".join(cmake.expand_list(call.arguments[1:], call, turn) or call.values)
    }
    return executables & linked - {None}


def _calls(cmake: CMakeLists, *names: str) -> Iterator[Command]:
    return (call for call in cmake.find(*names) if call.arguments)


def _holds_data(package: Package, install: Install, placed: Container[str | None]) -> bool:
    """Return whether an install has launch files, or only data that is looked for in share."""
    paths = [item.path for item in install.items]
    if not all(path in DIRECTORIES and path not in placed for path in paths):
        return False
    return any(path == "launch" or (path and is_named(package, path)) for path in paths)


def _is_asked_for(command: Command) -> bool:
    """Return whether a condition opts in, such as one for Debian packages."""
    at = command.parent
    while at is not None and at.name != "if":
        at = at.parent
    return at is not None
