"""Parses CMakeLists.txt into commands, and reports every syntax error of CMake."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from scaffold.model.cmake.lexer import KNOWN_COMMANDS, MOST_ERRORS, LexicalError, Tokens, tokenize
from scaffold.record import NamedTuple
from scaffold.source import Location, Source

_ENDINGS = {
    "endif": "if",
    "endforeach": "foreach",
    "endwhile": "while",
    "endfunction": "function",
    "endmacro": "macro",
    "endblock": "block",
}
_OPENERS = frozenset(_ENDINGS.values())
_BRANCHES = frozenset({"elseif", "else"})
_BLANK = frozenset({"space", "newline", "comment"})
_WORDS = frozenset({"identifier", "unquoted", "quoted"})
_ARGUMENT_KINDS = _WORDS | {"bracket", "open", "close"}
# Adjacent arguments without a space: CMake warns after a word, and fails after a bracket.
_JOINED = {
    "space": "",
    "newline": "",
    "open": "",
    "close": "word",
    "identifier": "word",
    "unquoted": "word",
    "quoted": "word",
    "bracket": "bracket",
    "bracket_comment": "bracket",
}
_ESCAPES = {"t": "\t", "n": "\n", "r": "\r"}


class Argument:
    """An argument of a command; offsets are characters of the source's text."""

    __slots__ = ("_source", "end", "kind", "start")

    def __init__(self, source: Source, kind: str, start: int, end: int) -> None:
        self._source = source
        self.start = start
        self.end = end
        self.kind = "unquoted" if kind == "identifier" else kind
        """``unquoted``, ``quoted`` or ``bracket``; ``open`` and ``close`` for parentheses."""

    def __repr__(self) -> str:
        return self.raw

    @property
    def raw(self) -> str:
        """The argument as it is written."""
        return self._source.text[self.start : self.end]

    @property
    def path(self) -> str:
        """The file, which may be included by another one."""
        return self._source.path

    @property
    def quoted(self) -> bool:
        """Whether it is in double quotes."""
        return self.kind == "quoted"

    @property
    def bracket(self) -> bool:
        """Whether it is in ``[[`` and ``]]``."""
        return self.kind == "bracket"

    @property
    def text(self) -> str:
        """The text without quotes or brackets, with escapes and variables as written."""
        raw = self.raw.replace("\r\n", "\n")
        if self.kind == "quoted":
            return _without_continuations(raw[1:-1])
        if self.kind == "bracket":
            level = raw.index("[", 1) + 1
            return raw[level:-level].removeprefix("\n")
        return raw

    @property
    def value(self) -> str:
        """The text with escapes resolved; variables stay as they are written."""
        text = self.text
        return text if self.bracket or "\\" not in text else unescape(text)

    @property
    def location(self) -> Location:
        """The location, including quotes."""
        return self._source.location(self.start, self.end)


