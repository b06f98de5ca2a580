"""D214, D215, D405 to D417: the sections of docstrings.

Without a configured convention, pydocstyle checks NumPy style if a docstring has a section of that
style, else Google style; both require a line of dashes below section names.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from scaffold.ament.pep257.definitions import METHOD, Definition, leading_space
from scaffold.record import NamedTuple

Violations = Iterator[tuple[str, str]]

Names = tuple[str, ...]

NUMPY: Names = (
    "Short Summary",
    "Extended Summary",
    "Parameters",
    "Returns",
    "Yields",
    "Other Parameters",
    "Raises",
    "See Also",
    "Notes",
    "References",
    "Examples",
    "Attributes",
    "Methods",
)

GOOGLE: Names = (
    "Args",
    "Arguments",
    "Attention",
    "Attributes",
    "Caution",
    "Danger",
    "Error",
    "Example",
    "Examples",
    "Hint",
    "Important",
    "Keyword Args",
    "Keyword Arguments",
    "Methods",
    "Note",
    "Notes",
    "Return",
    "Returns",
    "Raises",
    "References",
    "See Also",
    "Tip",
    "Todo",
    "Warning",
    "Warnings",
    "Warns",
    "Yield",
    "Yields",
)

_LOWER = {names: frozenset(name.lower() for name in names) for names in (NUMPY, GOOGLE)}
_PARAGRAPH_ENDS = (",", ";", ".", "-", "\\", "/", "]", "}", ")")
_ARGUMENT = r"^\s*(\w+)\s*(?:\(.*?\)\s*)?:\n?\s*.+"


class Section(NamedTuple):
    """A section: its name as written, its line, and the lines around it."""

    name: str
    before: str
    line: str
    after: Sequence[str]
    is_last: bool
    row: int
    """The row of its name within the docstring."""
    is_numpy: bool

    @property
    def title(self) -> str:
        """The correct form of the name."""
        return self.name.title()


def check(definition: Definition) -> Violations:
    """Yield the findings in the sections of a docstring."""
    for section in sections(definition):
        yield from (_numpy if section.is_numpy else _google)(section, definition)


def sections(definition: Definition) -> list[Section]:
    """Return the sections of a docstring: NumPy's, or else Google's."""
    lines = definition.docstring.split("\n")
    return _sections(lines, NUMPY) or _sections(lines, GOOGLE)


def google_sections(definition: Definition) -> list[Section]:
    """Return the sections of a docstring with names of Google style."""
    return _sections(definition.docstring.split("\n"), GOOGLE)


def _sections(lines: Sequence[str], names: Names) -> list[Section]:
    lowered = _LOWER[names]
    rows = [
        row
        for row, line in enumerate(lines)
        if _leading_words(line.lower()) in lowered and _is_section(line, lines[row - 1])
    ]
    ends = [*rows[1:], -1]
    return [
        Section(
            _leading_words(lines[row].strip()) or "",
            lines[row - 1],
            lines[row],
            lines[row + 1 : end],
            is_last=row == rows[-1],
            row=row,
            is_numpy=names is NUMPY,
        )
        for row, end in zip(rows, ends, strict=False)
    ]


def _is_section(line: str, before: str) -> bool:
    """Return whether a line is the name of a section, not just text."""
    name = _leading_words(line.strip()) or ""
    # Strips all characters that occur in the name, as pydocstyle does.
    suffix = line.strip().lstrip(name.strip()).strip()
    if suffix not in ("", ":"):
        return False
    return not before.strip() or before.strip().endswith(_PARAGRAPH_ENDS)


def _leading_words(line: str) -> str | None:
    """Return the leading words of a line, up to the first other character."""
    matched = re.match(r"[\w ]+", line.strip())
    return matched[0] if matched else None


def _numpy(section: Section, definition: Definition) -> Violations:
    yield from _common(section, definition, NUMPY)
    if section.line.strip().lstrip(section.name):
        yield "D406", f"the section name is {section.line.strip()!r}, not {section.title!r} alone"
    if section.title == "Parameters":
        yield from _undocumented(_numpy_parameters(section), definition)


def _google(section: Section, definition: Definition) -> Violations:
    yield from _common(section, definition, GOOGLE)
    if section.line.strip().lstrip(section.name) != ":":
        yield "D416", f"the section name is {section.line.strip()!r}, not '{section.title}:'"
    if section.title in ("Args", "Arguments"):
        yield from _undocumented(_google_arguments(section), definition)


def _common(section: Section, definition: Definition, names: Names) -> Violations:
    title = section.title
    if section.name not in names and title in names:
        yield "D405", f"the section name is {section.name!r}, not {title!r}"
    if leading_space(section.line) > definition.indent:
        yield "D214", f"the section {title!r} is indented more than the docstring"
    if not section.after or section.after[-1].strip():
        if section.is_last:
            yield "D413", f"no blank line after the last section {title!r}"
        else:
            yield "D410", f"no blank line after the section {title!r}"
    if section.before.strip():
        yield "D411", f"no blank line before the section {title!r}"
    yield from _underline(section, definition)


def _underline(section: Section, definition: Definition) -> Violations:
    title = section.title
    count = next((at for at, line in enumerate(section.after) if line.strip()), None)
    if count is None:
        yield "D407", f"no dashes below the section name {title!r}"
        yield "D414", f"the section {title!r} is empty"
        return
    line = section.after[count]
    dashes = line.strip()
    if set(dashes) != {"-"}:
        yield "D407", f"no dashes below the section name {title!r}"
        if count:
            yield "D412", f"blank lines between the section name {title!r} and its content"
        return
    if count:
        yield "D408", f"blank lines between the section name {title!r} and its dashes"
    if len(dashes) != len(title):
        yield "D409", f"{len(dashes)} dashes below the section name {title!r}, not {len(title)}"
    if leading_space(line) > definition.indent:
        yield "D215", f"the dashes of the section {title!r} are indented more than the docstring"
    rest = section.after[count + 1 :]
    if not any(line.strip() for line in rest):
        yield "D414", f"the section {title!r} is empty"
    elif not rest[0].strip():
        yield "D412", f"blank lines between the section name {title!r} and its content"


def _numpy_parameters(section: Section) -> set[str]:
    """Return the parameters with a description: a deeper line below them."""
    result: set[str] = set()
    level = leading_space(section.line)
    content = "\n".join(section.after).replace("\\\n", "").split("\n")
    for line, below in pairwise(content):
        deeper = len(leading_space(below)) > len(leading_space(line))
        if leading_space(line) == level and deeper and below.strip():
            names = line.partition(":")[0] if ":" in line else line.strip()
            result.update(name.strip() for name in names.split(","))
    return result


def _google_arguments(section: Section) -> set[str]:
    """Return the arguments with a description: lines as deep as the first one, with a colon."""
    if not section.after:
        return set()
    from textwrap import dedent

    level = leading_space(section.after[0])
    lines = [line for line in section.after if line.startswith(level) or not line]
    entries: list[str] = []
    for line in dedent("\n".join(lines)).strip().splitlines(keepends=True):
        if line[:1].isspace() and entries:
            entries[-1] += line
        else:
            entries.append(line)
    matches = (re.match(_ARGUMENT, entry) for entry in entries)
    return {item[1] for item in matches if item}


def _undocumented(documented: set[str], definition: Definition) -> Violations:
    node = definition.node
    if not isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
        return
    arguments = node.args
    names = [arg.arg for arg in [*arguments.args, *arguments.kwonlyargs]]
    if definition.kind == METHOD and "staticmethod" not in definition.decorators:
        names = names[1:]
    missing = {name for name in names if not name.startswith("_")} - documented
    if missing:
        listed = ", ".join(sorted(missing))
        yield "D417", f"'{node.name}' has arguments that its docstring does not describe: {listed}"
