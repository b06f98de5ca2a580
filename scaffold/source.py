"""The text of a file, and locations in it."""

from __future__ import annotations

from bisect import bisect_right
from functools import cached_property

from scaffold.record import NamedTuple


class Location(NamedTuple):
    """A range in a file: lines and columns count from 1, the end is exclusive."""

    path: str
    """The path relative to the package's root, with ``/`` as separator."""
    line: int
    column: int
    end_line: int
    end_column: int

    @property
    def location(self) -> Location:
        """The location itself, so that it can be reported like other objects with one."""
        return self

    @classmethod
    def start_of(cls, path: str, line: int = 1) -> Location:
        """Return the empty range at the start of a line."""
        return cls(path, line, 1, line, 1)


class Source:
    """A decoded file.

    Offsets are characters of ``text``, which keeps the byte order mark and the line endings of
    the file; ``text.encode(encoding)`` gives the file back.
    """

    def __init__(self, path: str, text: str, encoding: str = "utf-8") -> None:
        self.path = path
        self.text = text
        self.encoding = encoding

    @classmethod
    def decode(cls, path: str, data: bytes, encoding: str = "utf-8") -> Source:
        """Decode a file.

        Raises:
            ParseError: the bytes are invalid in this encoding.
        """
        try:
            return cls(path, data.decode(encoding), encoding)
        except UnicodeDecodeError as error:
            line = data.count(b"\n", 0, error.start) + 1
            at = Location.start_of(path, line)
            message = f"byte 0x{data[error.start]:02x} is not valid {encoding.upper()}"
            raise EncodingError(at, message) from error
        except LookupError as error:
            message = f"the declared encoding {encoding!r} is not known"
            raise ParseError(Location.start_of(path), message) from error

    @cached_property
    def line_starts(self) -> list[int]:
        """The offsets of the lines."""
        starts = [0]
        find = self.text.find
        at = find("\n")
        while at >= 0:
            starts.append(at + 1)
            at = find("\n", at + 1)
        return starts

    @cached_property
    def lines(self) -> list[str]:
        """The lines without their endings."""
        return [line.rstrip("\r") for line in self.text.split("\n")]

    @cached_property
    def has_lone_returns(self) -> bool:
        r"""Whether a ``\r`` is not part of ``\r\n``: Python ends a line there, ``lines`` do not."""
        return "\r" in self.text.replace("\r\n", "")

    @property
    def newline(self) -> str:
        r"""The line ending of the first line: ``\r\n`` or ``\n``."""
        first = self.text.find("\n")
        return "\r\n" if first > 0 and self.text[first - 1] == "\r" else "\n"

    def offset(self, line: int, column: int = 1) -> int:
        """Return the offset of a line and column, both from 1, limited to the text."""
        starts = self.line_starts
        if line > len(starts):
            return len(self.text)
        return min(starts[line - 1] + column - 1, len(self.text))

    def position(self, offset: int) -> tuple[int, int]:
        """Return line and column, both from 1, of an offset."""
        line = bisect_right(self.line_starts, offset)
        return line, offset - self.line_starts[line - 1] + 1

    def location(self, start: int, end: int | None = None) -> Location:
        """Return the place of the text from offset ``start`` to before ``end``."""
        return Location(self.path, *self.position(start), *self.position(end or start))

    def line_location(self, line: int) -> Location:
        """Return the place of a whole line, without its ending."""
        length = len(self.lines[line - 1]) if line <= len(self.lines) else 0
        return Location(self.path, line, 1, line, length + 1)


class ViewError(Exception):
    """A view of a package is not available; rules that need it report nothing."""


class MissingFileError(ViewError):
    """The package does not have the file that the view is built from."""


class ParseError(ViewError):
    """A file cannot be parsed; reported once, as SC001, at its place."""

    def __init__(self, location: Location, message: str) -> None:
        super().__init__(message)
        self.location = location
        self.message = message


class EncodingError(ParseError):
    """A file is not valid in its encoding; not every reader requires that."""


class UnreadEndError(ParseError):
    """The error is outside of the element that readers of the file use."""


class TooLargeError(ParseError):
    """A file that is too large to be read; reported once, as SC004."""


class NewerSyntaxError(ViewError):
    """A Python file that needs a newer Python than the running one; not a flaw."""

    def __init__(self, location: Location, version: tuple[int, int]) -> None:
        super().__init__(f"needs Python {version[0]}.{version[1]} or newer")
        self.location = location
        self.version = version