class Command:
    """A call of a command."""

    __slots__ = (
        "_arguments",
        "_first",
        "_last",
        "_source",
        "_tokens",
        "branch",
        "closed",
        "depth",
        "end",
        "index",
        "name",
        "open_end",
        "parent",
        "start",
        "written_name",
    )

    def __init__(self, source: Source, tokens: Tokens, name: int, opening: int) -> None:
        self._source = source
        self._tokens = tokens
        self._first = self._last = opening + 1
        self._arguments: list[Argument] | None = None
        self.start = tokens.starts[name]
        self.written_name = source.text[self.start : tokens.starts[name + 1]]
        self.name = self.written_name.lower()
        """The name in lower case, as CMake ignores case."""
        self.open_end = self.end = tokens.starts[opening + 1]
        """The offset after ``(``."""
        self.closed = False
        """Whether ``)`` exists."""
        self.index = 0
        """The number of the command in the file, from 0."""
        self.depth = 0
        """The number of blocks around it."""
        self.parent: Command | None = None
        """The command that opened the block around it: ``if``, ``foreach``, ``function`` …"""
        self.branch: Command | None = None
        """Like ``parent``, but the ``elseif`` or ``else`` of its branch."""

    def __repr__(self) -> str:
        return f"{self.written_name}({' '.join(map(repr, self.arguments))})"

    def close(self, last: int, *, closed: bool) -> None:
        """Set the end of the command; for the reader.

        Args:
            last: The index of the token after the last argument, which is ``)`` if it exists.
            closed: Whether it exists.
        """
        self._last = last
        self.closed = closed
        kinds, starts = self._tokens.kinds, self._tokens.starts
        if closed:
            self.end = starts[last + 1]
            return
        while last > self._first and kinds[last - 1] not in _ARGUMENT_KINDS:
            last -= 1
        self.end = starts[last]

    @property
    def arguments(self) -> list[Argument]:
        """The arguments; parentheses inside of them are arguments too."""
        if self._arguments is None:
            kinds, starts = self._tokens.kinds, self._tokens.starts
            self._arguments = [
                Argument(self._source, kinds[number], starts[number], starts[number + 1])
                for number in range(self._first, self._last)
                if kinds[number] in _ARGUMENT_KINDS
            ]
        return self._arguments

    @property
    def path(self) -> str:
        """The file, which may be included by another one."""
        return self._source.path

    @property
    def location(self) -> Location:
        """The place of the whole call."""
        return self._source.location(self.start, self.end)

    @property
    def name_location(self) -> Location:
        """The location of the name."""
        return self._source.location(self.start, self.start + len(self.name))

    @property
    def close_start(self) -> int:
        """The offset of ``)``."""
        return self.end - 1 if self.closed else self.end

    @property
    def blocks(self) -> tuple[Command, ...]:
        """The commands that opened the blocks around it, the outermost first."""
        return tuple(self._ancestors())[::-1]

    @property
    def values(self) -> list[str]:
        """The values of the arguments."""
        return [argument.value for argument in self.arguments]

    def sections(self, keywords: Collection[str]) -> dict[str, list[Argument]]:
        """Split the arguments at keywords; those before the first one are under ``""``.

        A keyword without arguments has an empty list; the arguments of one that occurs
        twice are joined.
        """
        result: dict[str, list[Argument]] = {"": []}
        current = result[""]
        for argument in self.arguments:
            if argument.kind in {"unquoted", "quoted"} and argument.value in keywords:
                current = result.setdefault(argument.value, [])
            else:
                current.append(argument)
        return result

    def keyword(self, name: str, keywords: Collection[str]) -> list[Argument]:
        """Return the arguments after a keyword, up to the next one."""
        return self.sections({name, *keywords}).get(name, [])

    def has(self, keyword: str) -> bool:
        """Return whether a keyword is among the arguments."""
        return any(argument.value == keyword for argument in self.arguments)

    def _ancestors(self) -> Iterator[Command]:
        parent = self.parent
        while parent is not None:
            yield parent
            parent = parent.parent


class Parsed(NamedTuple):
    """The commands of a file."""

    tokens: Tokens
    commands: list[Command]
    errors: list[tuple[Location, str]]


def parse(source: Source) -> Parsed:
    """Parse a file; ``errors`` are in file order."""
    tokens, lexical = tokenize(source.text)
    parser = _Parser(source, tokens, broken=bool(lexical))
    parser.run()
    nesting = _Nesting(source)
    nesting.run(parser.commands)
    # If a parenthesis is missing, errors about blocks would only mislead.
    errors = sorted({*lexical, *parser.errors} or nesting.errors)
    return Parsed(
        tokens,
        parser.commands,
        [(source.location(error.start, error.end), error.message) for error in errors],
    )


def unescape(text: str) -> str:
    r"""Replace escapes like CMake; ``\;`` is kept, as it matters in lists."""

    def replace(match: re.Match[str]) -> str:
        char = match[1]
        if char == ";":
            return "\\;"
        return _ESCAPES.get(char, char)

    return re.sub(r"\\([\s\S])", replace, text)


def _without_continuations(text: str) -> str:
    """Remove each backslash at the end of a line together with the line ending."""
    if "\\\n" not in text:
        return text
    return re.sub(r"\\([\s\S])", lambda match: "" if match[1] == "\n" else match[0], text)


