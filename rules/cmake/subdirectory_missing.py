"""CM102: directories that are added have a CMakeLists.txt."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule
from scaffold.api.workspace import is_untracked

_LISTS = "project(talker)\nadd_subdirectory({})\n"


class SubdirectoryMissing(Rule):
    """``add_subdirectory`` names a directory that is not there, or has no CMakeLists.txt.

    **Why.** CMake stops: ``add_subdirectory given source "src" which is not an existing
    directory``.

    **Fix.** Correct the name, or remove the line: a Python package needs none.

    **Source.** CMake documentation, ``add_subdirectory``.
    """

    code = "CM102"
    name = "subdirectory-missing"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "there",
            {"CMakeLists.txt": _LISTS.format("src"), "src/CMakeLists.txt": "message(STATUS src)\n"},
        ),
        Example(
            "a submodule of git, which a clone may not have",
            {
                "CMakeLists.txt": _LISTS.format("lib/json"),
                ".gitmodules": '[submodule "json"]\n  path = lib/json\n',
            },
        ),
        Example(
            "not there",
            {"CMakeLists.txt": _LISTS.format("src")},
            Report("2:18", "adds the directory src/, which does not exist: CMake stops"),
        ),
        Example(
            "without a CMakeLists.txt",
            {"CMakeLists.txt": _LISTS.format("src"), "src/talker.py": ""},
            Report("CMakeLists.txt:2:18", "adds src/, which has no CMakeLists.txt: CMake stops"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        made = cmake.find(
            "configure_file",
            "file",
            "execute_process",
            "externalproject_add",
            "fetchcontent_declare",
            "fetchcontent_makeavailable",
            "include",
        )
        for command in cmake.find("add_subdirectory"):
            if made or command.blocks or not command.arguments:
                continue
            value = cmake.expand(command.arguments[0], command)
            if value is None or set("$<*") & set(value) or value.startswith(("/", "..")):
                continue
            path = cmake.path_of(value)
            if package.has(f"{path}/CMakeLists.txt") or is_untracked(package, path):
                continue
            if not package.has_directory(path):
                message = f"adds the directory {path}/, which does not exist: CMake stops"
            elif any(name.startswith(f"{path}/") for name in package.files):
                message = f"adds {path}/, which has no CMakeLists.txt: CMake stops"
            else:
                continue  # a submodule that has not been cloned is an empty directory
            yield self.report(command.arguments[0], message)
