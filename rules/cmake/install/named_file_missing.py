"""CM011: files and directories named in CMakeLists.txt exist."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator

from scaffold.api import (
    CreateFile,
    Diagnostic,
    Effect,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    closest_name,
)
from scaffold.api.cmake import (
    CMakeLists,
    Command,
    Install,
    InstallItem,
    generations,
    is_made_by_build,
    subdirectories,
)
from scaffold.api.interfaces import SECTIONS, closest_word
from scaffold.api.workspace import is_untracked

from ._globs import interface_patterns_without_files

_INSTALL = "project(talker)\ninstall({} DESTINATION share/${{PROJECT_NAME}})\n"
_ENDINGS = (".cpp", ".cc", ".cxx", ".c", ".py")
_MAKERS = (
    *("configure_file", "file", "execute_process", "externalproject_add"),
    *("fetchcontent_declare", "include"),
)
"""Commands that may create files that git does not have."""
_MAKING = ("configure_file", "execute_process", "add_custom_command", "fetchcontent_declare")
"""Commands that may create interfaces before CMake collects them."""
_MAKERS_OF_SOURCES = (
    *_MAKERS,
    *("add_custom_command", "add_custom_target", "generate_parameter_library"),
)
_MAKERS_OF_DIRECTORIES = (*_MAKERS, "fetchcontent_makeavailable")
_KEYWORDS = frozenset(
    {"PACKAGE_DIR", "VERSION", "SETUP_CFG", "DESTINATION", "SCRIPTS_DESTINATION", "SKIP_COMPILE"}
)
"""The keywords of ament_python_install_package."""
_LISTS = "project(talker)\nadd_executable(talker {})\n"
_LISTS_SUBDIRECTORIES = "project(talker)\nadd_subdirectory({})\n"
_TESTING = ("ament_add_pytest_test", "add_launch_test", "add_ros_test")
_LISTS_TESTS = "project(talker)\nament_add_pytest_test(talk test/{})\n"
_LISTS_INTERFACES = (
    "project(my_msgs)\nset(files %s)\nrosidl_generate_interfaces(${PROJECT_NAME} ${files})\n"
)
_GLOB = (
    "project(my_msgs)\nset(directory ${CMAKE_CURRENT_SOURCE_DIR}/%s)\n"
    'file(GLOB files RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} "${directory}/*.msg")\n'
    "rosidl_generate_interfaces(${PROJECT_NAME} ${files} DEPENDENCIES std_msgs)\n"
)
_LISTS_PACKAGE = "project(talker)\nament_python_install_package({})\n"
_FILE_KINDS = frozenset({"FILES", "PROGRAMS"})
_MAX_DEPTH = 4
"""More functions that call each other are not followed."""
_COMPILING = ("add_executable", "add_library", "ament_add_gmock", "ament_add_gtest")


class NamedFileMissing(Rule):
    """A command names a file or directory that does not exist or is of the wrong kind.

    **Why.** The build stops: ``file INSTALL cannot find``, ``Cannot find source file``,
    ``add_subdirectory given source "src" which is not an existing directory``, ``the passed file
    'msg/Bet.msg' doesn't exist``, ``ament_add_pytest_test() the path 'test/test_talks.py' does not
    exist``. Git does not keep empty directories: they exist only on the author's machine.

    **Fix.** Correct the name, or remove it. Python packages need an ``__init__.py``, but neither
    ``add_executable`` nor ``add_subdirectory``. Interfaces must be in a directory, and end in .msg,
    .srv, .action or .idl.

    **Source.** CMake documentation, ``install``, ``add_executable``, ``add_subdirectory``;
    ``rosidl_generate_interfaces.cmake``, ``ament_add_pytest_test.cmake``,
    ``ament_python_install_package.cmake``.
    """

    code = "CM011"
    name = "named-file-missing"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "existing, generated and optional files",
            {
                "CMakeLists.txt": _INSTALL.format("DIRECTORY launch")
                + _INSTALL.format("FILES ${CMAKE_CURRENT_BINARY_DIR}/made.yaml")
                + "install(DIRECTORY maps OPTIONAL DESTINATION share/${PROJECT_NAME})\n"
                + "install(DIRECTORY rviz DESTINATION share/${PROJECT_NAME}\n"
                + "        FILES_MATCHING PATTERN *.rviz)\n",
                "launch/talk.launch.py": "",
            },
        ),
        Example(
            "install() of a missing directory and a missing file",
            {
                "CMakeLists.txt": _INSTALL.format("DIRECTORY include/")
                + _INSTALL.format("PROGRAMS talker/nod.py"),
                "talker/node.py": "",
            },
            "CMakeLists.txt:2:19: installs the directory include/, which does not exist: the "
            "build stops",
            "CMakeLists.txt:4:18: installs talker/nod.py, which does not exist: the build stops; "
            "did you mean talker/node.py?",
        ),
        Example(
            "an empty directory",
            {"CMakeLists.txt": _INSTALL.format("DIRECTORY include/"), "include/": ""},
            "CMakeLists.txt:2:19: the directory include/ is empty: git does not keep it, so the "
            "build of a clone stops",
        ),
        Example(
            "a directory as a file, a pattern, and sources of a test",
            {
                "CMakeLists.txt": _INSTALL.format("FILES launch")
                + _INSTALL.format("PROGRAMS talker/*.py")
                + "if(BUILD_TESTING)\n  ament_add_gtest(test_talk test_talk.cpp walk.cpp)\n"
                "endif()\n",
                "launch/talk.launch.py": "",
                "talker/node.py": "",
                "walk.cpp": "",
            },
            "CMakeLists.txt:2:15: installs the directory launch/ as a file: the build stops; use "
            "DIRECTORY",
            "CMakeLists.txt:4:18: CMake does not expand talker/*.py: the build stops; write each "
            "file",
            "CMakeLists.txt:6:29: file test_talk.cpp does not exist: CMake stops",
        ),
        Example(
            "a directory that git ignores, and a package in a subdirectory",
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
        Example(
            "existing sources, directory, test and Python package",
            {
                "CMakeLists.txt": _LISTS.format("src/a.cpp ${CMAKE_BINARY_DIR}/made.cpp")
                + _LISTS_SUBDIRECTORIES.format("src")
                + _LISTS_TESTS.format("test_talk.py")
                + _LISTS_PACKAGE.format("${PROJECT_NAME}"),
                "src/CMakeLists.txt": "message(STATUS src)\n",
                "src/a.cpp": "",
                "test/test_talk.py": "",
                "talker/__init__.py": "",
            },
        ),
        Example(
            "a missing source file",
            {"CMakeLists.txt": _LISTS.format("src/a.cpp"), "src/b.cpp": ""},
            "CMakeLists.txt:2:23: file src/a.cpp does not exist: CMake stops; did you mean "
            "src/b.cpp?",
        ),
        Example(
            "a submodule of git, which a clone may not have",
            {
                "CMakeLists.txt": _LISTS_SUBDIRECTORIES.format("lib/json"),
                ".gitmodules": '[submodule "json"]\n  path = lib/json\n',
            },
        ),
        Example(
            "add_subdirectory() of a missing directory",
            {"CMakeLists.txt": _LISTS_SUBDIRECTORIES.format("src")},
            "2:18: adds the directory src/, which does not exist: CMake stops",
        ),
        Example(
            "add_subdirectory() of a directory without CMakeLists.txt",
            {"CMakeLists.txt": _LISTS_SUBDIRECTORIES.format("src"), "src/talker.py": ""},
            "CMakeLists.txt:2:18: adds src/, which has no CMakeLists.txt: CMake stops",
        ),
        Example(
            "an included file, and a module of CMake",
            {
                "CMakeLists.txt": "project(talker)\ninclude(cmake/scripts.cmake)\n"
                "include(GNUInstallDirs)\ninclude(${talker_DIR}/talkerConfig.cmake OPTIONAL)\n",
                "cmake/scripts.cmake": "macro(scripts)\nendmacro()\n",
            },
        ),
        Example(
            "functions that nothing calls",
            {
                "CMakeLists.txt": "project(talker)\nfunction(node)\n"
                "  add_executable(talk src/talk.cpp)\n"
                "  install(PROGRAMS talk.py DESTINATION lib/${PROJECT_NAME})\n"
                "  ament_add_pytest_test(talk test/test_talk.py)\nendfunction()\n",
            },
        ),
        Example(
            "a missing included file",
            {
                "CMakeLists.txt": "project(talker)\ninclude(cmake/script.cmake)\n",
                "cmake/scripts.cmake": "macro(scripts)\nendmacro()\n",
            },
            "CMakeLists.txt:2:9: includes cmake/script.cmake, which does not exist: CMake stops; "
            "did you mean cmake/scripts.cmake?",
        ),
        Example(
            "a function that is called if the directory exists",
            {
                "CMakeLists.txt": "project(talker)\nfunction(data name)\n"
                "  install(DIRECTORY ${name} DESTINATION share/${PROJECT_NAME})\nendfunction()\n"
                "if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/maps)\n  data(maps)\nendif()\n",
            },
        ),
        Example(
            "sources of a function",
            {
                "CMakeLists.txt": "project(talker)\nfunction(node name)\n"
                '  cmake_parse_arguments(ARG "" "" "SOURCES" ${ARGN})\n'
                "  add_executable(${name} ${ARG_SOURCES})\nendfunction()\n"
                "node(talk SOURCES src/talk.cpp src/words.cpp)\n",
                "src/talk.cpp": "",
                "src/word.cpp": "",
            },
            "CMakeLists.txt:6:32: file src/words.cpp does not exist: CMake stops; did you mean "
            "src/word.cpp?",
        ),
        Example(
            "a missing test",
            {"CMakeLists.txt": _LISTS_TESTS.format("test_talks.py"), "test/test_talk.py": ""},
            "CMakeLists.txt:2:28: test file test/test_talks.py does not exist: CMake stops; did "
            "you mean test/test_talk.py?",
        ),
        Example(
            "tests of a loop and of a macro",
            {
                "CMakeLists.txt": "project(talker)\nforeach(name talk listen)\n"
                "  ament_add_pytest_test(${name} test/test_${name}.py)\nendforeach()\n"
                "macro(look name)\n  ament_add_pytest_test(${name} test/${name}.py ${ARGN})\n"
                "endmacro()\nlook(test_talk TIMEOUT 60)\nlook(test_listens)\n",
                "test/test_talk.py": "",
            },
            "CMakeLists.txt:3:33: test file test/test_listen.py does not exist: CMake stops; did "
            "you mean test/test_talk.py?",
            "CMakeLists.txt:6:33: test file test/test_listens.py does not exist: CMake stops; did "
            "you mean test/test_talk.py?",
        ),
        Example(
            "scripts that a macro of an included file installs",
            {
                "CMakeLists.txt": "project(talker)\ninclude(cmake/scripts.cmake)\n"
                "scripts(scripts/talk.py scripts/listens.py)\n",
                "cmake/scripts.cmake": "macro(scripts)\n"
                "  install(PROGRAMS ${ARGN} DESTINATION lib/${PROJECT_NAME})\nendmacro()\n",
                "scripts/talk.py": "",
                "scripts/listen.py": "",
            },
            "CMakeLists.txt:3:25: installs scripts/listens.py, which does not exist: the build "
            "stops; did you mean scripts/listen.py?",
        ),
        Example(
            "interfaces that exist, or that the build generates",
            {
                "CMakeLists.txt": _LISTS_INTERFACES
                % "msg/Beat.msg ${CMAKE_CURRENT_BINARY_DIR}:msg/Made.msg",
                "msg/Beat.msg": "int32 count\n",
            },
        ),
        Example(
            "interfaces that are misspelled, or lack the directory",
            {
                "CMakeLists.txt": _LISTS_INTERFACES % "\n  msg/beat.msg\n  Beat.msg\n",
                "msg/Beat.msg": "int32 count\n",
            },
            "CMakeLists.txt:3:3: file 'msg/beat.msg' does not exist: CMake stops; did you mean "
            "'msg/Beat.msg'?",
            "CMakeLists.txt:4:3: file 'Beat.msg' does not exist: CMake stops; did you mean "
            "'msg/Beat.msg'?",
        ),
        Example(
            "an interface next to CMakeLists.txt",
            {"CMakeLists.txt": _LISTS_INTERFACES % "Beat.msg", "Beat.msg": "int32 count\n"},
            "CMakeLists.txt:2:11: Beat.msg is not in a subdirectory: CMake stops; move it to msg/",
        ),
        Example(
            "a file that is not an interface",
            {"CMakeLists.txt": _LISTS_INTERFACES % "msg/Beat.txt", "msg/Beat.txt": ""},
            "CMakeLists.txt:2:11: msg/Beat.txt is not a .msg, .srv, .action or .idl file: CMake "
            "stops",
        ),
        Example(
            "a Python package without __init__.py",
            {"CMakeLists.txt": _LISTS_PACKAGE.format("${PROJECT_NAME}"), "talker/node.py": ""},
            Report(
                "talker/__init__.py:1:1",
                "missing, but CMakeLists.txt, line 2 installs talker/ as a Python "
                "package: CMake stops",
                fix="Create talker/__init__.py",
            ),
            fixed={"talker/__init__.py": ""},
        ),
        Example(
            "a missing Python package",
            {"CMakeLists.txt": _LISTS_PACKAGE.format("talkers"), "talker/__init__.py": ""},
            "CMakeLists.txt:2:30: the Python package directory talkers/ does not exist: CMake "
            "stops",
        ),
        Example(
            "interfaces collected by a pattern",
            {"CMakeLists.txt": _GLOB % "msg", "msg/Bet.msg": "int8 x\n"},
        ),
        Example(
            "a pattern that no interface matches",
            {"CMakeLists.txt": _GLOB % "msg", "msgs/Bet.msg": "int8 x\n"},
            "CMakeLists.txt:3:54: no file matches 'msg/*.msg': CMake stops without interfaces; "
            "they are in msgs/",
        ),
        Example(
            "a file and a missing one of a subdirectory",
            {
                "CMakeLists.txt": "project(talker)\nadd_subdirectory(scripts)\n",
                "scripts/CMakeLists.txt": "install(PROGRAMS talk.py scripts/talk.py\n"
                "  DESTINATION lib/${PROJECT_NAME}\n)\n"
                "install(FILES ${PROJECT_SOURCE_DIR}/package.xml DESTINATION share)\n",
                "scripts/talk.py": "",
                "package.xml": "<package/>\n",
            },
            "scripts/CMakeLists.txt:1:26: installs scripts/scripts/talk.py, which does not exist: "
            "the build stops",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_installed(package)
        yield from self._check_sources(package)
        yield from self._check_subdirectories(package)
        yield from self._check_included(package)
        yield from self._check_tests(package)
        yield from self._check_interfaces(package)
        yield from self._check_package(package)

    def _check_installed(self, package: Package) -> Iterator[Diagnostic]:
        for lists in (package.cmake, *(subdirectories(package) or ())):
            yield from self._check_items(package, lists)

    def _check_items(self, package: Package, cmake: CMakeLists) -> Iterator[Diagnostic]:
        for install in cmake.installs:
            if install.kind not in {"PROGRAMS", "FILES", "DIRECTORY"} or install.command.has(
                "OPTIONAL"
            ):
                continue
            if install.command.has("FILES_MATCHING"):
                continue  # CMake skips a missing directory
            if not cmake.is_called(install.command):
                continue
            for item in install.items:
                problem = self._problem(package, cmake, install, item)
                is_pattern = "*" in item.argument.raw and item.argument.raw == item.path
                if is_pattern and install.kind in _FILE_KINDS:
                    problem = f"CMake does not expand {item.path}: the build stops; write each file"
                if problem:
                    written = cmake.where_written(install.command, item.argument, item.value)
                    yield self.report(written, problem)

    def _problem(
        self, package: Package, cmake: CMakeLists, install: Install, item: InstallItem
    ) -> str | None:
        path = item.path
        if not path or not self._is_own(path) or is_made_by_build(package, path):
            return None
        if _runs_if_exists(cmake, install.command) or _is_elsewhere(package, path):
            return None
        nested = [f"{directory}/" for directory in package.tree.nested]
        if any(f"{path}/".startswith(item) or item.startswith(f"{path}/") for item in nested):
            return None  # the files of a nested package are its own
        if install.kind == "DIRECTORY":
            return self._directory_problem(package, path)
        return self._file_problem(package, path)

    def _file_problem(self, package: Package, path: str) -> str | None:
        if package.has(path):
            return None
        if package.has_directory(path):
            return f"installs the directory {path}/ as a file: the build stops; use DIRECTORY"
        hint = _closest(package, path, package.files, 0.8)
        return f"installs {path}, which does not exist: the build stops{hint}"

    def _directory_problem(self, package: Package, path: str) -> str | None:
        if not package.has_directory(path):
            return f"installs the directory {path}/, which does not exist: the build stops"
        if not any(name.startswith(f"{path}/") for name in package.files):
            kept = "git does not keep it, so the build of a clone stops"
            return f"the directory {path}/ is empty: {kept}"
        return None

    def _is_own(self, path: str) -> bool:
        """Return whether a path certainly lies in the package."""
        return not path.startswith(("/", "..")) and path != "." and not set("$<*") & set(path)

    def _check_sources(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if cmake.find(*_MAKERS_OF_SOURCES):
            return
        for command in cmake.find(*_COMPILING):
            if not _runs_always(cmake, command) or not cmake.is_called(command):
                continue
            for argument in command.arguments[1:]:
                for value in cmake.values_of(argument, command):
                    path = cmake.path_of(value)
                    if set("$<*;") & set(value) or not value.endswith(_ENDINGS):
                        continue
                    if package.has(path) or path.startswith(("/", "..")):
                        continue
                    if _is_elsewhere(package, path):
                        continue
                    hint = _closest(package, path, package.files, 0.8)
                    message = f"file {path} does not exist: CMake stops{hint}"
                    yield self.report(cmake.where_written(command, argument, value), message)

    def _check_subdirectories(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        made = cmake.find(*_MAKERS_OF_DIRECTORIES)
        for command in cmake.find("add_subdirectory"):
            if made or command.blocks or not command.arguments:
                continue
            value = cmake.expand(command.arguments[0], command)
            if value is None or set("$<*") & set(value) or value.startswith(("/", "..")):
                continue
            path = cmake.path_of(value)
            if package.has(f"{path}/CMakeLists.txt") or _is_elsewhere(package, path):
                continue
            if not package.has_directory(path):
                message = f"adds the directory {path}/, which does not exist: CMake stops"
            elif any(name.startswith(f"{path}/") for name in package.files):
                message = f"adds {path}/, which has no CMakeLists.txt: CMake stops"
            else:
                continue  # a submodule that has not been cloned is an empty directory
            yield self.report(command.arguments[0], message)

    def _check_included(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        if cmake.find("configure_file", "file", "execute_process"):
            return
        for command in cmake.find_own("include"):
            value = cmake.expand(command.arguments[0], command) if command.arguments else None
            if value is None or not value.endswith(".cmake") or value.startswith(("/", "..")):
                continue
            path = cmake.path_of(value)
            if command.blocks or command.has("OPTIONAL") or command in cmake.followed:
                continue
            if not package.has(path) and not _is_elsewhere(package, path):
                hint = _closest(package, path, package.files, 0.8)
                message = f"includes {path}, which does not exist: CMake stops{hint}"
                yield self.report(command.arguments[0], message)

    def _check_tests(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        for command in filter(cmake.is_called, cmake.find(*_TESTING)):
            position = 1 if command.name == "ament_add_pytest_test" else 0
            if len(command.arguments) <= position:
                continue
            argument = command.arguments[position]
            for turn in cmake.turns(command):
                value = cmake.expand(argument, command, turn)
                if value is None or value.startswith(("/", "..", "$")) or "<" in value:
                    continue
                path = cmake.path_of(value)
                if package.has(path) or package.has_directory(path) or _is_elsewhere(package, path):
                    continue
                hint = _closest(package, path, package.python_files, 0.7)
                message = f"test file {path} does not exist: CMake stops{hint}"
                yield self.report(cmake.where_written(command, argument, value), message)

    def _check_interfaces(self, package: Package) -> Iterator[Diagnostic]:
        interfaces = [
            path for path in package.files if path.rpartition(".")[2] in {*SECTIONS, "idl"}
        ]
        made = [command.values for command in package.cmake.find("configure_file", "file")]
        for call in generations(package):
            globbed = (
                []
                if package.cmake.find(*_MAKING)
                else interface_patterns_without_files(package, call)
            )
            for argument, pattern in globbed[:1]:
                places = {path.rpartition("/")[0] for path in interfaces}
                hint = f"; they are in {places.pop()}/" if len(places) == 1 else ""
                message = f"no file matches {pattern!r}: CMake stops without interfaces{hint}"
                yield self.report(argument, message)
            for file in call.files:
                path, ending = file.path, file.path.rpartition(".")[2]
                if package.has(path) and ending not in {*SECTIONS, "idl"}:
                    message = f"{path} is not a .msg, .srv, .action or .idl file: CMake stops"
                    yield self.report(file.argument, message)
                elif package.has(path) and "/" not in path:
                    message = f"{path} is not in a subdirectory: CMake stops; move it to {ending}/"
                    yield self.report(file.argument, message)
                elif not package.has(path) and not any(path in values for values in made):
                    same = [
                        item for item in interfaces if item.lower().endswith(f"/{path.lower()}")
                    ]
                    hint = (
                        f"; did you mean {same[0]!r}?" if same else closest_word(path, interfaces)
                    )
                    message = f"file {path!r} does not exist: CMake stops{hint}"
                    yield self.report(file.argument, message)

    def _check_package(self, package: Package) -> Iterator[Diagnostic]:
        cmake = package.cmake
        for command in cmake.find("ament_python_install_package"):
            sections = command.sections(_KEYWORDS)
            chosen = sections.get("PACKAGE_DIR") or sections[""]
            directory = cmake.expand(chosen[0], command) if chosen else None
            if not chosen or directory is None or directory.startswith(("/", "..")):
                continue
            path = cmake.path_of(directory)
            init = f"{path}/__init__.py"
            line = command.location.line
            if _is_elsewhere(package, path):
                continue
            if not package.has_directory(path):
                message = f"the Python package directory {path}/ does not exist: CMake stops"
                yield self.report(chosen[0], message)
            elif not package.has(init):
                fix = Fix(f"Create {init}", (CreateFile(init, ""),))
                message = (
                    f"missing, but CMakeLists.txt, line {line} installs {path}/ as a Python "
                    f"package: CMake stops"
                )
                yield self.report(package.start_of(init), message, fix)


def _runs_always(cmake: CMakeLists, command: Command) -> bool:
    """Return whether no condition decides about a command, except that tests are built."""
    blocks = command.blocks
    if blocks and blocks[0].name in {"function", "macro"} and blocks[0].values:
        calls = cmake.find(blocks[0].values[0].lower())
        return len(blocks) == 1 and not any(call.blocks for call in calls)
    return len(blocks) <= cmake.guarded_by_testing(command)


def _closest(package: Package, path: str, files: Collection[str], cutoff: float) -> str:
    closest = closest_name(package, path, files, cutoff)
    return f"; did you mean {closest}?" if closest else ""


def _is_elsewhere(package: Package, path: str) -> bool:
    """Return whether a path is not tracked by git, or exists through a link to a directory."""
    return is_untracked(package, path) or _is_linked(package, path)


def _is_linked(package: Package, path: str) -> bool:
    if package.place is None:
        return False
    disk, at = package.outside, os.path.join(package.place, path)
    is_own = disk.real(at) == os.path.join(disk.real(package.place), path)
    return not is_own and disk.exists(at)


def _runs_if_exists(cmake: CMakeLists, command: Command, depth: int = 0) -> bool:
    """Return whether a command may run only if a file exists: ``if(EXISTS ...)``."""
    at = command
    while at.parent is not None and at.branch is not None:
        if at.parent.name in {"function", "macro"} and at.parent.values:
            calls = cmake.find(at.parent.values[0].lower())
            if depth >= _MAX_DEPTH or any(
                _runs_if_exists(cmake, call, depth + 1) for call in calls
            ):
                return True
        asked = [at.branch, at.parent] if at.branch.name == "else" else [at.branch]
        if any("EXISTS" in item.values for item in asked):
            return True
        at = at.parent
    return False
