"""Formats the changes of a `WritePlan` as a patch for ``git apply``."""

from __future__ import annotations

import os
import stat
import string
from collections.abc import Iterator, Sequence

from scaffold.writing.planned_file import PlannedFile

_ESCAPES = {7: "a", 8: "b", 9: "t", 10: "n", 11: "v", 12: "f", 13: "r", 34: '"', 92: "\\"}
_LENGTHS = string.ascii_uppercase + string.ascii_lowercase
"""The letters for the length of a line of a binary patch, from one byte on."""
_PRINTABLE = range(0x20, 0x7F)
_LOOKED_AT = 8000
"""The number of bytes that git searches for a NUL to detect binary files."""


def base(roots: Sequence[str]) -> str:
    """Return the directory to which the paths of a patch are relative.

    It is the top of the git repository around the current directory, where ``git apply`` looks for
    them, and the current directory itself outside of any repository. When a root is elsewhere, it
    is the repository around all roots, or their common parent directory.
    """
    current = os.getcwd()
    top = _repository(current) or current
    real = [os.path.realpath(root) for root in roots]
    if all(_is_in(root, top) for root in real):
        return top
    shared = os.path.commonpath(real)
    return _repository(shared) or shared


def of(file: PlannedFile, relative_to: str) -> str:
    """Return the patch of one file that changes.

    Bytes that are not UTF-8 are lone surrogates, as in the names of files: encode the patch with
    ``surrogateescape``.

    Args:
        file: The file.
        relative_to: The directory to which the path in the patch is relative.
    """
    path = os.path.relpath(file.target, relative_to).replace(os.sep, "/")
    old, new = _quoted(f"a/{path}"), _quoted(f"b/{path}")
    before, after = file.before or b"", b"" if file.is_removed else file.content
    header = f"diff --git {old} {new}\n{''.join(_modes(file))}"
    if before == after:
        return header
    if b"\0" in before[:_LOOKED_AT] or b"\0" in after[:_LOOKED_AT]:
        return header + _binary(before, after)
    old = "/dev/null" if file.before is None else _path_line(old)
    new = "/dev/null" if file.is_removed else _path_line(new)
    return f"{header}--- {old}\n+++ {new}\n{''.join(_hunks(before, after))}"


def _repository(directory: str) -> str | None:
    """Return the top of the git repository around a directory."""
    while not os.path.lexists(os.path.join(directory, ".git")):
        parent = os.path.dirname(directory)
        if parent == directory:
            return None
        directory = parent
    return directory


def _is_in(path: str, directory: str) -> bool:
    return os.path.commonpath([path, directory]) == directory


def _quoted(path: str) -> str:
    """Quote a path like git, if it has unusual characters."""
    data = os.fsencode(path)
    if all(byte in _PRINTABLE and byte not in _ESCAPES for byte in data):
        return path
    return f'"{"".join(map(_escaped, data))}"'


def _escaped(byte: int) -> str:
    if byte in _ESCAPES:
        return f"\\{_ESCAPES[byte]}"
    return chr(byte) if byte in _PRINTABLE else f"\\{byte:03o}"


def _path_line(path: str) -> str:
    """Return a path as in a ``---`` line of git, where a tab ends a path with spaces."""
    return f"{path}\t" if " " in path and not path.startswith('"') else path


def _modes(file: PlannedFile) -> Iterator[str]:
    if file.before is None:
        yield f"new file mode {_mode(is_executable=file.executable)}\n"
        return
    was_executable = bool(os.stat(file.target).st_mode & stat.S_IXUSR)
    if file.is_removed:
        yield f"deleted file mode {_mode(is_executable=was_executable)}\n"
    elif file.executable and not was_executable:
        yield f"old mode {_mode(is_executable=False)}\n"
        yield f"new mode {_mode(is_executable=True)}\n"


def _mode(*, is_executable: bool) -> str:
    return "100755" if is_executable else "100644"


def _hunks(before: bytes, after: bytes) -> Iterator[str]:
    from difflib import unified_diff
    from itertools import islice

    for line in islice(unified_diff(_lines(before), _lines(after)), 2, None):
        yield line if line.endswith("\n") else f"{line}\n\\ No newline at end of file\n"


def _lines(data: bytes) -> list[str]:
    """Return the lines with their endings, split only at newlines."""
    lines = [line + "\n" for line in data.decode(errors="surrogateescape").split("\n")]
    last = lines.pop()[:-1]
    return [*lines, last] if last else lines


def _binary(before: bytes, after: bytes) -> str:
    index = f"index {_object_name(before)}..{_object_name(after)}\n"
    return f"{index}GIT binary patch\n{_literal(after)}\n{_literal(before)}\n"


def _literal(data: bytes) -> str:
    from base64 import b85encode
    from zlib import compress

    packed = compress(data)
    width = len(_LENGTHS)
    parts = [packed[at : at + width] for at in range(0, len(packed), width)]
    lines = (f"{_LENGTHS[len(part) - 1]}{b85encode(part, pad=True).decode()}\n" for part in parts)
    return f"literal {len(data)}\n{''.join(lines)}"


def _object_name(data: bytes) -> str:
    from hashlib import sha1

    if not data:
        return "0" * 40
    return sha1(b"blob %d\0%s" % (len(data), data), usedforsecurity=False).hexdigest()
