"""Python files that nobody runs: neither installed nor imported, or kept as a copy of old code."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from scaffold.model.python.module import is_in_tests

if TYPE_CHECKING:
    from scaffold.model.package import Package

_COPY = re.compile(
    r"^(?:old|backup|bak|deprecated|unused)[_ -]|^copy[_ -]of"
    r"|[_ .-](?:old|backup|bak|orig|original|deprecated|unused|copy)(?:[_ -]?\d{1,8})?$"
    r"|[ ](?:copy[ ])?\(?\d{1,4}\)?$|[ ]copy[ ]\d{1,4}$",
    re.IGNORECASE,
)
"""Matches the name of a module that somebody has kept beside the one that is used."""
_BUILDING = ("CMakeLists.txt", "setup.py", "setup.cfg", "pyproject.toml")
_NAMING = (".py", ".txt", ".cfg", ".toml", ".xml", ".yaml", ".yml", ".cmake", ".launch", ".sh")
_RUN_AS_THEY_ARE = frozenset({"setup.py", "conftest.py", "__init__.py", "__main__.py"})


def is_copy_of_old_code(package: Package, path: str) -> bool:
    """Tell whether a module is named like a copy, and nothing in the package names it."""
    name = path.rpartition("/")[2]
    stem = name.removesuffix(".py")
    if stem == name or not _COPY.search(stem):
        return False
    return not _is_named(package, path, stem)


def is_out_of_reach(package: Package, path: str) -> bool:
    """Tell whether a Python file is in no directory that is installed, and nothing names it."""
    directory, _, name = path.rpartition("/")
    stem = name.removesuffix(".py")
    if stem == name or name in _RUN_AS_THEY_ARE or is_in_tests(path) or ".launch." in name:
        return False
    if not any(package.has(item) for item in _BUILDING[:2]):
        return False
    parts = directory.split("/") if directory else []
    if any(package.has("/".join([*parts[:at], "__init__.py"])) for at in range(1, len(parts) + 1)):
        return False
    installing = [package.data(item) for item in _BUILDING if package.has(item)]
    is_mentioned = any(_mentions(data, part) for part in parts for data in installing)
    is_taken_whole = not parts and any(b"*.py" in data for data in installing)
    return not (is_mentioned or is_taken_whole or _is_named(package, path, stem))


def _is_named(package: Package, path: str, stem: str) -> bool:
    """Tell whether any other file of the package has the name of a module."""
    others = (
        item
        for item in package.files
        if item != path and (item.endswith(_NAMING) or item.startswith("scripts/"))
    )
    return any(_mentions(package.data(item), stem) for item in others)


def _mentions(data: bytes, name: str) -> bool:
    word = name.encode("utf-8", "surrogateescape")
    return word in data and re.search(rb"(?<![\w-])%b(?![\w-])" % re.escape(word), data) is not None
