"""Diagnostics for the findings of lint_cmake: codes, messages and fixes."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from scaffold.ament.codes import diagnostic
from scaffold.ament.lint_cmake import (
    LINE_LENGTH,
    PRAGMA_INVALID,
    Finding,
    findings,
    lines,
    outline,
)
from scaffold.diagnostic import Diagnostic
from scaffold.edits import Edit, Fix
from scaffold.files.tree import CMAKE_LISTS
from scaffold.model.package import Package
from scaffold.source import Source, ViewError

_Explained = tuple[str, Fix | None]
_BLOCK_ENDS = {"else", "endforeach", "endfunction", "endif", "endmacro", "endwhile"}


def diagnostics(package: Package, code: str) -> Iterator[Diagnostic]:
    """Yield what ament_lint_cmake reports under one code."""
    name, explain = _FILTERS[code]
    for finding in findings(package, name):
        explained = explain(package, finding)
        if explained is not None:
            yield diagnostic(code, finding.location, *explained)


def _line_length(_: Package, finding: Finding) -> _Explained:
    return f"{finding.detail} characters: ament_lint_cmake allows {LINE_LENGTH}", None


def _extra_whitespace(package: Package, finding: Finding) -> _Explained:
    message = f"space between `{finding.detail}` and `(`"
    return message, _removal(package, finding, "Remove the space")


def _mismatch(package: Package, finding: Finding) -> _Explained:
    last, fix = finding.end - 1, None
    if not outline(package, finding.source).touches_literal(last, finding.end):
        fix = Fix("Use equal spaces", _padding_edits(finding))
    line, _ = finding.source.position(last)
    return f'spaces after the "(" of {finding.detail} and before the ")" in line {line} differ', fix


def _padding_edits(finding: Finding) -> tuple[Edit, ...]:
    source, text, closing = finding.source, finding.source.text, finding.end - 1
    opened = finding.start + 1
    behind = opened
    while behind < closing and text[behind] in " \t":
        behind += 1
    start = closing
    while start > behind and text[start - 1] in " \t":
        start -= 1
    wanted = _indentation(source, finding.start) if text[start - 1] in "\r\n" else ""
    edits = (Edit(source.path, opened, behind, ""), Edit(source.path, start, closing, wanted))
    return tuple(edit for edit in edits if edit.text != text[edit.start : edit.end])


def _indentation(source: Source, offset: int) -> str:
    line = source.lines[source.position(offset)[0] - 1]
    return line[: len(line) - len(line.lstrip())]


def _tab(package: Package, finding: Finding) -> _Explained:
    line = finding.source.position(finding.start)[0]
    start, fix = finding.source.offset(line), None
    end = start + len(finding.source.lines[line - 1])
    if not outline(package, finding.source).touches_literal(start, end):
        text = finding.source.text[start:end]
        rest = text.lstrip(" \t")
        indentation = text[: len(text) - len(rest)].replace("\t", "  ")
        edit = Edit(finding.source.path, start, end, indentation + rest.replace("\t", " "))
        fix = Fix("Replace the tab with spaces", (edit,))
    return "tab in the line: ament_lint_cmake requires spaces", fix


def _line_end(package: Package, finding: Finding) -> _Explained:
    return "trailing whitespace", _removal(package, finding, "Remove the trailing whitespace")


def _removal(package: Package, finding: Finding, title: str) -> Fix | None:
    path, start, end = finding.source.path, finding.start, finding.end
    if outline(package, finding.source).touches_literal(start, end):
        return None
    return Fix(title, (Edit(path, start, end, ""),))


def _odd_indentation(_: Package, finding: Finding) -> _Explained:
    number = "one space" if finding.detail == "1" else f"{finding.detail} spaces"
    return f"indented by {number}: ament_lint_cmake requires multiples of two", None


def _mixed_case(package: Package, finding: Finding) -> _Explained:
    other = "lower" if finding.detail == finding.detail.upper() else "upper"
    message = f'"{finding.detail}" in a file whose first command is in {other} case'
    source = finding.source
    return message, package.remember(("lower_case", source.path), lambda: _lower(package, source))


def _lower(package: Package, source: Source) -> Fix | None:
    """Return one fix for the whole file, unless one of the words may be no command."""
    edits: list[Edit] = []
    commands = outline(package, source).commands
    for line in lines(source):
        start, end = line.start + line.name_start, line.start + line.name_end
        if line.command and line.command == line.command.upper() != line.command.lower():
            if start not in commands:
                return None
            edits.append(Edit(source.path, start, end, line.command.lower()))
    return Fix("Convert the commands to lower case", tuple(edits)) if edits else None


def _wonky_case(package: Package, finding: Finding) -> _Explained:
    source, lower, fix = finding.source, finding.detail.lower(), None
    if finding.start in outline(package, source).commands:
        fix = Fix(f"Replace with {lower}", (Edit(source.path, finding.start, finding.end, lower),))
    return f'"{finding.detail}" mixes cases: write "{lower}"', fix


def _repeated_condition(_: Package, finding: Finding) -> _Explained:
    if finding.detail.lower() not in _BLOCK_ENDS:
        return f"{finding.detail}() shares a line with the end of a block", None
    message = f"{finding.detail}() repeats what opens its block; CMake ignores the words"
    name, arguments = finding.source.text[finding.start : finding.end].split("(", 1)
    if any(character in arguments[:-1] for character in '()"['):
        return message, None
    edit = Edit(finding.source.path, finding.start + len(name) + 1, finding.end - 1, "")
    return message, Fix("Remove the argument", (edit,))


def _file_name(_: Package, finding: Finding) -> _Explained:
    if finding.detail == "CMakeLists.txt":
        return "CMake looks for CMakeLists.txt, spelled exactly so", None
    return f"ament_lint_cmake requires upper case in names of find modules: {finding.detail}", None


def _unclosed(package: Package, finding: Finding) -> _Explained | None:
    if finding.source.path == CMAKE_LISTS and _is_unparsable(package):
        return None  # SC001 reports it
    return f'no ")" follows the "(" of {finding.detail}', None


def _is_unparsable(package: Package) -> bool:
    try:
        return not package.cmake
    except ViewError:
        return True


def _pragma(_: Package, finding: Finding) -> _Explained:
    return f"{finding.detail!r} is not a filter with - or +: ament_lint_cmake crashes on it", None


def _handler_missing(_: Package, finding: Finding) -> _Explained:
    verb = "includes" if finding.detail[0].isupper() else "calls"
    return f"this find module never {verb} {finding.detail}", None


def _handler_misnamed(_: Package, finding: Finding) -> _Explained:
    given, expected = finding.detail.split(" ", 1)
    name = finding.source.path.rpartition("/")[2]
    return f"{given} is passed in {name}: expected {expected}", None


_FILTERS: Mapping[str, tuple[str, Callable[[Package, Finding], _Explained | None]]] = {
    "CM070": ("linelength", _line_length),
    "CM071": ("whitespace/extra", _extra_whitespace),
    "CM072": ("whitespace/mismatch", _mismatch),
    "CM073": ("whitespace/tabs", _tab),
    "CM074": ("whitespace/eol", _line_end),
    "CM075": ("whitespace/indent", _odd_indentation),
    "CM076": ("readability/mixedcase", _mixed_case),
    "CM077": ("readability/wonkycase", _wonky_case),
    "CM078": ("readability/logic", _repeated_condition),
    "CM080": ("convention/filename", _file_name),
    "CM081": ("package/consistency", _handler_missing),
    "CM082": ("package/stdargs", _handler_misnamed),
    "CM083": ("syntax", _unclosed),
    "CM084": (PRAGMA_INVALID, _pragma),
}
"""The linter filter of each code, and the function for its messages."""
