"""Comments that begin with ``#``, as in CMake, Python, YAML and shells."""

from __future__ import annotations

from typing import AnyStr

from scaffold import lazy_re

_COMMENT = r"(?m)(?:^|(?<=[ \t)\]},;]))#[^\n]*"
_IN_TEXT, _IN_BYTES = lazy_re.compile(_COMMENT), lazy_re.compile(_COMMENT.encode())


def without_comments(text: AnyStr) -> AnyStr:
    """Return a text without comments, which are also recognized in strings.

    Args:
        text: The text of a file, in which names are searched.
    """
    if isinstance(text, bytes):
        return _IN_BYTES.sub(b"", text)
    return _IN_TEXT.sub("", text)


def code_with(data: bytes, word: bytes) -> bytes:
    """Return the lines of a file that contain a word, without comments."""
    lines: list[bytes] = []
    at = data.find(word)
    while at >= 0:
        start, end = data.rfind(b"\n", 0, at) + 1, data.find(b"\n", at)
        end = len(data) if end < 0 else end
        lines.append(data[start:end])
        at = data.find(word, end + 1)
    return without_comments(b"\n".join(lines))
