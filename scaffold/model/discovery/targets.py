"""Finds the packages to check below the paths that a user gives, as colcon does."""

from __future__ import annotations

import os
from collections.abc import Container, Iterator, Sequence

from scaffold.configuration.exclusion import Exclusion
from scaffold.errors import InputError
from scaffold.files.disk import Disk
from scaffold.files.tree import MANIFEST, DiskTree
from scaffold.model.discovery import colcon
from scaffold.model.discovery.foreign import Foreign
from scaffold.model.discovery.unchecked import UncheckedPackages
from scaffold.model.package import Package
from scaffold.model.workspace.policy import Policy
from scaffold.model.workspace.workspace import Workspace
from scaffold.record import NamedTuple


class Target(NamedTuple):
    """A package to check; ``only`` limits the report to some of its files."""

    package: Package
    only: frozenset[str] | None = None


class _LooseFiles(DiskTree):
    """Python files that belong to no package."""

    def __init__(self, directory: str, names: Sequence[str]) -> None:
        super().__init__(directory)
        self._names = names

    @property
    def files(self) -> Sequence[str]:
        return self._names

    @property
    def directories(self) -> frozenset[str]:
        return frozenset()


def find(
    paths: Sequence[str],
    disk: Disk | None = None,
    *,
    are_saved: bool = True,
    whole_packages: bool = False,
    exclusion: Exclusion | None = None,
    skipped: set[str] | None = None,
    foreign: Foreign | None = None,
    policy: Policy | None = None,
) -> list[Target]:
    """Return the packages at or below the paths, and those of single files and directories.

    Args:
        paths: Directories and files.
        disk: Records what was accessed, now and later, outside of the packages.
        are_saved: Whether files must exist; those of an editor may be new.
        whole_packages: Whether a file selects its package, if colcon finds that around or below the
            current directory; other files are skipped.
        exclusion: Packages and files to skip; other packages still see these packages.
        skipped: Receives the skipped packages, and the files of ``paths``.
        foreign: Tells which packages are foreign: they are skipped as well, unless there
            are no others. The given paths are registered.
        policy: The configuration of rules.

    Raises:
        InputError: a path does not exist, or has no package.
    """
    disk = disk or Disk()
    workspace = Workspace[Package](disk=disk, policy=policy)
    if whole_packages:
        paths = _packages_of(disk, paths)
    directories = [path for path in paths if disk.is_directory(path)]
    if foreign is not None:
        foreign.name(disk.real(path) for path in paths if disk.exists(path))
    whole, excluded = _whole_packages(disk, workspace, directories, exclusion or Exclusion())
    files = [path for path in paths if path not in directories]
    excluded_files = {path for path in files if exclusion and exclusion.covers(disk, path)}
    if skipped is not None:
        skipped |= {*excluded, *excluded_files}
    if foreign is not None:
        _set_apart(disk, workspace, whole, excluded, foreign)
    checked_files = [path for path in files if path not in excluded_files]
    targets = [*whole.values()]
    targets += _targets_of_files(disk, workspace, checked_files, whole, are_saved=are_saved)
    for package in (*(target.package for target in targets), *excluded.values()):
        workspace.add(package)
    top = [disk.real(os.curdir)] if whole_packages else []
    workspace.around = _unchecked_neighbors(disk, workspace, directories, top)
    return sorted(targets, key=lambda target: target.package.directory)


def _targets_of_files(
    disk: Disk,
    workspace: Workspace[Package],
    paths: Sequence[str],
    whole: Container[str],
    *,
    are_saved: bool,
) -> Iterator[Target]:
    """Yield the packages of single files, unless they are checked as a whole, and loose files."""
    partial, loose = _sort_files(disk, paths, are_saved=are_saved)
    for root, names in partial.items():
        if disk.real(root) not in whole:
            yield Target(Package.at(root, workspace), frozenset(names))
    for directory, names in loose.items():
        package = Package(_LooseFiles(directory, sorted(names)), directory=directory)
        yield Target(package, frozenset(names))


def _whole_packages(
    disk: Disk, workspace: Workspace[Package], directories: Sequence[str], exclusion: Exclusion
) -> tuple[dict[str, Target], dict[str, Package]]:
    """Return the packages at and below directories, and the excluded ones, by directory."""
    whole: dict[str, Target] = {}
    excluded: dict[str, Package] = {}
    for path in directories:
        for directory in _package_directories(disk, path):
            real = disk.real(directory)
            if exclusion.covers(disk, directory):
                excluded.setdefault(real, Package.at(directory, workspace, disk))
            else:
                whole.setdefault(real, Target(Package.at(directory, workspace)))
    return whole, excluded


