"""The values of CMake variables, as far as the file itself determines them."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping, Sequence

from scaffold import lazy_re
from scaffold.model.cmake.parser import Argument, Command
from scaffold.record import NamedTuple

ROOT = "\0"
"""Placeholder for the directory of the package; no file can contain it."""

_PIECE = lazy_re.compile(r"\\([\s\S])|\$\{|\}|[^\\$}]+|\$")
_SPLIT = lazy_re.compile(r"(?:[^;\\]|\\[\s\S]?)+")
_ESCAPES = {"t": "\t", "n": "\n", "r": "\r", ";": "\\;"}
_MAX_TURNS = 20_000  # turns of loops followed in a file
_LONGEST_VALUE = 20_000
_MAX_ENTRIES = 16  # commands examined for one value
_MAX_DEPTH = 200  # blocks around a command; deeper ones make values unknown

HARMLESS = frozenset(
    """
    add_compile_definitions add_compile_options add_custom_command add_custom_target
    add_definitions add_dependencies add_executable add_library add_subdirectory add_test
    cmake_minimum_required configure_file else elseif enable_testing endblock endforeach
    endfunction endif endmacro endwhile if include_directories install link_directories
    link_libraries message project return set_property set_target_properties
    target_compile_definitions target_compile_features target_compile_options
    target_include_directories target_link_libraries target_sources while
    ament_add_gmock ament_add_gtest ament_add_pytest_test ament_auto_package
    ament_export_dependencies ament_export_include_directories ament_export_libraries
    ament_export_targets ament_package ament_python_install_package
    ament_python_install_module ament_target_dependencies rosidl_generate_interfaces
    """.split()  # noqa: SIM905  fifty quoted names would hide them
)
"""Commands that set no variable."""
_GNU_DIRECTORIES = {
    "CMAKE_INSTALL_BINDIR": "bin",
    "CMAKE_INSTALL_SBINDIR": "sbin",
    "CMAKE_INSTALL_INCLUDEDIR": "include",
    "CMAKE_INSTALL_DATADIR": "share",
    "CMAKE_INSTALL_DATAROOTDIR": "share",
}
"""What GNUInstallDirs sets on every Linux; its directory for libraries differs."""
_LOOPS = frozenset({"foreach", "while"})
_READING_LISTS = frozenset({"LENGTH", "GET", "JOIN", "SUBLIST", "FIND"})


class _Entry(NamedTuple):
    """The effect of a command on a variable; ``None`` if unknown."""

    command: Command
    value: str | None


class Variables:
    """Tracks ``set``, ``list(APPEND)``, ``unset`` and ``foreach`` from top to bottom."""

    def __init__(self, commands: Sequence[Command], directory: str, project: str | None) -> None:
        current = f"{ROOT}/{directory}" if directory else ROOT
        self._fixed: dict[str, str] = dict.fromkeys(
            (
                "CMAKE_CURRENT_SOURCE_DIR",
                "CMAKE_CURRENT_LIST_DIR",
                "CMAKE_SOURCE_DIR",
                "PROJECT_SOURCE_DIR",
            ),
            current,
        )
        self._turns = _MAX_TURNS
        self._history: dict[str, list[_Entry]] = {}
        self._names = {
            argument.value
            for command in commands
            if command.name in {"set", "list", "unset"}
            for argument in command.arguments[:2]
        }
        """All variables with possibly known values."""
        if project is not None:
            if "$" in project:
                self._follow_all(commands)
            name = self.evaluate(project, None, {})
            if name is not None:
                self._fixed["PROJECT_NAME"] = self._fixed["CMAKE_PROJECT_NAME"] = name
                self._fixed[f"{name}_SOURCE_DIR"] = current
        self._follow_all(commands)

    # -- asking

    def evaluate(self, text: str, at: Command | None, bindings: Mapping[str, str]) -> str | None:
        """Replace escapes and ``${…}`` in a text; ``None`` if anything is unknown.

        Args:
            text: The text of an argument.
            at: The command with the argument; ``None`` means the end of the file.
            bindings: Values of the variables of loops.
        """
        if "$<" in text or "$ENV{" in text or "$CACHE{" in text:
            return None
        stack: list[list[str]] = [[]]
        size = 0
        for match in _PIECE.finditer(text):
            piece = match[0]
            if piece == "${":
                stack.append([])
            elif piece == "}" and len(stack) > 1:
                name = "".join(stack.pop())
                value = self._value(name, at, bindings)
                if value is None:
                    return None
                stack[-1].append(value)
            elif match[1] is not None:
                stack[-1].append(_ESCAPES.get(match[1], match[1]))
            else:
                stack[-1].append(piece)
            size += len(stack[-1][-1]) if stack[-1] else 0
            if size > _LONGEST_VALUE:
                return None
        return "".join(stack[0]) if len(stack) == 1 else None

    def argument(
        self, argument: Argument, at: Command | None, bindings: Mapping[str, str]
    ) -> list[str] | None:
        """Return the values of an argument, several for an unquoted list."""
        if argument.bracket:
            return [argument.text]
        value = self.evaluate(argument.text, at, bindings)
        if value is None:
            return None
        return [value] if argument.quoted else split_list(value)

    def combinations(self, command: Command) -> Iterator[Mapping[str, str]] | None:
        """Return the combinations of values of the variables of the loops around a command.

        One empty mapping without a loop; ``None`` if a loop is over unknown values.
        """
        if command.depth > _MAX_DEPTH:
            return None
        loops = [block for block in command.blocks if block.name in _LOOPS]
        if not loops:
            return iter(({},))
        combinations: list[dict[str, str]] = [{}]
        for loop in loops:
            longer: list[dict[str, str]] = []
            for bindings in combinations:
                self._turns -= len(loop.arguments)
                turns = self._loop(loop, bindings) if self._turns > 0 else None
                if turns is None:
                    return None
                self._turns -= len(turns[1])
                longer.extend({**bindings, turns[0]: value} for value in turns[1])
            combinations = longer
        return iter(combinations)

    def _loop(self, loop: Command, bindings: Mapping[str, str]) -> tuple[str, list[str]] | None:
        """Return the variable of a foreach and its values."""
        if loop.name == "while" or not loop.arguments:
            return None
        variable = loop.arguments[0].value
        rest = loop.arguments[1:]
        if rest and rest[0].value == "RANGE":
            return None
        modern = bool(rest) and rest[0].value == "IN"
        values: list[str] = []
        mode = "ITEMS"
        for argument in rest[1:] if modern else rest:
            if modern and argument.value in {"ITEMS", "LISTS", "ZIP_LISTS"}:
                mode = argument.value
                continue
            if mode == "ZIP_LISTS":
                return None
            if mode == "LISTS":
                value = self._value(argument.value, loop, bindings)
                parts = None if value is None else split_list(value)
            else:
                parts = self.argument(argument, loop, bindings)
            if parts is None:
                return None
            values.extend(parts)
        return variable, values

    def _value(self, name: str, at: Command | None, bindings: Mapping[str, str]) -> str | None:
        if name in bindings:
            return bindings[name]
        history = self._history.get(name, [])
        before = len(history)
        if at is not None:
            before = bisect_left(history, at.index, key=_index)
        if before > _MAX_ENTRIES:
            history = history[before - _MAX_ENTRIES : before]
            before = _MAX_ENTRIES
        for number in range(before - 1, -1, -1):
            entry = history[number]
            seen = _reaches(entry.command, at)
            if seen == "surely":
                return entry.value
            if seen == "perhaps":
                return None
        return None if before == _MAX_ENTRIES else self._fixed.get(name)

    # -- following

    def _follow_all(self, commands: Sequence[Command]) -> None:
        self._history = {}
        for command in commands:
            self._follow(command)

    def _follow(self, command: Command) -> None:
        name = command.name
        if name in HARMLESS:
            return
        if name == "include" and command.values == ["GNUInstallDirs"]:
            self._fixed.update(_GNU_DIRECTORIES)
        arguments = command.arguments
        if name == "set":
            self._set(command)
        elif name == "list" and arguments and arguments[0].value == "APPEND":
            self._append(command)
        elif name == "list" and arguments and arguments[0].value in _READING_LISTS:
            self._forget(command, arguments[2:])
        elif name == "unset" and arguments:
            self._note(command, arguments[0].value, "")
        elif name in {"foreach", "function", "macro"}:
            self._forget(command, arguments if name == "foreach" else arguments[1:])
        else:
            self._forget(command, arguments)

    def _set(self, command: Command) -> None:
        if not command.arguments:
            return
        name, *rest = command.arguments
        written = [argument.value for argument in rest]
        if "CACHE" in written:
            # The user may have set it.
            self._note(command, name.value, None)
        elif written and written[-1] == "PARENT_SCOPE":
            if command.depth:
                self._note(command, name.value, None)
        else:
            self._note(command, name.value, self._join(rest, command))

    def _append(self, command: Command) -> None:
        if len(command.arguments) < len(("APPEND", "variable")):
            return
        name = command.arguments[1].value
        before = self._value(name, command, {}) if name in self._history else ""
        added = self._join(command.arguments[2:], command)
        if before is None or added is None:
            self._note(command, name, None)
        else:
            self._note(command, name, ";".join(filter(None, (before, added))))

    def _join(self, arguments: Iterable[Argument], at: Command) -> str | None:
        values = [
            argument.text if argument.bracket else self.evaluate(argument.text, at, {})
            for argument in arguments
        ]
        parts = [value for value in values if value is not None]
        return ";".join(parts) if len(parts) == len(values) else None

    def _forget(self, command: Command, arguments: Iterable[Argument]) -> None:
        """Mark a variable as unknown that a command may have written to."""
        for argument in arguments:
            if argument.kind == "unquoted" and argument.raw in self._names:
                self._note(command, argument.raw, None)

    def _note(self, command: Command, name: str, value: str | None) -> None:
        if command.depth > _MAX_DEPTH or (
            value is not None and any(block.name in _LOOPS for block in command.blocks)
        ):
            value = None  # each turn of the loop may set another value
        if value is not None and len(value) > _LONGEST_VALUE:
            value = None
        self._history.setdefault(name, []).append(_Entry(command, value))


def split_list(value: str) -> list[str]:
    r"""Split a list at ``;`` like CMake: empty parts are dropped, ``\;`` is a plain ``;``."""
    if ";" not in value:
        return [value] if value else []
    return [part.replace("\\;", ";") for part in _SPLIT.findall(value)]


def _reaches(setter: Command, reader: Command | None) -> str:
    """Return whether a value reaches another command: ``certainly``, ``perhaps``, ``never``."""
    if max(setter.depth, reader.depth if reader is not None else 0) > _MAX_DEPTH:
        return "perhaps"
    opens_own_scope = setter.name in {"foreach", "function", "macro"}
    around = {id(block) for block in reader.blocks} if reader is not None else set()
    if opens_own_scope:
        return "surely" if id(setter) in around else "never"
    branches = dict(_branches(reader)) if reader is not None else {}
    for opener, branch in _branches(setter):
        reached = branches.get(opener)
        if reached is branch:
            continue
        if opener.name == "function":
            parents = setter.arguments[-1:]
            leaves = bool(parents) and parents[0].value == "PARENT_SCOPE"
            return "perhaps" if leaves else "never"
        if reached is not None:
            return "never"  # in another branch of the same if()
        return "perhaps"
    return "surely"


def _index(entry: _Entry) -> int:
    return entry.command.index


def _branches(command: Command) -> Iterator[tuple[Command, Command]]:
    """Yield the blocks around a command with the branch that it is in, the outermost first."""
    result: list[tuple[Command, Command]] = []
    at = command
    while at.parent is not None and at.branch is not None:
        result.append((at.parent, at.branch))
        at = at.parent
    return iter(result[::-1])
