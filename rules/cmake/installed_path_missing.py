"""CM011: what is installed exists."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, closest_name
from scaffold.api.cmake import Install, InstallItem, is_made_by_build, runs_if_exists
from scaffold.api.workspace import is_untracked

_INSTALL = "project(talker)\ninstall({} DESTINATION share/${{PROJECT_NAME}})\n"


class InstalledPathMissing(Rule):
    """``install`` names a file or a directory that does not exist.

    **Why.** The build stops: ``file INSTALL cannot find``. An empty directory is there only on
    the machine of its author: git does not keep it.

    **Fix.** Correct the name, or remove it.

    **Source.** CMake documentation, ``install``.
    """

    code = "CM011"
    name = "installed-path-missing"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "there; a generated file and an optional one may come later",
            {
                "CMakeLists.txt": _INSTALL.format("DIRECTORY launch")
                + _INSTALL.format("FILES ${CMAKE_CURRENT_BINARY_DIR}/made.yaml")
                + "install(DIRECTORY maps OPTIONAL DESTINATION share/${PROJECT_NAME})\n",
                "launch/talk.launch.py": "",
            },
        ),
        Example(
            "a directory and a file that are not there",
            {
                "CMakeLists.txt": _INSTALL.format("DIRECTORY include/")
                + _INSTALL.format("PROGRAMS talker/nod.py"),
                "talker/node.py": "",
            },
            Report(
                "CMakeLists.txt:2:19",
                "installs the directory include/, which does not exist: the build stops",
            ),
            Report(
                "CMakeLists.txt:4:18",
                "installs talker/nod.py, which does not exist: the build stops; "
                "closest: talker/node.py",
            ),
        ),
        Example(
            "an empty directory",
            {"CMakeLists.txt": _INSTALL.format("DIRECTORY include/"), "include/": ""},
            Report(
                "CMakeLists.txt:2:19",
                "the directory include/ is empty: git does not keep it, then the build stops",
            ),
        ),
        Example(
            "a directory that git ignores, and a package in a directory",
            {
                "CMakeLists.txt": _INSTALL.format(
                    "DIRECTORY built templates templates/inner/launch"
                ),
                "templates/inner/package.xml": "<package/>\n",
                ".gitignore": "/built/\n",
            },
        ),
        Example(
            "a file that git ignores in one directory",
            {
                "CMakeLists.txt": _INSTALL.format("PROGRAMS simulator/controller"),
                "simulator/.gitignore": "/controller\n",
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for install in package.cmake.installs:
            if install.kind not in {"PROGRAMS", "FILES", "DIRECTORY"} or install.command.has(
                "OPTIONAL"
            ):
                continue
            for item in install.items:
                problem = self._problem(package, install, item)
                if problem:
                    yield self.report(item, problem)

    def _problem(self, package: Package, install: Install, item: InstallItem) -> str | None:
        path = item.path
        if not path or not self._is_own(path) or is_made_by_build(package, path):
            return None
        if runs_if_exists(install.command) or is_untracked(package, path):
            return None
        nested = [f"{directory}/" for directory in package.tree.nested]
        if any(f"{path}/".startswith(item) or item.startswith(f"{path}/") for item in nested):
            return None  # the files of a package inside of this one are its own
        if install.kind == "DIRECTORY":
            return self._directory_problem(package, path)
        if package.has(path):
            return None
        closest = closest_name(package, path, package.files, 0.8)
        hint = f"; closest: {closest}" if closest else ""
        return f"installs {path}, which does not exist: the build stops{hint}"

    def _directory_problem(self, package: Package, path: str) -> str | None:
        if not package.has_directory(path):
            return f"installs the directory {path}/, which does not exist: the build stops"
        if not any(name.startswith(f"{path}/") for name in package.files):
            return f"the directory {path}/ is empty: git does not keep it, then the build stops"
        return None

    def _is_own(self, path: str) -> bool:
        """Tell whether a path certainly lies in the package."""
        return not path.startswith(("/", "..")) and path != "." and not set("$<*") & set(path)
