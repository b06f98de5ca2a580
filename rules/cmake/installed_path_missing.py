"""CM011: what is installed exists."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.cmake import Install, InstallItem
from scaffold.model.cmake_parser import Command
from scaffold.model.left_out import is_left_out
from scaffold.model.near import nearest

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
            at=("CMakeLists.txt:2", "CMakeLists.txt:4"),
        ),
        Example(
            "an empty directory",
            {"CMakeLists.txt": _INSTALL.format("DIRECTORY include/"), "include/": ""},
            at=("CMakeLists.txt:2",),
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
        if not path or not self._is_own(path) or self._is_made(package, path):
            return None
        if _is_asked_for(install.command) or is_left_out(package, path):
            return None
        if install.kind == "DIRECTORY":
            return self._directory_problem(package, path)
        if package.has(path):
            return None
        near = nearest(package, path, package.files, 0.8)
        hint = f"; {near} is near" if near else ""
        return f"installs {path}, which does not exist: the build stops{hint}"

    def _directory_problem(self, package: Package, path: str) -> str | None:
        if not package.has_directory(path):
            return f"installs the directory {path}/, which does not exist: the build stops"
        if not any(name.startswith(f"{path}/") for name in package.files):
            return f"the directory {path}/ is empty: git does not keep it, then the build stops"
        return None

    def _is_own(self, path: str) -> bool:
        """Tell whether a path surely lies in the package."""
        return not path.startswith(("/", "..")) and path != "." and not set("$<*") & set(path)

    def _is_made(self, package: Package, path: str) -> bool:
        """Tell whether the build itself makes the file, in the source directory."""
        name = path.rpartition("/")[2]
        makers = package.cmake.find(
            "configure_file",
            "file",
            "add_custom_command",
            "add_custom_target",
            "execute_process",
            "externalproject_add",
            "fetchcontent_declare",
            "generate_parameter_library",
        )
        if any(name in argument.value for maker in makers for argument in maker.arguments):
            return True
        # set(model "${PROJECT_SOURCE_DIR}/models/a.onnx"), and a command fetches it
        makers = [*package.cmake.find("set")] if makers else []
        return any(f"/{path}/" in argument.value for one in makers for argument in one.arguments)


def _is_asked_for(command: Command) -> bool:
    """Tell whether a command runs only where a file is: ``if(EXISTS ...)``."""
    at = command
    while at.parent is not None and at.branch is not None:
        if "EXISTS" in at.branch.values or (at.branch.name == "else" and _asks(at.parent)):
            return True
        at = at.parent
    return False


def _asks(opening: Command) -> bool:
    return "EXISTS" in opening.values
