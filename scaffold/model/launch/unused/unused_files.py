"""Parameter files and descriptions of robots that no launch file and no text names."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.formats.hash_comments import without_comments
from scaffold.model.contents.dead_code import is_dead
from scaffold.model.discovery.texts_above import names_above
from scaffold.model.install.reach import is_unreached
from scaffold.model.launch.python_file import LaunchFile
from scaffold.model.launch.unused.unlaunched import is_never_used
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_DATA = (".yaml", ".yml", ".urdf", ".xacro", ".sdf")
"""The endings of files that only have an effect if another file names them."""
_NAMING = (
    *(".py", ".xml", ".launch", ".sh", ".md", ".rst", ".cpp", ".hpp", ".world", ".txt", ".cmake"),
    *_DATA,
)
"""The endings of files that start nodes, build a robot, or tell people how to."""
_WITH_HASHES = (".py", ".yaml", ".yml", ".sh", ".txt", ".cmake")
_WITH_MARKUP = (".xml", ".launch", ".urdf", ".xacro", ".sdf", ".world")
_JOINED = lazy_re.compile(rb"([\"'])\s*\+\s*\1")
"""Matches what separates two literals that are added."""
_DYNAMIC = rb"(?:\{[^{}\n]{0,99}\}|\$\([^()\n]{0,99}\)|%[sd]|\$\w{1,99}|\$\{[^{}\n]{0,99}\})"
"""Matches the part of a name that is only known when a launch file runs."""
_COMPUTED = lazy_re.compile(rb"[\w.-]{0,99}(?:%b[\w.-]{0,99}){1,9}" % _DYNAMIC)
_ADDED = lazy_re.compile(rb"(?:\+\s*[\"'](?![\w.-]*/)|[\"'](?=[._-]))([\w.-]+)[\"']")
"""Matches a literal that is added to the first part of a name, or is no name by itself."""
_MARKUP = (".py", ".xml", ".yaml", ".yml")


def is_left_alone(package: Package, path: str) -> bool:
    """Return whether launch files are about a package, and nothing that is used names a file.

    A launch file that computes names may name any that fits; one of another package with a file of
    that name means that one.
    """
    return package.remember(
        ("left alone", path), lambda: _is_left_alone(package, path, frozenset())
    )


def _is_left_alone(package: Package, path: str, seen: frozenset[tuple[str, str]]) -> bool:
    seen |= {(package.name, path)}
    name = path.rpartition("/")[2]
    if names_above(package, name):
        return False
    whole = re.compile(rb"(?<![\w.-])%b" % re.escape(_encoded(name)))
    is_launched = False
    for user in package.workspace:
        texts = dict(_texts(user))
        if user is not package and not any(_encoded(package.name) in x for x in texts.values()):
            continue
        is_launched = is_launched or any(map(_is_launch_file, texts))
        has_own = any(item.endswith(f"/{name}") for item in user.files)
        for file, text in texts.items():
            if (user.name, file) in seen:
                continue
            is_about = user is package or _encoded(package.name) in text
            if not is_about and has_own:
                continue
            if is_about and _is_computed_in(text, name):
                return False
            if whole.search(text) and not _is_unused_in(user, file, name, seen):
                return False
    return is_launched


def _encoded(name: str) -> bytes:
    return name.encode("utf-8", "surrogateescape")


def _texts(package: Package) -> Iterator[tuple[str, bytes]]:
    """Yield the files of a package that may name others, without comments."""
    for path in package.files:
        if not path.endswith(_NAMING) or path.endswith("setup.py"):
            continue
        try:
            data = package.data(path)
        except ViewError:
            continue
        if path.endswith(_WITH_HASHES):
            data = without_comments(data)
        elif path.endswith(_WITH_MARKUP):
            data, *parts = data.split(b"<!--")
            data += b"".join(part.partition(b"-->")[2] for part in parts)
        yield path, _JOINED.sub(b"", data)


def _is_computed_in(text: bytes, name: str) -> bool:
    """Return whether a text puts the name of a file together from parts that may result in it."""
    ending = _encoded(f".{name.rpartition('.')[2]}")
    if ending not in text:
        return False
    if any(
        _encoded(name).endswith(added[1]) for added in _ADDED.finditer(text) if ending in added[1]
    ):
        return True
    for computed in _COMPUTED.finditer(text):
        if computed[0].endswith(ending):
            parts = re.split(_DYNAMIC, computed[0])
            if re.fullmatch(rb".*".join(map(re.escape, parts)), _encoded(name)):
                return True
    return False


def _is_unused_in(package: Package, path: str, name: str, seen: frozenset[tuple[str, str]]) -> bool:
    """Return whether a file that names another one has no effect, at least not there."""
    if path.endswith(_DATA) and not _is_launch_file(path):
        return _is_left_alone(package, path, seen)
    if not path.endswith(".py"):
        return False
    if is_unreached(package, path):
        return True
    try:
        launch = LaunchFile.of(package, path)
        named = [
            constant
            for constant in launch.module.walk(ast.Constant)
            if isinstance(constant.value, str) and name in constant.value
        ]
        return bool(named) and all(
            is_never_used(launch, constant) or is_dead(package, path, constant.lineno)
            for constant in named
        )
    except ViewError:
        return False


def _is_launch_file(path: str) -> bool:
    return "launch" in path.rpartition("/")[2] and path.endswith(_MARKUP)
