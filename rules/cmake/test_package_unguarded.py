"""CM024: what only tests need is found for tests only."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

TEST_PACKAGES = (
    "ament_lint_auto",
    "ament_lint_common",
    "ament_cmake_pytest",
    "ament_cmake_gtest",
    "ament_cmake_gmock",
    "ament_cmake_copyright",
    "ament_cmake_flake8",
    "ament_cmake_pep257",
    "ament_cmake_lint_cmake",
    "ament_cmake_xmllint",
    "ament_cmake_cpplint",
    "ament_cmake_uncrustify",
    "launch_testing_ament_cmake",
    "ros_testing",
)
_MANIFEST = "<package><name>talker</name><test_depend>ament_lint_auto</test_depend></package>\n"
_FIND = "find_package(ament_lint_auto REQUIRED)\n"


class TestPackageUnguarded(Rule):
    """A ``<test_depend>`` is found outside of ``if(BUILD_TESTING)``.

    **Why.** A release build has no test dependencies: CMake stops there.

    **Fix.** Move the call into ``if(BUILD_TESTING)``.

    **Source.** ROS 2 documentation, "ament_cmake user documentation", "Testing and linting".
    """

    code = "CM024"
    name = "test-package-unguarded"
    examples = (
        Example(
            "guarded",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": f"project(talker)\nif(BUILD_TESTING)\n  {_FIND}endif()\n",
            },
        ),
        Example(
            "not guarded",
            {"package.xml": _MANIFEST, "CMakeLists.txt": f"project(talker)\n{_FIND}"},
            Report(
                "CMakeLists.txt:2:14",
                "'ament_lint_auto' is a test dependency, but found outside of if(BUILD_TESTING)",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        others = manifest.build_names | manifest.run_names | manifest.build_export_names
        for found in package.cmake.found_packages:
            name = found.name
            only_tests = name in manifest.test_names or name in TEST_PACKAGES
            if found.in_testing or not found.required or not only_tests or name in others:
                continue
            if self._is_guarded_otherwise(package, found.command.index):
                continue
            message = f"{name!r} is a test dependency, but found outside of if(BUILD_TESTING)"
            yield self.report(found, message)

    def _is_guarded_otherwise(self, package: Package, index: int) -> bool:
        """Tell whether some other condition or a function stands around the call."""
        command = package.cmake.commands[index]
        return bool(command.blocks)
