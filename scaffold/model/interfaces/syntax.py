"""Parses .msg, .srv and .action files, and reports every error.

The findings are those of rosidl_adapter, which converts these files to IDL during the build: what
it rejects is reported with its location, and what it accepts is accepted with the same values.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from enum import Enum

from scaffold.model.interfaces.types import (
    PRIMITIVES,
    FieldType,
    TypeSpellingError,
    Value,
    ValueSpellingError,
    is_constant_name,
    is_field_name,
    is_type_name,
    parse_type,
    parse_value,
)
from scaffold.record import NamedTuple
from scaffold.source import Location, Source

SEPARATOR = "---"
SECTIONS = {
    "msg": ("message",),
    "srv": ("request", "response"),
    "action": ("goal", "result", "feedback"),
}
"""The kinds of interfaces by file extension, with their sections."""

_BOM = "\ufeff"


class ProblemKind(Enum):
    """The kind of a problem."""

    TYPE_NAME = "type name"
    FIELD_NAME = "field name"
    CONSTANT_NAME = "constant name"
    DUPLICATE = "duplicate"
    SEPARATOR = "separator"
    SYNTAX = "syntax"
    TYPE = "type"
    VALUE = "value"


class Problem(NamedTuple):
    """An error that rosidl_adapter reports."""

    kind: ProblemKind
    location: Location
    message: str


class Field(NamedTuple):
    """A field; its location is its name."""

    type: FieldType
    name: str
    default: Value | None
    comment: str
    """The comment after ``#`` on its line."""
    location: Location
    type_location: Location


class Constant(NamedTuple):
    """A constant; its location is its name."""

    type: FieldType
    name: str
    value: Value
    comment: str
    """The comment after ``#`` on its line."""
    location: Location


class Section(NamedTuple):
    """A message, or one of the parts of a service or an action."""

    name: str
    """``message``, ``request``, ``response``, ``goal``, ``result`` or ``feedback``."""
    fields: tuple[Field, ...]
    constants: tuple[Constant, ...]
    comment: str
    """The comment lines it starts with."""

    def field(self, name: str) -> Field | None:
        """Return the field of a name."""
        return next((field for field in self.fields if field.name == name), None)

    def constant(self, name: str) -> Constant | None:
        """Return the constant of a name."""
        return next((constant for constant in self.constants if constant.name == name), None)


class Definition(NamedTuple):
    """The content of a definition file, as far as it can be parsed."""

    sections: tuple[Section, ...]
    problems: tuple[Problem, ...]

    @property
    def all_fields(self) -> list[Field]:
        """The fields of all sections."""
        return [field for section in self.sections for field in section.fields]


class _Line(NamedTuple):
    text: str
    """Without its ending and trailing spaces, tabs as spaces."""
    start: int
    """Offset in the file."""
    end: int
    """Offset of the next line."""
    number: int
    column: int
    """The column of its first character: 1, unless a form feed or the like ends the line before."""

    def at(self, path: str, start: int, length: int) -> Location:
        """Return the place of some characters of it."""
        column = self.column + start
        return Location(path, self.number, column, self.number, column + length)


def parse(source: Source, package: str, kind: str, name: str) -> Definition:
    """Read a definition.

    Args:
        source: The file.
        package: The package that defines it: types without a package are its own.
        kind: ``msg``, ``srv`` or ``action``.
        name: The name of the type, which is that of the file.
    """
    names = SECTIONS[kind]
    problems: list[Problem] = []
    if not is_type_name(name):
        at = Location.start_of(source.path)
        problems.append(Problem(ProblemKind.TYPE_NAME, at, _bad_type_name(name, kind)))
    if source.text.startswith(_BOM):
        message = "the file starts with a byte order mark, which rosidl reads as a type; remove it"
        problems.append(Problem(ProblemKind.SYNTAX, Location.start_of(source.path), message))
    parts = _split(source, kind, problems)
    sections = [
        _Parser(source.path, package, problems).section(names[index], lines)
        for index, lines in enumerate(parts[: len(names)])
    ]
    sections += [Section(missing, (), (), "") for missing in names[len(sections) :]]
    problems.sort(key=lambda problem: problem.location)
    return Definition(tuple(sections), tuple(problems))


