"""Fixes that add ``noqa: CODE``, in the comment syntax of each file.

The fixer applies these like other fixes, in rounds: if a comment makes its line too long, the next
round suppresses that as well. A finding without such a fix is at a place where no comment is
possible.
"""

from __future__ import annotations

import ast
import io
import re
import tokenize
from collections.abc import Iterator, Mapping, Sequence

from scaffold.ament.codes import STYLE
from scaffold.check.session import Session
from scaffold.check.suppression import COMMENT
from scaffold.diagnostic import Diagnostic
from scaffold.edits import Edit, Fix
from scaffold.files.tree import CMAKE_LISTS
from scaffold.model.discovery.targets import Target
from scaffold.model.package import Package
from scaffold.record import NamedTuple
from scaffold.source import Source, ViewError

_NEVER = ("SC", "CM074")
"""Codes that must not be suppressed: unchecked files, suppressions, and trailing whitespace."""
_XML = (".xml", ".launch", ".xacro", ".urdf")
_INTERFACES = (".msg", ".srv", ".action")
_YAML = (".yaml", ".yml")
_MARKUP = r"(?s)<!--.*?(?:-->|\Z)|<!\[CDATA\[.*?(?:\]\]>|\Z)|<[^>]*(?:>|\Z)"
_QUOTED = r'(?s)#[^\n]*|"(?:\\.|[^"\\])*(?:"|\Z)'


class SuppressingSession(Session):
    """A session whose findings have a ``noqa`` as their fix, or none."""

    def _report(self, target: Target, diagnostics: list[Diagnostic]) -> list[Diagnostic]:
        reported = super()._report(target, diagnostics)
        rows: dict[tuple[str, int], dict[str, None]] = {}
        places: list[tuple[str, int] | None] = []
        for item in reported:
            row = _row(target.package, item)
            place = None if row is None else (item.location.path, row)
            places.append(place)
            if place is not None:
                rows.setdefault(place, {})[item.code] = None
        fixes = {place: _fix(target.package, *place, [*codes]) for place, codes in rows.items()}
        return [
            item._replace(fix=fixes[place] if place else None)
            for item, place in zip(reported, places, strict=True)
        ]


def _fix(package: Package, path: str, row: int, codes: Sequence[str]) -> Fix:
    source = package.editable(path)
    line = source.lines[row - 1]
    words = ", ".join(codes)
    present = re.search(COMMENT, line, re.IGNORECASE)
    start = source.offset(row)
    if present is not None:
        at, text = start + present.end("codes"), f", {words}"
    else:
        at, text = start + len(line), f"  # noqa: {words}"
        if path.endswith(_XML):
            text = f"  <!-- noqa: {words} -->"
    return Fix(f"Suppress {words}", (Edit(path, at, at, text),))


def _row(package: Package, diagnostic: Diagnostic) -> int | None:
    """Return the next row on which a ``noqa`` may suppress a finding; ``None`` if there is none."""
    code, at = diagnostic.code, diagnostic.location
    if code.startswith(_NEVER):
        return None
    try:
        source = package.editable(at.path)
    except ViewError:
        return None
    for row in _suppressing_rows(package, source, diagnostic):
        if row > len(source.lines) or (row == 1 and source.text.startswith("#!")):
            continue
        present = re.search(COMMENT, source.lines[row - 1], re.IGNORECASE)
        if present is None or (present["codes"] and not _names(present["codes"], code)):
            return row
    return None


def _names(codes: str, code: str) -> bool:
    return code in re.split(r"[\s,]+", codes.upper())


def _suppressing_rows(package: Package, source: Source, diagnostic: Diagnostic) -> Iterator[int]:
    """Yield the rows on which a comment may suppress a finding."""
    path, row = source.path, diagnostic.location.line
    if path.endswith(".py"):
        yield from _python_rows(package, diagnostic)
    elif _may_end_in_comment(source, row):
        yield row


