"""The settings of pytest in a package, and the files that it collects with them."""

from __future__ import annotations

import os
import posixpath
import re
import shlex
from collections.abc import Mapping, Sequence
from contextlib import suppress
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING, Any

from scaffold.model.discovery.gitignore import directories_above
from scaffold.record import NamedTuple
from scaffold.source import Location, Source, ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_SECTIONS = {"pytest.ini": "pytest", ".pytest.ini": "pytest"}
_LATER_SECTIONS = {"tox.ini": "pytest", "setup.cfg": "tool:pytest"}
_SKIPPED = frozenset({"build", "dist", "node_modules", "venv", "CVS", "_darcs"})
"""The directories that pytest skips by default."""


class Setting(NamedTuple):
    """A setting of pytest."""

    words: Sequence[str]
    location: Location
    """The start of the package for a file above it."""
    file: str = ""
    """The file above the package, such as ``../pytest.ini``."""


def pytest_settings(package: Package) -> Mapping[str, Setting]:
    """Return the settings in the file that pytest reads, by name; none if it is malformed."""
    with suppress(ViewError, ValueError):
        for name, section in _SECTIONS.items():
            if package.has(name):
                return _of_ini(package, name, section) or {}
        found = _of_toml(package) if package.has("pyproject.toml") else None
        for name, section in _LATER_SECTIONS.items():
            if found is None and package.has(name):
                found = _of_ini(package, name, section)
        return _above(package) if found is None else found
    return {}


def _above(package: Package) -> Mapping[str, Setting]:
    """Return the settings in the first file above a package, which pytest reads as well.

    Without ``testpaths``, which only counts for tests run in the directory of that file.
    """
    for depth, directory in enumerate(directories_above(package), 1):
        for name, section in (_SECTIONS | _LATER_SECTIONS).items():
            path = os.path.join(directory, name)
            if not package.outside.is_file(path):
                continue
            with suppress(OSError):
                source = Source.decode(name, package.outside.read(path))
                found = _in_section(source, section)
                if found is not None:
                    start, shown = package.start_of("package.xml"), f"{'../' * depth}{name}"
                    return {
                        key: Setting(setting.words, start, shown)
                        for key, setting in found.items()
                        if key != "testpaths"
                    }
    return {}


def _of_ini(package: Package, name: str, section: str) -> Mapping[str, Setting] | None:
    return _in_section(package.source(name), section)


def _in_section(source: Source, section: str) -> Mapping[str, Setting] | None:
    from scaffold.formats.ini import IniFile

    found = IniFile.parse(source).sections.get(section)
    if found is None:
        return None
    return {
        key: Setting(shlex.split(option.value, comments=True), option.location)
        for key, option in found.options.items()
    }


def _of_toml(package: Package) -> Mapping[str, Setting] | None:
    from scaffold.toml import loads

    source = package.source("pyproject.toml")
    table: Any = loads(source.text)
    for key in ("tool", "pytest", "ini_options"):
        table = table.get(key) if isinstance(table, dict) else None
    if not isinstance(table, dict):
        return None
    result: dict[str, Setting] = {}
    for key, value in table.items():
        line = re.search(rf"(?m)^[ \t]*{re.escape(key)}[ \t]*=.*$", source.text)
        at = source.location(*line.span()) if line else Location.start_of("pyproject.toml")
        words = (
            [str(item) for item in value] if isinstance(value, list) else shlex.split(str(value))
        )
        result[key] = Setting(words, at)
    return result


def files_collected(package: Package, settings: Mapping[str, Setting]) -> list[str]:
    """Return the test files that pytest collects with some settings."""
    patterns = settings["python_files"].words if "python_files" in settings else _PATTERNS
    skipped = settings["norecursedirs"].words if "norecursedirs" in settings else _SKIPPED
    given = settings["testpaths"].words if "testpaths" in settings else ()
    paths = [posixpath.normpath(path) for path in given]
    tops = [top for top in paths if any(_is_below(path, top) for path in package.files)]
    return [
        path
        for path in package.files
        if path.endswith(".py")
        and not any(fnmatchcase(part, item) for part in path.split("/")[:-1] for item in skipped)
        and any(fnmatchcase(path.rpartition("/")[2], pattern) for pattern in patterns)
        and (not tops or any(_is_below(path, top) for top in tops))
    ]


_PATTERNS = ("test_*.py", "*_test.py")


def _is_below(path: str, top: str) -> bool:
    above = path.split("/")
    return top == "." or any(
        fnmatchcase("/".join(above[:depth]), top) for depth in range(1, len(above) + 1)
    )


def module_name(package: Package, path: str) -> str:
    """Return the name by which pytest imports a test file, from the top of its package."""
    directory, _, name = path.rpartition("/")
    names = [name.removesuffix(".py")]
    while directory and package.has(f"{directory}/__init__.py"):
        directory, _, parent = directory.rpartition("/")
        names.insert(0, parent)
    return ".".join(names)
