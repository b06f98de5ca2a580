"""The files installed below ``share/<package>``, and their sources."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Sequence
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from scaffold.model.contents.ament_cmake import has_unknown_commands
from scaffold.model.discovery.gitignore import is_untracked
from scaffold.model.python.evaluation.values import Glob
from scaffold.model.remembered import remembered
from scaffold.model.setup_py.globs import matches
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.cmake.lists import Install, InstallItem
    from scaffold.model.package import Package


class Share(NamedTuple):
    """The share directory of a package, as far as known."""

    files: dict[str, str]
    """Source by path relative to ``share/<package>``."""
    complete: bool
    """Whether these are all, except those in ``unread``."""
    unread: Sequence[str] = ()
    """Prefixes of paths in directories whose files are not listed: those ignored by git, such as
    products of other tools, and those of nested packages."""

    def has(self, path: str) -> bool:
        """Return whether a file or a directory exists."""
        return path in self.files or any(name.startswith(f"{path}/") for name in self.files)


@remembered
def share_of(package: Package) -> Share:
    """Return the files that a package installs below its share directory."""
    read = {"ament_cmake": _by_cmake, "ament_python": _by_setup}.get(package.build_type)
    try:
        share = read(package) if read else None
    except ViewError:
        share = None
    return share or Share({}, complete=False)


def _by_setup(package: Package) -> Share | None:
    setup = package.setup_py
    if setup.call is None:
        return None
    complete = setup.data_files_complete and not setup.has_unknown_keywords
    files: dict[str, str] = {}
    for data in setup.data_files:
        below = _below_share(data.destination, package.name)
        complete = complete and data.malformed is None
        if below is None:
            continue
        for source in data.sources:
            paths = matches(source, package.files) if isinstance(source, Glob) else [source]
            for path in paths:
                if isinstance(path, str):
                    name = path.rpartition("/")[2]
                    files[posixpath.join(below, name)] = posixpath.normpath(path)
    return Share(files, complete)


def _by_cmake(package: Package) -> Share | None:
    cmake = package.cmake
    complete = not has_unknown_commands(package) and not cmake.find("file", "configure_file")
    complete = complete and not cmake.find("add_custom_command", "add_custom_target")
    files: dict[str, str] = {"package.xml": "package.xml"}
    unread: list[str] = []
    for install in cmake.installs:
        if install.kind not in {"DIRECTORY", "FILES", "PROGRAMS"}:
            complete = complete and install.kind not in {"SCRIPT", "CODE"}
            continue
        below = _below_share(install.destination, package.name)
        if below is None:
            complete = complete and install.destination is not None
            continue
        for item in install.items:
            complete = complete and item.path is not None
            installed = [*installed_files(package, install, item)]
            files |= {posixpath.join(below, name): source for name, source in installed}
            if _is_unlisted(package, item.path or "", installed):
                unread.append(posixpath.join(below, "", _base(item)))
    return Share(files, complete, unread)


def _is_unlisted(package: Package, path: str, installed: Sequence[object]) -> bool:
    """Return whether a path is in a nested package, or has no files but those ignored by git."""
    is_nested = any(f"{path}/".startswith(f"{nested}/") for nested in package.tree.nested)
    return is_nested or (bool(path) and not installed and is_untracked(package, path))


def installed_files(
    package: Package, install: Install, item: InstallItem
) -> Iterator[tuple[str, str]]:
    """Yield the installed files of an item: the path below the destination, and the source."""
    path = item.path
    if path is None:
        return
    if install.kind != "DIRECTORY":
        yield install.rename or path.rpartition("/")[2], path
        return
    inside = "" if path == "." else f"{path}/"
    base = _base(item)
    for file in package.files:
        if file.startswith(inside) and _selected(install, file):
            yield base + file.removeprefix(inside), file


def _base(item: InstallItem) -> str:
    """Return the path of a directory below its destination: its name, or ``""`` with a slash."""
    keeps = not (item.value or "").endswith("/") and item.path not in {".", None}
    return (item.path or "").rpartition("/")[2] + "/" if keeps else ""


def _selected(install: Install, path: str) -> bool:
    """Return whether the patterns of install(DIRECTORY) select a file; true in doubt."""
    if "FILES_MATCHING" not in install.command.values or "REGEX" in install.command.values:
        return True
    return any(fnmatchcase(path.rpartition("/")[2], pattern) for pattern in install.patterns)


def _below_share(destination: object, name: str) -> str | None:
    """Return a destination relative to ``share/<package>``; ``None`` if elsewhere."""
    if not isinstance(destination, str):
        return None
    path = posixpath.normpath(destination)
    share = f"share/{name}"
    if path == share:
        return ""
    return path.removeprefix(f"{share}/") if path.startswith(f"{share}/") else None
