"""The values of CMake variables, as far as the file itself determines them."""

from __future__ import annotations

import posixpath
from bisect import bisect_left
from collections import Counter
from collections.abc import Callable, Container, Iterable, Iterator, Mapping, Sequence
from functools import partial

from scaffold import lazy_re
from scaffold.model.cmake.parser import Argument, Command
from scaffold.model.cmake.results import CHANGING, changed, place_of_output, text_of
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
_MAX_NESTING = 16  # functions that call each other, and variables set from each other, in turns

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
_DEFINITIONS = frozenset({"function", "macro"})
_LOOPS = frozenset({"foreach", "while"})
REPEATED = _DEFINITIONS | _LOOPS
_GLOBS = (["GLOB"], ["GLOB_RECURSE"])
_GLOB_OPTIONS = frozenset({"LIST_DIRECTORIES", "RELATIVE"})
_PARTS: Mapping[str, Callable[[str], str]] = {
    "NAME": posixpath.basename,
    "NAME_WE": lambda path: posixpath.basename(path).partition(".")[0],
    "NAME_WLE": lambda path: posixpath.splitext(posixpath.basename(path))[0],
    "DIRECTORY": posixpath.dirname,
    "PATH": posixpath.dirname,
}
"""The parts of a path that ``get_filename_component`` returns."""
_PARTS_ARGUMENTS = len(("path", "NAME"))
_READING_LISTS = frozenset({"LENGTH", "GET", "JOIN", "SUBLIST", "FIND"})
Bindings = Mapping[str, str | None]
"""Values of the variables of loops, and of the parameters of functions; ``None`` if unknown."""

_NOWHERE: Bindings = {}

Glob = Callable[[str, str], list[str] | None]
"""Lists what ``GLOB`` or ``GLOB_RECURSE`` finds with a pattern; ``None`` if unknown."""


class _Turn(dict[str, "str | None"]):
    """The bindings in one turn of the loops, and one call of the function, around a command."""

    def __init__(
        self, bindings: Bindings, call: Command | None = None, caller: Bindings = _NOWHERE
    ) -> None:
        super().__init__(bindings)
        self.call = call
        """The call of the innermost function or macro."""
        self.caller = caller
        """The bindings at that call."""


class _Entry(NamedTuple):
    """The effect of a command on a variable; ``None`` if unknown."""

    command: Command
    value: str | None
    again: Callable[[Bindings], str | None] | None = None
    """Returns the value in one turn of the loops and calls around the command."""


