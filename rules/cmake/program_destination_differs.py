"""CM010: programs are installed where ``ros2 run`` looks."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.cmake import Install

_LISTS = "project(talker)\ninstall(PROGRAMS talker/node.py DESTINATION {})\n"
_RIGHT = "lib/${PROJECT_NAME}"


class ProgramDestinationDiffers(Rule):
    """``install(PROGRAMS ...)`` does not install to ``lib/${PROJECT_NAME}``.

    **Why.** ``ros2 run`` looks in ``lib/<package>`` alone: ``No executable found``.

    **Fix.** Write ``DESTINATION lib/${PROJECT_NAME}``.

    **Source.** ``ros2pkg.api.get_executable_paths``; ROS 2 documentation, "ament_cmake user
    documentation".
    """

    code = "CM010"
    name = "program-destination-differs"
    examples = (
        Example(
            "where ros2 run looks",
            {"CMakeLists.txt": _LISTS.format(_RIGHT), "talker/node.py": "import rclpy\n"},
        ),
        Example(
            "to bin, as for other programs",
            {"CMakeLists.txt": _LISTS.format("bin"), "talker/node.py": "import rclpy\n"},
            Report(
                "CMakeLists.txt:2:45",
                "installs to bin; `ros2 run talker` looks in lib/talker",
                fix="install to lib/${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS.format(_RIGHT)},
        ),
        Example(
            "without the braces",
            {
                "CMakeLists.txt": _LISTS.format("lib/PROJECT_NAME"),
                "talker/node.py": "import rclpy\n",
            },
            Report(
                "CMakeLists.txt:2:45",
                "installs to lib/PROJECT_NAME; `ros2 run talker` looks in lib/talker",
                fix="install to lib/${PROJECT_NAME}",
            ),
            fixed={"CMakeLists.txt": _LISTS.format(_RIGHT)},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        wanted = f"lib/{cmake.project_name}"
        for install in cmake.installs:
            argument = install.destination_argument
            if install.kind != "PROGRAMS" or install.destination is None or argument is None:
                continue
            given = install.destination.rstrip("/")
            if given == wanted or not self._is_meant_for_run(package, install, given):
                continue
            edit = Edit("CMakeLists.txt", argument.start, argument.end, _RIGHT)
            fix = Fix(f"install to {_RIGHT}", (edit,)) if not given.startswith("/") else None
            message = f"installs to {given}; `ros2 run {cmake.project_name}` looks in {wanted}"
            yield self.report(argument, message, fix)

    def _is_meant_for_run(self, package: Package, install: Install, given: str) -> bool:
        """Tell a node from a helper that is rightly elsewhere, such as an environment hook."""
        if given.startswith(("include", "etc", "/")) or "python" in given:
            return False
        paths = [item.path for item in install.items if item.path and package.has(item.path)]
        if given.startswith("share/") or (given.startswith("lib/") and given != "lib/PROJECT_NAME"):
            programs = bool(paths) and all(self._is_program(package, path) for path in paths)
            return programs or self._is_near(package, given)
        return any(self._is_node(package, path) for path in paths)

    def _is_program(self, package: Package, path: str) -> bool:
        """Tell whether a file is a node that is started, and installed nowhere else."""
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
