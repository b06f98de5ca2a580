"""CM092: the arguments of ``install`` are valid."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Package, Report, Rule, closest_name
from scaffold.api.cmake import Argument

_OF_FILES = ("PROGRAMS", "FILES", "DIRECTORY")
_KINDS = (
    *_OF_FILES,
    "TARGETS",
    "IMPORTED_RUNTIME_ARTIFACTS",
    "SCRIPT",
    "CODE",
    "EXPORT",
    "EXPORT_ANDROID_MK",
    "PACKAGE_INFO",
    "RUNTIME_DEPENDENCY_SET",
)
_KIND = "project(talker)\ninstall({} talker/node.py DESTINATION lib/${{PROJECT_NAME}})\n"
_LISTS = "project(talker)\ninstall(DIRECTORY launch{})\nament_package()\n"
_RENAMED = (
    "project(talker)\ninstall(FILES {} DESTINATION share/${{PROJECT_NAME}} RENAME talk.yaml)\n"
)
_FILES = {"launch/talk.launch.py": ""}


class InstallMalformed(Rule):
    """``install`` has no destination, starts with an unknown keyword, or renames several files.

    **Why.** CMake stops: ``install DIRECTORY given no DESTINATION!``, ``install called with unknown
    mode PROGRAM``, ``install PROGRAMS given RENAME option with more than one file``.

    **Fix.** Add ``DESTINATION share/${PROJECT_NAME}``, for programs ``lib/${PROJECT_NAME}``. The
    keywords are ``PROGRAMS`` for scripts, ``TARGETS`` for executables and libraries, ``DIRECTORY``
    and ``FILES``, in upper case. Call ``install`` once for each renamed file.

    **Source.** CMake documentation, ``install``.
    """

    code = "CM092"
    name = "install-malformed"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "with a destination",
            {"CMakeLists.txt": _LISTS.format(" DESTINATION share/${PROJECT_NAME}"), **_FILES},
        ),
        Example(
            "without a destination",
            {"CMakeLists.txt": _LISTS.format(""), **_FILES},
            "CMakeLists.txt:2:1: install(DIRECTORY) has no DESTINATION: CMake stops",
        ),
        Example(
            "programs", {"CMakeLists.txt": _KIND.format("PROGRAMS"), "talker/node.py": "pass\n"}
        ),
        Example("a variable", {"CMakeLists.txt": _KIND.format("${kind}")}),
        Example(
            "a letter is missing",
            {"CMakeLists.txt": _KIND.format("PROGRAM"), "talker/node.py": "pass\n"},
            Report(
                "CMakeLists.txt:2:9",
                "unknown install() keyword 'PROGRAM': CMake stops; did you mean PROGRAMS?",
                fix="Replace with PROGRAMS",
            ),
            fixed={"CMakeLists.txt": _KIND.format("PROGRAMS")},
        ),
        Example(
            "in lower case",
            {"CMakeLists.txt": _KIND.format("programs"), "talker/node.py": "pass\n"},
            Report(
                "CMakeLists.txt:2:9",
                "unknown install() keyword 'programs': CMake stops; did you mean PROGRAMS?",
                fix="Replace with PROGRAMS",
            ),
            fixed={"CMakeLists.txt": _KIND.format("PROGRAMS")},
        ),
        Example(
            "an unknown keyword",
            {"CMakeLists.txt": _KIND.format("BINARY"), "talker/node.py": "pass\n"},
            "CMakeLists.txt:2:9: unknown install() keyword 'BINARY': CMake stops",
        ),
        Example(
            "a renamed file",
            {"CMakeLists.txt": _RENAMED.format("a.yaml"), "a.yaml": "", "b.yaml": ""},
        ),
        Example(
            "several renamed files",
            {"CMakeLists.txt": _RENAMED.format("a.yaml b.yaml"), "a.yaml": "", "b.yaml": ""},
            "CMakeLists.txt:2:1: RENAME with 2 files: CMake stops; call install(FILES) for each",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for command in package.cmake.find("install"):
            if command.arguments:
                yield from self._check_kind(package, command.arguments[0])
            values = command.values
            if not values or values[0] not in _OF_FILES or {"DESTINATION", "TYPE"} & set(values):
                continue
            if any("$" in value and ";" not in value and "/" not in value for value in values[1:]):
                continue  # a variable may hold the keyword
            message = f"install({values[0]}) has no DESTINATION: CMake stops"
            yield self.report(command.name_location, message)
        yield from self._check_renamed(package)

    def _check_renamed(self, package: Package) -> Iterator[Diagnostic]:
        for install in package.cmake.installs:
            count = len(install.items)
            if install.kind in _OF_FILES[:2] and install.command.has("RENAME") and count > 1:
                message = (
                    f"RENAME with {count} files: CMake stops; call install({install.kind}) for each"
                )
                yield self.report(install.command.name_location, message)

    def _check_kind(self, package: Package, kind: Argument) -> Iterator[Diagnostic]:
        if kind.value in _KINDS or "$" in kind.value:
            return
        message, fix = f"unknown install() keyword {kind.value!r}: CMake stops", None
        closest = closest_name(package, kind.value.upper(), _KINDS, 0.7)
        if closest:
            edit = Edit(kind.path, kind.start, kind.end, closest)
            message = f"{message}; did you mean {closest}?"
            fix = Fix(f"Replace with {closest}", (edit,))
        yield self.report(kind, message, fix)
