"""Parses Python source, and explains syntax errors."""

from __future__ import annotations

import ast
import re
import sys
import warnings
from bisect import bisect_left
from functools import cached_property

from scaffold import distributions
from scaffold.source import Location, NewerSyntaxError, ParseError, Source

BOM = "\ufeff"
MAX_CHARACTERS = 2_000_000
"""The length limit of modules; the trees of longer ones would take a gigabyte."""

"""The Python of the target: syntax up to here is right whatever runs this tool."""

_COOKIE = r"^[ \t\f]*#.*?coding[:=][ \t]*([-\w.]+)"

_WORDS = (
    (r"unexpected indent", "unexpected indentation"),
    (r"unindent does not match", "the indentation matches no block around it"),
    (r"inconsistent use of tabs", "tabs and spaces are mixed in the indentation"),
    (r"expected an indented block after .* on line (\d+)", "the block of line {0} is not indented"),
    (r"expected an indented block", "an indented block is missing"),
    (r"too many levels of indentation", "nested too deeply"),
    (r"too many nested parentheses", "nested too deeply"),
    (r"'(.)' was never closed", "'{0}' is never closed"),
    (r"unmatched '(.)'", "'{0}' closes nothing"),
    (r"closing parenthesis '(.)' .* '(.)' on line (\d+)", "'{0}' does not close '{1}' of line {2}"),
    (r"closing parenthesis '(.)' .* '(.)'", "'{0}' does not close '{1}'"),
    (r"unterminated triple-quoted", "a triple-quoted string is never closed"),
    (r"unterminated (?:f-)?string", "a string is not closed on its line"),
    (r"(?:f-string: )?expected ':'", "':' is missing"),
    (r"Missing parentheses in call to '(\w+)'", "{0} is a function in Python 3: write {0}(...)"),
    (
        r"(?:f-string: )?invalid syntax\. Perhaps you forgot a comma",
        "invalid syntax, perhaps a comma is missing",
    ),
    (r"invalid syntax\. Maybe you meant", "invalid syntax, perhaps '==' instead of '='"),
    (r"f-string", "a replacement field of this f-string is broken"),
    (r"multiple exception types must be parenthesized", "several exceptions need parentheses"),
    (r"Exceeds the limit .* for integer string", "a number has too many digits"),
)


class Positions:
    """Converts positions of syntax tree nodes, whose columns count UTF-8 bytes."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._text = source.text
        self._is_ascii = source.text.isascii()
        self._shift = 1 if source.text.startswith(BOM) else 0

    @cached_property
    def _starts(self) -> list[int]:
        """Offsets of the lines as in Python, where a lone carriage return ends one as well."""
        if "\r" in self._text:
            return [0, *(at.end() for at in re.finditer(r"\r\n|\r|\n", self._text))]
        return self._source.line_starts

    def line_span(self, line: int) -> tuple[int, int]:
        """Return the offsets of a line's first character and of its ending."""
        starts = self._starts
        start = self._start(line)
        end = starts[line] if line < len(starts) else len(self._text)
        return start, start + len(self._text[start:end].rstrip("\r\n"))

    def _start(self, line: int) -> int:
        starts = self._starts
        if line > len(starts):
            return len(self._text)
        return starts[line - 1] + (self._shift if line == 1 else 0)

    def line_of(self, offset: int) -> int:
        """Return the number of the line, from 1, with an offset."""
        return max(bisect_left(self._starts, offset + 1), 1)

    def offset(self, line: int, column: int) -> int:
        """Return the offset of a line from 1 and a column in bytes from 0."""
        start = self._start(line)
        if not self._is_ascii and not self._text[start : start + column].isascii():
            start, end = self.line_span(line)
            text = self._text[start:end]
            column = len(text.encode("utf-8", "replace")[:column].decode("utf-8", "ignore"))
        return min(start + column, len(self._text))


def decode(path: str, data: bytes) -> Source:
    """Decode a Python file by its coding cookie, or as UTF-8 without one.

    Raises:
        ParseError: the encoding is unknown, or the bytes are invalid in it.
    """
    encoding = _declared_encoding(data)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            source = Source.decode(path, data, encoding)
            if encoding != "utf-8" and source.text.encode(encoding) != data:
                message = f"{encoding.upper()} does not give back the bytes that it reads"
                raise ParseError(Location.start_of(path), message)
            return source
    except ValueError as error:
        message = f"the bytes are not valid {encoding.upper()}"
        raise ParseError(Location.start_of(path), message) from error


