r"""Tokenizes CMakeLists.txt as CMake's own lexer does.

An unquoted argument ends at a space, a parenthesis, ``#`` or ``"``; within it, ``$(X)`` and ``a"b
c"`` are kept together (the legacy forms). ``\`` escapes the next character. ``[==[`` opens a
bracket argument that only ``]==]`` closes, or a comment if ``#`` precedes it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import overload

from scaffold import lazy_re
from scaffold.model.cmake.known_commands import BUILT_IN, OF_AMENT
from scaffold.record import NamedTuple

BOM = "\ufeff"

_COMMON = lazy_re.compile(
    r"""(?P<space>[ \t\r]+)|(?P<newline>\n)|(?P<open>\()|(?P<close>\))"""
    r"""|(?P<bracket>\#?\[=*\[)|(?P<comment>\#[^\0\n]*)|(?P<quoted>"[^"\\]*")"""
    r"""|(?P<identifier>[A-Za-z_][A-Za-z0-9_]*(?=[ \t\r\n()\#]|\Z))"""
    r"""|(?P<word>[^ \0\t\r\n()\#"\[=\\]+)"""
)
_RUN = lazy_re.compile(r'[^ \0\t\r\n()#"\[=\\]+')
_QUOTED_RUN = lazy_re.compile(r'[^\0\r\n()#"\\]+')
_MAKE_VARIABLE = lazy_re.compile(r"\$\([A-Za-z0-9_]*\)")
_NUL = lazy_re.compile(r"\0+")
_EQUALS = lazy_re.compile("=*")
_SPECIAL = lazy_re.compile(r'["\\]')
_CALL = lazy_re.compile(r"\n[ \t]*([A-Za-z_]\w*)[ \t]*\(")
MOST_ERRORS = 100
_ATTEMPTS = 16  # at guessing the missing quote


class Token(NamedTuple):
    """A range of the file; all tokens joined are the file.

    Kinds: ``space newline comment bracket_comment open close identifier unquoted quoted bracket``,
    and ``bad`` for text that CMake rejects.
    """

    kind: str
    start: int
    end: int


class LexicalError(NamedTuple):
    """A lexical error of CMake, from offset ``start`` to before ``end``."""

    start: int
    end: int
    message: str


class Tokens(Sequence[Token]):
    """The tokens of a file, stored compactly."""

    def __init__(self) -> None:
        self.kinds: list[str] = []
        self.starts: list[int] = []
        """The start of each token; the last element is the end of the file."""

    def __len__(self) -> int:
        return len(self.kinds)

    @overload
    def __getitem__(self, number: int) -> Token: ...

    @overload
    def __getitem__(self, number: slice) -> list[Token]: ...

    def __getitem__(self, number: int | slice) -> Token | list[Token]:
        if isinstance(number, slice):
            return [self[item] for item in range(*number.indices(len(self)))]
        number = range(len(self.kinds))[number]
        return Token(self.kinds[number], self.starts[number], self.starts[number + 1])


def tokenize(text: str) -> tuple[Tokens, list[LexicalError]]:
    """Split a file into tokens; after an error, continue where that makes sense."""
    lexer = _Lexer(text)
    lexer.run()
    return lexer.tokens, lexer.errors


