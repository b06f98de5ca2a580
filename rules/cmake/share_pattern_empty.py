"""CM100: the patterns of a directory leave something to install."""

from __future__ import annotations

from collections.abc import Iterator
from fnmatch import fnmatchcase

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.cmake import Install

_LISTS = (
    "project(talker)\ninstall(DIRECTORY config DESTINATION share/${{PROJECT_NAME}}{})\n"
    "ament_package()\n"
)
_FILES = {"config/talker.yaml": "talker:\n  ros__parameters:\n    rate: 1.0\n"}


class SharePatternEmpty(Rule):
    """The patterns of ``install(DIRECTORY)`` leave no file of the directory.

    **Why.** The directory is installed without its files, and without a word: they are not found
    at run time.

    **Fix.** Correct the pattern, or remove it.

    **Source.** CMake documentation, ``install(DIRECTORY)``: ``FILES_MATCHING``, ``PATTERN``.
    """

    code = "CM100"
    name = "share-pattern-empty"
    examples = (
        Example(
            "a file is left",
            {"CMakeLists.txt": _LISTS.format(' FILES_MATCHING PATTERN "*.yaml"'), **_FILES},
        ),
        Example(
            "another ending, in ROS 1",
            {
                "CMakeLists.txt": "if($ENV{ROS_VERSION} EQUAL 1)\n"
                + _LISTS.format(' FILES_MATCHING PATTERN "*.launch"')
                + "endif()\n",
                **_FILES,
            },
        ),
        Example(
            "another ending",
            {"CMakeLists.txt": _LISTS.format(' FILES_MATCHING PATTERN "*.yml"'), **_FILES},
            Report(
                "CMakeLists.txt:2:19",
                "the patterns match no file of config/, for instance config/talker.yaml",
            ),
        ),
        Example(
            "all excluded",
            {"CMakeLists.txt": _LISTS.format(' PATTERN "*.yaml" EXCLUDE'), **_FILES},
            Report(
                "CMakeLists.txt:2:19",
                "the patterns match no file of config/, for instance config/talker.yaml",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for install in package.cmake.installs:
            if install.kind != "DIRECTORY" or install.command.has("REGEX"):
                continue
            for item in install.items:
                path = item.path or ""
                files = [file for file in package.files if path and file.startswith(f"{path}/")]
                if files and not any(_is_taken(install, file) for file in files):
                    message = f"the patterns match no file of {path}/, for instance {files[0]}"
                    yield self.report(item, message)


def _is_taken(install: Install, path: str) -> bool:
    parts = path.split("/")
    if any(fnmatchcase(part, pattern) for part in parts for pattern in install.excludes):
        return False
    if not install.command.has("FILES_MATCHING"):
        return True
    return any(
        fnmatchcase(parts[-1], pattern) or fnmatchcase(path, f"*{pattern}")
        for pattern in install.patterns
    )
