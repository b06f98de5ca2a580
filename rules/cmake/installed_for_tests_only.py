"""CM097: nodes are installed whether tests are built or not."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

_NODE = "#!/usr/bin/env python3\nimport rclpy\n\nif __name__ == '__main__':\n    rclpy.init()\n"
_INSTALL = "install(PROGRAMS talker/node.py DESTINATION lib/${PROJECT_NAME})\n"
_LISTS = "project(talker)\n{}ament_package()\n"


class InstalledForTestsOnly(Rule):
    """A node is installed only when tests are built.

    **Why.** Releases are built with ``BUILD_TESTING`` off: ``No executable found`` for everyone
    but the author.

    **Fix.** Move ``install`` out of ``if(BUILD_TESTING)``.

    **Source.** ROS 2 documentation, "ament_cmake user documentation", testing.
    """

    code = "CM097"
    name = "installed-for-tests-only"
    examples = (
        Example("always", {"CMakeLists.txt": _LISTS.format(_INSTALL), "talker/node.py": _NODE}),
        Example(
            "with tests",
            {
                "CMakeLists.txt": _LISTS.format(f"if(BUILD_TESTING)\n{_INSTALL}endif()\n"),
                "talker/node.py": _NODE,
            },
            Report(
                "CMakeLists.txt:3:18",
                "talker/node.py is installed only when tests are built: releases do not contain it",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        for install in cmake.installs:
            if install.kind != "PROGRAMS" or not cmake.guarded_by_testing(install.command):
                continue
            for item in install.items:
                path = item.path or ""
                if path not in package.python_files or path.startswith("test"):
                    continue
                module = package.module(path)
                if "rclpy" in module.imports_by_root and not module.in_tests:
                    message = (
                        f"{path} is installed only when tests are built: releases do not contain it"
                    )
                    yield self.report(item, message)
