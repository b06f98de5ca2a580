"""A Python file as read by the linters: lines, tokens, logical lines and syntax tree."""

from __future__ import annotations

import ast
import io
import re
import tokenize
import warnings
from bisect import bisect_right
from collections.abc import Iterator
from functools import cached_property
from itertools import accumulate

from scaffold.ament import linters
from scaffold.ament.python_text import quick_lines
from scaffold.ament.python_text.logical import LogicalLine, split
from scaffold.ament.python_text.tokenizer import read
from scaffold.ament.python_text.tokens import (
    FSTRING_END,
    FSTRING_START,
    OPEN_FSTRINGS,
    STRING,
    Token,
)
from scaffold.errors import EXHAUSTED
from scaffold.model.python.bounds import why_unchecked
from scaffold.model.python.scopes import FunctionNode, Node, ScopeIndex
from scaffold.record import NamedTuple

BOM = "\ufeff"
_EXACT = frozenset({"utf-8", "utf-8-sig", "iso-8859-1"})
"""Encodings that round-trip all bytes."""
MAX_DEPTH = 300
"""The depth limit of syntax trees; real modules stay below 50, and visitors recurse."""


class Decoded(NamedTuple):
    """The text of a file, universal newlines, without byte order mark."""

    text: str
    is_clean: bool
    """Whether the bytes are valid in the declared encoding; otherwise they were read as Latin-1."""


def decode(data: bytes) -> Decoded:
    """Decode a file like Python, and as Latin-1 if Python would fail."""
    if data.isascii() and b"coding" not in data[:400]:
        return Decoded(_universal_newlines(data.decode("ascii")), is_clean=True)
    try:
        encoding, _ = tokenize.detect_encoding(io.BytesIO(data).readline)
        text = data.decode(encoding)
        # A codec that is not a charset, such as idna, does not round-trip.
        is_exact = encoding in _EXACT or text.encode(encoding) == data
    except (SyntaxError, UnicodeError, LookupError):
        is_exact = False
    if is_exact:
        return Decoded(_universal_newlines(text).lstrip(BOM), is_clean=True)
    return Decoded(_universal_newlines(data.decode("latin-1")), is_clean=False)


def _universal_newlines(text: str) -> str:
    r"""Return the text with every line ending as ``\n``."""
    return text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text


