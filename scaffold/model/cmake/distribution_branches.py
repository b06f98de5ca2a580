"""Branches of CMakeLists.txt that do not run on the target distribution.

Their conditions test ROS_DISTRO, or the version of a package that every distribution has.
"""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.distributions import VARIABLE
from scaffold.model.cmake.conditions import (
    UNKNOWN,
    Condition,
    Decision,
    Known,
    Scope,
    Word,
    compare,
)
from scaffold.model.cmake.lists import CMakeLists
from scaffold.model.cmake.parser import Argument, Command
from scaffold.model.cmake.variables import HARMLESS

WORDS = (VARIABLE, "_VERSION")
"""Words without which a file has no such branches."""
_CONDITIONS = frozenset({"if", "elseif", "else", "endif"})
_DEFINITIONS = frozenset({"function", "macro"})
_BODIES = _DEFINITIONS | {"foreach", "while"}
"""Commands that open a block that runs never, once or several times."""
_CASES = {"TOLOWER": str.lower, "TOUPPER": str.upper}

Lines = tuple[int, int]


def lines_not_run(lists: CMakeLists) -> Iterator[Lines]:
    """Yield the first and last lines of code that does not run on the target distribution."""
    dead = [*_Walk(lists).run()]
    pending = {name: body for name, body in _bodies(lists) if _calls(lists, name)}
    for _ in range(len(pending)):  # a function may only be called by an uncalled one
        unused = [
            name
            for name in pending
            if all(any(first <= at <= last for first, last in dead) for at in _calls(lists, name))
        ]
        if not unused:
            break
        dead += [pending.pop(name) for name in unused]
    yield from dead


def _bodies(lists: CMakeLists) -> Iterator[tuple[str, Lines]]:
    """Yield the functions and macros of a file, with the lines of their bodies."""
    opened: list[Command] = []
    for command in lists.own_commands:
        if command.name in _DEFINITIONS:
            opened.append(command)
        elif command.name.removeprefix("end") in _DEFINITIONS and opened:
            first = opened.pop()
            if first.values:
                lines = (_line(lists, first) + 1, _line(lists, command) - 1)
                yield first.values[0].lower(), lines


def _calls(lists: CMakeLists, name: str) -> list[int]:
    """Return the lines of a file that call a function."""
    return [_line(lists, command) for command in lists.own_commands if command.name == name]


def _line(lists: CMakeLists, command: Command) -> int:
    return lists.source.location(command.start, command.start).line


