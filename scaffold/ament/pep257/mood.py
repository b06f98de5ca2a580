"""D401: whether the first word of a docstring is an imperative.

The word lists are pydocstyle's. They are read as files, because importing pydocstyle takes longer
than checking a package.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from functools import lru_cache
from typing import Protocol


@lru_cache(maxsize=4096)
def correct(word: str) -> str | None:
    """Return the imperative form of a word; ``None`` if it is fine, empty if unknown."""
    lowered = word.lower()
    if lowered in _blacklist():
        return ""
    if lowered in _imperative_words():  # the usual case, without the stems of all words of the list
        return None
    forms = _imperatives().get(_stem(lowered))
    if not forms or lowered in forms:
        return None
    return max(sorted(forms), key=lambda form: _common(lowered, form)).capitalize()


def _common(text: str, two: str) -> int:
    """Return the length of the common prefix of two words."""
    pairs = zip(text, two, strict=False)
    return next((at for at, (a, b) in enumerate(pairs) if a != b), min(len(text), len(two)))


@lru_cache(maxsize=1)
def _blacklist() -> frozenset[str]:
    return frozenset(_words("imperatives_blacklist.txt"))


@lru_cache(maxsize=1)
def _imperative_words() -> frozenset[str]:
    return frozenset(_words("imperatives.txt"))


@lru_cache(maxsize=1)
def _imperatives() -> dict[str, set[str]]:
    """Return the words of the list by stem, cached after the first time."""
    import marshal

    from scaffold.files import cache
    from scaffold.files.disk import stamp

    kept = cache.directory("words")
    place = os.path.join(kept, "imperatives") if kept else ""
    head = b"scaffold-words-1\n" + stamp(os.path.join(_data(), "imperatives.txt")).encode()
    data = cache.read_sealed(place, head) if kept else None
    if data is not None:
        stems: dict[str, set[str]] = marshal.loads(data)  # noqa: S302  own file
        return stems
    result: dict[str, set[str]] = {}
    for word in _imperative_words():
        result.setdefault(_stem(word), set()).add(word)
    if kept:
        cache.write_sealed(place, head, marshal.dumps(result))
    return result


@lru_cache(maxsize=4096)
def _stem(word: str) -> str:
    return _stemmer().stemWord(word)


class _Stemmer(Protocol):
    def stemWord(self, word: str) -> str:  # noqa: N802  snowballstemmer's name
        """Return the stem of a word."""


@lru_cache(maxsize=1)
def _stemmer() -> _Stemmer:
    from importlib import import_module
    from importlib.util import find_spec
    from types import ModuleType

    # The package itself imports the stemmers of all languages.
    spec = find_spec("snowballstemmer")
    package = ModuleType("scaffold_snowball")
    package.__path__ = [*(spec.submodule_search_locations or ())] if spec else []
    sys.modules[package.__name__] = package
    stemmer: _Stemmer = import_module(f"{package.__name__}.english_stemmer").EnglishStemmer()
    return stemmer


def _words(name: str) -> Iterator[str]:
    with open(os.path.join(_data(), name), encoding="utf-8") as file:
        for line in file:
            word = line.partition("#")[0].strip()
            if word:
                yield word


def _data() -> str:
    for entry in sys.path:
        directory = os.path.join(entry or os.curdir, "pydocstyle", "data")
        if os.path.isdir(directory):
            return directory
    from importlib.util import find_spec

    spec = find_spec("pydocstyle")
    origin = spec.origin if spec else None
    return os.path.join(os.path.dirname(origin or ""), "data")