def _bad_type_name(name: str, kind: str) -> str:
    return (
        f"the file name {name!r} is not a valid type name: rosidl requires letters and digits "
        f"only, a capital first, as in '{suggest_type_name(name) or 'MyType'}.{kind}'"
    )


def suggest_type_name(name: str) -> str:
    """Return the valid type name closest to a name; empty if there is none."""
    words = re.findall("[A-Za-z0-9]+", name)
    joined = "".join(word[0].upper() + word[1:] for word in words).lstrip("0123456789")
    return joined[:1].upper() + joined[1:]


def suggest_field_name(name: str) -> str:
    """Return the valid field name closest to a name; empty if there is none."""
    spaced = re.sub("(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name)
    return re.sub("[^a-z0-9]+", "_", spaced.lower()).strip("_").lstrip("0123456789_")


def suggest_constant_name(name: str) -> str:
    """Return the valid constant name closest to a name; empty if there is none."""
    return suggest_field_name(name).upper()


def _lines(source: Source) -> Iterator[_Line]:
    offset = int(source.text.startswith(_BOM))
    number, column = 1, 1 + offset
    for raw in source.text[offset:].splitlines(keepends=True):
        end = offset + len(raw)
        yield _Line(raw.replace("\t", " ").rstrip(), offset, end, number, column)
        offset = end
        if raw.endswith("\n"):
            number, column = number + 1, 1
        else:
            column += len(raw)


def _split(source: Source, kind: str, problems: list[Problem]) -> list[list[_Line]]:
    """Return the lines of each section; with wrong separators, only the first section."""
    parts: list[list[_Line]] = [[]]
    places: list[Location] = []
    wanted = len(SECTIONS[kind]) - 1
    for line in _lines(source):
        if wanted and line.text == SEPARATOR:
            at = line.at(source.path, 0, len(SEPARATOR))
            places.append(at)
            if source.text[line.start : line.end].splitlines() != [SEPARATOR]:
                message = (
                    f"trailing whitespace after '{SEPARATOR}': rosidl does not see the separator"
                )
                problems.append(Problem(ProblemKind.SEPARATOR, at, message))
            parts.append([])
        else:
            parts[-1].append(line)
    if len(places) != wanted:
        at = places[wanted] if len(places) > wanted else Location.start_of(source.path)
        sections = ", ".join(SECTIONS[kind])
        message = (
            f"a .{kind} file needs {wanted} line{'s' * (wanted > 1)} '{SEPARATOR}' between "
            f"{sections}, but this file has {len(places)}"
        )
        problems.append(Problem(ProblemKind.SEPARATOR, at, message))
    return parts


class _Word(NamedTuple):
    text: str
    at: Location


class _Words(NamedTuple):
    """The declaration on a line."""

    type: _Word
    name: _Word
    value: _Word
    """A default or the value of a constant; empty without one."""
    comment: str


class _Parser:
    """Parses the lines of one section."""

    def __init__(self, path: str, package: str, problems: list[Problem]) -> None:
        self._path = path
        self._package = package
        self._problems = problems
        self._fields: list[Field] = []
        self._constants: list[Constant] = []
        self._seen: dict[str, Location] = {}

    def section(self, name: str, lines: Sequence[_Line]) -> Section:
        for line in lines:
            text, _, comment = line.text.partition("#")
            text = text.rstrip()
            if text:
                self._declaration(line, text, comment.strip())
        return Section(name, tuple(self._fields), tuple(self._constants), _heading(lines))

    def _declaration(self, line: _Line, text: str, comment: str) -> None:
        indent = len(text) - len(text.lstrip(" "))
        type_text, _, behind = text[indent:].partition(" ")
        type_at = line.at(self._path, indent, len(type_text))
        if indent:
            message = "indented line: rosidl needs the type in the first column"
            self._problem(ProblemKind.SYNTAX, type_at, message)
        rest = behind.lstrip()
        if not rest:
            self._incomplete(type_text, type_at)
            return
        name, sign, value = rest.partition("=")
        if not sign:
            name, _, value = rest.partition(" ")
        name = name.rstrip()
        value = value.lstrip()
        words = _Words(
            _Word(type_text, type_at),
            _Word(name, line.at(self._path, len(text) - len(rest), max(len(name), 1))),
            _Word(value, line.at(self._path, len(text) - len(value), len(value))),
            comment,
        )
        if sign:
            self._constant(words)
        else:
            self._field(words)

    def _incomplete(self, text: str, at: Location) -> None:
        if text == SEPARATOR:
            message = f"'{SEPARATOR}' belongs in .srv and .action files only"
            self._problem(ProblemKind.SEPARATOR, at, message)
            return
        message = f"no field name after {text!r}; write a type and a name"
        self._problem(ProblemKind.SYNTAX, at, message)

    def _field(self, words: _Words) -> None:
        name, name_at = words.name
        if not is_field_name(name):
            self._problem(ProblemKind.FIELD_NAME, name_at, _bad_field_name(name))
        self._unique(name, name_at, "field")
        type_ = self._type(words.type)
        if type_ is None:
            return
        default = self._value(type_, words.value) if words.value.text else None
        self._fields.append(Field(type_, name, default, words.comment, name_at, words.type.at))

    def _constant(self, words: _Words) -> None:
        name, name_at = words.name
        if is_constant_name(name):
            self._unique(name, name_at, "constant")
        else:
            message = _bad_constant_name(name, words.type.text)
            self._problem(ProblemKind.CONSTANT_NAME, name_at, message)
        type_ = self._type(words.type)
        if type_ is None:
            return
        if words.type.text not in PRIMITIVES:
            message = (
                f"a constant cannot be a {words.type.text!r}; use a primitive type without bounds"
            )
            self._problem(ProblemKind.TYPE, words.type.at, message)
            return
        value = self._value(type_, words.value)
        if value is not None:
            self._constants.append(Constant(type_, name, value, words.comment, name_at))

    def _type(self, word: _Word) -> FieldType | None:
        try:
            return parse_type(word.text, self._package)
        except TypeSpellingError as error:
            self._problem(ProblemKind.TYPE, word.at, str(error))
            return None

    def _value(self, type_: FieldType, word: _Word) -> Value | None:
        try:
            return parse_value(type_, word.text)
        except ValueSpellingError as error:
            self._problem(ProblemKind.VALUE, word.at, str(error))
            return None

    def _unique(self, name: str, at: Location, kind: str) -> None:
        before = self._seen.setdefault(f"{kind} {name}", at)
        if before is not at:
            message = f"the {kind} {name!r} exists already, in line {before.line}"
            self._problem(ProblemKind.DUPLICATE, at, message)

    def _problem(self, kind: ProblemKind, at: Location, message: str) -> None:
        self._problems.append(Problem(kind, at, message))


def _heading(lines: Iterable[_Line]) -> str:
    heading: list[str] = []
    for line in lines:
        if not line.text.startswith("#"):
            break
        heading.append(line.text.lstrip("#").strip())
    return "\n".join(heading).strip()


def _bad_field_name(name: str) -> str:
    message = (
        f"{name!r} is not a valid field name: rosidl requires lower-case letters, digits and "
        "single underscores, a letter first"
    )
    better = suggest_field_name(name)
    return f"{message}, as in {better!r}" if better else message


def _bad_constant_name(name: str, type_text: str) -> str:
    if name.startswith("<"):
        return f"a bound is written without spaces, as in '{type_text}<=10'"
    if " " in name:
        return (
            f"the '=' makes this line a constant, and {name!r} is not a valid name for "
            "one; a default value comes after the name, without '='"
        )
    message = (
        f"the '=' makes this line a constant, and {name!r} is not a valid name for one: "
        "rosidl requires capitals, digits and single underscores, a letter first"
    )
    better = suggest_constant_name(name)
    return f"{message}, as in {better!r}" if better else message