def _python_rows(package: Package, diagnostic: Diagnostic) -> Iterator[int]:
    path, row = diagnostic.location.path, diagnostic.location.line
    # Read inside of the functions, as cached data is dropped when the file changes.
    ends = package.remember(("rows with comments", path), lambda: _ends(package.editable(path)))
    if diagnostic.code not in STYLE:
        if ends.get(row) == row:
            yield row
        return
    if row in ends:
        yield ends[row]
    if diagnostic.code.startswith("D"):
        headers = package.remember(
            ("rows of headers", path), lambda: _headers(package.editable(path))
        )
        inner = [header for header in headers if header.start <= row <= header.stop]
        yield from [max(inner).row] if inner else ()


def _may_end_in_comment(source: Source, row: int) -> bool:
    path = source.path
    if path.endswith(_XML):
        return not _is_inside(_MARKUP, source, row)
    if path.endswith((CMAKE_LISTS, ".cmake")):
        return "[[" not in source.text and not _is_inside(_QUOTED, source, row)
    if path.endswith(_INTERFACES):
        return not {'"', "'"} & {*"".join(source.lines[row - 1 : row])}
    return path.endswith(_YAML) and _is_plain_yaml(source, row)


def _is_inside(pattern: str, source: Source, row: int) -> bool:
    """Return whether the end of a row is inside of a match of a pattern."""
    end = source.offset(row) + len("".join(source.lines[row - 1 : row]))
    return any(
        match.start() < end < match.end()
        for match in re.finditer(pattern, source.text)
        if not match[0].startswith("#")
    )


def _is_plain_yaml(source: Source, row: int) -> bool:
    """Return whether a comment at the end of a row does not change the data."""
    import yaml

    end = source.offset(row) + len("".join(source.lines[row - 1 : row]))
    text = f"{source.text[:end]}  # noqa{source.text[end:]}"
    try:
        return _events(text) == _events(source.text)
    except (yaml.YAMLError, RecursionError):
        return False


def _events(text: str) -> list[str]:
    import yaml

    return [f"{type(event)} {getattr(event, 'value', '')}" for event in yaml.parse(text)]


def _ends(source: Source) -> Mapping[int, int]:
    """Return for each row the first row, from it on, that may end in a comment."""
    inside = {
        row for row, line in enumerate(source.lines, 1) if re.search(r"^[^#]*\\$", line.rstrip())
    }
    starts: list[int] = []
    for token in _tokens(source):
        name = tokenize.tok_name[token.type]
        if name in {"FSTRING_START", "TSTRING_START"}:
            starts.append(token.start[0])
        elif name in {"FSTRING_END", "TSTRING_END"}:
            inside.update(range(starts.pop(), token.end[0]))
        elif name == "STRING":
            inside.update(range(token.start[0], token.end[0]))
    ends: dict[int, int] = {}
    following = 0
    for row in range(len(source.lines), 0, -1):
        following = following if row in inside else row
        if following:
            ends[row] = following
    return ends


def _tokens(source: Source) -> list[tokenize.TokenInfo]:
    try:
        return [*tokenize.generate_tokens(io.StringIO(source.text).readline)]
    except (tokenize.TokenError, SyntaxError, ValueError):
        return []


class _Header(NamedTuple):
    """A class, function or module with a docstring, and the rows where pydocstyle reads ``noqa``.

    The rows from ``start`` to ``stop`` end with the docstring.
    """

    start: int
    stop: int
    row: int


def _headers(source: Source) -> list[_Header]:
    """Return the rows where pydocstyle reads comments about docstrings."""
    try:
        tree = ast.parse(source.text.removeprefix("\ufeff"))
    except (SyntaxError, ValueError, RecursionError):
        return []
    tokens = _tokens(source)
    ends = [token.start[0] for token in tokens if token.type == tokenize.NEWLINE]
    headers: list[_Header] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            row = next((end for end in ends if end >= node.lineno), 0)
            if row:
                headers.append(_Header(node.lineno, node.body[0].end_lineno or row, row))
    for token in tokens:
        if token.type not in {tokenize.COMMENT, tokenize.NL}:
            break
        if token.type == tokenize.COMMENT and not token.string.startswith("#!"):
            stop = (tree.body[0].end_lineno or 1) if tree.body else 1
            headers.append(_Header(1, stop, token.start[0]))
            break
    return headers
