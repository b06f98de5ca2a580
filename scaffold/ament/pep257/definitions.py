"""Modules, classes and functions with their docstrings, as pydocstyle parses them."""

from __future__ import annotations

import ast
import re
import warnings
from bisect import bisect_left
from collections.abc import Iterator, Sequence
from functools import cached_property

from scaffold import lazy_re
from scaffold.ament.python_text.text import PythonText
from scaffold.ament.python_text.tokens import COMMENT, NEWLINE, NL, QUOTED
from scaffold.record import NamedTuple

MODULE, CLASS, FUNCTION, METHOD = range(4)

_LITERAL = lazy_re.compile(rf"(?:[rRuU]|[bB][rR]?|[rR][bB])?(?:{'|'.join(QUOTED)})", re.DOTALL)

_Definition = ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef


class Literal(NamedTuple):
    """A string literal at the start of a body."""

    text: str
    line: int
    column: int
    """From 1."""
    end_line: int
    end_column: int


class Definition:
    """A definition that may have a docstring."""

    def __init__(
        self, text: PythonText, kind: int, node: ast.Module | _Definition, literal: Literal
    ) -> None:
        self.kind = kind
        self.node = node
        self.literal = literal
        self.docstring = literal.text
        self.text = text
        """The file of the definition."""

    @property
    def is_function(self) -> bool:
        """Whether it is a function or a method."""
        return self.kind in (FUNCTION, METHOD)

    @property
    def is_bytes(self) -> bool:
        """Whether the literal is a bytes literal."""
        return "b" in self.docstring[:2].lower().partition(self.docstring[-1])[0]

    @property
    def name(self) -> str:
        """The name in the source; empty for a module."""
        return "" if isinstance(self.node, ast.Module) else self.node.name

    @cached_property
    def value(self) -> str:
        """The value of the docstring."""
        literal = self.docstring
        if "\\" not in literal:
            body = literal[literal.index(literal[-1]) :]
            quote = 3 if body[:3] in ('"""', "'''") else 1
            return body[quote:-quote]
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return str(ast.literal_eval(literal))

    @cached_property
    def source(self) -> str:
        """The lines of the definition without trailing comments and blank lines."""
        node = self.node
        lines = self.text.lines
        if isinstance(node, ast.Module):
            start, end = 1, len(lines)
        else:
            start, end = node.lineno, node.end_lineno or node.lineno
        while end >= start and _is_empty_or_comment(lines[end - 1]):
            end -= 1
        return "".join(lines[start - 1 : end])

    @cached_property
    def around(self) -> tuple[str, str]:
        """The source before and after the docstring."""
        before, _, after = self.source.partition(self.docstring)
        return before, after

    @cached_property
    def indent(self) -> str:
        """The text on the line before the docstring's quotes."""
        return self.around[0].rpartition("\n")[2]

    @property
    def is_docstring(self) -> bool:
        """Whether the literal is a whole statement at the start of a line: a docstring."""
        body = self.node.body[0]
        line = self.text.lines[self.literal.line - 1]
        return (
            isinstance(body, ast.Expr)
            and isinstance(body.value, ast.Constant)
            and isinstance(body.value.value, str)
            and body.end_lineno == self.literal.end_line
            and self.text.column(body.end_lineno, body.end_col_offset or 0)
            == self.literal.end_column
            and line[: self.literal.column - 1] == self.indent
            and not self.indent.strip()
        )

    @cached_property
    def decorators(self) -> Sequence[str]:
        """Names of the decorators without arguments."""
        if isinstance(self.node, ast.Module):
            return ()
        return tuple(self._decorator(item) for item in self.node.decorator_list)

    def _decorator(self, node: ast.expr) -> str:
        line = self.text.lines[node.lineno - 1]
        start = self.text.column(node.lineno, node.col_offset) - 1
        name = "".join(line[start:].partition("(")[0].split())
        return name.replace("\\", "")

    @cached_property
    def skipped(self) -> str:
        """The codes in pydocstyle's ``noqa``, or ``all``."""
        if "noqa" not in self.text.text:
            return ""
        for comment in self._header_comments():
            codes = "".join(comment.split("noqa: ")[1:])
            if codes:
                return codes
            if "noqa: " not in comment and comment.startswith("# noqa"):
                return "all"
        return ""

    def _header_comments(self) -> Iterator[str]:
        """Yield the comments from the end of the header, or the file's start, to the body."""
        tokens = self.text.tokens
        at = 0
        if not isinstance(self.node, ast.Module):
            at = bisect_left(self.text.token_rows, self.node.lineno)
            while at < len(tokens) and tokens[at].type != NEWLINE:
                at += 1
            if at == len(tokens) or tokens[at].start[0] >= self.literal.line:
                return
            if tokens[at - 1].type == COMMENT:
                at -= 1
        while at < len(tokens) and tokens[at].type in (COMMENT, NL, NEWLINE):
            if tokens[at].type == COMMENT:
                yield tokens[at].string
            at += 1


