"""The package data that setup.py installs."""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.values import Glob
from scaffold.model.remembered import remembered
from scaffold.model.setup_py.globs import matches

if TYPE_CHECKING:
    from scaffold.model.package import Package


@remembered
def installed_data(package: Package) -> frozenset[str] | None:
    """Return the files that data_files install; ``None`` if unknown.

    A ``glob`` with a condition may install less than this.
    """
    setup = package.setup_py
    if setup.call is None or setup.has_unknown_keywords or not setup.data_files_complete:
        return None
    result: set[str] = set()
    for data in setup.data_files:
        for source in data.sources:
            if isinstance(source, Glob):
                result.update(matches(source, package.files))
            elif isinstance(source, str):
                result.add(posixpath.normpath(source))
    return frozenset(result)


def package_data(package: Package) -> list[Glob] | None:
    """Return the installed files other than modules; ``None`` if unknown."""
    setup = package.setup_py
    included = setup.keyword("include_package_data")
    elsewhere = (
        setup.call is None
        or setup.has_unknown_keywords
        or setup.keyword("package_dir") is not None
        or (included is not None and included.value is not False and _has_manifest(package))
        or any("site-packages" in str(data.destination) for data in setup.data_files)
        or _mentions(package, "pyproject.toml", "package-data")
    )
    word = setup.keyword("package_data")
    value = word.value if word else {}
    if elsewhere or not isinstance(value, dict):
        return None
    globs: list[Glob] = []
    for name, patterns in value.items():
        if not isinstance(patterns, list | tuple):
            return None
        base = str(name).replace(".", "/").strip("*") or "**"
        for pattern in patterns:
            if not isinstance(pattern, str):
                return None
            globs.append(Glob(f"{base}/{pattern}", recursive=True))
    return globs


def _has_manifest(package: Package) -> bool:
    """Return whether ``include_package_data`` may include anything: it reads MANIFEST.in."""
    return package.has("MANIFEST.in") or b"setuptools_scm" in package.data("setup.py")


def _mentions(package: Package, path: str, word: str) -> bool:
    return package.has(path) and word in package.source(path).text
