"""What calls of ``install`` install, and where."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from scaffold.model.cmake.parser import Argument, Command
from scaffold.model.cmake.variables import ROOT, Bindings, Variables
from scaffold.record import NamedTuple
from scaffold.source import Location

_INSTALL_KINDS = ("PROGRAMS", "FILES", "DIRECTORY", "TARGETS", "SCRIPT", "CODE", "EXPORT")
_INSTALL_KEYWORDS = frozenset(
    """
    DESTINATION PERMISSIONS CONFIGURATIONS COMPONENT NAMELINK_COMPONENT RENAME OPTIONAL
    EXCLUDE_FROM_ALL NAMELINK_ONLY NAMELINK_SKIP TYPE ARCHIVE LIBRARY RUNTIME OBJECTS FRAMEWORK
    BUNDLE PRIVATE_HEADER PUBLIC_HEADER RESOURCE FILE_SET CXX_MODULES_BMI INCLUDES EXPORT
    RUNTIME_DEPENDENCIES RUNTIME_DEPENDENCY_SET FILE_PERMISSIONS DIRECTORY_PERMISSIONS
    USE_SOURCE_PERMISSIONS MESSAGE_NEVER FILES_MATCHING PATTERN REGEX EXCLUDE NAMESPACE
    EXPORT_LINK_INTERFACE_LIBRARIES FILE ALL_COMPONENTS
    """.split()  # noqa: SIM905  forty quoted names would hide them
)
_FOR_BUILDING = ("ARCHIVE", "LIBRARY", "RUNTIME", "OBJECTS", "FRAMEWORK", "BUNDLE")
_FOR_USERS = ("INCLUDES", "PUBLIC_HEADER", "PRIVATE_HEADER", "RESOURCE", "FILE_SET")
_ARTIFACTS = frozenset({*_FOR_BUILDING, *_FOR_USERS})
_PREFIX = "${CMAKE_INSTALL_PREFIX}/"


class InstallItem(NamedTuple):
    """An installed item."""

    argument: Argument
    value: str | None
    """The argument with variables replaced; ``None`` if one of them is unknown."""
    path: str | None
    """The path relative to the root of the package; ``None`` for a target or if unknown."""

    @property
    def location(self) -> Location:
        """The place of the argument."""
        return self.argument.location


class Install(NamedTuple):
    """A call of ``install``, or of a macro that installs directories; one for each loop turn."""

    kind: str
    """``PROGRAMS``, ``FILES``, ``DIRECTORY``, ``TARGETS`` …"""
    items: list[InstallItem]
    destination: str | None
    """The destination with variables replaced; ``None`` if missing or unknown."""
    destination_argument: Argument | None
    destinations: dict[str, str | None]
    """The destinations of TARGETS by artifact, such as ``RUNTIME``; ``""`` is for all."""
    rename: str | None
    patterns: list[str]
    """The patterns that select files of a DIRECTORY."""
    excludes: list[str]
    command: Command

    @property
    def location(self) -> Location:
        """The place of the call."""
        return self.command.location


class InstallReader:
    """Reads the calls of ``install`` in a file.

    Args:
        variables: The variables of the file.
        directory: The directory of the file, from ``ROOT``.
        project_name: The name in ``project``, if known.
    """

    def __init__(self, variables: Variables, directory: str, project_name: str | None) -> None:
        self._variables = variables
        self._directory = directory
        self._project_name = project_name

    def read(self, command: Command, bindings: Bindings) -> Iterator[Install]:
        """Yield what a call installs in one turn of the loops around it."""
        if command.name != "install":
            keyword = "INSTALL_TO_SHARE"
            arguments = command.keyword(
                keyword, {"INSTALL_TO_PATH", "USE_SCOPED_HEADER_INSTALL_DIR"}
            )
            if arguments:
                name = self._project_name
                share = None if name is None else f"share/{name}"
                items = self._items(arguments, command, bindings, are_files=True)
                yield Install("DIRECTORY", items, share, None, {}, None, [], [], command)
            return
        kind = next(iter(command.values), "")
        if kind not in _INSTALL_KINDS:
            return
        sections = command.sections({kind, *_INSTALL_KEYWORDS})
        destination = next(iter(sections.get("DESTINATION", ())), None)
        rename = next(iter(sections.get("RENAME", ())), None)
        patterns, excludes = _patterns(command)
        yield Install(
            kind,
            self._items(sections[kind], command, bindings, are_files=kind in _INSTALL_KINDS[:3]),
            self._expanded(destination, command, bindings),
            destination,
            self._destinations(command, bindings),
            self._expanded(rename, command, bindings),
            patterns,
            excludes,
            command,
        )

    def _items(
        self,
        arguments: Sequence[Argument],
        command: Command,
        bindings: Bindings,
        *,
        are_files: bool,
    ) -> list[InstallItem]:
        install_items: list[InstallItem] = []
        for argument in arguments:
            values = self._variables.argument(argument, command, bindings)
            if values is None:
                install_items.append(InstallItem(argument, None, None))
                continue
            for value in values:
                full = value if value.startswith((ROOT, "/")) else f"{self._directory}/{value}"
                path = plain_path(full) if are_files else None
                install_items.append(InstallItem(argument, shown(value), path))
        return install_items

    def _destinations(self, command: Command, bindings: Bindings) -> dict[str, str | None]:
        """Return the destination of each kind of artifact of a target."""
        result: dict[str, str | None] = {}
        artifact = ""
        arguments = iter(command.arguments)
        for argument in arguments:
            value = argument.value
            if value in _ARTIFACTS:
                artifact = value
            elif value == "DESTINATION":
                where = next(arguments, None)
                if where is not None:
                    result[artifact] = self._expanded(where, command, bindings)
        return result

    def _expanded(
        self, argument: Argument | None, command: Command, bindings: Bindings
    ) -> str | None:
        """Return an argument with variables replaced, and without an explicit prefix."""
        if argument is None:
            return None
        text = argument.text.removeprefix(_PREFIX)
        value = text if argument.bracket else self._variables.evaluate(text, command, bindings)
        return None if value is None else re.sub("/{2,}", "/", shown(value))


def _patterns(command: Command) -> tuple[list[str], list[str]]:
    """Return the including and excluding patterns of install(DIRECTORY)."""
    selected: list[str] = []
    excluded: list[str] = []
    values = command.values
    for number, value in enumerate(values[:-1]):
        if value not in {"PATTERN", "REGEX"}:
            continue
        behind = values[number + 2 : number + 3]
        (excluded if behind == ["EXCLUDE"] else selected).append(values[number + 1])
    return selected, excluded


def plain_path(full: str) -> str:
    """Return a path that begins with ``ROOT`` relative to it, without ``.`` and ``..``."""
    parts: list[str] = []
    for part in full.removeprefix(ROOT).split("/"):
        if part == ".." and parts and parts[-1] != "..":
            parts.pop()
        elif part not in {"", "."}:
            parts.append(part)
    absolute = "/" if full.startswith("/") else ""
    return absolute + "/".join(parts) or "."


def shown(value: str) -> str:
    """Return paths below the root of the package in their usual form."""
    if ROOT not in value:
        return value
    return value.replace(f"{ROOT}/", "").replace(ROOT, ".") or "."