def definitions(text: PythonText) -> Iterator[Definition]:
    """Yield the definitions with a docstring, outer before inner."""
    if text.tree is None:
        return
    literal = _docstring(text, text.tree.body)
    if literal:
        yield Definition(text, MODULE, text.tree, literal)
    pending: list[tuple[Sequence[ast.stmt], bool]] = [(text.tree.body, False)]
    while pending:
        body, in_class = pending.pop()
        for node in body:
            if isinstance(node, _Definition):
                is_class = isinstance(node, ast.ClassDef)
                literal = _docstring(text, node.body)
                if literal and not _is_misread(text, node):
                    kind = CLASS if is_class else METHOD if in_class else FUNCTION
                    yield Definition(text, kind, node, literal)
                pending.append((node.body, is_class))
            elif hasattr(node, "body") or isinstance(node, ast.Match):
                pending.extend((inner, in_class) for inner in _blocks(node))


def _is_misread(text: PythonText, node: _Definition) -> bool:
    """Return whether pydocstyle takes an earlier colon as the end of the header.

    It does not support ``def f[T](x: T)`` or ``-> a[b:c]`` and stops at the first colon.
    """
    returns = getattr(node, "returns", None)
    if returns and any(
        isinstance(part, (ast.Slice, ast.Lambda, ast.Dict)) for part in ast.walk(returns)
    ):
        return True
    if not getattr(node, "type_params", None):
        return False
    header = "".join(text.lines[node.lineno - 1 : node.body[0].lineno - 1])
    return header.count(":") > 1


def _blocks(node: ast.stmt) -> Iterator[Sequence[ast.stmt]]:
    for field in ("body", "orelse", "finalbody"):
        block = getattr(node, field, None)
        if block:
            yield block
    for field in ("handlers", "cases"):
        for part in getattr(node, field, ()):
            yield part.body


def _docstring(text: PythonText, body: Sequence[ast.stmt]) -> Literal | None:
    """Return the literal at the start of a body, even if it is part of an expression."""
    if not body or not isinstance(body[0], (ast.Expr, ast.Assign, ast.AugAssign, ast.AnnAssign)):
        return None
    node = body[0]
    if isinstance(node, ast.Expr) and isinstance(node.value, (ast.Await, ast.Yield, ast.Name)):
        return None
    line = text.lines[node.lineno - 1]
    column = text.column(node.lineno, node.col_offset)
    if line[column - 1 : column] not in "\"'rRuUbB":
        return None
    start = text.line_starts[node.lineno - 1] + column - 1
    matched = _LITERAL.match(text.text, start)
    if matched is None:
        return None
    literal = matched[0]
    rows = literal.count("\n")
    end = len(literal) - literal.rfind("\n") if rows else column + len(literal)
    return Literal(literal, node.lineno, column, node.lineno + rows, end)


def _is_empty_or_comment(line: str) -> bool:
    stripped = line.strip()
    return not stripped or stripped.startswith("#")


def leading_space(line: str) -> str:
    """Return the whitespace that a line starts with."""
    return line[: len(line) - len(line.lstrip())]
