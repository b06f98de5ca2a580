"""E301 to E306: blank lines around definitions."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from functools import cached_property

from scaffold.ament.finding import Finding
from scaffold.ament.python_text.logical import LogicalLine, expand_indent
from scaffold.ament.python_text.text import PythonText

_STRING = r"u?r?[\"']"
_DEFINITION = r"(async\s+def\s+|def\s+|class\s+|@)"
_DEFINING = frozenset({"async", "def", "class", "@"})
_FUNCTION = r"(async\s+def|def)\b"
AT_TOP = 2
IN_BLOCK = 1


def check(text: PythonText) -> Iterator[Finding]:
    """Yield the logical lines with too many or too few blank lines before them."""
    state = _State(text.lines)
    for logical in text.logical_lines:
        if logical.blank_lines or not logical.indent or logical.first in _DEFINING:
            code, message = state.judge(logical)
            if code:
                row, column = logical.position(0)
                yield Finding(code, row, column + 1, message)
        state.move_on(logical)


class _State:
    """The state that determines the blank lines before the next logical line."""

    def __init__(self, lines: list[str]) -> None:
        self.lines = lines
        self.before = 0
        """Blank lines before the statement, including those above its comments."""
        self.last = ""
        self.last_indent = 0
        self.last_at_top = ""

    def judge(self, logical: LogicalLine) -> tuple[str, str]:
        """Return the code and the message for a logical line; empty if it is right."""
        self.before = max(self.before, logical.blank_lines)
        count, indent = logical.blank_lines, logical.indent
        if not self.last and self.before < AT_TOP:
            return "", ""
        if self.last.startswith("@"):
            return ("E304", f"blank lines after a decorator ({count})") if count else ("", "")
        if count > AT_TOP or (indent and count == IN_BLOCK + 1):
            return "E303", f"too many blank lines ({count})"
        start = _start(logical)
        if re.match(_DEFINITION, start):
            return self._judge_definition(logical)
        after_definition = self.last_at_top.startswith(("def ", "class "))
        if start and not indent and self.before != AT_TOP and after_definition:
            return "E305", (
                f"expected {AT_TOP} blank lines after a class or function, found {self.before}"
            )
        return "", ""

    def _judge_definition(self, logical: LogicalLine) -> tuple[str, str]:
        indent = logical.indent
        if self.before == 0 and self._is_one_liner(logical):
            return "", ""
        if not indent:
            if self.before == AT_TOP:
                return "", ""
            return "E302", f"expected {AT_TOP} blank lines, found {self.before}"
        follows = self.before == IN_BLOCK or self.last_indent < indent
        if follows or re.match(_STRING, self.last):
            return "", ""
        if self._is_in_function(logical):
            return "E306", f"expected {IN_BLOCK} blank line before a nested definition, found 0"
        return "E301", f"expected {IN_BLOCK} blank line, found 0"

    def _is_in_function(self, logical: LogicalLine) -> bool:
        """Search upwards for the block around the definition, by indentation."""
        around, level = self._indentations, logical.indent
        row = logical.end_row - AT_TOP
        while row >= 0:
            width, above = around[row]
            if width < level:
                if re.match(_FUNCTION, self.lines[row].lstrip()):
                    return True
                level = width
            row = above
        return False

    @cached_property
    def _indentations(self) -> list[tuple[int, int]]:
        """Return the indentation of each line, and the nearest line above with less.

        Blank lines have infinite indentation.
        """
        result: list[tuple[int, int]] = []
        for number, line in enumerate(self.lines):
            width = expand_indent(line) if line.strip() else sys.maxsize
            above = number - 1
            while above >= 0 and result[above][0] >= width:
                above = result[above][1]
            result.append((width, above))
        return result

    def _is_one_liner(self, logical: LogicalLine) -> bool:
        """Return whether a definition is a one-liner, which needs no blank lines before it."""
        lines, indent, at = self.lines, logical.indent, logical.end_row - 1
        if at >= 1 and expand_indent(lines[at - 1]) > indent:
            return False
        while at < len(lines):
            line = lines[at].strip()
            if not line.startswith("@") and re.match(_DEFINITION, line):
                break
            at += 1
        else:
            return False
        for line in lines[at + 1 :]:
            if line.strip():
                return expand_indent(line) <= indent
        return True

    def move_on(self, logical: LogicalLine) -> None:
        """Update the state after a logical line."""
        if not logical.is_comment:
            self.last = _start(logical)
            self.last_indent = logical.indent
            if not logical.indent:
                self.last_at_top = self.last
            self.before = 0


def _start(logical: LogicalLine) -> str:
    """Return the first word of the logical line, or all of it if a definition may start there."""
    if logical.is_comment:
        return ""
    if logical.first in _DEFINING:
        return logical.text
    return logical.first
