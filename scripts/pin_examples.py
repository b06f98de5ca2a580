"""Write the current reports of examples to rule files; review the result with ``git diff``.

``python scripts/pin_examples.py [CODE ...]``: the rules with these codes or prefixes, else all.
An example with the right reports is not changed.
"""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from scaffold.check.rules import registry
from scaffold.check.rules.examples import reports
from scaffold.check.rules.rule import Example, Report, Rule
from scaffold.configuration import content
from scaffold.errors import ScaffoldError

WIDTH = 100
INDENT = " " * 12


def main(prefixes: Sequence[str]) -> int:
    """Rewrite the chosen rule files and list those that changed; return the exit status."""
    try:
        _pin(prefixes)
    except ScaffoldError as error:
        sys.stderr.write(f"error: {error}\n")
        return 1
    return 0


def _pin(prefixes: Sequence[str]) -> None:
    for rule in registry.load(content.roots("rules")):
        if not prefixes or rule.code.startswith(tuple(prefixes)):
            path = Path(str(sys.modules[rule.__module__].__file__))
            before = path.read_text(encoding="utf-8")
            after = _pinned(rule, before)
            if after != before:
                path.write_text(after, encoding="utf-8")
                sys.stdout.write(f"{rule.code} {path.name}\n")


def _pinned(rule: type[Rule], text: str) -> str:
    """Return the source of a rule file with up-to-date reports in its examples."""
    calls = list(_example_calls(ast.parse(text)))
    if len(calls) != len(rule.examples):
        message = f"{rule.code}: examples must be a tuple of Example(...) calls"
        raise SystemExit(message)
    offsets = _line_offsets(text)
    edits: list[tuple[int, int, str]] = []
    for call, example in zip(calls, rule.examples, strict=True):
        current = reports(rule, example)
        if list(map(vars, current)) != list(map(vars, example.reports)):
            places = _places(example, current)
            edits.append(_edit(call, offsets, text, zip(places, current, strict=True)))
    for start, end, new in sorted(edits, reverse=True):
        text = text[:start] + new + text[end:]
    return _with_imports(text)


def _example_calls(module: ast.Module) -> Iterator[ast.Call]:
    for class_ in module.body:
        for statement in class_.body if isinstance(class_, ast.ClassDef) else ():
            if (
                isinstance(statement, ast.Assign)
                and ast.unparse(statement.targets[0]) == "examples"
                and isinstance(statement.value, ast.Tuple)
            ):
                yield from (item for item in statement.value.elts if isinstance(item, ast.Call))


def _edit(
    call: ast.Call, offsets: Sequence[int], text: str, current: Iterable[tuple[str, Report]]
) -> tuple[int, int, str]:
    """Return the edit of the reports: the positional arguments after title and files."""
    files, *old = call.args[1:]
    last = old[-1] if old else files
    start = _offset(offsets, text, files.end_lineno, files.end_col_offset)
    end = _offset(offsets, text, last.end_lineno, last.end_col_offset)
    return start, end, "".join(f", {_source(at, report)}" for at, report in current)


def _places(example: Example, current: Sequence[Report]) -> list[str]:
    """Return the locations of the reports, without the path if there is only one file."""
    if len(example.files) > 1:
        return [report.at for report in current]
    return [report.at.partition(f"{path}:")[2] for report in current for path in example.files]


def _source(at: str, report: Report) -> str:
    if (report.fix, report.unsafe_fix, report.severity) == (None, None, None):
        return _string(f"{at}: {report.message}", "")
    arguments = [repr(at), _string(report.message)]
    for name in ("fix", "unsafe_fix"):
        title = getattr(report, name)
        if title is not None:
            arguments.append(f"{name}={_string(title)}")
    if report.severity is not None:
        arguments.append(f"severity=Severity.{report.severity.name}")
    return f"Report({', '.join(arguments)})"


def _string(text: str, keyword: str = "    unsafe_fix=") -> str:
    """Return a string literal, split if it would be too long for a line."""
    room = WIDTH - len(INDENT) - len(f'{keyword}"",')
    parts = [""]
    for word in text.split(" "):
        if parts[-1] and len(repr(f"{parts[-1]}{word}")) > room + 1:
            parts.append("")
        parts[-1] += f"{word} "
    parts[-1] = parts[-1][:-1]
    return " ".join(map(_literal, parts))


def _literal(text: str) -> str:
    literal = repr(text)
    if literal.startswith("'") and '"' not in text:
        return '"' + literal[1:-1].replace("\\'", "'") + '"'
    return literal


def _with_imports(text: str) -> str:
    """Import the names that the reports need; ruff sorts them."""
    wanted = [
        name
        for name, use in (("Report", " Report("), ("Severity", "severity=Severity."))
        if use in text.replace("(Report(", " Report(") and not _imports(text, name)
    ]
    for name in wanted:
        text = text.replace("from scaffold.api import ", f"from scaffold.api import {name}, ", 1)
        text = text.replace(f"import {name}, (", f"import ({name}, ", 1)
    return text


def _imports(text: str, name: str) -> bool:
    return any(
        alias.name == name
        for node in ast.parse(text).body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    )


def _line_offsets(text: str) -> list[int]:
    offsets = [0]
    for line in text.splitlines(keepends=True):
        offsets.append(offsets[-1] + len(line))
    return offsets


def _offset(offsets: Sequence[int], text: str, line: int | None, column: int | None) -> int:
    """Return a character offset: columns of ``ast`` count bytes."""
    assert line is not None  # noqa: S101  parsed from text
    start = offsets[line - 1]
    head = text[start : offsets[line]].encode()[:column]
    return start + len(head.decode())


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
