"""CMakeLists.txt as commands, with every mistake that CMake itself would stop at."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from typing import NamedTuple

from scaffold.model.cmake_lexer import KNOWN_COMMANDS, LexicalError, Token, tokenize
from scaffold.model.source import Location, Source

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
_ARGUMENT_KINDS = frozenset({"identifier", "unquoted", "quoted", "bracket"})
_ESCAPES = {"t": "\t", "n": "\n", "r": "\r"}


class Argument:
    """An argument of a command; offsets are characters of the source's text."""

    __slots__ = ("_source", "end", "kind", "start")

    def __init__(self, source: Source, token: Token) -> None:
        self._source = source
        self.start = token.start
        self.end = token.end
        self.kind = "unquoted" if token.kind == "identifier" else token.kind
        """``unquoted``, ``quoted`` or ``bracket``; ``open`` and ``close`` for parentheses."""

    def __repr__(self) -> str:
        return self.raw

    @property
    def raw(self) -> str:
        """The argument as it is written."""
        return self._source.text[self.start : self.end]

    @property
    def quoted(self) -> bool:
        """Whether it stands in double quotes."""
        return self.kind == "quoted"

    @property
    def bracket(self) -> bool:
        """Whether it stands in ``[[`` and ``]]``."""
        return self.kind == "bracket"

    @property
    def text(self) -> str:
        """What CMake reads: without quotes or brackets, escapes and variables untouched."""
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
        """The place, quotes included."""
        return self._source.location(self.start, self.end)


