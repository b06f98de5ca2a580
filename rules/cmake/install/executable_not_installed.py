"""CM012: every node and every executable is installed."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Effect,
    Example,
    Package,
    Report,
    Rule,
    Severity,
    closest_name,
    listed_names,
)
from scaffold.api.cmake import PACKAGE_COMMANDS, has_unknown_commands, is_used_by_build, programs
from scaffold.api.install import file_of, is_started, paths_imported_by
from scaffold.api.launch import package_uses
from scaffold.api.programs import programs_of
from scaffold.api.setup_py import call_without_destination, configured_scripts

_TRIALS = ("test", "example")
"""Prefixes of executables that are only meant for the author."""
_NODE = (
    "#!/usr/bin/env python3\nimport rclpy\n\n\ndef main():\n    rclpy.init()\n\n\n"
    "if __name__ == '__main__':\n    main()\n"
)
_LISTS = (
    "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
    "install(\n  PROGRAMS\n    talker/node.py\n{}  DESTINATION lib/${{PROJECT_NAME}}\n)\n"
    "ament_package()\n"
)
_DATA = "install(DIRECTORY scripts DESTINATION share/talker)\nament_package()\n"
_FOR_USERS = ("launch.py", "launch.xml", "launch.yaml", "launch.yml", ".sh", ".md", ".rst")
_LISTS_TARGETS = (
    "project(talker)\nfind_package(ament_cmake REQUIRED)\nadd_executable(talk src/talk.cpp)\n"
    "add_executable(listen src/listen.cpp)\n"
    "install(TARGETS talk {}DESTINATION lib/${{PROJECT_NAME}})\nament_package()\n"
)
_CONFIGURED = {
    "package.xml": '<package format="3"><name>talker</name><export>'
    "<build_type>ament_cmake</build_type></export></package>\n",
    "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake_python REQUIRED)\n"
    "ament_python_install_package(talker SCRIPTS_DESTINATION lib/${PROJECT_NAME})\n"
    "ament_package()\n",
    "setup.cfg": "[options.entry_points]\nconsole_scripts =\n  talk = talker.talk:main\n",
    "talker/__init__.py": "",
    "talker/talk.py": "def main():\n    pass\n",
}


class ExecutableNotInstalled(Rule):
    """A node or an executable is not installed.

    **Why.** ``ros2 run`` fails with ``No executable found``.

    **Fix.** Install scripts with ``install(PROGRAMS ... DESTINATION lib/${PROJECT_NAME})``, and
    executables with ``install(TARGETS ... DESTINATION lib/${PROJECT_NAME})``.

    **Source.** ``ros2run/command/run.py``; ROS 2 documentation, "ament_cmake user documentation";
    catkin_lint, "target is not installed".
    """

    code = "CM012"
    name = "executable-not-installed"
    other_severities = {
        Severity.WARNING: "it may not be meant for users: no launch file starts it, and no other "
        "executable in its directory is installed, its name contains test or "
        "example, it imports rospy, or nothing mentions it",
    }
    examples = (
        Example(
            "both installed, and a module that is not an executable",
            {
                "CMakeLists.txt": _LISTS.format("    talker/other.py\n"),
                "talker/node.py": _NODE,
                "talker/other.py": _NODE,
                "talker/text.py": "",
            },
        ),
        Example(
            "scripts that are started in another way, excluded, or data; a module with a demo",
            {
                "CMakeLists.txt": _LISTS.format("    # talker/old.py\n").replace(
                    "ament_p",
                    "ament_python_install_package(talker SETUP_CFG talker/setup.cfg)\n"
                    "install(DIRECTORY skills DESTINATION share/talker)\nament_p",
                ),
                "talker/setup.cfg": "console_scripts =\n  a = talker.a:main\n",
                "talker/node.py": "from talker.other import main\n\nmain()\n",
                **dict.fromkeys(("talker/a.py", "talker/old.py", "talker/other.py"), _NODE),
                "talker/__init__.py": "",
                "talker/list.py": _NODE.replace("main()", "show()"),
                "skills/arm/scripts/move.py": _NODE,
            },
        ),
        Example("scripts as data", {"CMakeLists.txt": _DATA, "scripts/node.py": _NODE}),
        Example(
            "a package that colcon does not build",
            {
                "package.xml": "<package><export><build_type>ament_python</build_type>"
                "</export></package>\n",
                "setup.py": "",
                "CMakeLists.txt": _LISTS.format(""),
                **dict.fromkeys(("talker/node.py", "talker/other.py"), _NODE),
            },
        ),
        Example(
            "a script that is never mentioned",
            {
                "CMakeLists.txt": _LISTS.format(""),
                **dict.fromkeys(("talker/node.py", "talker/other.py"), _NODE),
            },
            Report(
                "CMakeLists.txt:3:1",
                "talker/other.py is a node with a main function, but not installed: `ros2 run` "
                "does not find it; add it to install(PROGRAMS "
                "...)",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "one of two is not installed",
            {
                "CMakeLists.txt": _LISTS.format(""),
                "README.md": "    ros2 run talker other.py\n",
                **dict.fromkeys(("talker/node.py", "talker/other.py"), _NODE),
            },
            "CMakeLists.txt:3:1: talker/other.py is a node with a main function, but not "
            "installed: `ros2 run` does not find it; add it to "
            "install(PROGRAMS ...)",
        ),
        Example(
            "a script for experiments",
            {
                "CMakeLists.txt": _LISTS.format(""),
                **dict.fromkeys(("talker/node.py", "talker/test_node.py"), _NODE),
            },
        ),
        Example(
            "a node in a separate directory",
            {
                "CMakeLists.txt": _LISTS.format(""),
                **dict.fromkeys(("talker/node.py", "extra/other.py"), _NODE),
            },
            Report(
                "CMakeLists.txt:3:1",
                "extra/other.py is a node with a main function, but not installed: `ros2 run` "
                "does not find it; add it to install(PROGRAMS "
                "...)",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a script left over from ROS 1",
            {
                "CMakeLists.txt": _LISTS.format(""),
                "talker/node.py": _NODE,
                "talker/other.py": _NODE.replace("import rclpy\n", "import rclpy\nimport rospy\n"),
            },
            Report(
                "CMakeLists.txt:3:1",
                "talker/other.py is a node with a main function, but not installed: `ros2 run` "
                "does not find it; add it to install(PROGRAMS "
                "...)",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a node of a launch file and a test, in a package that installs no executables",
            {
                "package.xml": "<package><name>talker</name></package>\n",
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake_pytest REQUIRED)\n"
                "ament_add_pytest_test(test_node test/test_node.py)\nament_package()\n",
                "launch/a.launch.py": "from launch import LaunchDescription\n"
                "from launch_ros.actions import Node\n\n\n"
                "def generate_launch_description():\n"
                "    return LaunchDescription([Node(package='talker', executable='node.py')])\n",
                "talker/node.py": _NODE,
            },
            "CMakeLists.txt:4:1: talker/node.py is a node with a main function, but not "
            "installed: `ros2 run` does not find it; add it to "
            "install(PROGRAMS ...)",
            executable=("talker/node.py",),
        ),
        Example("both installed", {"CMakeLists.txt": _LISTS_TARGETS.format("listen ")}),
        Example("console scripts of setup.cfg", _CONFIGURED),
        Example(
            "console scripts of setup.cfg without a destination",
            {
                **_CONFIGURED,
                "CMakeLists.txt": _CONFIGURED["CMakeLists.txt"].replace(
                    " SCRIPTS_DESTINATION lib/${PROJECT_NAME}", ""
                ),
            },
            "CMakeLists.txt:3:1: setup.cfg declares talk, but ament_python_install_package() "
            "installs no scripts: `ros2 run` does not find them; add SCRIPTS_DESTINATION "
            "lib/${PROJECT_NAME}",
        ),
        Example(
            "an executable that is not installed",
            {"CMakeLists.txt": _LISTS_TARGETS.format("")},
            "4:16: 'listen' is built, but not installed: `ros2 run` does not "
            "find it; add it to install(TARGETS ...)",
        ),
        Example(
            "shared libraries, of which one is not installed, and a static one",
            {
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "add_library(words SHARED words.cpp)\nadd_library(voice SHARED voice.cpp)\n"
                "add_library(ear STATIC ear.cpp)\nadd_executable(talk talk.cpp)\n"
                "target_link_libraries(talk words voice ear)\n"
                "install(TARGETS words LIBRARY DESTINATION lib)\n"
                "install(TARGETS talk DESTINATION lib/${PROJECT_NAME})\nament_package()\n"
            },
            "4:13: 'voice' is not installed, but 'talk' is linked with it: 'error while loading "
            "shared libraries'; add it to install(TARGETS ...)",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_targets(package)
        yield from self._check_configured(package)
        cmake = package.cmake
        if not cmake.find(*PACKAGE_COMMANDS) or has_unknown_commands(package):
            return
        installs = [
            install
            for install in cmake.installs
            if install.kind in {"PROGRAMS", "FILES", "DIRECTORY"}
        ]
        if any(item.path is None for install in installs for item in install.items):
            return
        installed = {program.path for program in programs(package)}
        at = next((install.command for install in installs if install.kind == "PROGRAMS"), None)
        uses = package_uses(package)
        launched = {use.executable for use in uses if use.name == package.name}
        used = tuple(f"/{path}" for path in paths_imported_by(package, installed))
        for path in package.python_files:
            if path in installed or not is_started(package, path):
                continue
            if f"/{path}".endswith(used):
                continue
            if is_used_by_build(package, path) or self._is_misspelled(package, path):
                continue
            place = at.name_location if at else cmake.find(*PACKAGE_COMMANDS)[0].name_location
            message = (
                f"{path} is a node with a main function, but not installed: `ros2 run` does not "
                f"find it; add it to install(PROGRAMS ...)"
            )
            directory = path.rpartition("/")[0]
            has_neighbor = any(other.rpartition("/")[0] == directory for other in installed)
            is_trial = path.rpartition("/")[2].startswith(_TRIALS)
            is_whole = has_neighbor and not is_trial and not _is_of_ros1(package, path)
            is_whole = is_whole and _is_named(package, path)
            is_launched = path.rpartition("/")[2] in launched
            severity = Severity.ERROR if is_whole or is_launched else Severity.WARNING
            effect = Effect.STOPS_START if is_launched else None
            yield self.report(place, message, severity=severity, effect=effect)

    def _check_configured(self, package: Package) -> Iterator[Diagnostic]:
        """Check that console scripts of setup.cfg are installed, unless other programs run them."""
        call = call_without_destination(package)
        if call is None or has_unknown_commands(package):
            return
        programs = programs_of(package)
        scripts = [
            script.name
            for script in configured_scripts(package)
            if script.name not in programs.sources
            and file_of(package, script.module) not in programs.sources.values()
        ]
        if scripts and programs.complete:
            message = (
                f"setup.cfg declares {listed_names(scripts, '')}, but "
                f"ament_python_install_package() installs no scripts: `ros2 run` does not find "
                f"them; add SCRIPTS_DESTINATION lib/${{PROJECT_NAME}}"
            )
            cause = "" if programs.sources else f"executables of {package.name}"
            yield self.report(call.name_location, message, cause=cause)

    def _is_misspelled(self, package: Package, path: str) -> bool:
        """Return whether a missing installed file must be this one."""
        missing = [program.path for program in programs(package) if not package.has(program.path)]
        return bool(closest_name(package, path, missing, 0.8))

    def _check_targets(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if not cmake.find(*PACKAGE_COMMANDS) or has_unknown_commands(package):
            return
        targets = [install for install in cmake.installs if install.kind == "TARGETS"]
        installed = {item.value for target in targets for item in target.items}
        # An application without any install commands has not forgotten this one.
        if not installed or None in installed:
            return
        yield from self._check_libraries(package, installed)
        for command in cmake.find("add_executable"):
            if command.blocks or not command.arguments or cmake.guarded_by_testing(command):
                continue
            name = cmake.expand(command.arguments[0], command)
            kinds = set(command.values[1:2])
            if (
                name is None
                or name in installed
                or kinds & {"IMPORTED", "ALIAS", "EXCLUDE_FROM_ALL"}
            ):
                continue
            if self._is_used(package, name) or "test" in name or "benchmark" in name:
                continue
            yield self.report(
                command.arguments[0],
                f"{name!r} is built, but not installed: `ros2 "
                f"run` does not find it; add it to install(TARGETS ...)",
            )

    def _check_libraries(
        self, package: Package, installed: set[str | None]
    ) -> Iterator[Diagnostic]:
        """Report shared libraries that installed executables need."""
        cmake = package.cmake
        names = {
            cmake.expand(command.arguments[0], command): command.arguments[0]
            for command in cmake.find("add_library")
            if command.values[1:2] == ["SHARED"] and not command.blocks
        }
        for command in cmake.find("target_link_libraries"):
            user = cmake.expand(command.arguments[0], command) if command.arguments else None
            for argument in command.arguments[1:] if user in installed else ():
                name = cmake.expand(argument, command)
                place = names.pop(name, None)
                if name is None or place is None or name in installed | {None}:
                    continue
                if not self._is_used(package, name):
                    message = (
                        f"{name!r} is not installed, but {user!r} is linked with it: 'error while "
                        f"loading shared libraries'; add it to install(TARGETS ...)"
                    )
                    yield self.report(place, message)

    def _is_used(self, package: Package, name: str) -> bool:
        """Return whether the build itself runs or installs the executable."""
        ways = (
            "add_custom_command",
            "add_custom_target",
            "rclcpp_components_register_node",
            "install",
            "add_test",
            "add_dependencies",
        )
        return any(
            name in value.split(":") or f"TARGET_FILE:{name}" in value
            for command in package.cmake.find(*ways)
            for value in command.values
        )


def _is_named(package: Package, path: str) -> bool:
    """Return whether anything that users start or read mentions an executable."""
    name = path.rpartition("/")[2].encode()
    return any(name in package.data(item) for item in package.files if item.endswith(_FOR_USERS))


def _is_of_ros1(package: Package, path: str) -> bool:
    return any(item.module.partition(".")[0] == "rospy" for item in package.module(path).imports)
