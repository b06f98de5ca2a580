"""The rendered base of each file of a package, in a sidecar of its record: one line per file.

A line consists of the path, the hash and the compressed text, separated by tabs. The lines are
sorted by path, and git keeps the lines of both sides in a merge
(docs/adr/0007-packages-keep-their-origin.md).
"""

from __future__ import annotations

import base64
import hashlib
import zlib
from collections import Counter
from collections.abc import Mapping, Sequence
from difflib import SequenceMatcher
from urllib.parse import quote, unquote

from scaffold.errors import InputError
from scaffold.writing.transaction import BASES, RECORD

MOST = 20_000_000
"""The maximum size of the files in a record; those of generated packages are smaller."""

_ABOUT = "# Rendered templates, for `ros2-scaffold update`. Commit this file; do not edit it.\n"
_SAFE = "/:+@ ,{}()[]="
"""Characters that are not escaped in paths; all that could end a field or a line are."""
_MARKS = ("<<<<<<<", "|||||||", "=======", ">>>>>>>")
_MAX_EQUAL = 200_000
"""The maximum number of compared pairs of equal lines; far more than in normal files."""


def hash_of(content: bytes) -> str:
    """Return the hash of a file for the record."""
    return hashlib.sha256(content).hexdigest()


def text(files: Mapping[str, str]) -> str:
    """Return the sidecar for files, by path."""
    lines = [_ABOUT]
    for path, content in sorted(files.items()):
        data = content.encode()
        packed = base64.b85encode(zlib.compress(data, 9)).decode()
        lines.append(f"{quote(path, safe=_SAFE)}\t{hash_of(data)}\t{packed}\n")
    return "".join(lines)


def parse(sidecar: str, path: str) -> dict[tuple[str, str], str]:
    """Return the texts in a sidecar, by path and hash.

    Args:
        sidecar: Its content.
        path: For messages.

    Raises:
        InputError: it is damaged or has a merge conflict.
    """
    refuse_conflict(sidecar, path)
    texts: dict[tuple[str, str], str] = {}
    rest = MOST
    for number, line in enumerate(sidecar.split("\n"), 1):
        fields = line.rstrip("\r").split("\t")
        if fields == [""] or line.startswith("#"):
            continue
        try:
            name, recorded, packed = fields
            content = _unpacked(packed, recorded, rest)
            texts[unquote(name, errors="strict"), recorded] = content.decode()
        except (ValueError, zlib.error) as error:
            reason = " ".join(str(error).split())
            raise InputError(
                f"{path}:{number}: damaged: {reason}; restore the file from git"
            ) from error
        rest -= len(content)
    return texts


def _unpacked(packed: str, recorded: str, most: int) -> bytes:
    """Decompress the text of a line.

    Raises:
        ValueError: it is too large or does not match its hash.
        zlib.error: the same.
    """
    decoder = zlib.decompressobj()
    content = decoder.decompress(base64.b85decode(packed), most + 1)
    if len(content) > most:
        raise ValueError("the files are larger than a package can be")
    if not decoder.eof or hash_of(content) != recorded:
        raise ValueError("the content does not match the hash")
    return content


def refuse_conflict(content: str, path: str) -> None:
    """Raise InputError if the record or its sidecar has a merge conflict."""
    starts = {line[: len(_MARKS[0])] for line in content.split("\n")}
    if _MARKS[0] in starts and _MARKS[-1] in starts:
        raise InputError(
            f"{path}: has a merge conflict; take the same side of {RECORD} and {BASES}, as with "
            "`git checkout --ours`, and repeat each `add` of the other side; nothing was changed"
        )


def combined(texts: Sequence[str]) -> str:
    """Combine the texts of two branches: the lines of both, common ones once."""
    first, *others = texts
    for other in others:
        first = _union(first.splitlines(keepends=True), other.splitlines(keepends=True))
    return first


def _union(ours: list[str], theirs: list[str]) -> str:
    counts = Counter(theirs)
    if sum(counts[line] for line in ours) > _MAX_EQUAL:
        return "".join(ours)
    lines: list[str] = []
    for tag, start, end, other_start, other_end in SequenceMatcher(
        None, ours, theirs, autojunk=False
    ).get_opcodes():
        lines += ours[start:end]
        if tag != "equal":
            lines += theirs[other_start:other_end]
    return "".join(lines)
