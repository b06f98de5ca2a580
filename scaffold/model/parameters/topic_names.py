"""Parameters with topic names, and whether the package sets them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.formats.hash_comments import without_comments
from scaffold.formats.yaml import Scalar
from scaffold.model.parameters.files import parameter_file, parameter_paths
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.programs.topics import NamedEndpoint

_LAUNCH = (".launch.py", "_launch.py", ".launch.xml", ".launch.yaml", ".launch.yml", ".launch")


def keeps_default_name(package: Package, endpoint: NamedEndpoint) -> bool:
    """Return whether no parameter file or launch file of a package sets another name."""
    parameter = endpoint.from_parameter
    if parameter is None:
        return True
    for path in parameter_paths(package):
        file = parameter_file(package, path) if _may_name(package, path, parameter) else None
        for section in file.sections if file else ():
            for entry in section.entries:
                if entry.name == parameter and not _is_same(entry.value, endpoint):
                    return False
    return not package.remember(
        ("named in launch files", parameter), lambda: _is_named(package, parameter)
    )


def is_named_in_launch_files(package: Package, topic: str) -> bool:
    """Return whether a launch file gives a topic to nodes, as a parameter or by remapping."""
    name = re.compile(rf"[\"']/?{re.escape(topic)}[\"']")
    return any(
        topic in text and name.search(without_comments(text)) for text in _launch_texts(package)
    )


def _may_name(package: Package, path: str, name: str) -> bool:
    """Return whether the last part of a name is a key in a file, without parsing it."""
    key = re.escape(name.rpartition(".")[2])
    with suppress(ViewError):
        return re.search(rf"\b{key}\b['\"]?\s*:", package.source(path).text) is not None
    return False


def _is_named(package: Package, name: str) -> bool:
    """Return whether a launch file contains a word."""
    word = re.compile(rf"\b{re.escape(name)}\b")
    return any(name in text and word.search(text) for text in _launch_texts(package))


def _is_same(value: object, endpoint: NamedEndpoint) -> bool:
    name = endpoint.name.removeprefix("/")
    return isinstance(value, Scalar) and value.text.removeprefix("/") == name


def _launch_texts(package: Package) -> Iterator[str]:
    for path in package.files:
        if path.endswith(_LAUNCH):
            with suppress(ViewError):
                yield package.source(path).text