def _declared_encoding(data: bytes) -> str:
    if data.startswith(BOM.encode()):
        return "utf-8"
    for line in data[:400].split(b"\n", 2)[:2]:
        text = line.decode("latin-1")
        matched = re.match(_COOKIE, text, re.ASCII)
        if matched:
            name = matched[1].lower().replace("_", "-")
            return "utf-8" if name in {"utf-8", "utf8", "utf-8-sig"} else name
        if not re.match(r"^[ \t\f]*(?:#.*)?\r?$", text):
            break
    return "utf-8"


def parse_tree(source: Source, positions: Positions) -> ast.Module:
    """Return the syntax tree.

    Raises:
        NewerSyntaxError: the file is valid for the target's Python, not for the running one.
        ParseError: the file is not Python.
    """
    text = source.text
    if len(text) > MAX_CHARACTERS:
        message = f"too large to be read: more than {MAX_CHARACTERS} characters"
        raise ParseError(Location.start_of(source.path), message)
    null = text.find("\0")
    if null >= 0:
        raise ParseError(source.location(null, null + 1), "a NUL character in the source")
    try:
        # A warning about an escape is for the linter; under -W error it would be raised.
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return ast.parse(text.removeprefix(BOM), feature_version=_feature_version())
    except SyntaxError as error:
        raise _explain(source, positions, error) from error
    except (RecursionError, MemoryError) as error:
        raise ParseError(Location.start_of(source.path), "nested too deeply") from error
    except UnicodeEncodeError as error:
        at = source.location(error.start, error.end)
        raise ParseError(at, "a character that is no valid Unicode") from error
    except ValueError as error:
        raise ParseError(Location.start_of(source.path), str(error)) from error


def _feature_version() -> tuple[int, int] | None:
    """Return the Python version of the target, if it is older than the running one.

    Python itself does not check later features of f-strings and type parameters.
    """
    version = distributions.target().python
    is_older = version < sys.version_info[:2] and version < _FIRST_TYPES
    return version if is_older else None


def _explain(
    source: Source, positions: Positions, error: SyntaxError
) -> ParseError | NewerSyntaxError:
    at = _place(source, positions, error)
    version = _newer_version(source.text, positions, error)
    if version and version <= distributions.target().python:
        return NewerSyntaxError(at, version)
    if version:
        return ParseError(at, past_target(version))
    return ParseError(at, _in_our_words(error.msg))


def past_target(version: tuple[int, int]) -> str:
    """Return the message for syntax that is newer than the target."""
    target = distributions.target()
    own = target.python
    return f"needs Python {version[0]}.{version[1]}, but ROS 2 {target.title} has {own[0]}.{own[1]}"


def _place(source: Source, positions: Positions, error: SyntaxError) -> Location:
    """Return the location of an error, independent of the Python version."""
    start, end = positions.line_span(max(error.lineno or 1, 1))
    line = source.text[start:end]
    if isinstance(error, IndentationError):
        first = len(line) - len(line.lstrip())
        return source.location(start + first, max(end, start + first))
    at = min(start + max((error.offset or 1) - 1, 0), end)
    if error.msg.startswith("f-string"):
        at = min([*(start + item.start() for item in re.finditer(_F_STRING, line)), at])
    return source.location(at, min(at + 1, end))


def _in_our_words(message: str) -> str:
    for pattern, words in _WORDS:
        matched = re.match(pattern, message)
        if matched:
            return words.format(*matched.groups())
    return message[:1].lower() + message[1:].rstrip(".?")


# -- newer syntax

