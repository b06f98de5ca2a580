"""Reimplementation of ament_lint_cmake: the layout of CMake files, checked in one pass.

As in the linter, commands are matched by a pattern at the start of a line, and a comment begins at
the first ``#``, even inside quotes.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Iterator
from itertools import pairwise

from scaffold.ament.files import lintable
from scaffold.model.package import Package
from scaffold.model.remembered import remembered
from scaffold.record import NamedTuple
from scaffold.source import Location, Source, ViewError

LINE_LENGTH = 140
INDENTATION = 2
PRAGMA = "# lint_cmake: "
PRAGMA_INVALID = "pragma"
"""Not a filter of the linter, which crashes on such a line."""
FILTERS = (
    "convention/filename",
    "linelength",
    "package/consistency",
    "package/stdargs",
    "readability/logic",
    "readability/mixedcase",
    "readability/wonkycase",
    "syntax",
    "whitespace/eol",
    "whitespace/extra",
    "whitespace/indent",
    "whitespace/mismatch",
    "whitespace/newline",
    "whitespace/tabs",
)

_BLOCK_ENDS = ("else", "endforeach", "endfunction", "endif", "endmacro", "endwhile")
_HANDLER = "find_package_handle_standard_args"
_HANDLER_MODULE = "FindPackageHandleStandardArgs"


class Finding(NamedTuple):
    """A line that the linter reports."""

    filter: str
    source: Source
    start: int
    """The start offset; both offsets are 0 for the file as a whole."""
    end: int
    detail: str = ""
    """A name or a number for the message."""

    @property
    def location(self) -> Location:
        """The place."""
        return self.source.location(self.start, self.end)


def findings(package: Package, name: str) -> Iterator[Finding]:
    """Yield the findings of one filter in the CMake files of a package."""
    for path in package.remember("cmake_files", lambda: _cmake_files(package)):
        try:
            by_filter = _of_file(package, path)
        except ViewError:
            continue
        yield from by_filter.get(name, ())


def _cmake_files(package: Package) -> list[str]:
    return [path for path in lintable(package) if _is_cmake(path)]


def _is_cmake(path: str) -> bool:
    name = path.rpartition("/")[2].lower()
    return name == "cmakelists.txt" or name.endswith((".cmake", ".cmake.in"))


@remembered
def _of_file(package: Package, path: str) -> dict[str, list[Finding]]:
    result: dict[str, list[Finding]] = {}
    for finding in Scan(package.source(path)).run():
        result.setdefault(finding.filter, []).append(finding)
    return result


class Line(NamedTuple):
    """A line: as written in the file, and without its comment."""

    start: int
    raw: str
    code: str
    command: str
    """The word before a parenthesis at the start of the line; empty without one."""
    name_start: int
    name_end: int
    open: int
    """The offset of the parenthesis."""


def lines(source: Source) -> list[Line]:
    """Return the lines of a CMake file."""
    text = source.text
    command = re.compile(r"\s*(\w+)\s*\(")
    result: list[Line] = []
    bounds = [0, *(match.end() for match in re.finditer(r"\r\n?|\n", text)), len(text)]
    for start, end in pairwise(bounds):
        raw = text[start:end].rstrip("\r\n")
        if start == end:
            continue
        code = raw
        if "#" in raw:
            code = raw[: raw.index("#")].rstrip()
        match = command.match(code) if "(" in code else None
        if match:
            result.append(Line(start, raw, code, match[1], *match.span(1), match.end() - 1))
        else:
            result.append(Line(start, raw, code, "", 0, 0, 0))
    return result


class Scan:
    """One pass over a file."""

    def __init__(self, source: Source) -> None:
        self.source = source
        self.name = source.path.rpartition("/")[2]
        self.lines = lines(source)

    def run(self) -> list[Finding]:
        """Return the findings, without those disabled by a pragma of the file."""
        result = [*self._file_name(), *self._each_line(), *self._spaces(), *self._find_module()]
        switches: list[str] = []
        for line in self.lines:
            if line.raw.startswith(PRAGMA):
                words = [word.strip() for word in line.raw[len(PRAGMA) :].split(",") if word]
                wrong = next((word for word in words if not _is_switch(word)), None)
                if wrong is not None:
                    result.append(self._finding(PRAGMA_INVALID, line, 0, len(line.raw), wrong))
                switches += filter(_is_switch, words)
        if not switches:
            return result
        return [f for f in result if f.filter == PRAGMA_INVALID or _is_on(f.filter, switches)]

    def _finding(self, name: str, line: Line, start: int, end: int, text: str = "") -> Finding:
        return Finding(name, self.source, line.start + start, line.start + end, text)

    def _file_finding(self, name: str, text: str) -> Finding:
        return Finding(name, self.source, 0, 0, text)

    def _file_name(self) -> Iterator[Finding]:
        match = re.match(r"Find(.*)\.cmake", self.name)
        if match and not match[1].isupper():
            yield self._file_finding("convention/filename", f"Find{match[1].upper()}.cmake")
        elif self.source.path.lower() == "cmakelists.txt" and self.name != "CMakeLists.txt":
            yield self._file_finding("convention/filename", "CMakeLists.txt")

    def _each_line(self) -> Iterator[Finding]:
        above = ""  # the command of strings in a long line
        first_is_upper: bool | None = None
        for line in self.lines:
            raw = line.raw
            if len(raw) > LINE_LENGTH and not (_is_string(raw) and above not in {"", "message"}):
                yield self._finding("linelength", line, LINE_LENGTH, len(raw), str(len(raw)))
            above = line.command or above
            if line.command:
                upper = line.command == line.command.upper()
                if not upper and line.command != line.command.lower():
                    yield self._name(line, "readability/wonkycase")
                elif first_is_upper is None:
                    first_is_upper = upper
                elif upper != first_is_upper:
                    yield self._name(line, "readability/mixedcase")
            indentation = len(raw) - len(raw.lstrip(" "))
            if indentation % INDENTATION:
                yield self._finding("whitespace/indent", line, 0, indentation, str(indentation))
            if "\t" in raw:
                at = raw.index("\t")
                yield self._finding("whitespace/tabs", line, at, at + 1)
            if raw and raw[-1].isspace():
                yield self._finding("whitespace/eol", line, len(raw.rstrip()), len(raw))
            yield from self._repeated(line)

    def _name(self, line: Line, name: str) -> Finding:
        return self._finding(name, line, line.name_start, line.name_end, line.command)

    def _repeated(self, line: Line) -> Iterator[Finding]:
        if "(" not in line.code:
            return
        lowered = line.code.lower()
        if not any(end in lowered and re.search(rf"\b{end}\b", lowered) for end in _BLOCK_ENDS):
            return
        last = line.code.rfind(")")
        for match in re.finditer(r"\b(\w+)\s*\(", line.code):
            if match.end() >= last:
                return
            if _has_arguments(line.code, match.end(), last):
                yield self._finding("readability/logic", line, match.start(), last + 1, match[1])
                return

    def _spaces(self) -> Iterator[Finding]:
        """Compare the spaces after ``(`` with those before the next ``)``, wherever it is."""
        closing: Line | None = None
        result: list[Finding] = []
        for line in reversed(self.lines):
            if ")" in line.code:
                closing = line
            if not line.command:
                continue
            if line.name_end != line.open:
                start, end = line.name_end, line.open
                result.append(self._finding("whitespace/extra", line, start, end, line.command))
            if closing is None:
                result.append(self._name(line, "syntax"))
                continue
            before = closing.code[: closing.code.index(")")]
            behind = line.code[line.open + 1 :]
            opened, closed = len(behind) - len(behind.lstrip()), len(before) - len(before.rstrip())
            if closed not in {opened, line.name_start}:
                start, end = line.start + line.open, closing.start + len(before) + 1
                result.append(Finding("whitespace/mismatch", self.source, start, end, line.command))
        return iter(result)

    def _find_module(self) -> Iterator[Finding]:
        if not (self.name.startswith("Find") and self.name.endswith(".cmake")):
            return
        missing = {"include": _HANDLER_MODULE, "call": _HANDLER}
        match = re.match(r"Find(.*)\.cmake", self.name)
        expected = (match[1] if match else self.name).upper()
        for number, line in enumerate(self.lines):
            command = line.command.lower()
            if command == "include" and self._argument(number) == _HANDLER_MODULE:
                missing.pop("include", None)
            elif command == _HANDLER:
                missing.pop("call", None)
                actual = self._argument(number)
                if actual != expected:
                    detail = f"{actual} {expected}"
                    yield self._finding("package/stdargs", line, line.name_start, line.open, detail)
        for detail in missing.values():
            yield self._file_finding("package/consistency", detail)

    def _argument(self, number: int) -> str:
        """Return the first word after the command, here or further down."""
        own = self.lines[number].command
        for line in self.lines[number:]:
            for match in re.finditer(r"\w+", line.code):
                if match[0] != own:
                    return match[0]
        return ""


def _is_switch(word: str) -> bool:
    return word[:1] in {"-", "+"} and any(name.startswith(word[1:]) for name in FILTERS)


def _is_on(name: str, switches: list[str]) -> bool:
    return next((s[0] == "+" for s in reversed(switches) if name.startswith(s[1:])), True)


def _is_string(raw: str) -> bool:
    """Return whether a line starts with a string, which cannot be broken."""
    rest = raw.lstrip()
    if rest.startswith("#"):
        rest = rest[1:].lstrip()
    return rest.startswith('"') and rest.find('"', 1) > 1


def _has_arguments(code: str, start: int, last: int) -> bool:
    """Return whether it contains at least two characters, the second one no parenthesis."""
    at = len(code) - len(code[start:].lstrip())
    while at < len(code) and not code[at].isspace():
        at += 1
        if at >= last:
            return False
        if code[at] != ")":
            return True
    return False


class Outline(NamedTuple):
    """The arguments of a CMake file that a fix must not change, and its commands."""

    literals: list[tuple[int, int]]
    """The quoted and bracket arguments in order, whose spaces are significant."""
    commands: frozenset[int]
    """The offsets of the names of commands."""

    def touches_literal(self, start: int, end: int) -> bool:
        """Return whether any of the characters is inside of an argument in quotes or brackets."""
        before = bisect_left(self.literals, (end,))
        return before > 0 and start < self.literals[before - 1][1]


def outline(package: Package, source: Source) -> Outline:
    """Return the outline of a CMake file; computed once, only for files with fixes."""
    return package.remember(("cmake_outline", source.path), lambda: _outline(source.text))


def _outline(text: str) -> Outline:
    literals: list[tuple[int, int]] = []
    commands: set[int] = set()
    token = re.compile(r'#(?:\[=*\[)?|\[=*\[|"|\\.|[()]|\w+', re.DOTALL)
    quoted_end = re.compile(r'(?:[^"\\]|\\.)*"?', re.DOTALL)
    at = depth = 0
    while match := token.search(text, at):
        word, at = match[0], match.end()
        if word == "#":
            at = _index(text, "\n", at)
        elif word[-1] == "[":
            closing = f"]{'=' * word.count('=')}]"
            at = min(_index(text, closing, at) + len(closing), len(text))
            if word[0] == "[" and depth:
                literals.append((match.start(), at))
        elif word == '"':
            end = quoted_end.match(text, at)
            at = end.end() if end else at
            literals.append((match.start(), at))
        elif word == "(":
            depth += 1
        elif word == ")":
            depth = max(0, depth - 1)
        elif depth == 0 and word[0] != "\\":
            commands.add(match.start())
    return Outline(literals, frozenset(commands))


def _index(text: str, searched: str, start: int) -> int:
    at = text.find(searched, start)
    return len(text) if at < 0 else at
