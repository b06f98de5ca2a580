"""CM072: as many blanks stand before a closing parenthesis as behind the opening one."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity, Source
from scaffold.api.ament import Finding, lint_cmake


class ParenthesisSpaceMismatch(Rule):
    """The blanks behind ``(`` and before ``)`` of a command differ.

    **Why.** ``ament_lint_cmake`` fails under ``colcon test``. It compares with the first ``)``
    that follows; one that begins a line may be indented like its command.

    **Fix.** Remove the blanks.

    **Source.** ament_lint_cmake, filter ``whitespace/mismatch``.
    """

    code = "CM072"
    name = "parenthesis-space-mismatch"
    severity = Severity.WARNING
    examples = (
        Example(
            "the same on both sides, or on a line of its own",
            {"CMakeLists.txt": "if(A)\n  set( B 1 )\n  set(\n    C 1\n  )\nendif()\n"},
        ),
        Example(
            "one side only",
            {"CMakeLists.txt": "if(A)\n  set( B 1)\nendif()\nset(C 1 )\n"},
            reports=(
                Report(
                    "CMakeLists.txt:2:6",
                    'blanks behind the "(" of set and before the ")" in line 2 differ',
                    fix="even the blanks out",
                ),
                Report(
                    "CMakeLists.txt:4:4",
                    'blanks behind the "(" of set and before the ")" in line 4 differ',
                    fix="even the blanks out",
                ),
            ),
            fixed={"CMakeLists.txt": "if(A)\n  set(B 1)\nendif()\nset(C 1)\n"},
        ),
        Example(
            "indented like nothing else",
            {"CMakeLists.txt": "set(\n  B\n  1\n    )\n"},
            reports=(
                Report(
                    "CMakeLists.txt:1:4",
                    'blanks behind the "(" of set and before the ")" in line 4 differ',
                    fix="even the blanks out",
                ),
            ),
            fixed={"CMakeLists.txt": "set(\n  B\n  1\n)\n"},
        ),
        Example(
            "the first parenthesis is in a string: mend it by hand",
            {"CMakeLists.txt": 'message("so ) " )\n'},
            reports=(
                Report(
                    "CMakeLists.txt:1:8",
                    'blanks behind the "(" of message and before the ")" in line 1 differ',
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for found in lint_cmake.findings(package, "whitespace/mismatch"):
            outline = lint_cmake.outline(package, found.source)
            last = found.end - 1
            fix = None
            if not outline.touches_literal(last, found.end):
                fix = Fix("even the blanks out", _edits(found))
            line, _ = found.source.position(last)
            message = (
                f'blanks behind the "(" of {found.said} and before the ")" in line {line} differ'
            )
            yield self.report(found, message, fix)


def _edits(found: Finding) -> tuple[Edit, ...]:
    source, text, closing = found.source, found.source.text, found.end - 1
    opened = found.start + 1
    behind = opened
    while behind < closing and text[behind] in " \t":
        behind += 1
    start = closing
    while start > behind and text[start - 1] in " \t":
        start -= 1
    wanted = _indentation(source, found.start) if text[start - 1] in "\r\n" else ""
    edits = (Edit(source.path, opened, behind, ""), Edit(source.path, start, closing, wanted))
    return tuple(edit for edit in edits if edit.text != text[edit.start : edit.end])


def _indentation(source: Source, offset: int) -> str:
    line = source.lines[source.position(offset)[0] - 1]
    return line[: len(line) - len(line.lstrip())]
