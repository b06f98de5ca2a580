"""Step-by-step edits of a CMakeLists.txt: programs, directories, tests."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fnmatch import fnmatchcase

from scaffold.generate.edit.addition import ByHand, spliced
from scaffold.model.cmake import edit as cmake_edit
from scaffold.model.cmake.edit import Edits
from scaffold.model.cmake.lists import LAST_CALLS, CMakeLists, Install
from scaffold.model.cmake.parser import Argument, Command
from scaffold.source import Source

PYTEST = "ament_cmake_pytest"
PYTHON = "ament_cmake_python"
ADD_PYTEST = "ament_add_pytest_test"
TEST_TIMEOUT = 300
"""Seconds that a test file gets: the 60 of ament are not enough for nodes on a busy machine."""
LONG_CALL = 98
"""The length from which a call is written on two lines."""
INSTALL_PYTHON = "ament_python_install_package"
_NAME = "${PROJECT_NAME}"


def installs_program(lists: CMakeLists, path: str, package: str) -> bool:
    """Return whether a file is installed where ``ros2 run`` looks for programs."""
    return any(
        install.destination is not None
        and install.destination.rstrip("/") == f"lib/{package}"
        and _installs(lists, install, path)
        for install in lists.installs
    )


def runs_test(lists: CMakeLists, path: str) -> bool:
    """Return whether a pytest file is run, alone or with its directory."""
    for command in lists.commands:
        if not (command.name.startswith("ament_add_") and command.name.endswith("pytest_test")):
            continue
        arguments = lists.expand_list(command.arguments[1:2], command)
        for value in arguments or ():
            tested = lists.path_of(value)
            if path == tested or path.startswith(f"{tested}/"):
                return True
    return False


class Editor:
    """A CMakeLists.txt that is edited step by step and parsed again after each."""

    def __init__(self, source: Source, package: str) -> None:
        self.package = package
        self.by_hand: list[ByHand] = []
        self.lists = _read(source)

    def install_python(self) -> None:
        """Install the Python package with the name of the project."""
        if self.lists.find(INSTALL_PYTHON):
            return
        line = f"{INSTALL_PYTHON}({_NAME})"
        if self.refused(line):
            return
        self.edit(cmake_edit.insert_find_package(self.lists, PYTHON))
        self.edit(cmake_edit.insert_before_end(self.lists, [line]))

    def install_program(self, path: str) -> None:
        """Install a script where ``ros2 run`` looks for it."""
        if installs_program(self.lists, path, self.package):
            return
        line = f"install(PROGRAMS {path} DESTINATION lib/{_NAME})"
        if self.refused(line):
            return
        self.edit(_extension(self.lists, "PROGRAMS", path, f"lib/{self.package}"))
        if not installs_program(self.lists, path, self.package):
            self.edit(cmake_edit.insert_install(self.lists, "PROGRAMS", path, "lib"))
        if not installs_program(self.lists, path, self.package):
            self.refuse(line, "no safe place to insert it")

    def install_directory(self, path: str, files: Sequence[str] = ()) -> None:
        """Install a directory, its name included, to ``share/<package>``.

        If its files are installed one by one, the new ones are added to the list.
        """
        share = f"share/{_NAME}"
        if _installs_directory(self.lists, path):
            for file in files:
                if not _installs_file(self.lists, file):
                    line = f"install(FILES {file} DESTINATION {share}/{path})"
                    self.refuse(line, f"what installs {path}/ does not include it")
            return
        line = f"install(DIRECTORY {path} DESTINATION {share})"
        if self.refused(line):
            return
        for file in files:
            self.edit(_append_to_install(self.lists, file, f"share/{self.package}/{path}"))
        if files and all(_installs_file(self.lists, file) for file in files):
            return
        for make in (_share_keyword, _share_extension, _share_block):
            self.edit(make(self.lists, path))
            if _installs_directory(self.lists, path):
                return
        self.refuse(line, "no safe place to insert it")

    def add_test(self, path: str) -> None:
        """Run a pytest file when tests are built."""
        if runs_test(self.lists, path):
            return
        name = path.rpartition("/")[2].removesuffix(".py")
        line = f"{ADD_PYTEST}({name} {path} TIMEOUT {TEST_TIMEOUT})"
        by_hand = f"find_package({PYTEST} REQUIRED) and {line} inside if(BUILD_TESTING)"
        if self.refused(by_hand, is_test=True):
            return
        if not self.lists.finds_tests_automatically:
            self.edit(cmake_edit.insert_find_package(self.lists, PYTEST, testing=True))
        if len(line) > LONG_CALL:
            line = line.replace(" TIMEOUT", f"{self.lists.source.newline}    TIMEOUT")
        self.edit(_below_last_test(self.lists, line))
        if not runs_test(self.lists, path):
            self.edit(cmake_edit.insert_in_testing(self.lists, [line]))
        if not runs_test(self.lists, path):
            self.refuse(by_hand, "if(BUILD_TESTING) and endif() are not on lines of their own")

    def edit(self, edits: Edits | None) -> None:
        """Apply edits, unless CMake could not parse the result."""
        if not edits:
            return
        changed = CMakeLists.parse(spliced(self.lists.source, edits))
        if not changed.errors:
            self.lists = changed

    def refused(self, line: str, *, is_test: bool = False) -> bool:
        """Leave a line to the user if no edit of the file is safe; return whether that is so."""
        lists = self.lists
        ends = [call for call in lists.find(*LAST_CALLS) if call.depth == 0]
        if lists.project_name != self.package:
            self.refuse(line, f"the name of the project is not known to be {self.package!r}")
        elif not ends:
            self.refuse(line, f"there is no {LAST_CALLS[0]}() at the top level")
        elif not is_test and all(lists.guarded_by_testing(call) for call in ends):
            self.refuse(line, "the end of the file is not always reached")
        else:
            return False
        return True

    def refuse(self, line: str, reason: str) -> None:
        """Tell the user to add a line."""
        self.by_hand.append(ByHand(self.lists.source.path, line, reason))


def _read(source: Source) -> CMakeLists:
    lists = CMakeLists.parse(source)
    lists.require()
    return lists


# -- what exists


def _installs(lists: CMakeLists, install: Install, path: str) -> bool:
    if install.kind == "PROGRAMS":
        return any(
            item.path == path or (item.path is None and _globs(lists, item.argument, path))
            for item in install.items
        )
    if install.kind != "DIRECTORY" or not install.command.has("USE_SOURCE_PERMISSIONS"):
        return False
    return any(
        item.path is not None and item.argument.value.endswith("/")
        and path.rpartition("/")[0] == item.path
        for item in install.items
    )  # fmt: skip


def _globs(lists: CMakeLists, argument: Argument, path: str) -> bool:
    """Return whether an argument is a variable filled by ``file(GLOB)`` with such files."""
    for command in lists.find("file"):
        values = command.values
        if values[:1] in (["GLOB"], ["GLOB_RECURSE"]) and argument.raw == f"${{{values[1]}}}":
            patterns = lists.expand_list(command.arguments[2:], command) or []
            return any(fnmatchcase(path, lists.path_of(pattern)) for pattern in patterns)
    return False


def _installs_directory(lists: CMakeLists, path: str) -> bool:
    """Return whether a directory is installed already, with any destination."""
    return any(
        item.path is not None and (path == item.path or path.startswith(f"{item.path}/"))
        for install in lists.installs
        if install.kind == "DIRECTORY"
        for item in install.items
    )


def _installs_file(lists: CMakeLists, path: str) -> bool:
    """Return whether a file is installed: by name, by a list, or with a directory around it."""
    return any(
        _selects(install, path)
        if install.kind == "DIRECTORY" and item.path and path.startswith(f"{item.path}/")
        else item.path == path or (item.path is None and _globs(lists, item.argument, path))
        for install in lists.installs
        if install.kind in {"DIRECTORY", "FILES", "PROGRAMS"}
        for item in install.items
    )


def _selects(install: Install, path: str) -> bool:
    """Return whether the patterns of a directory let a file through; in doubt they do."""
    if not install.command.has("FILES_MATCHING") or install.command.has("REGEX"):
        return True
    name = path.rpartition("/")[2]
    return any(fnmatchcase(name, pattern) for pattern in install.patterns)


# -- where things are added


def _extension(lists: CMakeLists, kind: str, path: str, destination: str) -> Edits | None:
    """Add to the install command with the most similar files, in their style."""
    best: tuple[int, Install, Argument, str] | None = None
    for install in lists.installs:
        if not _is_extendable(install, kind, destination):
            continue
        neighbors = [item for item in install.items if _is_beside(item.path, path)]
        last = (neighbors or install.items)[-1]
        behind = install.items[-1].argument if _has_list(install) else last.argument
        rank = len(neighbors)
        if best is None or rank > best[0]:
            best = rank, install, behind, _written_like(lists, last.argument, last.path, path)
    if best is None:
        return None
    _, install, behind, written = best
    return cmake_edit.append_arguments(lists, install.command, behind, [written], raw=True)


def _is_extendable(install: Install, kind: str, destination: str) -> bool:
    at = install.destination
    return (
        install.kind == kind
        and install.command.name == "install"
        and install.command.depth == 0
        and install.rename is None
        and not install.patterns
        and not install.excludes
        and not install.command.has("FILES_MATCHING")
        and not install.command.has("OPTIONAL")
        and not install.command.has("CONFIGURATIONS")
        and at is not None
        and at.rstrip("/") == destination
        and bool(install.items)
    )


def _is_beside(text: str | None, other: str) -> bool:
    return text is not None and text.rpartition("/")[0] == other.rpartition("/")[0]


def _has_list(install: Install) -> bool:
    return any(item.path is None for item in install.items)


def _written_like(lists: CMakeLists, argument: Argument, path: str | None, new: str) -> str:
    """Write a path like its neighbor, with the same leading variables and quotes."""
    text, project = argument.text, f"{lists.project_name}/"
    directory, _, name = new.rpartition("/")
    if path is not None and path.rpartition("/")[0] == directory and not argument.bracket:
        old = path.rpartition("/")[2]
        if text.endswith(old):
            written = text.removesuffix(old) + name
            return f'"{written}"' if argument.quoted else written
    if text.startswith(f"{_NAME}/") and new.startswith(project):
        return f"{_NAME}/{new.removeprefix(project)}"
    return cmake_edit.quote(new)


def _append_to_install(lists: CMakeLists, path: str, destination: str) -> Edits | None:
    """Add a file to the install command that lists files of its directory."""
    if _installs_file(lists, path):
        return None
    neighbors = [
        install
        for install in lists.installs
        if _is_extendable(install, "FILES", destination)
        and any(_is_beside(item.path, path) for item in install.items)
    ]
    return _extension(lists, "FILES", path, destination) if neighbors else None


def _share_keyword(lists: CMakeLists, path: str) -> Edits | None:
    """Add a directory to ``ament_auto_package(INSTALL_TO_SHARE ...)``."""
    for command in lists.find(*LAST_CALLS[1:]):
        words = command.keyword(
            "INSTALL_TO_SHARE", {"INSTALL_TO_PATH", "USE_SCOPED_HEADER_INSTALL_DIR"}
        )
        if words and command.depth == 0:
            return cmake_edit.append_arguments(lists, command, words[-1], [path])
    return None


def _share_extension(lists: CMakeLists, path: str) -> Edits | None:
    return _extension(lists, "DIRECTORY", path, f"share/{lists.project_name}")


def _share_block(lists: CMakeLists, path: str) -> Edits | None:
    return cmake_edit.insert_install(lists, "DIRECTORY", path, "share")


def _below_last_test(lists: CMakeLists, line: str) -> Edits | None:
    """Add a call below the last one of its kind in the unconditional test section."""
    block = cmake_edit.testing_block(lists)
    calls = [call for call in _tests(lists) if block is not None and call.branch is block[0]]
    calls += [call for call in _tests(lists) if call.depth == 0 and lists.guarded_by_testing(call)]
    return cmake_edit.insert_below(lists, calls[-1], line) if calls else None


def _tests(lists: CMakeLists) -> Iterator[Command]:
    yield from lists.find(ADD_PYTEST)
