"""The interfaces available to a package: messages, services and actions."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from scaffold.errors import InputError
from scaffold.model.interfaces.sources import (
    DefinitionSource,
    KnownPackage,
    Text,
)
from scaffold.model.interfaces.syntax import (
    SECTIONS,
    SEPARATOR,
    Constant,
    Definition,
    Field,
    Section,
    parse,
)
from scaffold.model.interfaces.types import TEXTS, Value
from scaffold.record import NamedTuple

KINDS = tuple(SECTIONS)


class Interface(NamedTuple):
    """A message, a service or an action."""

    package: str
    kind: str
    """``msg``, ``srv`` or ``action``."""
    name: str
    sections: tuple[Section, ...]
    origin: str
    """A description of the definition, for messages."""

    @property
    def full_name(self) -> str:
        """``package/kind/Name``."""
        return f"{self.package}/{self.kind}/{self.name}"

    def section(self, name: str) -> Section:
        """Return a section by name; raises KeyError for one that the kind lacks."""
        for section in self.sections:
            if section.name == name:
                return section
        raise KeyError(name)

    @property
    def all_fields(self) -> list[Field]:
        """The fields of all sections."""
        return [field for section in self.sections for field in section.fields]

    @property
    def fields(self) -> tuple[Field, ...]:
        """The fields of a message."""
        return self.section("message").fields

    @property
    def constants(self) -> tuple[Constant, ...]:
        """The constants of a message."""
        return self.section("message").constants

    @property
    def request(self) -> Section:
        """The request of a service."""
        return self.section("request")

    @property
    def response(self) -> Section:
        """The response of a service."""
        return self.section("response")

    @property
    def goal(self) -> Section:
        """The goal of an action."""
        return self.section("goal")

    @property
    def result(self) -> Section:
        """The result of an action."""
        return self.section("result")

    @property
    def feedback(self) -> Section:
        """The feedback of an action."""
        return self.section("feedback")


class Spelling(NamedTuple):
    """A type as written by the user."""

    package: str | None
    kind: str | None
    name: str


class Definitions:
    """Looks up interfaces; the first source that has a package provides all of it."""

    def __init__(self, sources: Sequence[DefinitionSource]) -> None:
        self._sources = sources
        self._packages: dict[str, KnownPackage | None] = {}
        self._interfaces: dict[str, Interface | None] = {}

    def find(self, full_name: str) -> Interface | None:
        """Return an interface by ``package/kind/Name``.

        ``None`` if it is unknown, its file has problems, or it is IDL.
        """
        if full_name not in self._interfaces:
            self._interfaces[full_name] = self._read(full_name)
        return self._interfaces[full_name]

    def _read(self, full_name: str) -> Interface | None:
        parsed = self._parsed(full_name)
        if parsed is None or parsed[1].problems:
            return None
        package, kind, name = full_name.split("/")
        return Interface(package, kind, name, parsed[1].sections, parsed[0].origin)

    def _parsed(self, full_name: str) -> tuple[Text, Definition] | None:
        package, kind, name = (*full_name.split("/"), "", "")[:3]
        source = self._package(package)
        text = source.text(kind, name) if source is not None and kind in SECTIONS else None
        if text is None or full_name.count("/") != 2:  # noqa: PLR2004  package, kind and name
            return None
        return text, parse(text.source, package, kind, name)

    def names(self, package: str, kind: str) -> Sequence[str] | None:
        """Return the sorted names of a kind in a package.

        ``None`` if the package is unknown, or may have more.
        """
        source = self._package(package)
        return source.names(kind) if source is not None and kind in SECTIONS else None

    def packages(self) -> Sequence[str]:
        """Return the sorted names of all packages that define interfaces."""
        return sorted({name for source in self._sources for name in source.packages()})

    def all_names(self) -> list[str]:
        """Return the full names of all interfaces, sorted."""
        return [
            f"{package}/{kind}/{name}"
            for package in self.packages()
            for kind in KINDS
            for name in self.names(package, kind) or ()
        ]

    def _package(self, name: str) -> KnownPackage | None:
        if name not in self._packages:
            packages = (source.package(name) for source in self._sources)
            self._packages[name] = next((item for item in packages if item is not None), None)
        return self._packages[name]

    # -- spellings of users

    def matches(self, spelling: str) -> list[str]:
        """Return the full names that match a spelling, sorted.

        ``std_msgs/msg/String``, ``std_msgs/String``, ``std_msgs.msg.String`` or ``String``; the
        last is never the copy that example_interfaces has.
        """
        wanted = spell(spelling)
        packages = [wanted.package] if wanted.package else self.packages()
        kinds = [wanted.kind] if wanted.kind else KINDS
        result = [
            f"{package}/{kind}/{wanted.name}"
            for package in packages
            for kind in kinds
            if wanted.name in (self.names(package, kind) or ())
        ]
        return [name for name in result if not _is_copy(name)] or result

    def resolve(self, spelling: str) -> Interface:
        """Return the only interface that matches a spelling.

        Raises:
            InputError: there is none, there are several, or its file cannot be read; the
                message names what it may be.
        """
        matches = self.matches(spelling)
        if not matches:
            closest = self.nearest(spelling)
            listing = "see `ros2-scaffold interfaces`"
            hint = f"; did you mean {' or '.join(closest)}?" if closest else f"; {listing}"
            raise InputError(f"there is no interface {spelling!r}{hint}")
        if len(matches) > 1:
            raise InputError(
                f"{spelling!r} is ambiguous: it may be {', '.join(matches[:-1])} or {matches[-1]}"
            )
        interface = self.find(matches[0])
        if interface is None:
            raise InputError(f"{matches[0]}: {self._why_unreadable(matches[0])}")
        return interface

    def _why_unreadable(self, full_name: str) -> str:
        parsed = self._parsed(full_name)
        if parsed is None:
            return "it is defined in IDL, or in a file that cannot be read"
        problem = parsed[1].problems[0]
        return f"{parsed[0].origin}:{problem.location.line}: {problem.message}"

    def nearest(self, spelling: str, count: int = 3) -> list[str]:
        """Return the full names closest to a misspelled one, best first."""
        wanted = spell(spelling)
        result: list[tuple[float, bool, str]] = []
        for full_name in self.all_names():
            package, kind, name = full_name.split("/")
            likeness = _similarity(wanted.name, name)
            if likeness < _ALIKE:
                continue
            if wanted.package:
                likeness += _similarity(wanted.package, package)
            if wanted.kind == kind:
                likeness += _SAME_KIND
            result.append((-likeness, _is_copy(full_name), full_name))
        best = min(result, default=(0.0, False, ""))[0]
        return [name for score, _, name in sorted(result)[:count] if score <= best + _FAR]


class WatchedDefinitions(Definitions):
    """Definitions that record whether anything was looked up in them."""

    def __init__(self, shared: Definitions, tell: Callable[[], None]) -> None:
        super().__init__(())
        self._shared = shared
        self._tell = tell

    def find(self, full_name: str) -> Interface | None:
        """Return an interface by ``package/kind/Name``."""
        self._tell()
        return self._shared.find(full_name)

    def packages(self) -> Sequence[str]:
        """Return the sorted names of all packages that define interfaces."""
        self._tell()
        return self._shared.packages()

    def _package(self, name: str) -> KnownPackage | None:
        self._tell()
        return self._shared._package(name)  # noqa: SLF001  its own class


def _is_copy(full_name: str) -> bool:
    """Return whether an interface is one of the package that repeats those of std_msgs."""
    return full_name.startswith("example_interfaces/")


_ALIKE = 0.7
_MAX_KNOWN = 300
_MAX_LENGTH = 200
"""The length of words from which they are not compared, to save time."""
_SAME_KIND = 0.1
_FAR = 0.5
"""Suggestions that are less similar than the best one by more than this are dropped."""


def _similarity(text: str, other: str) -> float:
    from difflib import SequenceMatcher

    return SequenceMatcher(None, text.lower(), other.lower()).ratio()


def closest_word(word: str, words: Sequence[str]) -> str:
    """Return the end of a message, ``; did you mean ...``; empty if nothing is similar."""
    from difflib import get_close_matches

    if len(words) > _MAX_KNOWN or len(word) > _MAX_LENGTH:
        return ""
    lowered = {name.lower(): name for name in reversed(words)}
    closest = get_close_matches(word.lower(), list(lowered), n=1, cutoff=0.6)
    return f"; did you mean {lowered[closest[0]]!r}?" if closest else ""


def spell(text: str) -> Spelling:
    """Split the spelling of a type."""
    parts = [part for part in text.replace(".", "/").split("/") if part]
    if len(parts) > 2 and parts[-2] in SECTIONS:  # noqa: PLR2004  package, kind and name
        return Spelling("/".join(parts[:-2]), parts[-2], parts[-1])
    if len(parts) == 2 and parts[0] in SECTIONS:  # noqa: PLR2004  kind and name
        return Spelling(None, parts[0], parts[1])
    return Spelling("/".join(parts[:-1]) or None, None, parts[-1] if parts else text)


# -- as text


def render(interface: Interface) -> str:
    """Return a definition as text without comments, equivalent for rosidl."""
    parts = [_render_section(section, interface.package) for section in interface.sections]
    return f"{SEPARATOR}\n".join(parts)


def _render_section(section: Section, package: str) -> str:
    lines = [
        f"{constant.type} {constant.name}={_value(constant.type.name, constant.value)}"
        for constant in section.constants
    ]
    for field in section.fields:
        type_ = str(field.type)
        if field.type.package == package:
            type_ = type_.partition("/")[2]
        line = f"{type_} {field.name}"
        if field.default is not None:
            line += f" {_value(field.type.name, field.default)}"
        lines.append(line)
    return "".join(line + "\n" for line in lines)


def _value(type_name: str, value: Value) -> str:
    if isinstance(value, tuple):
        return f"[{', '.join(_value(type_name, element) for element in value)}]"
    if isinstance(value, bool):
        return "true" if value else "false"
    if type_name in TEXTS:
        text = str(value)
        quote = "'" if '"' in text else '"'
        return quote + text.replace(quote, "\\" + quote) + quote
    return repr(value)
