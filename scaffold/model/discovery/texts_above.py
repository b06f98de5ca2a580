"""Scripts and texts of the checkout around a package, which tell what people start."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.model.discovery.gitignore import directories_above

if TYPE_CHECKING:
    from scaffold.model.package import Package

_ENDINGS = (".sh", ".bash", ".md", ".rst", ".yml", ".yaml", "dockerfile", "makefile", "justfile")
_DIRECTORIES = ("", "scripts", "docker", "bin")
"""The directories with such files, relative to each directory above a package."""


def names_above(package: Package, name: str) -> bool:
    """Return whether a script or text above a package names a file, such as ``talk.py``."""
    whole = re.compile(rb"(?<![\w.-])%b" % re.escape(name.encode("utf-8", "surrogateescape")))
    texts = package.remember("texts above", lambda: [*_texts_above(package)])
    return any(whole.search(text) for text in texts)


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
