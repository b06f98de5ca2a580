"""D2xx to D4xx: the format of docstrings, as checked by pydocstyle.

Each check yields codes with their messages for one definition. The sections of docstrings are
checked in ``sections``.
"""

from __future__ import annotations

import re
import string
from collections.abc import Callable, Iterator
from itertools import takewhile

from scaffold.ament.finding import FLAKE8, PEP257, Finding
from scaffold.ament.linters import of_target
from scaffold.ament.pep257.definitions import CLASS, Definition, definitions, leading_space
from scaffold.ament.python_text.text import PythonText

Violations = Iterator[tuple[str, str]]

_PEP257 = """
    D200 D201 D202 D204 D205 D206 D207 D208 D209 D210 D211 D300 D301 D302 D400 D401 D402 D403
    D412 D414 D419
"""

IN_FLAKE8 = frozenset(_PEP257.split())
"""flake8-docstrings follows the convention ``pep257``; ament_pep257 reports all codes here."""

PROPERTIES = frozenset({"property", "cached_property", "functools.cached_property"})
"""Decorators that exempt a function from D401, in flake8-docstrings only."""


def check(text: PythonText) -> Iterator[Finding]:
    """Yield the findings about the docstrings of a file, with the linters that report them."""
    has_properties = of_target().since("pydocstyle", 6, 2)
    for definition in definitions(text):
        messages = dict(_judge(definition))
        if messages:
            from scaffold.ament.pep257.fixes import UNSAFE, fix
        at = definition.literal
        for code, message in messages.items():
            linters = PEP257 | (FLAKE8 if code in IN_FLAKE8 else 0)
            if code == "D401" and has_properties and PROPERTIES.intersection(definition.decorators):
                linters &= ~FLAKE8
            if definition.skipped == "all" or code in definition.skipped:
                linters &= ~PEP257
            if linters:
                edits, title = fix(definition, code)
                yield Finding(
                    code,
                    at.line,
                    at.column,
                    message,
                    at.end_line,
                    at.end_column,
                    edits,
                    title,
                    linters,
                    code in UNSAFE,
                )


def _judge(definition: Definition) -> Violations:
    if definition.is_bytes:
        yield "D300", "the docstring is bytes: both linters of ament crash on it"
        return
    if not definition.value.strip():
        if of_target().since("pydocstyle", 6, 2):
            yield "D419", "the docstring is empty"
        return
    for item in _CHECKS:
        yield from item(definition)
    if definition.kind == CLASS:
        yield from _blank_lines_in_class(definition)
    elif definition.is_function:
        for item in _FUNCTION_CHECKS:
            yield from item(definition)
    if "\n" in definition.docstring:
        from scaffold.ament.pep257.sections import check as check_sections

        yield from check_sections(definition)


def _one_liner(definition: Definition) -> Violations:
    lines = definition.value.split("\n")
    if len(lines) > 1 and sum(1 for line in lines if line.strip()) == 1:
        yield "D200", f"a one-line docstring is spread over {len(lines)} lines"


def _blank_lines_in_function(definition: Definition) -> Violations:
    before, after = _blank_lines(definition)
    if before:
        yield "D201", f"blank lines before the docstring of a function ({before})"
    follows = definition.around[1]
    if after and any(line.strip() for line in follows.split("\n")[1:]):
        inner = after == 1 and re.match(r"\s+(?:(?:class|def|async def)\s|@)", follows)
        if not inner:
            yield "D202", f"blank lines after the docstring of a function ({after})"


def _blank_lines_in_class(definition: Definition) -> Violations:
    before, after = _blank_lines(definition)
    if before:
        yield "D211", f"blank lines before the docstring of a class ({before})"
    if after != 1 and any(line.strip() for line in definition.around[1].split("\n")[1:]):
        yield "D204", f"expected 1 blank line after the docstring of a class, found {after}"


def _blank_lines(definition: Definition) -> tuple[int, int]:
    """Count the blank lines right before and right after the docstring."""
    before, after = definition.around
    above = (not line.strip() for line in reversed(before.split("\n")[:-1]))
    below = (not line.strip() for line in after.split("\n")[1:])
    return sum(takewhile(bool, above)), sum(takewhile(bool, below))


def _summary(definition: Definition) -> str:
    return definition.value.strip().split("\n")[0]


def _blank_after_summary(definition: Definition) -> Violations:
    lines = definition.value.strip().split("\n")
    if len(lines) > 1:
        count = sum(takewhile(bool, (not line.strip() for line in lines[1:])))
        if count != 1:
            yield "D205", f"expected 1 blank line after the summary line, found {count}"


