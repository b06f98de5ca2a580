"""Scripts and texts of the checkout around a package, which tell what people start."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.discovery.gitignore import directories_above

if TYPE_CHECKING:
    from scaffold.model.package import Package

_IN_NAME = lazy_re.compile(rb"[\w.-]")
_ENDINGS = (".sh", ".bash", ".md", ".rst", ".yml", ".yaml", "dockerfile", "makefile", "justfile")
_DIRECTORIES = ("", "scripts", "docker", "bin")
"""The directories with such files, relative to each directory above a package."""


def names_above(package: Package, name: str) -> bool:
    """Return whether a script or text above a package names a file, such as ``talk.py``."""
    word = name.encode("utf-8", "surrogateescape")
    texts = package.remember("texts above", lambda: [*_texts_above(package)])
    return any(_names_file(text, word) for text in texts)


def _names_file(text: bytes, word: bytes) -> bool:
    """Return whether a text has the name of a file that is not the end of a longer one."""
    at = text.find(word)
    while at >= 0:
        if not _IN_NAME.match(text, max(at - 1, 0), at):
            return True
        at = text.find(word, at + 1)
    return False


def _texts_above(package: Package) -> Iterator[bytes]:
    disk = package.outside
    for top in directories_above(package):
        for below in _DIRECTORIES:
            directory = os.path.join(top, below)
            for name in disk.entries(directory):
                path = os.path.join(directory, name)
                if name.lower().endswith(_ENDINGS) and disk.is_file(path):
                    with suppress(OSError):
                        yield disk.read(path)
