"""The launch files of a package, and the other files in their directories."""

from __future__ import annotations

import re
from collections.abc import Set as AbstractSet
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.facts import fact
from scaffold.model.launch.python_file import LaunchFile
from scaffold.model.launch.unused.unlaunched import is_only_stored
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

ENDINGS = ("launch.py", "launch.xml", "launch.yaml", "launch.yml")
DIRECTORIES = ("launch/", "launches/")
_USERS = (".py", ".xml", ".yaml", ".yml", ".cpp", ".hpp")
_LONGEST_PATH = 200
_WORD = lazy_re.compile(r"(?<![^\"'\s=/])(?!self\.)[\w-]*\.[\w.-]*")
"""Matches possible file names in a text, but not attributes of ``self``."""
_INSTALLED = lazy_re.compile(
    r"(?i)share|package://|model://|\$\(find|\$\(dirname\)|__file__|ThisLaunchFileDir|MoveItConfigs"
)
"""Matches what paths to installed files start with."""
_OF_DATA = (
    *(".yaml", ".yml", ".json", ".xml", ".rviz", ".urdf", ".xacro", ".sdf", ".world", ".pgm"),
    *(".png", ".dae", ".stl", ".csv", ".cfg", ".ini", ".toml", ".lua"),
)
"""The suffixes of most data files."""
DATA_DIRECTORIES = ("config", "params", "param", "rviz", "urdf", "maps", "worlds", "meshes")
"""Directories whose files are read at run time from ``share/<package>``."""


def launch_files(package: Package) -> list[str]:
    """Return the launch files, by file name or ``generate_launch_description``."""
    return [path for path in package.files if _is_launch_file(package, path)]


def data_files(package: Package, directory: str) -> list[str]:
    """Return the files of a data directory that a node or a launch file may read."""
    return [
        path
        for path in package.files
        if path.startswith(f"{directory}/") and not path.endswith((".py", ".md", ".in", ".txt"))
    ]


def is_named(package: Package, directory: str) -> bool:
    """Return whether code or a launch file of the workspace looks for a file of a data directory.

    The name of a file alone may be that of one in any other directory.
    """
    mine = (f"{directory}/", "test/", "tests/")
    elsewhere = [path for path in package.files if not path.startswith(mine)]
    names = _names(data_files(package, directory)) - _names(elsewhere)
    for other in package.workspace:
        wanted = names
        if other.name != package.name:  # which may refer to its own file of this name
            wanted = names - _data_names(other)
        if not wanted or (wanted.isdisjoint(_words(other)) and all(map(_is_word, wanted))):
            continue
        for path in other.files:
            is_own = other.name == package.name and path.startswith(f"{directory}/")
            if not is_own and _named_in(package, other, path, directory, wanted):
                return True
    return False


def _named_in(
    package: Package, user: Package, path: str, directory: str, wanted: AbstractSet[str]
) -> AbstractSet[str]:
    """Return the data files of a package that a file mentions, with installed places."""
    if not path.endswith(_USERS):
        return set()
    try:
        text = user.source(path).text
    except ViewError:
        return set()
    if directory not in text or not _INSTALLED.search(text):
        return set()
    named = {name for name in wanted if name in text and _is_named_in(text, name)}
    named = {name for name in named if not is_only_stored(user, path, name)}
    if named:
        named -= _of_other_packages(package, user, path)
    if user.name == package.name:
        return named
    return {name for name in named if not _is_of_neighbor(package, name)}


@fact
def _words(package: Package) -> frozenset[str]:
    """Return the words that may name data files in the code and launch files of a package."""
    result: set[str] = set()
    for path in package.files:
        if path.endswith(_USERS):
            with suppress(ViewError):
                result.update(_WORD.findall(package.source(path).text))
    return frozenset(word for word in result if word.endswith(_OF_DATA))


def _is_word(name: str) -> bool:
    return name.endswith(_OF_DATA) and _WORD.fullmatch(name) is not None


@fact
def _data_names(package: Package) -> frozenset[str]:
    """Return the names of the data files of a package."""
    return frozenset(
        name for directory in DATA_DIRECTORIES for name in _names(data_files(package, directory))
    )


def _is_of_neighbor(package: Package, name: str) -> bool:
    """Return whether another package has a data file with this name."""
    return any(
        name in _data_names(other) for other in package.workspace if other.name != package.name
    )


def _is_named_in(text: str, name: str) -> bool:
    """Return whether a text mentions a file, not as a path into a source tree."""
    for match in re.finditer(rf"{re.escape(name)}(?![\w.-])", text):
        line = text[max(0, match.start() - _LONGEST_PATH) : match.start()]
        path = re.split(r"[\"'\s=]", line)[-1]
        if path[-1:] in {"", "/"} and "/src/" not in f"/{path}":
            return True
    return False


def _of_other_packages(package: Package, user: Package, path: str) -> set[str]:
    """Return the names that a launch file uses only for files of other packages."""
    if not path.endswith(".py"):
        return set()
    try:
        paths = LaunchFile.of(user, path).share_paths
    except ViewError:
        return set()
    own = _names([item.path for item in paths if item.package == package.name])
    return _names([item.path for item in paths if item.package != package.name]) - own


def _names(paths: list[str]) -> set[str]:
    return {path.rpartition("/")[2] for path in paths}


def _is_launch_file(package: Package, path: str) -> bool:
    directory, _, name = path.rpartition("/")
    if not f"{directory}/".startswith(DIRECTORIES):
        return False
    if name.endswith(ENDINGS):
        return True
    if not name.endswith(".py"):
        return False
    try:
        return package.module(path).defines("generate_launch_description") is True
    except ViewError:
        return False