class PythonText:
    """The shared views of a file, created lazily.

    Args:
        path: The path of the file in its package.
        text: Its text, with universal newlines and without a byte order mark.
        index: The nodes of its syntax tree, if parsed before.
    """

    def __init__(self, path: str, text: str, index: ScopeIndex | None = None) -> None:
        self.path = path
        """The path of the file in its package."""
        self.name = path.rpartition("/")[2]
        """The name of the file without its directory."""
        self.text = text
        *ended, rest = text.split("\n")
        self.lines = [line + "\n" for line in ended]
        r"""The lines with their ``\n``, which the last one may lack."""
        if rest:
            self.lines.append(rest)
        self._given_index = index

    @cached_property
    def tree(self) -> ast.Module | None:
        """The syntax tree; ``None`` if the running Python cannot parse the file.

        Also if it is too deep for visitors, or too large; see ``is_too_deep`` and
        ``why_unchecked``.
        """
        return self.index.tree if self.index is not None else None

    @cached_property
    def is_too_deep(self) -> bool:
        """Whether the file is nested too deeply to be parsed."""
        return self._parsed[1]

    @property
    def why_unchecked(self) -> str:
        """Why the file is not checked: it is too large. Empty if it is checked."""
        return self._parsed[2]

    @property
    def index(self) -> ScopeIndex | None:
        """The nodes of the syntax tree, if there is one."""
        return self._parsed[0]

    def nodes(self, *kinds: type[Node]) -> Iterator[Node]:
        """Yield the nodes of some types, one type after the other, in preorder."""
        return self.index.of_types(*kinds) if self.index is not None else iter(())

    @property
    def functions(self) -> list[FunctionNode]:
        """The functions and methods."""
        return [*self.nodes(ast.FunctionDef), *self.nodes(ast.AsyncFunctionDef)]

    @property
    def imports(self) -> list[ast.Import | ast.ImportFrom]:
        """The import statements."""
        return [*self.nodes(ast.Import), *self.nodes(ast.ImportFrom)]

    def parents(self, node: ast.AST) -> Iterator[ast.AST]:
        """Yield the ancestors of a node, from the inside out."""
        return self.index.parents(node) if self.index is not None else iter(())

    @cached_property
    def _parsed(self) -> tuple[ScopeIndex | None, bool, str]:
        if self._given_index is not None:
            return self._given_index, False, ""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                tree = ast.parse(self.text)
            except (SyntaxError, ValueError):
                return None, False, ""
            except EXHAUSTED:
                return None, True, ""
        index = ScopeIndex(tree)
        if not index.build(MAX_DEPTH):
            return None, True, ""
        reason = why_unchecked(index)
        return (None if reason else index), False, reason

    @cached_property
    def tokens(self) -> list[Token]:
        """The tokens as in Python 3.12; empty if the file cannot be tokenized."""
        return read(self.lines)

    @property
    def is_without_tokens(self) -> bool:
        """Whether the file cannot be tokenized."""
        return self.outline is None and not self.tokens

    @cached_property
    def multiline_rows(self) -> set[int]:
        """The rows that end within a string."""
        rows: set[int] = set()
        if self.outline is not None:
            for start, _, end in self.outline.literals:
                if "\n" in self.text[start:end]:
                    rows.update(range(self.line_of(start), self.line_of(end - 1)))
            return rows
        first = 0
        for token in self.tokens:
            if token.type == FSTRING_START:
                first = token.start[0]
            elif token.type == FSTRING_END:
                rows.update(range(first, token.end[0]))
            elif token.type == STRING and token.start[0] != token.end[0]:
                rows.update(range(token.start[0], token.end[0]))
        return rows

    @cached_property
    def are_fstrings_opened(self) -> bool:
        """Whether the linters check the fields of f-strings."""
        return linters.of_target().python >= OPEN_FSTRINGS

    @cached_property
    def outline(self) -> quick_lines.Outline | None:
        """The outline of the file without tokens, if possible."""
        if self.tree is None:
            return None
        return quick_lines.read(self.text, self.lines, is_opened=self.are_fstrings_opened)

    @cached_property
    def logical_lines(self) -> list[LogicalLine]:
        """Statements and comment lines, in order."""
        return self.outline.lines if self.outline else split(self.tokens, self.lines)

    def lines_with(self, pattern: str) -> list[LogicalLine]:
        """Return the logical lines whose text may contain a pattern.

        It is searched fast if all of its alternatives start with a fixed character.
        """
        code, starts, opaque = self._code
        result = {
            bisect_right(starts, item.end() - 1) - 1
            for item in re.finditer(pattern, code, re.MULTILINE)
        }
        return [self.logical_lines[at] for at in sorted(result | opaque)]

    @cached_property
    def _code(self) -> tuple[str, list[int], set[int]]:
        """The texts of all logical lines, their starts, and which of them are inexact."""
        texts = [logical.code for logical in self.logical_lines]
        starts = [0, *accumulate(len(text) + 1 for text in texts)]
        opaque = {at for at, logical in enumerate(self.logical_lines) if logical.is_opaque}
        return "\n".join(texts), starts, opaque

    @cached_property
    def indent_char(self) -> str:
        """The character that the first indented line starts with; empty without one."""
        matched = re.search(r"^[ \t]", self.text, re.MULTILINE)
        return matched[0] if matched else ""

    def logical_line_at(self, line: int) -> LogicalLine | None:
        """Return the logical line that covers a line of the file."""
        at = bisect_right(self._starts, line) - 1
        if at < 0 or self.logical_lines[at].end_row < line:
            return None
        return self.logical_lines[at]

    @cached_property
    def line_starts(self) -> list[int]:
        """The offsets of the lines."""
        starts = [0]
        for line in self.lines:
            starts.append(starts[-1] + len(line))
        return starts

    def line_of(self, offset: int) -> int:
        """Return the line, from 1, of an offset."""
        return bisect_right(self.line_starts, offset)

    @cached_property
    def token_rows(self) -> list[int]:
        """The first rows of the tokens."""
        return [token.start[0] for token in self.tokens]

    @cached_property
    def _starts(self) -> list[int]:
        return [logical.row for logical in self.logical_lines]

    def column(self, line: int, byte_column: int) -> int:
        """Convert a column of ``ast`` (bytes, from 0) to one in characters, from 1."""
        row = self.lines[line - 1] if line <= len(self.lines) else ""
        if row.isascii():
            return byte_column + 1
        return len(row.encode()[:byte_column].decode(errors="replace")) + 1
