"""E2, E4 and E7 codes for which ruff and pycodestyle differ, checked on logical lines.

A regular expression over the whole text selects candidate lines, so that clean files are cheap.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from scaffold.ament import linters
from scaffold.ament.finding import Finding, Replacement
from scaffold.ament.python_text.logical import LogicalLine
from scaffold.ament.python_text.text import PythonText
from scaffold.ament.python_text.tokens import (
    COMMENT,
    FSTRING_END,
    FSTRING_START,
    NAME,
    OP,
    Position,
    Token,
)

_BLOCK_WORDS = "def async for if elif else try except finally with class while"
_BLOCK_KEYWORDS = frozenset(_BLOCK_WORDS.split())
_BLOCK = (
    r"\s*(def|async\s+def|for|async\s+for|if|elif|else|try|except|finally|with|async\s+with"
    r"|class|while)\b"
)
_BEFORE_IMPORTS = ("try", "except", "else", "finally", "with", "if", "elif")
_DUNDER = r"__([^\s]+)__(?::\s*[a-zA-Z.0-9_\[\]\"]+)? = "
_SINGLETON = r"(?:(\bNone|\bFalse|\bTrue)\s*)?([=!]=)\s*(?(1)|(None|False|True))\b"
_NEGATION = r"\b(?<!is\s)(not)\s+[^][)(}{\s]+\s+(in|is)\s"
# linear: Python rejects more than 200 open parentheses
_TYPES = r"[=!]=\s+type\s*\(([^)]*[^ )]) *\)|\btype\s*\([^)]*[^ )] *\)\s+[=!]="
_TYPES_2_12 = _TYPES.replace(r"\btype", r"(?<!\.)\btype")
_TYPES_2_8 = r"(?:[=!]=|is(?:\s+not)?)\s+type(?:s\.\w+Type|\s*\(([^)]*[^ )]) *\))"
_SPACE = r"[\[({][ \t]|[ \t][\]}),;:](?!=)"
_AMBIGUOUS = ("l", "O", "I")

Faults = Iterator[tuple[int, str, str]]
"""Offset in the logical line, code, message."""


def check(text: PythonText) -> Iterator[Finding]:
    """Yield the findings in statements."""
    is_modern = linters.of_target().since("pycodestyle", 2, 11)
    for pattern, judge in (
        (_SPACE, spaces),
        (r"[=!]=" if is_modern else r"[=!]=|\bis\b[^\n]*\btype", comparisons),
        (r"not\b", negations),
        (r";|=[ \t]*lambda\b", compounds),
        (r"except(?<!.except)\s*:", bare_except),
    ):
        for logical in text.lines_with(pattern):
            yield from _located_findings(logical, judge(logical.text))
    for logical in text.logical_lines:
        if logical.first in _BLOCK_KEYWORDS and logical.last != ":":
            yield from _located_findings(logical, compounds(logical.text))
    for logical in _continued(text):
        yield from needless_backslashes(logical)
    for logical in text.lines_with(r"[lOI](?<!\w.)(?!\w)"):
        yield from ambiguous_names(logical)
    if linters.of_target().since("pycodestyle", 2, 12):
        for logical in text.lines_with(r"@(?<!.@)\s"):
            yield from _located_findings(logical, spaced_decorator(logical.text))
    yield from late_imports(text)


def spaced_decorator(line: str) -> Faults:
    """E204: spaces after the ``@`` of a decorator."""
    if re.match(r"@\s", line):
        yield 1, "E204", "whitespace after '@'"


def _continued(text: PythonText) -> Iterator[LogicalLine]:
    """Yield the logical lines with a backslash at the end of a row."""
    seen = 0
    for item in re.finditer(r"\\\n", text.text):
        line = text.line_of(item.start())
        if line <= seen:
            continue
        logical = text.logical_line_at(line)
        if logical is not None:
            seen = logical.end_row
            if not logical.is_comment:
                yield logical


def _located_findings(logical: LogicalLine, faults: Faults) -> Iterator[Finding]:
    """Yield the findings in a logical line at their places in the file, with fixes."""
    brackets = _Brackets(logical)
    for offset, code, message in faults:
        row, column = logical.position(offset)
        yield _with_fix(logical, brackets, Finding(code, row, column + 1, message))


def _with_fix(logical: LogicalLine, brackets: _Brackets, finding: Finding) -> Finding:
    if finding.code in ("E201", "E202", "E203"):
        place = finding.line, finding.column - 1
        fix = _without_spaces(logical, place, brackets.around(place))
        return finding._replace(fix=fix, fix_title="Remove the whitespace")
    if finding.code in ("E701", "E702"):
        fix = _on_new_line(logical, finding)
        return finding._replace(fix=fix, fix_title="Move the statement to a separate line")
    return finding


def _on_new_line(logical: LogicalLine, finding: Finding) -> tuple[Replacement, ...]:
    """Return the edits that break a line after its colon or at its semicolon."""
    row = finding.line
    line = logical.lines[row - 1].rstrip("\n")
    indent = line[: len(line) - len(line.lstrip())]
    opens = finding.code == "E701"
    if logical.row != row or logical.end_row != row or "\t" in indent or len(indent) % 4:
        return ()
    if not opens and logical.first in _BLOCK_KEYWORDS:
        return ()  # first the block is moved to a separate line
    column = finding.column  # of the colon or semicolon, and the text after it
    start = column + 1 if opens else column
    end = column + len(line[column:]) - len(line[column:].lstrip())
    deeper = " " * 4 if opens else ""
    return ((row, start, row, end + 1, f"\n{indent}{deeper}"),)


def _without_spaces(
    logical: LogicalLine, place: Position, around: Sequence[str]
) -> tuple[Replacement, ...]:
    """Return the edits that remove spaces; those around the colon of a slice as well."""
    row, column = place
    line = logical.lines[row - 1].rstrip("\n")
    matched = re.compile(r"[ \t]+").match(line, column)
    if matched is None or not line[:column].strip() or "f" in around:
        # In f'{x = }' the spaces are part of the output.
        return ()
    start = len(line[:column].rstrip(" \t"))
    end = matched.end()
    spaces = (row, start + 1, row, end + 1, "")
    after_colon = re.compile(r"[ \t]+(?=[^ \t\\#])").match(line, end + 1)
    is_slice = line[end : end + 1] == ":" and around[-1:] == ["["]
    if is_slice and after_colon and "lambda" not in logical.text:
        return (spaces, (row, end + 2, row, after_colon.end() + 1, ""))
    return (spaces,)


class _Brackets:
    """The open brackets in a logical line; queries must be in the order of the text."""

    def __init__(self, logical: LogicalLine) -> None:
        self._logical = logical
        self._at = 0
        self._open: list[str] = []

    def around(self, place: Position) -> Sequence[str]:
        """Return the open brackets at an offset, and ``f`` for an f-string."""
        tokens = self._logical.tokens
        while self._at < len(tokens) and tokens[self._at].start < place:
            self._read(tokens[self._at])
            self._at += 1
        return self._open

    def _read(self, token: Token) -> None:
        if token.type == FSTRING_START:
            self._open.append("f")
        elif token.type == OP and token.string in ("(", "[", "{"):
            self._open.append(token.string)
        elif self._open and (
            token.type == FSTRING_END or (token.type == OP and token.string in (")", "]", "}"))
        ):
            self._open.pop()


def spaces(line: str) -> Faults:
    """E201, E202, E203: spaces inside brackets and before punctuation."""
    for item in re.finditer(_SPACE, line):
        character = item[0].strip()
        at = item.start()
        if item[0][-1].isspace():
            yield at + 1, "E201", f"whitespace after '{character}'"
        elif line[at - 1] != ",":
            code = "E202" if character in "}])" else "E203"
            yield at, code, f"whitespace before '{character}'"


def comparisons(line: str) -> Faults:
    """E711, E712, E721: equality where identity is intended."""
    for item in re.finditer(_SINGLETON, line):
        value = item[1] or item[3]
        wanted = "is" if item[2] == "==" else "is not"
        code = "E711" if value == "None" else "E712"
        yield item.start(2), code, f"comparison to {value} with '{item[2]}', not '{wanted}'"
    types = re.search(_types(), line)
    if types:
        inside = (types[1] or "").strip()
        if not (inside.isidentifier() and inside not in ("None", "True", "False")):
            yield types.start(), "E721", "types compared with '==', not with 'is' or isinstance()"


def _types() -> str:
    """Return the pattern of E721."""
    target = linters.of_target()
    if target.since("pycodestyle", 2, 12):
        return _TYPES_2_12
    return _TYPES if target.since("pycodestyle", 2, 11) else _TYPES_2_8


def negations(line: str) -> Faults:
    """E713, E714: ``not`` in front of a test instead of within it."""
    matched = re.search(_NEGATION, line)
    if matched:
        code, wanted = ("E713", "not in") if matched[2] == "in" else ("E714", "is not")
        yield matched.start(1), code, f"'not ... {matched[2]} ...' instead of '{wanted}'"


def bare_except(line: str) -> Faults:
    """E722: every exception is caught, even SystemExit."""
    if re.match(r"except\s*:", line):
        yield 0, "E722", "bare 'except:' also catches SystemExit and KeyboardInterrupt"


def compounds(line: str) -> Faults:  # noqa: C901  one scan for all of them
    """E701 to E704, E731: several statements on one line."""
    last = len(line) - 1
    depth = dict.fromkeys("([{", 0)
    pairs = {")": "(", "]": "[", "}": "{"}
    before = 0
    at = line.find(":")
    while -1 < at < last:
        for item in line[before:at]:
            if item in depth:
                depth[item] += 1
            elif item in pairs:
                depth[pairs[item]] -= 1
        if max(depth.values()) <= 0 and line[at + 1] != "=":
            keyword = re.compile(r"\blambda\b").search(line, 0, at)
            if keyword:
                target = line[: keyword.start()].rstrip()
                if target[-1:] == "=" and target[:-1].strip().isidentifier():
                    yield 0, "E731", f"a lambda is assigned to '{target[:-1].strip()}'; use def"
                break
            if re.match(r"(async\s+def|def)\b", line):
                yield 0, "E704", "the body of the function follows on the same line"
            elif re.match(_BLOCK, line):
                yield at, "E701", "a statement follows the colon on the same line"
        before = at
        at = line.find(":", at + 1)
    at = line.find(";")
    while at > -1:
        if at < last:
            yield at, "E702", "several statements on one line"
        else:
            yield at, "E703", "the statement ends with a semicolon"
        at = line.find(";", at + 1)


def ambiguous_names(logical: LogicalLine) -> Iterator[Finding]:
    """E741, E742, E743: names that look like digits."""
    if linters.of_target().since("pycodestyle", 2, 9):
        return _ambiguous_names(logical)
    return _ambiguous_names_2_8(logical)


def _ambiguous_names_2_8(logical: LogicalLine) -> Iterator[Finding]:
    tokens = logical.tokens
    is_definition = False
    depth = 0
    for before, token in pairwise(tokens):
        is_definition = is_definition or before.string == "def"
        if depth == 0 and (before.type, token.string) == (NAME, "("):
            depth = 1
        elif depth and token.type == OP:
            depth += (token.string == "(") - (token.string == ")")
        name: Token | None = None
        if token.type == OP and "=" in token.string and not depth and before.string in _AMBIGUOUS:
            name = before
        is_bound = before.string in ("as", "for", "global", "nonlocal") or is_definition
        if is_bound and token.string in _AMBIGUOUS:
            name = token
        if name is not None:
            yield _ambiguous("E741", "variable", name.string, name.start)
        if before.string == "class" and token.string in _AMBIGUOUS:
            yield _ambiguous("E742", "class", token.string, token.start)
        if before.string == "def" and token.string in _AMBIGUOUS:
            yield _ambiguous("E743", "function", token.string, token.start)


def _ambiguous_names(logical: LogicalLine) -> Iterator[Finding]:  # noqa: C901  one scan for all
    tokens = logical.tokens
    depth = 0
    function: int | None = None
    in_header = False
    for at in range(1, len(tokens)):
        before, token = tokens[at - 1], tokens[at]
        if before.string in ("def", "lambda"):
            function, in_header = depth, True
        elif function is not None and token.string == ":" and depth == function:
            in_header = False
        if token.string in "([{":
            depth += 1
        elif token.string in ")]}":
            depth -= 1
        assigned = token.string == ":=" or (token.string == "=" and depth == 0)
        if assigned and before.string in _AMBIGUOUS:
            yield _ambiguous("E741", "variable", before.string, before.start)
        if token.string not in _AMBIGUOUS:
            continue
        binds = before.string in ("as", "for", "global", "nonlocal")
        is_parameter = (
            in_header
            and at < len(tokens) - 1
            and tokens[at + 1].string in ":,=)"
            and before.string in ("lambda", ",", "*", "**", "(")
        )
        if binds or is_parameter:
            yield _ambiguous("E741", "variable", token.string, token.start)
        if before.string == "class":
            yield _ambiguous("E742", "class", token.string, token.start)
        if before.string == "def":
            yield _ambiguous("E743", "function", token.string, token.start)


def _ambiguous(code: str, kind: str, name: str, at: tuple[int, int]) -> Finding:
    return Finding(code, at[0], at[1] + 1, f"the {kind} name '{name}' looks like a digit")


def needless_backslashes(logical: LogicalLine) -> Iterator[Finding]:
    """E502: a backslash between brackets, unless a comment precedes it.

    From 2.12 on, a comment counts for its own line only.
    """
    depth = start = end = 0
    backslash: tuple[int, int] | None = None
    is_one_line = linters.of_target().since("pycodestyle", 2, 12)
    has_comment = False
    for token in logical.tokens:
        has_comment = has_comment or token.type == COMMENT
        if token.start[0] != start:
            if depth and backslash and not has_comment:
                message = "the backslash between brackets is not needed"
                yield Finding("E502", backslash[0], backslash[1], message)
            has_comment = has_comment and not is_one_line
        if token.end[0] != end:
            line = logical.lines[token.end[0] - 1].rstrip("\n")
            backslash = (token.end[0], len(line)) if line.endswith("\\") else None
            start = end = token.end[0]
        else:
            start = token.start[0]
        if token.type == OP:
            depth += (token.string in "([{") - (token.string in ")]}")


def late_imports(text: PythonText) -> Iterator[Finding]:
    """E402: module-level imports below other code."""
    seen_code = seen_docstring = False
    for logical in text.logical_lines:
        if logical.is_comment or logical.indent:
            continue
        first = logical.first
        if first in ("import", "from") and logical.text.startswith(f"{first} "):
            if seen_code:
                row, column = logical.position(0)
                yield Finding("E402", row, column + 1, "import not at the top of the file")
        elif (first.startswith("__") and re.match(_DUNDER, logical.text)) or first.startswith(
            _BEFORE_IMPORTS
        ):
            continue
        elif _is_plain_string(first) and not seen_docstring:
            seen_docstring = True
        else:
            seen_code = True


def _is_plain_string(first: str) -> bool:
    if first[:1] in "uUbB":
        first = first[1:]
    if first[:1] in "rR":
        first = first[1:]
    return first[:1] in ("'", '"')