class Variables:
    """Tracks ``set``, ``list``, ``string``, ``file(GLOB)``, ``unset``, ``foreach`` and calls.

    Args:
        commands: The commands of the file, and of those that it includes.
        directory: The directory of the file.
        project: The name in ``project``, as it is written.
        glob: Lists the files of the package, if known.
        is_subdirectory: Whether the project is that of a file above.
    """

    def __init__(
        self,
        commands: Sequence[Command],
        directory: str,
        project: str | None,
        glob: Glob | None = None,
        *,
        is_subdirectory: bool = False,
    ) -> None:
        current = f"{ROOT}/{directory}" if directory else ROOT
        top = ROOT if is_subdirectory else current
        self._glob = glob
        self._fixed: dict[str, str] = {
            "CMAKE_CURRENT_SOURCE_DIR": current,
            "CMAKE_CURRENT_LIST_DIR": current,
            "CMAKE_SOURCE_DIR": top,
            "PROJECT_SOURCE_DIR": top,
        }
        self._turns = _MAX_TURNS
        self._nesting = 0
        self._calls: dict[str, list[Command]] = {}
        self._definitions: Counter[str] = Counter()
        for command in commands:
            self._calls.setdefault(command.name, []).append(command)
            if command.name in _DEFINITIONS and command.arguments:
                self._definitions[command.values[0].lower()] += 1
        self._history: dict[str, list[_Entry]] = {}
        self._names = {
            argument.value
            for command in commands
            if command.name in {"set", "list", "unset", "file"}
            for argument in command.arguments[:2]
        }
        """All variables with possibly known values."""
        if project is not None:
            if "$" in project:
                self._follow_all(commands)
            name = self.evaluate(project, None, {})
            if name is not None:
                self._fixed["PROJECT_NAME"] = self._fixed["CMAKE_PROJECT_NAME"] = name
                self._fixed[f"{name}_SOURCE_DIR"] = top
        self._follow_all(commands)

    # -- asking

    def evaluate(self, text: str, at: Command | None, bindings: Bindings) -> str | None:
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
        self, argument: Argument, at: Command | None, bindings: Bindings
    ) -> list[str] | None:
        """Return the values of an argument, several for an unquoted list."""
        if argument.bracket:
            return [argument.text]
        value = self.evaluate(argument.text, at, bindings)
        if value is None:
            return None
        return [value] if argument.quoted else split_list(value)

    def combinations(self, command: Command) -> Iterator[Bindings] | None:
        """Return the values of variables in the turns of the loops around a command.

        A function or macro has a turn for each call, or one with unknown parameters. One empty
        mapping outside of both; ``None`` if a loop is over unknown values.
        """
        if command.depth > _MAX_DEPTH:
            return None
        turns: list[Bindings] = [{}]
        for block in _repeated(command):
            longer: list[Bindings] = []
            for turn in turns:
                self._turns -= len(block.arguments)
                more = self._turns_of(block, turn) if self._turns > 0 else None
                if more is None:
                    return None
                self._turns -= len(more)
                longer.extend(more)
            turns = longer
        return iter(turns)

    def _turns_of(self, block: Command, turn: Bindings) -> list[_Turn] | None:
        if block.name in _DEFINITIONS:
            return [*self._turns_of_calls(block)] or [_Turn(self._parameters(block, [], None))]
        loop = self._loop(block, turn)
        if loop is None:
            return None
        call, caller = (turn.call, turn.caller) if isinstance(turn, _Turn) else (None, {})
        return [_Turn({**turn, loop[0]: value}, call, caller) for value in loop[1]]

    def _turns_of_calls(self, definition: Command) -> Iterator[_Turn]:
        """Yield a turn for each call of a function or macro that is defined once."""
        name = definition.values[0].lower() if definition.arguments else ""
        if self._definitions[name] != 1 or self._nesting >= _MAX_NESTING:
            return
        self._nesting += 1
        for call in self._calls.get(name, ()):
            for caller in self.combinations(call) or ():
                given: list[str] = []
                for argument in call.arguments:
                    values = self.argument(argument, call, caller)
                    if values is None:
                        yield _Turn(self._parameters(definition, given, None), call, caller)
                        break
                    given += values
                else:
                    yield _Turn(self._parameters(definition, given, given), call, caller)
        self._nesting -= 1

    def _parameters(
        self, definition: Command, known: Sequence[str], given: Sequence[str] | None
    ) -> dict[str, str | None]:
        """Return the parameters in a call.

        Args:
            definition: The function or macro.
            known: The first arguments, as far as they are known.
            given: All arguments; ``None`` if some are unknown.
        """
        names = definition.values[1:]
        result: dict[str, str | None] = dict.fromkeys((*names, "ARGC", "ARGV", "ARGN"))
        result.update(zip(names, known, strict=False))
        if given is not None:
            result["ARGC"] = str(len(given))
            result["ARGV"] = ";".join(given)
            result["ARGN"] = ";".join(given[len(names) :])
        return result

    def _loop(self, loop: Command, bindings: Bindings) -> tuple[str, list[str]] | None:
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

    def _value(self, name: str, at: Command | None, bindings: Bindings) -> str | None:
        if name in bindings:
            return bindings[name]
        turn = bindings if isinstance(bindings, _Turn) else _Turn({})
        start = _start_of_function(at) if at is not None and turn.call is not None else -1
        history = self._history.get(name, [])
        before = len(history) if at is None else bisect_left(history, at.index, key=_index)
        first = max(before - _MAX_ENTRIES, 0)
        for entry in reversed(history[first:before]):
            if entry.command.index <= start:
                return self._value(name, turn.call, turn.caller)
            seen = _reaches(entry.command, at)
            if seen != "never":
                return self._value_in_turn(entry, at, turn) if seen == "surely" else None
        if before - first == _MAX_ENTRIES:
            return None
        return self._value_at_start(name, at, turn)

    def _value_at_start(self, name: str, at: Command | None, turn: _Turn) -> str | None:
        """Return a value that nothing before a command sets in the same function or file."""
        if turn.call is not None:
            return self._value(name, turn.call, turn.caller)
        if name == "CMAKE_CURRENT_LIST_DIR" and at is not None:
            directory = posixpath.dirname(at.path)
            return f"{ROOT}/{directory}" if directory else ROOT
        return self._fixed.get(name)

    def _value_in_turn(self, entry: _Entry, at: Command | None, bindings: _Turn) -> str | None:
        """Return a value, which may differ between the turns of loops."""
        if entry.again is None or at is None or not bindings:
            return entry.value
        blocks = _repeated(entry.command)
        if not blocks or blocks != _repeated(at):
            return entry.value
        if self._turns <= 0 or self._nesting >= _MAX_NESTING:
            return None
        self._turns -= 1
        self._nesting += 1
        value = entry.again(bindings)
        self._nesting -= 1
        return value

    # -- following

    def _follow_all(self, commands: Sequence[Command]) -> None:
        self._history = {}
        for command in commands:
            self._follow(command)

    def _follow(self, command: Command) -> None:
        name = command.name
        if name in HARMLESS:
            return
        if self._note_result(command):
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
            self._note(
                command,
                name.value,
                self._join(rest, command, {}),
                lambda turn: self._join(rest, command, turn),
            )

    def _note_result(self, command: Command) -> bool:
        """Note what a command returns in a variable; return whether it is such a command."""
        if command.name == "cmake_parse_arguments":
            self._parse_arguments(command)
        elif command.name == "get_filename_component":
            self._note_each(command, 0, self._component)
        elif command.name == "file" and command.values[:1] in _GLOBS:
            self._note_each(command, 1, self._globbed)
        elif command.name == "string" and (place := place_of_output(command.values)):
            self._note_each(command, place, self._text)
        elif command.name == "list" and command.values[:1] and command.values[0] in CHANGING:
            self._note_each(command, 1, self._changed)
        else:
            return False
        return True

    def _note_each(
        self,
        command: Command,
        position: int,
        result: Callable[[Command, Bindings], str | None],
    ) -> None:
        """Note the result of a command that writes it to one of its arguments."""
        if len(command.arguments) > position:
            name = command.arguments[position].value
            again = partial(result, command)
            self._note(command, name, again({}), again)

    def _globbed(self, command: Command, bindings: Bindings) -> str | None:
        """Return the files that ``file(GLOB)`` finds."""
        arguments = iter(command.arguments[2:])
        relative: str | None = None
        found: set[str] = set()
        for argument in arguments:
            values = self.argument(argument, command, bindings)
            if argument.value in _GLOB_OPTIONS:
                value = next(arguments, None)
                if value is not None and argument.value == "RELATIVE":
                    relative = self.evaluate(value.text, command, bindings)
                    if relative is None:
                        return None
            elif argument.value != "CONFIGURE_DEPENDS":
                for pattern in [None] if values is None else values:
                    matches = self._matches(command, pattern)
                    if matches is None:
                        return None
                    found.update(matches)
        if relative is None:
            return ";".join(sorted(found))
        if not all(path.startswith(f"{relative}/") for path in found):
            return None
        return ";".join(sorted(path.removeprefix(f"{relative}/") for path in found))

    def _matches(self, command: Command, pattern: str | None) -> list[str] | None:
        current = self._fixed["CMAKE_CURRENT_SOURCE_DIR"]
        if pattern is None or self._glob is None:
            return None
        full = pattern if pattern.startswith((ROOT, "/")) else f"{current}/{pattern}"
        if not full.startswith(f"{ROOT}/"):
            return None
        path = posixpath.normpath(full.removeprefix(f"{ROOT}/"))
        paths = self._glob(path, command.values[0])
        return None if paths is None else [f"{ROOT}/{path}" for path in paths]

    def _text(self, command: Command, bindings: Bindings) -> str | None:
        """Return the result of ``string``."""
        given = [self.evaluate(item.text, command, bindings) for item in command.arguments]
        known = [value for value in given if value is not None]
        return text_of(known) if len(known) == len(given) else None

    def _changed(self, command: Command, bindings: Bindings) -> str | None:
        """Return a list after ``list`` has removed or ordered items."""
        action, name = command.values[:2]
        if any(block.name in _LOOPS for block in command.blocks):
            return None  # each turn changes what the one before left
        before = self._value(name, command, bindings)
        words: list[str] = []
        for argument in command.arguments[2:]:
            values = self.argument(argument, command, bindings)
            if values is None:
                return None
            words += values
        return None if before is None else changed(split_list(before), action, words, ROOT)

    def _parse_arguments(self, command: Command) -> None:
        """Note what ``cmake_parse_arguments(PREFIX flags single multiple ...)`` sets."""
        prefix, *kinds = command.values[:4]
        if "PARSE_ARGV" in command.values[:1] or len(kinds) < len(("flags", "single", "multiple")):
            return
        keywords = {word for kind in kinds for word in kind.split(";")}
        for keyword in (*kinds[1].split(";"), *kinds[2].split(";")):
            again = partial(self._parsed, command, keyword, keywords)
            self._note(command, f"{prefix}_{keyword}", None, again)

    def _parsed(
        self, command: Command, keyword: str, keywords: Container[str], bindings: Bindings
    ) -> str | None:
        """Return what follows a keyword in the parsed arguments."""
        result: list[str] = []
        is_inside = False
        for argument in command.arguments[4:]:
            values = self.argument(argument, command, bindings)
            if values is None:
                return None
            for value in values:
                if value in keywords:
                    is_inside = value == keyword
                elif is_inside:
                    result.append(value)
        return ";".join(result)

    def _component(self, command: Command, bindings: Bindings) -> str | None:
        """Return the part of a path that ``get_filename_component`` returns."""
        _, *rest = command.arguments
        part = _PARTS.get(rest[1].value) if len(rest) == _PARTS_ARGUMENTS else None
        value = None if part is None else self.evaluate(rest[0].text, command, bindings)
        return None if part is None or value is None else part(value)

    def _append(self, command: Command) -> None:
        if len(command.arguments) < len(("APPEND", "variable")):
            return
        name = command.arguments[1].value
        before = self._value(name, command, {}) if name in self._history else ""
        added = self._join(command.arguments[2:], command, {})
        if before is None or added is None:
            self._note(command, name, None)
        else:
            self._note(command, name, ";".join(filter(None, (before, added))))

    def _join(self, arguments: Iterable[Argument], at: Command, bindings: Bindings) -> str | None:
        values = [
            argument.text if argument.bracket else self.evaluate(argument.text, at, bindings)
            for argument in arguments
        ]
        parts = [value for value in values if value is not None]
        return ";".join(parts) if len(parts) == len(values) else None

    def _forget(self, command: Command, arguments: Iterable[Argument]) -> None:
        """Mark a variable as unknown that a command may have written to."""
        for argument in arguments:
            if argument.kind == "unquoted" and argument.raw in self._names:
                self._note(command, argument.raw, None)

    def _note(
        self,
        command: Command,
        name: str,
        value: str | None,
        again: Callable[[Bindings], str | None] | None = None,
    ) -> None:
        if command.depth > _MAX_DEPTH or (
            value is not None and any(block.name in _LOOPS for block in command.blocks)
        ):
            value = None  # each turn of the loop may set another value
        if value is not None and len(value) > _LONGEST_VALUE:
            value = None
        self._history.setdefault(name, []).append(_Entry(command, value, again))


def split_list(value: str) -> list[str]:
    r"""Split a list at ``;`` like CMake: empty parts are dropped, ``\;`` is a plain ``;``."""
    if ";" not in value:
        return [value] if value else []
    return [part.replace("\\;", ";") for part in _SPLIT.findall(value)]


def _reaches(setter: Command, reader: Command | None) -> str:
    """Return whether a value reaches another command: ``surely``, ``perhaps``, ``never``."""
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


def _repeated(command: Command) -> list[Command]:
    """Return the loops, functions and macros around a command, the outermost first."""
    return [block for block in command.blocks if block.name in REPEATED]


def _start_of_function(command: Command) -> int:
    """Return the index of the innermost function or macro around a command."""
    starts = (block.index for block in command.blocks if block.name in _DEFINITIONS)
    return max(starts, default=-1)


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