def _indentation(definition: Definition) -> Violations:
    lines = definition.docstring.split("\n")
    if len(lines) == 1:
        return
    indent = definition.indent
    continued = [line for at, line in enumerate(lines) if at and not lines[at - 1].endswith("\\")]
    indents = [leading_space(line) for line in continued if line.strip()]
    if set("".join(indents) + indent) == {" ", "\t"}:
        yield "D206", "the docstring is indented with tabs and spaces"
    if not indents:
        return
    if (len(indents) > 1 and min(indents[:-1]) > indent) or indents[-1] > indent:
        yield "D208", "the docstring is indented more than its quotes"
    if min(indents) < indent:
        yield "D207", "the docstring is indented less than its quotes"


def _closing_quotes(definition: Definition) -> Violations:
    filled = [line for line in definition.value.split("\n") if line.strip()]
    if len(filled) > 1:
        last = definition.docstring.split("\n")[-1].strip()
        if last not in ('"""', "'''"):
            yield "D209", "the closing quotes of a multi-line docstring are not on their own line"


def _surrounding_space(definition: Definition) -> Violations:
    lines = definition.value.split("\n")
    if lines[0].startswith(" ") or (len(lines) == 1 and lines[0].endswith(" ")):
        yield "D210", "whitespace between the quotes and the text of the docstring"


def _summary_line(definition: Definition) -> Violations:
    if len(definition.value.split("\n")) > 1:
        first = definition.docstring.split("\n")[0].strip().lower()
        if re.fullmatch("(?:u|r|ur)?(?:\"\"\"|''')", first) is None:
            yield "D213", "the summary of a multi-line docstring does not start on the second line"


def _quotes(definition: Definition) -> Violations:
    docstring = definition.docstring
    wanted = "'''[^']" if '"""' in definition.value else '"""[^"]'
    if not re.match(f"[uU]?[rR]?{wanted}", docstring):
        matched = re.match("[uU]?[rR]?(\"+|'+)", docstring)
        yield "D300", f'the docstring uses {matched[1] if matched else "other"} quotes, not """'


def _backslashes(definition: Definition) -> Violations:
    docstring = definition.docstring
    if re.search(r"\\[^\nuN]", docstring) and not docstring.startswith(("r", "ur")):
        yield "D301", 'a docstring with backslashes is not raw (r""")'


def _check_punctuation(definition: Definition) -> Violations:
    summary = _summary(definition)
    if not summary.endswith("."):
        yield "D400", f"the first line of the docstring ends with {summary[-1]!r}, not with '.'"
    if not summary.endswith((".", "!", "?")):
        yield (
            "D415",
            f"the first line of the docstring ends with {summary[-1]!r}, not with . ? or !",
        )


def _check_mood(definition: Definition) -> Violations:
    name = definition.name
    if name.startswith("test") or name == "runTest":
        return
    words = definition.value.split()
    first = re.sub(r"[\W_]+", "", words[0])
    from scaffold.ament.pep257.mood import correct

    expected = correct(first)
    if expected is not None:
        correction = f": use {expected!r}" if expected else ""
        yield (
            "D401",
            f"docstring summary should be imperative, not {first!r}{correction}",
        )


def _signature(definition: Definition) -> Violations:
    if definition.name + "(" in _summary(definition).replace(" ", ""):
        yield "D402", f"the first line of the docstring is the signature of '{definition.name}'"


def _capital(definition: Definition) -> Violations:
    first = definition.value.split()[0]
    letters = string.ascii_letters + "'"
    if first == first.upper() or any(item not in letters for item in first):
        return
    if first != first.capitalize():
        yield "D403", f"the first word of the docstring is {first!r}, not {first.capitalize()!r}"


def _overload(definition: Definition) -> Violations:
    if "overload" in definition.decorators:
        yield "D418", f"'{definition.name}' is an @overload and has a docstring"


_CHECKS: tuple[Callable[[Definition], Violations], ...] = (
    _one_liner,
    _blank_after_summary,
    _indentation,
    _closing_quotes,
    _surrounding_space,
    _summary_line,
    _quotes,
    _backslashes,
    _check_punctuation,
)

_FUNCTION_CHECKS: tuple[Callable[[Definition], Violations], ...] = (
    _blank_lines_in_function,
    _check_mood,
    _signature,
    _capital,
    _overload,
)
