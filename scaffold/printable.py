"""Text for terminals: names and contents of files may hold escapes that a terminal obeys."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import TextIO


def printable(text: str) -> str:
    """Return one line without escapes for terminals; what cannot be shown is spelled out."""
    if text.isprintable():
        return text
    return "".join(one if one.isprintable() else _spelled(one) for one in text)


def write_lines(text: str, out: TextIO) -> None:
    """Write lines such as those of a patch: as they are to a file, spelled out on a terminal.

    Lone surrogates are written as the bytes that they are made of; see `patch.of`.
    """
    if out.isatty():
        lines = (
            "".join(one if one == "\t" else printable(one) for one in line)
            for line in text.split("\n")
        )
        text = "\n".join(lines)
    elif (buffer := getattr(out, "buffer", None)) is not None:
        out.flush()
        buffer.write(text.encode("utf-8", "surrogateescape"))
        return
    out.write(text)


def _spelled(character: str) -> str:
    if "\udc80" <= character <= "\udcff":
        # A byte of a file name that is no text.
        return f"\\x{ord(character) - 0xDC00:02x}"
    return character.encode("unicode_escape").decode("ascii")