class _Parser:
    """Parses the grammar of CMake, and recovers after errors."""

    def __init__(self, source: Source, tokens: Tokens, *, broken: bool) -> None:
        self.source = source
        self.tokens = tokens
        self.kinds = tokens.kinds
        self.commands: list[Command] = []
        self.errors: list[LexicalError] = []
        self.recovering = broken
        self.at = 0

    def run(self) -> None:
        kinds = self.kinds
        fresh_line = True
        while self.at < len(kinds):
            number = self.at
            kind = kinds[number]
            self.at += 1
            if kind == "newline":
                fresh_line = True
            elif kind == "bracket_comment":
                fresh_line = False
            elif kind == "identifier":
                if not fresh_line:
                    self._complain(number, "a new line expected before this command")
                fresh_line = False
                self._command(number)
            elif kind not in _BLANK:
                self._skip_stray(number)
                fresh_line = True

    def _skip_stray(self, number: int) -> None:
        """Skip a token that cannot start a command, and the rest of its line."""
        if self.kinds[number] == "close":
            self._complain(number, 'no "(" belongs to this ")"')
            return
        if self.kinds[number] != "bad":
            self._complain(number, "the name of a command expected")
        self._skip_line()

    def _skip_line(self) -> None:
        while self.at < len(self.kinds) and self.kinds[self.at] != "newline":
            self.at += 1

    def _command(self, name: int) -> None:
        opening = self.at = self._behind_space(self.at)
        if opening >= len(self.kinds) or self.kinds[opening] != "open":
            written = self.source.text[self.tokens.starts[name] : self.tokens.starts[name + 1]]
            self._complain(name, f'"(" expected after {written}')
            self._skip_line()
            return
        self.at += 1
        command = Command(self.source, self.tokens, name, opening)
        command.index = len(self.commands)
        self.commands.append(command)
        self._arguments(command)

    def _arguments(self, command: Command) -> None:
        kinds, first, at = self.kinds, self.at, self.at
        depth = 0
        joined = ""
        while at < len(kinds):
            kind = kinds[at]
            if kind == "close":
                if not depth:
                    command.close(at, closed=True)
                    self.at = at + 1
                    return
                depth -= 1
            elif kind == "open":
                depth += 1
            elif kind == "newline":
                if self.recovering and self._command_follows(at + 1):
                    break
            elif (joined == "bracket" and kind in _WORDS) or (joined and kind == "bracket"):
                self._complain(at, "a space expected before this argument")
            joined = _JOINED.get(kind, joined)
            at += 1
        self._unclosed(command, first, at)

    def _unclosed(self, command: Command, first: int, end: int) -> None:
        """Report a missing ``)``, and continue with a command inside of the arguments."""
        kinds = self.kinds
        if end < len(kinds) or kinds[-1] != "bad":  # otherwise it is inside of the unclosed part
            message = f'")" expected: {command.written_name}( is not closed'
            self._note(command.start, command.open_end, message)
        for number in range(first, end):
            if kinds[number] == "newline" and self._command_follows(number + 1):
                end = number
                break
        command.close(end, closed=False)
        self.at = end

    def _command_follows(self, number: int) -> bool:
        """Return whether a known command starts at a token, the first of its line."""
        kinds, starts = self.kinds, self.tokens.starts
        number = self._behind_space(number)
        if number >= len(kinds) or kinds[number] != "identifier":
            return False
        name = self.source.text[starts[number] : starts[number + 1]].lower()
        number = self._behind_space(number + 1)
        return name in KNOWN_COMMANDS and number < len(kinds) and kinds[number] == "open"

    def _behind_space(self, number: int) -> int:
        if number < len(self.kinds) and self.kinds[number] == "space":
            return number + 1
        return number

    def _complain(self, number: int, message: str) -> None:
        starts = self.tokens.starts
        self._note(starts[number], starts[number + 1], message)

    def _note(self, start: int, end: int, message: str) -> None:
        self.recovering = True
        if len(self.errors) < MOST_ERRORS:
            self.errors.append(LexicalError(start, end, message))


class _Nesting:
    """Assigns commands to their blocks; reports blocks that do not match."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.errors: list[LexicalError] = []
        self.blocks: list[Command] = []
        self.branches: list[Command] = []
        self.open_names: dict[str, int] = dict.fromkeys(_OPENERS, 0)

    def run(self, commands: list[Command]) -> None:
        for command in commands:
            opener = _ENDINGS.get(command.name, "if" if command.name in _BRANCHES else "")
            fits = bool(opener) and self._leave_inner(command, opener)
            self._place(command, len(self.blocks) - fits)
            if fits and command.name in _BRANCHES:
                if self.branches[-1].name == "else":
                    self._complain(command, "else() was the last branch of this if()")
                self.branches[-1] = command
            elif fits:
                self._close_block()
            elif command.name in _OPENERS:
                self.blocks.append(command)
                self.branches.append(command)
                self.open_names[command.name] += 1
        for command in self.blocks:
            message = f"end{command.name}() expected: this block is not closed"
            self._complain(command, message)

    def _place(self, command: Command, depth: int) -> None:
        command.depth = depth
        if depth:
            command.parent = self.blocks[depth - 1]
            command.branch = self.branches[depth - 1]

    def _leave_inner(self, end: Command, opener: str) -> bool:
        """Leave unclosed blocks inside the one that a command belongs to, if there is one."""
        if not self.open_names[opener]:
            self._complain(end, f"{opener}() expected before {end.name}()")
            return False
        line = self.source.position(end.start)[0]
        while self.blocks[-1].name != opener:
            block = self._close_block()
            message = f"end{block.name}() expected before the {end.name}() of line {line}"
            self._complain(block, message)
        return True

    def _close_block(self) -> Command:
        block = self.blocks.pop()
        self.branches.pop()
        self.open_names[block.name] -= 1
        return block

    def _complain(self, command: Command, message: str) -> None:
        if len(self.errors) < MOST_ERRORS:
            self.errors.append(LexicalError(command.start, command.end, message))
