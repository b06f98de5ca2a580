"""Size limits for files, far above what people write."""

from __future__ import annotations

from scaffold.files.tree import (
    CMAKE_LISTS,
    MANIFEST,
    SETUP_CFG,
    SETUP_PY,
)

MAX_BYTES = 500_000
"""The size limit of code files; the largest in 800 public packages has 270 kB."""
MOST_BYTES_OF_DATA = 1_000_000
"""The size limit of YAML and documents; the largest YAML file of those packages has 270 kB."""
MOST_BYTES_OF_CMAKE = 250_000
"""The size limit of CMakeLists.txt; the largest of those packages has 60 kB."""
MOST_BYTES_OF_DECLARATIONS = 100_000
"""The size limit of package.xml, setup.py and setup.cfg, which have a few kB."""
MOST_BYTES_OF_LINE = 20_000
"""The length limit of a line of code; the longest Python line of those packages has 2 kB."""
MAX_TOKENS = 100_000
"""The token limit of code files, operators and newlines included; the largest has 70 000."""
MOST_WORDS_OF_CMAKE = 30_000
"""The word limit of CMakeLists.txt; the largest has 10 000."""
MOST_WORDS_OF_DECLARATIONS = 20_000
"""The word limit of package.xml, setup.py and setup.cfg, which have up to 1 000."""
_CODE = (".py", ".cfg", "CMakeLists.txt")
_DATA = (".yaml", ".yml", ".rst", ".md", ".txt")

_SPACE = b" \t\r"
_WORD = b"\\_0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
_KINDS = bytes(ord(" " if byte in _SPACE else "w" if byte in _WORD else ".") for byte in range(256))
"""The kind of each byte: space, part of a word, or operator."""


def why_unread(path: str, data: bytes) -> str:
    """Return why a file is not read; empty if it is.

    The time of some checks is quadratic in the length of a line, so lines are limited as well; and
    a file of two bytes for each word takes ten times as long as text of the same size.
    """
    if len(data) > most_bytes(path):
        return too_large(len(data), path)
    if len(data) <= MOST_BYTES_OF_LINE or not (path == MANIFEST or path.endswith(_CODE)):
        return ""
    longest = max(map(len, data.splitlines()))
    if longest > MOST_BYTES_OF_LINE:
        most = MOST_BYTES_OF_LINE // 1000
        return f"a line of {longest // 1000} kB; the limit is {most} kB: the file is not checked"
    most = _most_words(path)
    words = len(data) if len(data) <= most else _token_count(data)
    if words > most:
        return f"{words} tokens; the limit is {most}: the file is not checked"
    return ""


def too_large(size: int, path: str) -> str:
    """Return why a file of this size is not read."""
    return f"{size // 1000} kB; the limit is {most_bytes(path) // 1000} kB: the file is not checked"


def _token_count(data: bytes) -> int:
    """Count the tokens of code, as time and memory depend on these and not on bytes."""
    kinds = b" " + data.translate(_KINDS)
    return kinds.count(b".") + kinds.count(b" w") + kinds.count(b".w")


def most_bytes(path: str) -> int:
    """Return the size limit of a file by kind, far above what people write."""
    if path in {MANIFEST, SETUP_PY, SETUP_CFG}:
        return MOST_BYTES_OF_DECLARATIONS
    if path.endswith(CMAKE_LISTS):
        return MOST_BYTES_OF_CMAKE
    return MOST_BYTES_OF_DATA if path.endswith(_DATA) else MAX_BYTES


def _most_words(path: str) -> int:
    """Return the word limit of a file by kind."""
    if path in {MANIFEST, SETUP_PY, SETUP_CFG}:
        return MOST_WORDS_OF_DECLARATIONS
    return MOST_WORDS_OF_CMAKE if path.endswith(CMAKE_LISTS) else MAX_TOKENS
