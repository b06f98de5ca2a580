"""Fixes for the format of docstrings; docstrings with unusual quoting are not fixed."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from functools import partial

from scaffold.ament.finding import Replacement
from scaffold.ament.flake8.pycodestyle.physical import MAX_LENGTH
from scaffold.ament.pep257.definitions import CLASS, Definition, leading_space

Splice = tuple[int, int, str]
"""Start and end offsets in the literal, and the replacement text."""

_DEFINITION = r"\s*(?:(?:class|def|async def)\s|@)"
_SENTENCE_END = r"[A-Za-z0-9_)\]}\"'`>%]$"
_NEXT_SENTENCE = r"\s*[A-Z\d:@*>`\"'(\[-]"
_NO_SENTENCE = r">>>|[:@*-]|(?=[^\s./]*[./])\S+$"


def fix(definition: Definition, code: str) -> tuple[tuple[Replacement, ...], str]:
    """Return the edits that fix a finding, and a title; no edits if no fix is safe."""
    if not definition.is_docstring or "\f" in definition.docstring:
        return (), ""
    if code in _AROUND:
        make_edits, title = _AROUND[code]
        return tuple(make_edits(definition)), title
    if _is_for_doxygen(definition):
        return (), ""
    make_splices, title = _INSIDE.get(code) or _of_section(code)
    if "\\" in definition.docstring and not (code in _LOOKS_AT_ESCAPES or _is_raw(definition)):
        return (), ""
    splices = tuple(make_splices(definition))
    # A summary that moves to the second line was too long already.
    if not splices or (code != "D213" and _is_too_long(definition, splices)):
        return (), ""
    return tuple(_replacement(definition, splice) for splice in splices), title


def _is_for_doxygen(definition: Definition) -> bool:
    """Return whether the opening quotes are those of a comment for Doxygen, with ``!``."""
    start, end = _quotes(definition)
    return definition.docstring[start:end].startswith("!")


def _is_raw(definition: Definition) -> bool:
    literal = definition.docstring
    return literal[0] in "rR" and "\\\n" not in literal


def _of_section(code: str) -> tuple[Callable[[Definition], Iterator[Splice]], str]:
    from scaffold.ament.pep257.section_fixes import TITLES, splices

    return partial(splices, code), TITLES.get(code, "")


def _replacement(definition: Definition, splice: Splice) -> Replacement:
    start, end, text = splice
    return *_place(definition, start), *_place(definition, end), text


def _place(definition: Definition, offset: int) -> tuple[int, int]:
    before = definition.docstring[:offset]
    rows = before.count("\n")
    column = offset - before.rfind("\n") if rows else definition.literal.column + offset
    return definition.literal.line + rows, column


def _is_too_long(definition: Definition, splices: tuple[Splice, ...]) -> bool:
    """Return whether the edits would make a line longer than the linters allow."""
    literal, indent = definition.docstring, definition.indent
    parts: list[str] = []
    at = 0
    for start, end, text in sorted(splices):
        parts += literal[at:start], text
        at = end
    after = indent + "".join([*parts, literal[at:]])
    before = set((indent + literal).split("\n"))
    return any(len(line) > MAX_LENGTH and line not in before for line in after.split("\n"))


# -- blank lines around


def _blank_lines_before(definition: Definition) -> Iterator[Replacement]:
    lines, last = definition.text.lines, definition.literal.line - 1
    first = last
    while first > 0 and not lines[first - 1].strip():
        first -= 1
    if first < last:
        yield first + 1, 1, last + 1, 1, ""


def _blank_lines_after(definition: Definition) -> Iterator[Replacement]:
    lines, first = definition.text.lines, definition.literal.end_line
    last = first
    while last < len(lines) and not lines[last].strip():
        last += 1
    if last == len(lines):
        return
    wanted = 0
    if definition.kind == CLASS or re.match(_DEFINITION, lines[last]):
        wanted = 1
    if not lines[first - 1].endswith("\\\n"):
        yield first + 1, 1, last + 1, 1, "\n" * wanted


# -- inside


def _quotes(definition: Definition) -> tuple[int, int]:
    """Return the start and end of the text within the literal."""
    literal = definition.docstring
    start = literal.index(literal[-1])
    width = 3 if literal[start : start + 3] in ('"""', "'''") else 1
    return start + width, len(literal) - width


def _text(definition: Definition) -> tuple[int, int]:
    """Return the start and end of the stripped text."""
    literal = definition.docstring
    start, end = _quotes(definition)
    inner = literal[start:end]
    return start + len(inner) - len(inner.lstrip()), end - len(inner) + len(inner.rstrip())


def _touches_quotes(definition: Definition) -> bool:
    """Return whether the text would merge with quotes next to it."""
    start, end = _text(definition)
    literal = definition.docstring
    return '"' in (literal[start], literal[end - 1]) or "'" in (literal[start], literal[end - 1])


def _one_line(definition: Definition) -> Iterator[Splice]:
    first, last = _quotes(definition)
    start, end = _text(definition)
    if not _touches_quotes(definition):
        yield first, start, ""
        yield end, last, ""


def _strip(definition: Definition) -> Iterator[Splice]:
    literal = definition.docstring
    first, last = _quotes(definition)
    inner = literal[first:last]
    if _touches_quotes(definition):
        return
    if inner.startswith(" "):
        yield first, first + len(inner) - len(inner.lstrip(" ")), ""
    if "\n" not in inner and inner.endswith(" "):
        yield last - len(inner) + len(inner.rstrip(" ")), last, ""


