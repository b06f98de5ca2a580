"""The words in the files of a package: who may mention a name is known without reading them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.formats.hash_comments import without_comments
from scaffold.model.facts import fact
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_WORD = lazy_re.compile(rb"\b[A-Za-z_]\w*")


@fact
def words_of(package: Package, path: str) -> bytes:
    """Return the words of a file outside of comments, each between ends of lines.

    Raises:
        ViewError: the file cannot be read.
    """
    return _framed(sorted({*_WORD.findall(without_comments(package.data(path)))}))


def files_with(
    package: Package, kind: object, paths: Callable[[], Iterable[str]], name: bytes
) -> Iterator[str]:
    """Yield the files that have all words of a name outside of comments, or cannot be read.

    Args:
        package: The package.
        kind: Identifies the files.
        paths: Returns the files to search.
        name: A name; it need not be one word.
    """

    def read() -> list[tuple[str, bytes | None]]:
        return [(path, _readable_words_of(package, path)) for path in paths()]

    words = [_framed([word]) for word in _WORD.findall(name)]
    for path, text in package.remember(("words", kind), read):
        if text is None or all(word in text for word in words):
            yield path


def _readable_words_of(package: Package, path: str) -> bytes | None:
    try:
        return words_of(package, path)
    except ViewError:
        return None


def _framed(words: Iterable[bytes]) -> bytes:
    return b"\n%b\n" % b"\n\n".join(words)
