"""The files of a package that its CMakeLists.txt includes."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.model.cmake.variables import REPEATED
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.cmake.lists import CMakeLists
    from scaffold.model.cmake.parser import Command
    from scaffold.model.package_files import PackageFiles

_MAX_COMMANDS = 20_000  # of all files


def splice_included(files: PackageFiles, lists: CMakeLists) -> None:
    """Add the commands of included files to those of a file, which may list files from now on.

    Args:
        files: The files of the package.
        lists: The file.
    """
    inclusion = _Inclusion(files, lists)
    lists.splice(inclusion.commands, inclusion.followed, files.listed)


class _Inclusion:
    def __init__(self, files: PackageFiles, lists: CMakeLists) -> None:
        self.followed: set[Command] = set()
        """The calls of ``include`` whose file is known."""
        self._files = files
        self._modules = [*module_directories(lists)]
        self._paths = {lists.source.path}
        self._left = _MAX_COMMANDS - len(lists.own_commands)
        self.commands = [*self._commands(lists)]
        """All commands, in the order in which CMake runs them."""
        for number, command in enumerate(self.commands):
            command.index = number

    def _commands(self, lists: CMakeLists) -> Iterator[Command]:
        for command in lists.own_commands:
            yield command
            if command.name == "include":
                below = self._included(lists, command)
                for inner in below.own_commands if below is not None else ():
                    inner.depth += command.depth
                    if inner.parent is None:
                        inner.parent, inner.branch = command.parent, command.branch
                yield from () if below is None else self._commands(below)

    def _included(self, lists: CMakeLists, command: Command) -> CMakeLists | None:
        """Return a file that is included for the first time; notes whether it is known."""
        if any(block.name in REPEATED for block in command.blocks):
            return None
        path = named_file(self._files, "", lists, command, self._modules)
        if path is None:
            return None
        if path in self._paths:
            self.followed.add(command)
            return None
        try:
            below = lists.parse(self._files.source(path))
        except ViewError:
            return None
        self._left -= len(below.own_commands)
        if below.errors or self._left < 0:
            return None
        self._paths.add(path)
        self.followed.add(command)
        return below


def named_file(
    files: PackageFiles, directory: str, lists: CMakeLists, command: Command, modules: list[str]
) -> str | None:
    """Return the file of the package that ``add_subdirectory`` or ``include`` names.

    Args:
        files: The files of the package.
        directory: The directory of the file with the command.
        lists: The file with the command.
        command: The command.
        modules: The directories in which ``include`` looks for modules.
    """
    value = lists.expand(command.arguments[0], command) if command.arguments else None
    if value is None:
        return None
    if command.name == "add_subdirectory":
        places = [posixpath.join(directory, value, "CMakeLists.txt")]
    else:
        # An expanded path is relative to the root of the package, others to the directory.
        places = [posixpath.join(directory, value), value]
        places += [posixpath.join(module, f"{value}.cmake") for module in modules]
    paths = map(posixpath.normpath, places)
    return next((path for path in paths if files.has(path)), None)


def module_directories(lists: CMakeLists) -> Iterator[str]:
    """Yield the directories of the package in which ``include`` looks for modules."""
    for command in lists.find("set", "list"):
        if "CMAKE_MODULE_PATH" in command.values[:2]:
            for argument in command.arguments[1:]:
                yield from lists.expand_list([argument], command) or ()