def _second_line(definition: Definition) -> Iterator[Splice]:
    literal = definition.docstring
    first, last = _quotes(definition)
    start, _ = _text(definition)
    filled = sum(1 for line in literal[first:last].split("\n") if line.strip())
    if filled > 1 and literal[start] != "\\":
        yield first, start, f"\n{definition.indent}"


def _closing_line(definition: Definition) -> Iterator[Splice]:
    _, last = _quotes(definition)
    _, end = _text(definition)
    yield end, last, f"\n{definition.indent}"


def _blank_after_summary(definition: Definition) -> Iterator[Splice]:
    literal = definition.docstring
    start, end = _text(definition)
    summary_end = literal.find("\n", start, end)
    following = summary_end + 1
    while (line_end := literal.find("\n", following, end)) >= 0:
        if literal[following:line_end].strip():
            break
        following = line_end + 1
    summary = literal[start:summary_end].rstrip()
    # A sentence that continues in the second line must be reworded.
    is_whole = summary.endswith(".") and re.match(_NEXT_SENTENCE, literal[following:])
    if following > summary_end + 1 or is_whole:
        yield summary_end + 1, following, "\n"


def _indentation(definition: Definition) -> Iterator[Splice]:
    """Shift all lines after the first by the same amount, so ``help`` shows the same text."""
    literal, indent = definition.docstring, definition.indent
    rows = literal.split("\n")
    closes = rows[-1].strip() in ('"""', "'''")
    body = rows[1:-1] if closes else rows[1:]
    spaces = [leading_space(row) for row in rows[1:] if row.strip()]
    if set("".join([*spaces, indent])) - {" "}:
        return
    widths = [len(leading_space(row)) for row in body if row.strip()]
    shift = len(indent) - min(widths) if widths else 0
    moved = [rows[0]]
    for number, row in enumerate(rows[1:], 1):
        width = len(leading_space(row)) + shift
        if closes and number == len(rows) - 1:
            width = len(indent)
        moved.append(" " * width + row.lstrip() if row.strip() else row)
    # The whole literal is replaced: no other fix may add lines that are not shifted.
    yield 0, len(literal), "\n".join(moved)


def _double_quotes(definition: Definition) -> Iterator[Splice]:
    literal = definition.docstring
    first, last = _quotes(definition)
    inner = literal[first:last]
    if '"""' not in inner and not inner.endswith('"') and not inner.startswith('"'):
        yield literal.index(literal[-1]), first, '"""'
        yield last, len(literal), '"""'


def _raw(definition: Definition) -> Iterator[Splice]:
    literal = definition.docstring
    if literal[0] not in "\"'" or "\\\n" in literal:
        return
    first, last = _quotes(definition)
    if definition.value == literal[first:last]:
        # The whole literal is replaced: other fixes of its backslashes must not overlap.
        yield 0, len(literal), f"r{literal}"


def _period(definition: Definition) -> Iterator[Splice]:
    literal = definition.docstring
    start, end = _text(definition)
    summary_end = literal.find("\n", start, end)
    following = ""
    if summary_end >= 0:
        following = literal[summary_end + 1 : end].split("\n")[0]
        end = summary_end
    summary = literal[start:end].rstrip()
    word = summary.split()[-1]
    is_sentence = (
        re.search(_SENTENCE_END, summary)
        and not re.match(_NO_SENTENCE, summary)
        and "://" not in word
        and "@" not in word
    )
    if is_sentence and not following.strip() and (_is_raw(definition) or "\\" not in summary):
        at = start + len(summary)
        yield at, at, "."


def _capital(definition: Definition) -> Iterator[Splice]:
    start, _ = _text(definition)
    first = definition.value.split()[0]
    if definition.docstring.startswith(first, start) and (first[1:].islower() or not first[1:]):
        yield start, start + 1, first[0].upper()


def _imperative(definition: Definition) -> Iterator[Splice]:
    from scaffold.ament.pep257.mood import correct

    first = definition.value.split()[0]
    wanted = correct(first) if first.isalpha() else None
    if wanted:
        start, _ = _text(definition)
        yield start, start + len(first), wanted[:1].upper() + wanted[1:]


_LOOKS_AT_ESCAPES = frozenset({"D213", "D301", "D400", "D403", "D415"})
"""Codes whose fix handles backslashes."""

UNSAFE = frozenset({"D401"})
"""Codes whose fix changes words."""

_AROUND: dict[str, tuple[Callable[[Definition], Iterator[Replacement]], str]] = {
    "D201": (_blank_lines_before, "remove the blank lines before the docstring"),
    "D202": (_blank_lines_after, "remove the blank lines after the docstring"),
    "D204": (_blank_lines_after, "leave one blank line after the docstring"),
    "D211": (_blank_lines_before, "remove the blank lines before the docstring"),
}

_INSIDE: dict[str, tuple[Callable[[Definition], Iterator[Splice]], str]] = {
    "D200": (_one_line, "put the docstring on one line"),
    "D205": (_blank_after_summary, "leave one blank line after the summary"),
    "D207": (_indentation, "indent the docstring like its quotes"),
    "D208": (_indentation, "indent the docstring like its quotes"),
    "D209": (_closing_line, "put the closing quotes on a line of their own"),
    "D210": (_strip, "remove the spaces around the text"),
    "D213": (_second_line, "start the summary on the second line"),
    "D300": (_double_quotes, 'use """'),
    "D301": (_raw, 'use r"""'),
    "D400": (_period, "end the summary with a period"),
    "D401": (_imperative, "write the summary in the imperative"),
    "D403": (_capital, "start the summary with a capital letter"),
    "D415": (_period, "end the summary with a period"),
}
