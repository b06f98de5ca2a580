"""CM108: the sources of a target exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, closest_name
from scaffold.api.workspace import is_untracked

_ENDINGS = (".cpp", ".cc", ".cxx", ".c", ".py")
_MAKERS = (
    "configure_file",
    "file",
    "add_custom_command",
    "add_custom_target",
    "execute_process",
    "externalproject_add",
    "fetchcontent_declare",
    "include",
    "generate_parameter_library",
)
_LISTS = "project(talker)\nadd_executable(talker {})\n"


class SourceFileMissing(Rule):
    """``add_executable`` or ``add_library`` names a source file that does not exist.

    **Why.** CMake stops: ``Cannot find source file: src/talker.cpp``.

    **Fix.** Correct the name; a Python package needs no executable, but
    ``install(PROGRAMS ...)``.

    **Source.** CMake documentation, ``add_executable``.
    """

    code = "CM108"
    name = "source-file-missing"
    effect = Effect.STOPS_BUILD
    examples = (
        Example("there", {"CMakeLists.txt": _LISTS.format("src/a.cpp"), "src/a.cpp": ""}),
        Example(
            "made by the build", {"CMakeLists.txt": _LISTS.format("${CMAKE_BINARY_DIR}/made.cpp")}
        ),
        Example(
            "not there",
            {"CMakeLists.txt": _LISTS.format("src/a.cpp"), "src/b.cpp": ""},
            Report(
                "CMakeLists.txt:2:23", "there is no file src/a.cpp: CMake stops; closest: src/b.cpp"
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if cmake.find(*_MAKERS):
            return
        for command in cmake.find("add_executable", "add_library"):
            if command.blocks:
                continue
            for argument in command.arguments[1:]:
                value = cmake.expand(argument, command)
                if value is None or set("$<*;") & set(value) or not value.endswith(_ENDINGS):
                    continue
                path = cmake.path_of(value)
                if package.has(path) or path.startswith(("/", "..")) or is_untracked(package, path):
                    continue
                closest = closest_name(package, path, package.files, 0.8)
                hint = f"; closest: {closest}" if closest else ""
                message = f"there is no file {path}: CMake stops{hint}"
                yield self.report(argument, message)