class _Block:
    """A block: an ``if`` up to the current branch, or the body of a function or loop."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.line = 0
        """The line of the command that opened the branch."""
        self.is_dead = False
        self.is_sure = False
        """Whether the branch certainly runs on the target."""
        self.left_at = 0
        """The line of a function after which no code runs."""
        self._is_decided = False
        self._is_open = False

    def enter(self, decision: Decision, line: int) -> None:
        """Continue with a branch.

        Args:
            decision: The decision on its condition; that of an ``else`` always holds.
            line: The first line.
        """
        holds = decision.holds if decision.is_specific else None
        self.line = line
        self.is_dead = self._is_decided or holds is False
        self.is_sure = not self.is_dead and not self._is_open and holds is True
        self._is_decided = self._is_decided or holds is True
        self._is_open = self._is_open or holds is None

    def enter_last(self, line: int) -> None:
        """Continue with the ``else``, which runs if no earlier branch does."""
        self.enter(Decision(holds=True, is_specific=True), line)


class _Walk:
    """Walks through a file from top to bottom, with the values of its variables."""

    def __init__(self, lists: CMakeLists) -> None:
        self._lists = lists
        self._scope = Scope()
        self._blocks: list[_Block] = []

    def run(self) -> Iterator[Lines]:
        for command in self._lists.own_commands:
            if command.name in _CONDITIONS:
                yield from self._branch(command, self._line(command))
            elif command.name in _BODIES:
                self._blocks.append(_Block(command.name))
                self._forget(command)
            elif command.name.startswith("end") and command.name[3:] in _BODIES:
                yield from self._close(command)
            elif _ends_file(command) and self._is_sure:
                holder = self._function
                if holder is None:
                    yield self._line(command) + 1, len(self._lists.source.lines)
                    return
                holder.left_at = holder.left_at or self._line(command)
            else:
                self._follow(command)

    # -- blocks

    def _branch(self, command: Command, line: int) -> Iterator[Lines]:
        block = self._blocks[-1] if self._blocks and self._blocks[-1].name == "if" else None
        if command.name == "if":
            block = _Block("if")
            self._blocks.append(block)
        elif block is None:
            return  # which is reported
        elif block.is_dead:
            yield block.line + 1, line - 1
        if command.name == "endif":
            self._blocks.pop()
        elif command.name == "else":
            block.enter_last(line)
        else:
            words = [_as_word(argument) for argument in command.arguments]
            block.enter(Condition(words, self._scope).decide(), line)

    def _close(self, command: Command) -> Iterator[Lines]:
        names = [block.name for block in self._blocks]
        if command.name[3:] not in names:
            return
        while self._blocks:
            block = self._blocks.pop()
            if block.name == command.name[3:]:
                if block.left_at:
                    yield block.left_at + 1, self._line(command) - 1
                return

    @property
    def _function(self) -> _Block | None:
        """The function around the command."""
        return next((block for block in reversed(self._blocks) if block.name == "function"), None)

    @property
    def _is_sure(self) -> bool:
        """Return whether a command is in a branch that certainly runs on the target."""
        around: list[_Block] = []
        for block in reversed(self._blocks):
            if block.name == "function":
                break
            around.append(block)
        return bool(around) and all(block.is_sure for block in around)

    # -- variables

    def _follow(self, command: Command) -> None:
        match command.name, [argument.value for argument in command.arguments]:
            case "set", [name, *rest] if not {"CACHE", "PARENT_SCOPE"} & {*rest}:
                self._set(name, self._list_value(command.arguments[1:]))
            case "unset", [name]:
                self._set(name, Known(""))
            case "list", ["APPEND", name, *_]:
                before, added = self._scope.lookup(name), self._list_value(command.arguments[2:])
                self._set(name, _appended(before, added))
            case "string", ["COMPARE", operator, _, _, name]:
                left, right = (
                    self._scope.expand(argument.text) for argument in command.arguments[2:4]
                )
                decision = compare(operator, left, right)
                value = None if decision.holds is None else str(int(decision.holds))
                self._set(name, Known(value, decision.is_specific))
            case "string", ["TOLOWER" | "TOUPPER" as case, _, name]:
                known = self._scope.expand(command.arguments[1].text)
                value = None if known.value is None else _CASES[case](known.value)
                self._set(name, known._replace(value=value))
            case _ if command.name not in HARMLESS:
                self._forget(command)

    def _set(self, name: str, value: Known) -> None:
        """Set a variable, if the command runs."""
        if any(block.is_dead for block in self._blocks):
            before = self._scope.lookup(name) if self._scope.is_set(name) else Known("")
            self._scope.set(name, before._replace(is_specific=True))
        elif all(block.is_sure for block in self._blocks):
            self._scope.set(
                name, value._replace(is_specific=value.is_specific or bool(self._blocks))
            )
        else:
            self._scope.set(name, UNKNOWN)

    def _forget(self, command: Command) -> None:
        """Mark variables as unknown that a command may write to."""
        for argument in command.arguments:
            if not argument.quoted and self._scope.is_set(argument.value):
                self._scope.set(argument.value, UNKNOWN)

    def _list_value(self, arguments: list[Argument]) -> Known:
        known = [
            Known(argument.text) if argument.bracket else self._scope.expand(argument.text)
            for argument in arguments
        ]
        values = [argument.value for argument in known if argument.value is not None]
        is_all = len(values) == len(known)
        return Known(
            ";".join(values) if is_all else None, any(argument.is_specific for argument in known)
        )

    def _line(self, command: Command) -> int:
        return _line(self._lists, command)


def _as_word(argument: Argument) -> Word:
    return Word(argument.text, is_quoted=argument.quoted or argument.bracket)


def _ends_file(command: Command) -> bool:
    """Return whether no command of the file runs after another one."""
    return command.name == "return" or (
        command.name == "message" and command.values[:1] == ["FATAL_ERROR"]
    )


def _appended(before: Known, added: Known) -> Known:
    if before.value is None or added.value is None:
        return UNKNOWN
    value = ";".join(filter(None, (before.value, added.value)))
    return Known(value, before.is_specific or added.is_specific)
