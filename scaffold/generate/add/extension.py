"""Adds fields and constants to an existing message, service or action."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold.errors import InputError
from scaffold.generate.questions.fields import fields
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates.template import Role
from scaffold.model.interfaces.syntax import SECTIONS, SEPARATOR, parse
from scaffold.record import NamedTuple
from scaffold.source import Source

if TYPE_CHECKING:
    from scaffold.generate.add.rendered_part import Wanted
    from scaffold.model.package import Package


class Extension(NamedTuple):
    """A definition with new lines at the ends of its sections."""

    files: dict[str, bytes]
    """The changed definition; empty if it does not exist or no fields are given."""
    given: dict[str, Given]
    """The answers to the questions for fields, with all lines of the new definition."""


def of(package: Package, wanted: Wanted) -> Extension:
    """Return an existing definition extended by the fields of the user.

    Raises:
        InputError: a field is not acceptable, or there is another one of its name.
    """
    template = wanted.template
    asked = [question.name for question in template.questions if question.type == "fields"]
    path = f"{template.definition}/{wanted.name}.{template.definition}"
    is_extended = template.role is Role.INTERFACE and any(name in wanted.given for name in asked)
    if not is_extended or not package.has(path):
        return Extension({}, {})
    source = package.source(path)
    sections = _sections(source.text)
    names = SECTIONS[template.definition]
    given: dict[str, Given] = {}
    for name, section in zip(names, sections, strict=False):
        question = name if name in asked else "fields"
        if question in wanted.given:
            lines = fields(wanted.given[question].value, package.directory).lines
            _append_lines(section, list(_missing(section, lines, path)))
        existing = [line.strip() for line in section if line.strip()]
        given[question] = Given(existing, path)
    ending = "\r\n" if "\r\n" in source.text else "\n"
    separator = f"{SEPARATOR}{ending}"
    text = separator.join("".join(f"{line}{ending}" for line in lines) for lines in sections)
    return Extension({path: text.encode()}, given)


def _sections(text: str) -> list[list[str]]:
    """Return the lines of each section."""
    sections: list[list[str]] = [[]]
    for line in text.splitlines():
        if line.strip() == SEPARATOR:
            sections.append([])
        else:
            sections[-1].append(line)
    return sections


def _missing(section: Sequence[str], lines: Sequence[str], path: str) -> Iterator[str]:
    """Yield the lines that define something new."""
    defined = {name: line for line in section for name in _defined(line)}
    for line in lines:
        for name, meaning in _defined(line).items():
            if name not in defined:
                yield line
            elif _defined(defined[name])[name] != meaning:
                existing = defined[name].strip()
                raise InputError(
                    f"{path} has {name!r} already, as {existing!r}; choose another name"
                )


def _defined(line: str) -> dict[str, tuple[str, str]]:
    """Return the name that a line defines, with its type and its value or default."""
    (section,) = parse(Source("fields", line), "", "msg", "Fields").sections
    defined = {item.name: (str(item.type), str(item.default)) for item in section.fields}
    return defined | {item.name: (str(item.type), repr(item.value)) for item in section.constants}


def _append_lines(section: list[str], lines: Sequence[str]) -> None:
    """Put lines after the last one that is not empty."""
    end = len(section)
    while end and not section[end - 1].strip():
        end -= 1
    section[end:end] = lines
