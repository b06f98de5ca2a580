"""CM103: ``install`` is told what to install."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, nearest

_KINDS = (
    "TARGETS",
    "IMPORTED_RUNTIME_ARTIFACTS",
    "FILES",
    "PROGRAMS",
    "DIRECTORY",
    "SCRIPT",
    "CODE",
    "EXPORT",
    "EXPORT_ANDROID_MK",
    "PACKAGE_INFO",
    "RUNTIME_DEPENDENCY_SET",
)
_LISTS = "project(talker)\ninstall({} talker/node.py DESTINATION lib/${{PROJECT_NAME}})\n"


class InstallKindUnknown(Rule):
    """``install`` begins with a word that CMake does not know there.

    **Why.** CMake stops: ``install called with unknown mode PROGRAM``.

    **Fix.** Write ``PROGRAMS`` for scripts, ``TARGETS`` for what is compiled, ``DIRECTORY`` for
    directories, ``FILES`` for other files; in capitals.

    **Source.** CMake documentation, ``install``.
    """

    code = "CM103"
    name = "install-kind-unknown"
    examples = (
        Example(
            "programs", {"CMakeLists.txt": _LISTS.format("PROGRAMS"), "talker/node.py": "pass\n"}
        ),
        Example("a variable", {"CMakeLists.txt": _LISTS.format("${kind}")}),
        Example(
            "a letter is missing",
            {"CMakeLists.txt": _LISTS.format("PROGRAM"), "talker/node.py": "pass\n"},
            Report(
                "CMakeLists.txt:2:9",
                "install() knows no PROGRAM, PROGRAMS is meant: CMake stops",
                fix="write PROGRAMS",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("PROGRAMS")},
        ),
        Example(
            "in lower case",
            {"CMakeLists.txt": _LISTS.format("programs"), "talker/node.py": "pass\n"},
            Report(
                "CMakeLists.txt:2:9",
                "install() knows no programs, PROGRAMS is meant: CMake stops",
                fix="write PROGRAMS",
            ),
            fixed={"CMakeLists.txt": _LISTS.format("PROGRAMS")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.find("install"):
            if not command.arguments:
                continue
            first = command.arguments[0]
            word = first.value
            if word in _KINDS or "$" in word:
                continue
            meant = nearest(package, word.upper(), _KINDS, 0.7)
            if not meant:
                yield self.report(first, f"install() knows no {word}: CMake stops")
                continue
            edit = Edit("CMakeLists.txt", first.start, first.end, meant)
            message = f"install() knows no {word}, {meant} is meant: CMake stops"
            yield self.report(first, message, Fix(f"write {meant}", (edit,)))
