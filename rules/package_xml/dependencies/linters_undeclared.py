"""PX030: linters that CMake runs are declared."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Fix, Package, Report, Rule, Severity

_LINTERS = frozenset(
    f"ament_cmake_{name}"
    for name in (
        *("black", "clang_format", "clang_tidy", "copyright", "cppcheck", "cpplint", "flake8"),
        *("lint_cmake", "mypy", "pclint", "pep257", "pycodestyle", "pyflakes", "uncrustify"),
        "xmllint",
    )
)
_MANIFEST = (
    '<package format="3">\n  <name>talker</name>\n'
    "  <test_depend>ament_lint_auto</test_depend>\n{}</package>\n"
)
_LISTS = (
    "project(talker)\nfind_package(ament_cmake REQUIRED)\nif(BUILD_TESTING)\n"
    "  find_package(ament_lint_auto REQUIRED)\n  ament_lint_auto_find_test_dependencies()\n"
    "endif()\nament_package()\n"
)


class LintersUndeclared(Rule):
    """CMake runs the linters in package.xml, but none is declared.

    **Why.** ``colcon test`` passes without running any linter:
    ``ament_lint_auto_find_test_dependencies()`` only runs linters declared with ``<test_depend>``.

    **Fix.** Add ``<test_depend>ament_lint_common</test_depend>``, or declare individual linters.

    **Source.** ``ament_lint_auto/cmake/ament_lint_auto_find_test_dependencies.cmake``.
    """

    code = "PX030"
    name = "linters-undeclared"
    severity = Severity.WARNING
    examples = (
        Example(
            "ament_lint_common",
            {
                "CMakeLists.txt": _LISTS,
                "package.xml": _MANIFEST.format("  <test_depend>ament_lint_common</test_depend>\n"),
            },
        ),
        Example(
            "a single linter",
            {
                "CMakeLists.txt": _LISTS,
                "package.xml": _MANIFEST.format("  <test_depend>ament_cmake_mypy</test_depend>\n"),
            },
        ),
        Example(
            "no linter",
            {"CMakeLists.txt": _LISTS, "package.xml": _MANIFEST.format("")},
            Report(
                "package.xml:3:4",
                "CMakeLists.txt:5 runs the linters declared with <test_depend>, but "
                "there are none; add <test_depend>ament_lint_common</test_depend>",
                fix="Declare ament_lint_common",
            ),
            fixed={
                "package.xml": _MANIFEST.format("  <test_depend>ament_lint_common</test_depend>\n")
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        calls = package.cmake.find("ament_lint_auto_find_test_dependencies")
        if not calls or any(package.cmake.finds(name) for name in _LINTERS):
            return
        declared = {item.name for item in manifest.dependencies if item.kind == "test_depend"}
        if any("lint" in name and name != "ament_lint_auto" for name in declared):
            return
        if declared & _LINTERS or manifest.all("group_depend"):
            return
        last = manifest.dependencies[-1].element if manifest.dependencies else manifest.root
        line = calls[0].location.line
        message = (
            f"CMakeLists.txt:{line} runs the linters declared with <test_depend>, but there are "
            f"none; add <test_depend>ament_lint_common</test_depend>"
        )
        edit = manifest.insert("test_depend", "ament_lint_common")
        yield self.report(last.name_location, message, Fix("Declare ament_lint_common", (edit,)))
