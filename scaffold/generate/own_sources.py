"""The sources written by the authors of a package: no tests, launch or vendored files."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Hashable, Iterable
from typing import TypeVar

from scaffold import lazy_re
from scaffold.ament import copyright as notices
from scaffold.ament.copyright import Header
from scaffold.generate import repository
from scaffold.model.discovery.gitignore import is_untracked
from scaffold.model.launch.files import ENDINGS
from scaffold.model.package import Package

_T = TypeVar("_T", bound=Hashable)

_SOURCES = (".py", ".c", ".cc", ".cpp", ".cxx", ".h", ".hh", ".hpp", ".hxx")
_NOT_CODE = frozenset({"test", "tests", "launch", "launches", "doc", "docs"})
"""Directories whose files are often copied: `ros2 pkg create` writes linter tests of its own."""
_VENDORED = lazy_re.compile(
    r"(?i)_*(3rd|third)[-_]?part(y|ies)|vendor(s|ed|ing)?|extern(al|als)?|deps|dependencies|"
    r"sub_?modules|contrib|node_modules|site-packages"
)
_LICENSES = lazy_re.compile(r"(?i)(licen[sc]e|copying|notice)s?([-_.].*)?")


def own_headers(package: Package) -> list[Header]:
    """Return the headers of a package's own sources, those without a notice included."""
    foreign = tuple(_foreign_directories(package))
    return [
        header
        for header in notices.headers(package)
        if _is_own(header.path)
        and not header.path.startswith(foreign)
        and not is_untracked(package, header.path)
    ]


def license_texts(package: Package) -> list[bytes]:
    """Return the texts of the license: those of the package, else those of its repository."""
    own = [path for path in package.files if _LICENSES.fullmatch(path)]
    top = repository.place_of(package.place).top
    if own or not top:
        return [package.tree.read(path) for path in own]
    names = [name for name in package.outside.names(top)[0] if _LICENSES.fullmatch(name)]
    return [package.outside.read(os.path.join(top, name)) for name in names]


def majority(values: Iterable[_T], total: int) -> _T | None:
    """Return the value that more than half of ``total`` files have, if there is one."""
    for value, count in Counter(values).most_common(1):
        if 2 * count > total:
            return value
    return None


def _is_own(path: str) -> bool:
    *directories, name = path.split("/")
    if not name.endswith(_SOURCES) or name.endswith(ENDINGS) or name == "setup.py":
        return False
    if name.startswith("test_") or name == "conftest.py":
        return False
    return not any(
        directory in _NOT_CODE or _VENDORED.fullmatch(directory) for directory in directories
    )


def _foreign_directories(package: Package) -> set[str]:
    """Return the directories with their own license file, which are vendored."""
    result: set[str] = set()
    for path in package.files:
        directory, _, name = path.rpartition("/")
        if directory and _LICENSES.fullmatch(name):
            result.add(f"{directory}/")
    return result