_NEWER = (
    (r"^\s*except\s*\*", (3, 11)),
    (r"^\s*(?:async\s+def|def|class)\s+\w+\s*\[[^\]]*=", (3, 13)),
    (r"^\s*(?:async\s+def|def|class)\s+\w+\s*\[", (3, 12)),
    (r"^\s*type\s+\w+\s*(?:\[.*\]\s*)?=[^=]", (3, 12)),
    (r"\w\[(?:[^\[\]]*,)?\s*\*\s*\w", (3, 11)),
    (r"\*\w+\s*:\s*\*\s*\w", (3, 11)),
)
_NEWEST = (
    (r"^\s*except\s+[\w.]+\s*,", (3, 14)),
    (r"""(?i:(?<![\w'"])(?:t|rt|tr)['"])""", (3, 14)),
)
"""The newest version whose syntax is recognized."""
_FIRST_TYPES = (3, 12)
"""The version that introduced type parameters and new f-strings."""


def _newer_version(text: str, positions: Positions, error: SyntaxError) -> tuple[int, int] | None:
    """Return the Python version of syntax that an older one rejects."""
    target = distributions.target().python
    running = target if _feature_version() is not None else sys.version_info[:2]
    match = re.search(r"only supported in Python 3\.(\d+) and greater", error.msg)
    if match is not None:
        return 3, int(match[1])
    start, end = positions.line_span(max(error.lineno or 1, 1))
    patterns = [*_NEWER, *_NEWEST] if target >= _NEWEST[0][1] else [*_NEWER]
    for pattern, version in patterns:
        if running < version and re.search(pattern, text[start:end]):
            return version
    if running < (3, 12) and _has_new_f_string(text, start, end):
        return (3, 12)
    return None


_F_STRING = r"""(?<!\w)(?:[fF][rR]?|[rR][fF])(\"\"\"|'''|"|')"""
_DEEPEST_F_STRING = 8


def _has_new_f_string(text: str, start: int, end: int) -> bool:
    """Return whether a line has an f-string that is only valid since Python 3.12."""
    for item in re.finditer(_F_STRING, text[start:end]):
        is_new, after = _scan_f_string(text, start + item.end(), item[1], 0)
        if is_new and after > 0:
            return True
    return False


def _scan_f_string(text: str, at: int, quote: str, depth: int) -> tuple[bool, int]:
    """Return whether replacement fields use newer syntax, and the end; 0 if there is none."""
    is_new = False
    while at < len(text) and depth < _DEEPEST_F_STRING:
        if text.startswith(quote, at):
            return is_new, at + len(quote)
        character = text[at]
        if character == "\\" or text.startswith(("{{", "}}"), at):
            at += 2
        elif character == "{":
            field_is_new, at = _scan_field(text, at + 1, quote, depth)
            is_new = is_new or field_is_new
            if not at:
                return False, 0
        elif character == "\n" and len(quote) == 1:
            return False, 0
        else:
            at += 1
    return False, 0


def _scan_field(text: str, at: int, quote: str, depth: int) -> tuple[bool, int]:
    """Like _scan_f_string, for the text between ``{`` and ``}``."""
    is_new = False
    open_brackets = 0
    while at < len(text):
        character = text[at]
        if character in "'\"":
            inner = character * 3 if text.startswith(character * 3, at) else character
            is_new = is_new or inner.startswith(quote)
            is_f = text[at - 1] in "fF" or text[at - 2 : at].lower() == "fr"
            scan = _scan_f_string if is_f else _scan_string
            inner_is_new, at = scan(text, at + len(inner), inner, depth + 1)
            is_new = is_new or inner_is_new
            if not at:
                return False, 0
            continue
        if character in "([{":
            open_brackets += 1
        elif character in ")]}":
            if not open_brackets:
                return is_new, at + 1 if character == "}" else 0
            open_brackets -= 1
        elif character in "\\#" or (character == "\n" and len(quote) == 1):
            is_new = True
            if character == "#":
                at = text.find("\n", at)
                if at < 0:
                    return False, 0
        at += 1
    return False, 0


def _scan_string(text: str, at: int, quote: str, depth: int) -> tuple[bool, int]:
    """Like _scan_f_string, for a plain string in a field; a backslash makes it new."""
    del depth
    is_new = False
    while at < len(text) and not text.startswith(quote, at):
        if text[at] == "\n" and len(quote) == 1:
            return False, 0
        is_new = is_new or text[at] == "\\"
        at += 2 if text[at] == "\\" else 1
    return is_new, at + len(quote) if at < len(text) else 0