class Command:
    """A call of a command."""

    __slots__ = (
        "_source",
        "arguments",
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

    def __init__(self, source: Source, name: Token) -> None:
        self._source = source
        self.written_name = source.text[name.start : name.end]
        self.name = self.written_name.lower()
        """In lower case: CMake does not tell them apart."""
        self.arguments: list[Argument] = []
        self.start = name.start
        self.open_end = name.end
        """The offset behind ``(``."""
        self.end = name.end
        self.closed = False
        """Whether ``)`` is there."""
        self.index = 0
        """The number of the command in the file, from 0."""
        self.depth = 0
        """The number of blocks around it."""
        self.parent: Command | None = None
        """The command that opened the block around it: ``if``, ``foreach``, ``function`` …"""
        self.branch: Command | None = None
        """Like ``parent``, but the ``elseif`` or ``else`` when it stands behind one."""

    def __repr__(self) -> str:
        return f"{self.written_name}({' '.join(map(repr, self.arguments))})"

    @property
    def location(self) -> Location:
        """The place of the whole call."""
        return self._source.location(self.start, self.end)

    @property
    def name_location(self) -> Location:
        """The place of the name."""
        return self._source.location(self.start, self.start + len(self.name))

    @property
    def close_start(self) -> int:
        """The offset of ``)``."""
        return self.end - 1 if self.closed else self.end

    @property
    def blocks(self) -> tuple[Command, ...]:
        """The commands that opened the blocks around it, the outermost first."""
        return tuple(self._around())[::-1]

    @property
    def values(self) -> list[str]:
        """The values of the arguments."""
        return [argument.value for argument in self.arguments]

    def sections(self, keywords: Collection[str]) -> dict[str, list[Argument]]:
        """Split the arguments at keywords; what stands before the first one is under ``""``.

        A keyword that is there without arguments has an empty list; the arguments of one that is
        there twice are joined.
        """
        found: dict[str, list[Argument]] = {"": []}
        current = found[""]
        for argument in self.arguments:
            if argument.kind in {"unquoted", "quoted"} and argument.value in keywords:
                current = found.setdefault(argument.value, [])
            else:
                current.append(argument)
        return found

    def keyword(self, name: str, keywords: Collection[str]) -> list[Argument]:
        """Return the arguments behind a keyword, up to the next one."""
        return self.sections({name, *keywords}).get(name, [])

    def has(self, keyword: str) -> bool:
        """Tell whether a keyword is among the arguments."""
        return any(argument.value == keyword for argument in self.arguments)

    def _around(self) -> Iterator[Command]:
        parent = self.parent
        while parent is not None:
            yield parent
            parent = parent.parent


class Parsed(NamedTuple):
    """A file as commands."""

    tokens: list[Token]
    commands: list[Command]
    errors: list[tuple[Location, str]]


def parse(source: Source) -> Parsed:
    """Read a file; what is wrong is in ``errors``, in the order of the file."""
    tokens, lexical = tokenize(source.text)
    parser = _Parser(source, tokens, lexical)
    parser.run()
    _Nesting(source, parser.errors).run(parser.commands)
    errors = sorted({*lexical, *parser.errors})
    return Parsed(
        tokens,
        parser.commands,
        [(source.location(error.start, error.end), error.message) for error in errors],
    )


def unescape(text: str) -> str:
    r"""Replace escapes the way CMake does; ``\;`` stays, it matters to lists."""

    def replace(match: re.Match[str]) -> str:
        char = match[1]
        if char == ";":
            return "\\;"
        return _ESCAPES.get(char, char)

    return re.sub(r"\\([\s\S])", replace, text)


def _without_continuations(text: str) -> str:
    """Take out each backslash at the end of a line together with the line's ending."""
    if "\\\n" not in text:
        return text
    return re.sub(r"\\([\s\S])", lambda match: "" if match[1] == "\n" else match[0], text)


class _Parser:
    """Reads what CMake's parser reads; after the first error it also looks for new beginnings."""

    def __init__(self, source: Source, tokens: list[Token], lexical: list[LexicalError]) -> None:
        self.source = source
        self.tokens = tokens
        self.commands: list[Command] = []
        self.errors: list[LexicalError] = []
        self.recovering = bool(lexical)
        self.at = 0

    def run(self) -> None:
        tokens = self.tokens
        fresh_line = True
        while self.at < len(tokens):
            token = tokens[self.at]
            self.at += 1
            if token.kind == "newline":
                fresh_line = True
            elif token.kind == "bracket_comment":
                fresh_line = False
            elif token.kind == "identifier":
                if not fresh_line:
                    self._complain(token, "a new line expected before this command")
                fresh_line = False
                self._command(token)
            elif token.kind not in _BLANK:
                self._stray(token)
                fresh_line = True

    def _stray(self, token: Token) -> None:
        """Skip what cannot begin a command, and the rest of its line."""
        if token.kind == "close":
            self._complain(token, 'no "(" belongs to this ")"')
            return
        if token.kind != "bad":
            self._complain(token, "the name of a command expected")
        self._skip_line()

    def _skip_line(self) -> None:
        while self.at < len(self.tokens) and self.tokens[self.at].kind != "newline":
            self.at += 1

    def _command(self, name: Token) -> None:
        command = Command(self.source, name)
        while self.at < len(self.tokens) and self.tokens[self.at].kind == "space":
            self.at += 1
        if self.at == len(self.tokens) or self.tokens[self.at].kind != "open":
            self._complain(name, f'"(" expected behind {command.written_name}')
            self._skip_line()
            return
        command.open_end = command.end = self.tokens[self.at].end
        self.at += 1
        command.index = len(self.commands)
        self.commands.append(command)
        self._arguments(command)

    def _arguments(self, command: Command) -> None:
        tokens, first = self.tokens, self.at
        depth = 0
        joined = ""  # to the token before: "word" is a warning for CMake, "bracket" an error
        while self.at < len(tokens):
            token = tokens[self.at]
            kind = token.kind
            if self.recovering and kind == "newline" and self._command_follows(self.at + 1):
                break
            self.at += 1
            if kind in {"space", "newline"}:
                joined = ""
            elif kind == "close" and depth == 0:
                command.end = token.end
                command.closed = True
                return
            elif kind in {"open", "close"}:
                depth += 1 if kind == "open" else -1
                command.arguments.append(Argument(self.source, token))
                command.end = token.end
                joined = "" if kind == "open" else "word"
            elif kind in _ARGUMENT_KINDS:
                if joined and (joined == "bracket" or kind == "bracket"):
                    self._complain(token, "a blank expected before this argument")
                command.arguments.append(Argument(self.source, token))
                command.end = token.end
                joined = "bracket" if kind == "bracket" else "word"
            elif kind == "bracket_comment":
                joined = "bracket"
            elif kind == "bad":
                self.recovering = True
        self._unclosed(command, first)

    def _unclosed(self, command: Command, first: int) -> None:
        """Complain that ``)`` is missing; a command that was swallowed gets its turn."""
        name = Token("identifier", command.start, command.open_end)
        self._complain(name, f'")" expected: {command.written_name}( is not closed')
        for number in range(first, self.at):
            if self.tokens[number].kind == "newline" and self._command_follows(number + 1):
                start = self.tokens[number].start
                command.arguments = [item for item in command.arguments if item.end <= start]
                ends = [item.end for item in command.arguments]
                command.end = ends[-1] if ends else command.open_end
                self.at = number
                return

    def _command_follows(self, number: int) -> bool:
        """Tell whether a known command begins at a token, the first of its line."""
        tokens = self.tokens
        number = self._behind_space(number)
        if number >= len(tokens) or tokens[number].kind != "identifier":
            return False
        name = self.source.text[tokens[number].start : tokens[number].end].lower()
        number = self._behind_space(number + 1)
        return name in KNOWN_COMMANDS and number < len(tokens) and tokens[number].kind == "open"

    def _behind_space(self, number: int) -> int:
        if number < len(self.tokens) and self.tokens[number].kind == "space":
            return number + 1
        return number

    def _complain(self, at: Token, message: str) -> None:
        self.recovering = True
        self.errors.append(LexicalError(at.start, at.end, message))


class _Nesting:
    """Tells the commands what blocks they stand in; complains of blocks that do not fit."""

    def __init__(self, source: Source, errors: list[LexicalError]) -> None:
        self.source = source
        self.errors = errors
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
                self._pop()
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
            block = self._pop()
            message = f"end{block.name}() expected before the {end.name}() of line {line}"
            self._complain(block, message)
        return True

    def _pop(self) -> Command:
        block = self.blocks.pop()
        self.branches.pop()
        self.open_names[block.name] -= 1
        return block

    def _complain(self, command: Command, message: str) -> None:
        self.errors.append(LexicalError(command.start, command.end, message))
