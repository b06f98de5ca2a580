"""Escapes control and invisible characters in text for terminals.

Letters, digits, punctuation, symbols and the ASCII space are kept. Control characters (C0 and C1),
bidirectional and zero-width characters, other spaces, line and paragraph separators, undecodable
bytes and unassigned code points are escaped as in a Python literal.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import TextIO


def printable(text: str) -> str:
    """Return one line with control characters escaped for terminals."""
    if text.isprintable():
        return text
    return "".join(item if item.isprintable() else _spelled(item) for item in text)


def printable_lines(text: str) -> str:
    """Return lines with control characters escaped, except newlines and tabs."""
    if text.isprintable():
        return text
    return "".join(
        item if item in "\n\t" or item.isprintable() else _spelled(item) for item in text
    )


def json_text(data: object) -> str:
    """Return data as JSON in ASCII, for programs and for terminals."""
    from json import dumps

    return dumps(data, indent=2).replace("\x7f", "\\u007f")


def write_lines(text: str, out: TextIO) -> None:
    """Write lines such as those of a patch: exact to a file, escaped on a terminal.

    Lone surrogates are written as the bytes that they are made of; see `patch.of`.
    """
    if out.isatty():
        out.write(printable_lines(text))
    elif (buffer := getattr(out, "buffer", None)) is not None:
        out.flush()
        buffer.write(text.encode("utf-8", "surrogateescape"))
    else:
        out.write(text)


def _spelled(character: str) -> str:
    if "\udc80" <= character <= "\udcff":
        # An undecodable byte of a file name.
        return f"\\x{ord(character) - 0xDC00:02x}"
    return character.encode("unicode_escape").decode("ascii")
