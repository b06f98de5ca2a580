"""CM016: the installed Python package exists."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import CreateFile, Diagnostic, Effect, Example, Fix, Package, Report, Rule

_LISTS = "project(talker)\nament_python_install_package({})\n"


class PythonPackageMissing(Rule):
    """``ament_python_install_package`` names a directory that is no Python package.

    **Why.** CMake stops: the folder does not exist, or does not contain an ``__init__.py``.

    **Fix.** Write the name of the directory, or create its ``__init__.py``.

    **Source.** ``ament_cmake_python/cmake/ament_python_install_package.cmake``.
    """

    code = "CM016"
    name = "python-package-missing"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "there", {"CMakeLists.txt": _LISTS.format("${PROJECT_NAME}"), "talker/__init__.py": ""}
        ),
        Example(
            "no __init__.py",
            {"CMakeLists.txt": _LISTS.format("${PROJECT_NAME}"), "talker/node.py": ""},
            Report(
                "talker/__init__.py:1:1",
                "missing, but CMakeLists.txt, line 2 installs talker/: CMake stops",
                fix="create talker/__init__.py",
            ),
            fixed={"talker/__init__.py": ""},
        ),
        Example(
            "no directory",
            {"CMakeLists.txt": _LISTS.format("talkers"), "talker/__init__.py": ""},
            Report(
                "CMakeLists.txt:2:30",
                "the Python package folder talkers/ does not exist: CMake stops",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        for command in cmake.find("ament_python_install_package"):
            sections = command.sections(
                {
                    "PACKAGE_DIR",
                    "VERSION",
                    "SETUP_CFG",
                    "DESTINATION",
                    "SCRIPTS_DESTINATION",
                    "SKIP_COMPILE",
                }
            )
            chosen = sections.get("PACKAGE_DIR") or sections[""]
            directory = cmake.expand(chosen[0], command) if chosen else None
            if not chosen or directory is None or directory.startswith(("/", "..")):
                continue
            path = cmake.path_of(directory)
            init = f"{path}/__init__.py"
            line = command.location.line
            if not package.has_directory(path):
                message = f"the Python package folder {path}/ does not exist: CMake stops"
                yield self.report(chosen[0], message)
            elif not package.has(init):
                fix = Fix(f"create {init}", (CreateFile(init, ""),))
                message = f"missing, but CMakeLists.txt, line {line} installs {path}/: CMake stops"
                yield self.report(package.start_of(init), message, fix)
