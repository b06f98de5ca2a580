"""setup.cfg: sections and options with locations, parsed as setuptools does."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.record import NamedTuple
from scaffold.source import Location, ParseError, Source

if TYPE_CHECKING:
    from scaffold.edits import Edit

DEFAULT_SECTION = "DEFAULT"
_LINE = lazy_re.compile(r"[^\r\n]*(?:\r\n|\r|\n|\Z)")
_HEADER = lazy_re.compile(r"\[(.+)\]")
_DELIMITER = lazy_re.compile(r"[=:]\s*")
_COMMENTS = ("#", ";")


class IniLine(NamedTuple):
    """One line of a value, without spaces around it."""

    text: str
    location: Location


class IniOption(NamedTuple):
    """An option of a section; offsets are characters of the source's text."""

    section: str
    key: str
    """The key as written; setuptools is case-sensitive."""
    value: str
    """All lines, joined with newlines."""
    lines: tuple[IniLine, ...]
    """The non-empty lines."""
    location: Location
    """The place of the value."""
    key_location: Location
    start: int
    """The offset of the line of the key."""
    key_start: int
    value_start: int
    value_end: int
    end: int
    """The offset after the last line of the value."""


class IniSection:
    """A section; a duplicate one is an error, as for setuptools."""

    def __init__(
        self, name: str, location: Location, name_location: Location, start: int, end: int
    ) -> None:
        self.name = name
        self.location = location
        """The location of the header, including brackets."""
        self.name_location = name_location
        self.start = start
        """The offset of the header's line."""
        self.end = end
        """The offset after the last line other than empty lines and comments."""
        self.options: dict[str, IniOption] = {}


class IniFile:
    """A file such as setup.cfg."""

    def __init__(self, source: Source, sections: dict[str, IniSection]) -> None:
        self.source = source
        self.sections = sections

    @classmethod
    def parse(cls, source: Source) -> IniFile:
        """Read a file.

        Raises:
            ParseError: setuptools would reject it.
        """
        return cls(source, _Reader(source).read())

    def option(self, section: str, *keys: str) -> IniOption | None:
        """Return the first existing one of some options of a section or the defaults."""
        for name in (section, DEFAULT_SECTION):
            current = self.sections.get(name)
            if current is None and name == section:
                return None
            for key in keys:
                if current is not None and key in current.options:
                    return current.options[key]
        return None

    def get(self, section: str, *keys: str) -> str | None:
        """Return the value of the first existing one of some options."""
        option = self.option(section, *keys)
        return None if option is None else option.value

    @cached_property
    def options(self) -> list[IniOption]:
        """All options, in the order of the file."""
        return [option for section in self.sections.values() for option in section.options.values()]

    # -- edits

    def set(self, section: str, key: str, value: str) -> Edit:
        """Return the edit that sets the value of an option, which it adds if missing."""
        from scaffold.edits import Edit

        path, newline = self.source.path, self.source.newline
        existing = self.sections.get(section)
        if existing is not None and key in existing.options:
            option = existing.options[key]
            return Edit(path, option.value_start, option.value_end, value)
        line = f"{key}={value}"
        if existing is not None:
            return Edit(path, existing.end, existing.end, f"{newline}{line}")
        text = self.source.text
        at = len(text.rstrip())
        before = newline if text[:at] else ""
        after = "" if "\n" in text[at:] else newline
        return Edit(path, at, at, f"{before}[{section}]{newline}{line}{after}")

    def rename(self, option: IniOption, key: str) -> Edit:
        """Return the edit that renames the key of an option."""
        from scaffold.edits import Edit

        start = option.key_start
        return Edit(self.source.path, start, start + len(option.key), key)


class _Line(NamedTuple):
    """A line that is neither empty nor a comment, without spaces around it."""

    text: str
    start: int
    indent: int
    line_start: int

    @property
    def end(self) -> int:
        return self.start + len(self.text)


class _Reader:
    def __init__(self, source: Source) -> None:
        self.source = source
        self.sections: dict[str, IniSection] = {}
        self.section: IniSection | None = None
        self.key: tuple[_Line, str, int] | None = None
        """The line of the current option, its key and the start of its value."""
        self.values: list[_Line] = []
        self.raw: list[str] = []

    def read(self) -> dict[str, IniSection]:
        level = 0
        for line in self._lines():
            if line is None:
                self.raw.append("")
            elif self.key is not None and line.indent > level:
                self.raw.append(line.text)
                self.values.append(line)
            else:
                level = line.indent
                self._finish()
                self._begin(line)
        self._finish()
        return self.sections

    def _lines(self) -> Iterator[_Line | None]:
        """Yield the lines without comments, ``None`` for an empty one."""
        text = self.source.text
        at = 0
        while at < len(text):
            match = _LINE.match(text, at)
            line = match[0] if match else text[at:]
            stripped = line.strip()
            if not stripped:
                yield None
            elif not stripped.startswith(_COMMENTS):
                indent = len(line) - len(line.lstrip())
                yield _Line(stripped, at + indent, indent, at)
            at += len(line)

    def _begin(self, line: _Line) -> None:
        locate = self.source.location
        header = _HEADER.match(line.text)
        if header is not None:
            end = line.start + header.end()
            self._open(header[1], locate(line.start, end), line)
            return
        if self.section is None:
            subject = "a byte order mark" if line.text.startswith("\ufeff") else "this line"
            message = f"a section such as [develop] expected before {subject}"
            raise ParseError(locate(line.start, line.end), message)
        delimiter = _DELIMITER.search(line.text)
        key = line.text[: delimiter.start()].rstrip() if delimiter else ""
        if delimiter is None or not key:
            message = 'a key expected before "="' if delimiter else '"=" expected after the key'
            raise ParseError(locate(line.start, line.end), message)
        if key in self.section.options:
            first = self.section.options[key].key_location.line
            message = f"{key} is set in line {first} already"
            raise ParseError(locate(line.start, line.start + len(key)), message)
        value = line.start + delimiter.end()
        self.key = (line, key, value)
        self.raw = [line.text[delimiter.end() :]]
        self.values = [_Line(self.raw[0], value, 0, line.line_start)] if self.raw[0] else []

    def _open(self, name: str, at: Location, line: _Line) -> None:
        if name in self.sections and name != DEFAULT_SECTION:
            first = self.sections[name].location.line
            raise ParseError(at, f"the section [{name}] is in line {first} already")
        inside = self.source.location(line.start + 1, line.start + 1 + len(name))
        if name not in self.sections:
            self.sections[name] = IniSection(name, at, inside, line.line_start, line.end)
        self.section = self.sections[name]
        self.section.end = line.end

    def _finish(self) -> None:
        """Add the current option to its section."""
        if self.key is None or self.section is None:
            return
        line, key, value = self.key
        self.key = None
        locate = self.source.location
        start = self.values[0].start if self.values else value
        end = self.values[-1].end if self.values else value
        self.section.end = max(line.end, end)
        self.section.options[key] = IniOption(
            section=self.section.name,
            key=key,
            value="\n".join(self.raw).rstrip(),
            lines=tuple(IniLine(item.text, locate(item.start, item.end)) for item in self.values),
            location=locate(start, end),
            key_location=locate(line.start, line.start + len(key)),
            start=line.line_start,
            key_start=line.start,
            value_start=start,
            value_end=end,
            end=max(line.end, end),
        )
