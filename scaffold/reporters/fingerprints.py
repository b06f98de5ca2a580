"""Fingerprints identify a finding even after the lines around it have moved."""

from __future__ import annotations

from collections import Counter
from hashlib import sha256
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.ament.codes import STYLE
from scaffold.check.several import without_distribution
from scaffold.model.remembered import remembered
from scaffold.reporters.paths import in_repository
from scaffold.source import ViewError

if TYPE_CHECKING:
    from collections.abc import Callable

    from scaffold.diagnostic import Diagnostic
    from scaffold.model.package import Package

_BLOCK = 100
"""The number of characters in the hash of a line, without spaces and tabs."""
_FACTOR = 37
_END_OF_FILE = "\uffff"
_STYLE_OF_FILES = frozenset({"D100", "D104"})
"""Style codes about a whole file, reported at line 1 whatever its text."""
_NUMBERS = lazy_re.compile(r"\d+")


class Fingerprints:
    """Assigns a unique fingerprint to each finding of a report.

    It depends on the file, the code, the text of the line unless the finding is about the whole
    file, and the message without its numbers, which may be those of other lines, and without the
    distributions that were checked for. Findings that agree in all of it are counted.

    Args:
        path_of: Returns the path of a file of a package that fingerprints are computed from.
    """

    def __init__(self, path_of: Callable[[Package, str], str] = in_repository) -> None:
        self._path_of = path_of
        self._counts: Counter[tuple[str, ...]] = Counter()

    def of(self, package: Package, diagnostic: Diagnostic) -> str:
        """Return the fingerprint of the next finding."""
        at = diagnostic.location
        lines = _text(package, at.path).split("\n")
        is_of_file = diagnostic.code not in STYLE or diagnostic.code in _STYLE_OF_FILES
        is_of_file &= (at.line, at.column, at.end_line, at.end_column) == (1, 1, 1, 1)
        line = lines[at.line - 1].strip() if at.line <= len(lines) and not is_of_file else ""
        message = _NUMBERS.sub("", without_distribution(diagnostic.message))
        key = (self._path_of(package, at.path), diagnostic.code, line, message)
        self._counts[key] += 1
        text = "\0".join([*key, str(self._counts[key])])
        return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def line_hash(package: Package, path: str, line: int) -> str:
    """Return the hash of a line, computed like GitHub code scanning.

    A polynomial over the characters from the start of the line, and how many earlier lines begin
    with the same characters.
    """
    hashes = package.remember(("line hashes", path), lambda: _LineHashes(_text(package, path)))
    return hashes.of(line)


class _LineHashes:
    def __init__(self, text: str) -> None:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
        text = text.replace(" ", "").replace("\t", "")
        if not text.isascii():
            units = text.encode("utf-16-le", "surrogatepass")  # as JavaScript counts characters
            text = "".join(map(chr, memoryview(units).cast("H")))
        blocks: list[str] = []
        start = 0
        text += _END_OF_FILE + "\0" * _BLOCK
        while True:
            blocks.append(text[start : start + _BLOCK])
            start = text.find("\n", start) + 1
            if not start:
                break
        counts: Counter[str] = Counter()
        self._blocks: list[tuple[str, int]] = []
        for block in blocks:
            counts[block] += 1
            self._blocks.append((block, counts[block]))

    def of(self, line: int) -> str:
        block, count = self._blocks[min(line, len(self._blocks)) - 1]
        value = 0
        for character in block:
            value = value * _FACTOR + ord(character)
        return f"{value % 2**64:x}:{count}"


@remembered
def _text(package: Package, path: str) -> str:
    """Return the text of a file, or of none."""
    try:
        return package.data(path).decode("utf-8", "replace")
    except ViewError:
        return ""