def _set_apart(
    disk: Disk,
    workspace: Workspace[Package],
    whole: dict[str, Target],
    excluded: dict[str, Package],
    foreign: Foreign,
) -> None:
    """Move foreign packages to the excluded ones."""
    kinds = {real: foreign.kind_of(disk, real, is_directory=True) for real in whole}
    if all(kinds.values()):
        foreign.name(kinds)  # if there are no others, the user means these
        return
    for real, kind in kinds.items():
        if kind:
            foreign.packages.append(kind)
            excluded[real] = Package.at(whole.pop(real).package.directory, workspace, disk)


def _packages_of(disk: Disk, paths: Sequence[str]) -> list[str]:
    """Return directories unchanged, and the packages of files; see `find`."""
    around = colcon.package_around(disk, os.path.abspath(os.curdir))
    packages = [os.path.relpath(around)] if around else colcon.package_directories(disk, os.curdir)
    by_place = {os.path.join(disk.real(item), ""): os.path.normpath(item) for item in packages}
    result: dict[str, None] = {}
    for path in paths:
        if disk.is_directory(path) or not disk.exists(path):
            result[path] = None
            continue
        real = disk.real(path)
        result.update((item, None) for place, item in by_place.items() if real.startswith(place))
    return [*result]


def _unchecked_neighbors(
    disk: Disk, workspace: Workspace[Package], given: Sequence[str], tops: Sequence[str]
) -> UncheckedPackages | None:
    """Return the packages next to those given, unless the whole workspace was given.

    Without a directory ``src``, the workspace is the packages next to a package, in the git
    repository around it, and in the current directory. No more is searched: it may be a home.

    Args:
        disk: Records what was accessed.
        workspace: The packages given.
        given: The directories that were searched.
        tops: Further directories whose packages belong together.
    """
    own = [
        disk.real(item.directory) for item in workspace if not isinstance(item.tree, _LooseFiles)
    ]
    covered = [os.path.join(disk.real(path), "") for path in given]
    current = disk.real(os.curdir)
    beside: list[str] = []
    sources = [*tops]
    for item in own:
        around = colcon.sources_around(disk, item)
        if around is not None:
            sources.append(around)
            continue
        beside.append(os.path.dirname(item))
        if item.startswith(os.path.join(current, "")):
            beside.append(current)
        sources += filter(None, [colcon.repository_around(disk, item)])

    def open_(directories: list[str]) -> list[str]:
        unique = dict.fromkeys(directories)
        return [top for top in unique if not os.path.join(top, "").startswith((*covered,))]

    left = open_(beside), open_(sources)
    return UncheckedPackages(*left, frozenset(own), workspace) if any(left) else None


def _sort_files(
    disk: Disk, paths: Sequence[str], *, are_saved: bool
) -> tuple[dict[str, set[str]], dict[str, set[str]]]:
    """Return the files of packages by package, and loose Python files by directory."""
    partial: dict[str, set[str]] = {}
    loose: dict[str, set[str]] = {}
    for path in paths:
        exists = disk.exists(path)
        if not exists and (are_saved or not disk.is_directory(os.path.dirname(path) or ".")):
            raise InputError(f"{path}: no such file or directory")
        if exists and not disk.is_file(path):
            raise InputError(f"{path}: neither a file nor a directory")
        root = _package_of(disk, path)
        if root is not None:
            partial.setdefault(root, set()).add(_relative(path, root))
        elif path.endswith(".py"):
            directory, name = os.path.split(path)
            loose.setdefault(directory or ".", set()).add(name)
        else:
            raise InputError(f"{path}: belongs to no package and is not a Python file")
    return partial, loose


def _package_directories(disk: Disk, path: str) -> list[str]:
    result = colcon.package_directories(disk, path)
    # If there are no others, the user means these; a rule reports that colcon ignores them.
    result = result or colcon.package_directories(disk, path, ignored=True)
    if result:
        return result
    around = colcon.package_around(disk, os.path.abspath(path))
    if around is not None:
        return [around if os.path.isabs(path) else os.path.relpath(around)]
    if disk.is_file(os.path.join(path, "setup.py")):
        raise InputError(f"{path}: no {MANIFEST}; colcon does not take it for a ROS 2 package")
    raise InputError(f"{path}: no ROS 2 package (no {MANIFEST}) here, below or above")


def _package_of(disk: Disk, path: str) -> str | None:
    """Return the package of a file, as a path in the form given by the user."""
    package = colcon.package_around(disk, os.path.dirname(os.path.abspath(path)))
    return os.path.relpath(package) if package and not os.path.isabs(path) else package


def _relative(path: str, root: str) -> str:
    return os.path.relpath(path, root).replace(os.sep, "/")