class _Lexer:
    def __init__(self, text: str) -> None:
        self.text = text
        self.tokens = Tokens()
        self.errors: list[LexicalError] = []
        self.attempts = 0
        self.blamed = -1

    def run(self) -> None:
        text, common = self.text, _COMMON.match
        add_kind, add_start = self.tokens.kinds.append, self.tokens.starts.append
        at, end = 0, len(text)
        if text.startswith(BOM):
            self._add("space", 0)
            at = 1
        while at < end:
            match = common(text, at)
            kind = match.lastgroup if match else None
            if match is None or kind == "word" or kind is None:
                at = self._unquoted(at, match.end() if match else at)
            elif kind == "bracket":
                at = self._bracket(at, match.end())
            else:
                add_kind(kind)
                add_start(at)
                at = match.end()
        add_start(end)

    def _add(self, kind: str, start: int) -> None:
        self.tokens.kinds.append(kind)
        self.tokens.starts.append(start)

    def _complain(self, start: int, end: int, message: str) -> None:
        if len(self.errors) < MOST_ERRORS:
            self.errors.append(LexicalError(start, end, message))

    def _unquoted(self, start: int, end: int) -> int:
        text = self.text
        after = text[end : end + 1]
        if end > start and after not in {"=", "[", "\\", '"', "("}:
            self._add("unquoted", start)
            return end
        if end == start and after == '"':
            return self._quoted(start)
        end = unquoted_end(text, start)
        if end > start:
            self._add("unquoted", start)
            return end
        self._add("bad", start)
        self._complain(start, start + 1, _bad_character(text[start]))
        nul = _NUL.match(text, start)
        return nul.end() if nul else start + 1

    def _quoted(self, start: int) -> int:
        """Read a string with a backslash, or an unterminated one."""
        at = start + 1
        while True:
            match = _SPECIAL.search(self.text, at)
            if match is None:
                return self._unterminated(start)
            if match[0] == '"':
                self._add("quoted", start)
                return match.end()
            at = match.end() + 1

    def _bracket(self, start: int, opened: int) -> int:
        is_comment = self.text[start] == "#"
        level = opened - start - 2 - is_comment
        closing = "]" + "=" * level + "]"
        end = self.text.find(closing, opened)
        if end < 0:
            kind = "bracket comment" if is_comment else "bracket argument"
            self._complain(start, opened, f'"{closing}" expected: this {kind} is not closed')
            self._add("bad", start)
            return len(self.text)
        self._add("bracket_comment" if is_comment else "bracket", start)
        return end + len(closing)

    def _unterminated(self, start: int) -> int:
        """Find the wrong quote, end its string on its line and continue from there.

        The unterminated string is the last one; but if an earlier one spans lines on which
        commands start, a quote is missing there.
        """
        text = self.text
        self.attempts += 1
        if self.attempts > _ATTEMPTS:
            self._add("bad", start)
            return len(text)
        start = self._unclosed_string(start)
        self.blamed = start
        line_end = text.find("\n", start)
        line = text[start : len(text) if line_end < 0 else line_end]
        self._complain(start, start + 1, 'a second " expected: this string is not closed')
        self._add("bad", start)
        return start + max(len(line.rstrip(" \t\r)")), 1)

    def _unclosed_string(self, last: int) -> int:
        """Return the start of the first string that contains a command; drop what follows."""
        kinds, starts = self.tokens.kinds, self.tokens.starts
        for number, kind in enumerate(kinds):
            if kind != "quoted" or starts[number] <= self.blamed:
                continue
            end = starts[number + 1] if number + 1 < len(starts) else last
            match = _CALL.search(self.text, starts[number], end)
            if match is not None and match[1].lower() in KNOWN_COMMANDS:
                start = starts[number]
                del kinds[number:], starts[number:]
                return start
        return last


def unquoted_end(text: str, start: int) -> int:
    """Return the end of the unquoted argument at an offset; ``start`` if there is none."""
    at = start
    if text.startswith("[", start):
        equals = _EQUALS.match(text, start + 1)
        at = equals.end() if equals else start + 1
        if _legacy_end(text, at) == at:
            return start + 1
    while True:
        step = _legacy_end(text, at)
        if step == at and at < len(text) and text[at] in "=[":
            step = at + 1
        if step == at:
            return at
        at = step


def _legacy_end(text: str, at: int) -> int:
    """Return the end of one part of an unquoted argument."""
    run = _RUN.match(text, at)
    if run is not None:
        return _after_make_variable(text, run.end())
    if text.startswith("\\", at):
        return _after_escape(text, at)
    return _legacy_quoted_end(text, at) if text.startswith('"', at) else at


def _legacy_quoted_end(text: str, start: int) -> int:
    """Return the end of quotes inside an unquoted argument; ``start`` if unterminated."""
    at = start + 1
    while at < len(text):
        run = _QUOTED_RUN.match(text, at)
        if run is not None:
            behind = _after_make_variable(text, run.end())
        elif text[at] == '"':
            return at + 1
        else:
            behind = _after_escape(text, at) if text[at] == "\\" else at
        if behind == at:
            break
        at = behind
    return start


def _after_make_variable(text: str, at: int) -> int:
    r"""Return the offset after ``$(X)`` if ``(`` at the offset is part of one.

    The ``$`` is the last character of a run, so no ``\`` precedes it.
    """
    if not text.startswith("$(", at - 1):
        return at
    match = _MAKE_VARIABLE.match(text, at - 1)
    return match.end() if match else at


def _after_escape(text: str, at: int) -> int:
    r"""Return the offset after ``\`` and its character; the offset itself at a line's end."""
    following = text[at + 1 : at + 2]
    if following in {"", "\n", "\0"} or text.startswith("\r\n", at + 1):
        return at
    return at + 2


def _bad_character(char: str) -> str:
    if char == "\\":
        return r'"\" at the end of a line is only allowed inside a string'
    return f"the character U+{ord(char):04X} is not allowed here"


KNOWN_COMMANDS = BUILT_IN | OF_AMENT
"""Names that start a command after an error, at the start of a line and before ``(``."""
