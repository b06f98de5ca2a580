"""CM024: tests and their dependencies are guarded by ``if(BUILD_TESTING)``."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule, Severity

COMMANDS = (
    "ament_add_gmock",
    "ament_add_gtest",
    "ament_add_pytest_test",
    "ament_add_test",
    "ament_lint_auto_find_test_dependencies",
    "add_launch_test",
    "add_ros_test",
)
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
_TEST = "ament_add_pytest_test(talk test/test_talk.py)\n"


class TestUnguarded(Rule):
    """A test is registered, or a test dependency found, outside of ``if(BUILD_TESTING)``.

    **Why.** A build without tests (``-DBUILD_TESTING=OFF``) does not install test dependencies:
    CMake stops at the missing package or the unknown command. The build works only where they
    happen to be installed.

    **Fix.** Move the call into ``if(BUILD_TESTING)``.

    **Source.** ROS 2 documentation, "ament_cmake user documentation", "Testing and linting";
    ros_buildfarm #903, which does not install test dependencies if tests are skipped.
    """

    code = "CM024"
    name = "test-unguarded"
    severity = Severity.WARNING
    effect = Effect.STOPS_BUILD
    release_refused = "the build farm may build it without its test dependencies"
    examples = (
        Example(
            "a guarded package",
            {
                "package.xml": _MANIFEST,
                "CMakeLists.txt": f"project(talker)\nif(BUILD_TESTING)\n  {_FIND}endif()\n",
            },
        ),
        Example(
            "a package that is not guarded",
            {"package.xml": _MANIFEST, "CMakeLists.txt": f"project(talker)\n{_FIND}"},
            "CMakeLists.txt:2:14: test dependency 'ament_lint_auto' is found outside of "
            "if(BUILD_TESTING): builds without tests stop",
        ),
        Example(
            "a guarded test",
            {"CMakeLists.txt": f"project(talker)\nif(BUILD_TESTING)\n  {_TEST}endif()\n"},
        ),
        Example(
            "a test that is not guarded",
            {"CMakeLists.txt": f"project(talker)\n{_TEST}"},
            "2:1: ament_add_pytest_test() is outside of if(BUILD_TESTING): builds without "
            "tests stop",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_tests(package)
        manifest = package.manifest
        others = manifest.build_names | manifest.run_names | manifest.build_export_names
        for found_package in package.cmake.found_packages:
            name = found_package.name
            only_tests = name in manifest.test_names or name in TEST_PACKAGES
            if (
                found_package.in_testing
                or not found_package.required
                or not only_tests
                or name in others
            ):
                continue
            if not found_package.command.blocks:
                message = (
                    f"test dependency {name!r} is found outside of if(BUILD_TESTING): "
                    f"builds without tests stop"
                )
                yield self.report(found_package, message)

    def _check_tests(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.find(*COMMANDS):
            if not command.blocks and not package.cmake.guarded_by_testing(command):
                message = (
                    f"{command.name}() is outside of if(BUILD_TESTING): builds without tests stop"
                )
                yield self.report(command.name_location, message)
