"""Comments that begin with ``#``, as in CMake, Python, YAML and shells."""

from __future__ import annotations

import re
from typing import AnyStr

_COMMENT = r"(?m)(?:^|(?<=[ \t)\]},;]))#[^\n]*"
_IN_TEXT, _IN_BYTES = re.compile(_COMMENT), re.compile(_COMMENT.encode())


def without_comments(text: AnyStr) -> AnyStr:
    """Return a text without comments, which are also recognized in strings.

    Args:
        text: The text of a file, in which names are searched.
    """
    if isinstance(text, bytes):
        return _IN_BYTES.sub(b"", text)
    return _IN_TEXT.sub("", text)
