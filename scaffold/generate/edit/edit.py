"""Edits all files of a package that must mention an addition."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import NamedTuple

from scaffold.files.tree import CMAKE_LISTS, MANIFEST, SETUP_CFG, SETUP_PY
from scaffold.formats.ini import IniFile
from scaffold.generate.edit import (
    changelog,
    cmake,
    cmake_editor,
    manifest,
    readme,
    setup_cfg,
    setup_py,
)
from scaffold.generate.edit.addition import Addition, ByHand, Outcome
from scaffold.generate.edit.layout import layout_of
from scaffold.model.package import Package
from scaffold.model.setup_py.entry_points import EntryPoint
from scaffold.source import ParseError, Source, ViewError

README = "README.md"
CHANGELOG = "CHANGELOG.rst"
EDITED = frozenset({MANIFEST, CMAKE_LISTS, SETUP_PY, SETUP_CFG, README, CHANGELOG})
"""The files that may be edited."""


class Edited(NamedTuple):
    """The files that an addition changes."""

    files: Mapping[str, bytes]
    """New content by path."""
    by_hand: tuple[ByHand, ...]
    """What the user has to do where no edit was safe."""


def edit(package: Package, addition: Addition) -> Edited:
    """Return the files of a package, edited for an addition.

    Args:
        package: The package as it is; its new files need not be there.
        addition: What is added.

    Raises:
        ViewError: package.xml or the file of its build system is missing or cannot be parsed.
    """
    files: dict[str, bytes] = {}
    by_hand: list[ByHand] = []
    for path, make in _editors(package, addition):
        source = package.editable(path) if package.has(path) else Source(path, "")
        outcome = make(source)
        by_hand += outcome.by_hand
        if outcome.source.text != source.text:
            files[path] = outcome.source.text.encode(source.encoding)
    return Edited(files, tuple(by_hand))


_Editor = Callable[[Source], Outcome]


def _editors(package: Package, addition: Addition) -> Iterator[tuple[str, _Editor]]:
    """Yield the files to edit, each with its editor."""
    is_cmake = package.build_type == "ament_cmake"
    installs_python = (
        is_cmake and addition.program is not None and layout_of(package).installs_python
    )
    needs = _with_build(addition, is_cmake=is_cmake, installs_python=installs_python)
    if is_cmake:
        needs = _with_cmake_packages(needs, package)
    yield MANIFEST, lambda source: manifest.add_to_manifest(source, needs)
    if is_cmake:
        yield (
            CMAKE_LISTS,
            lambda source: cmake.add_to_cmake(source, addition, python_package=installs_python),
        )
    else:
        yield from _python_editors(package, addition)
    yield from _documents(package, addition)


def _with_build(addition: Addition, *, is_cmake: bool, installs_python: bool) -> Addition:
    """Return an addition that also depends on its build and test tools."""
    depends = {kind: list(names) for kind, names in addition.depends.items()}
    if installs_python:
        depends.setdefault("buildtool", []).append(cmake_editor.PYTHON)
    if addition.test is not None:
        pytest = cmake_editor.PYTEST if is_cmake else setup_py.PYTEST
        depends.setdefault("test", []).append(pytest)
    return addition._replace(depends=depends)


def _with_cmake_packages(addition: Addition, package: Package) -> Addition:
    """Return an addition whose dependencies are also available at build time.

    CMakeLists.txt may look for a package that package.xml does not declare: when it is declared
    for running or for tests alone, the build still fails.
    """
    declared = package.manifest.names_for("build", "run")
    required = {
        found_package.name
        for found_package in package.cmake.found_packages
        if not found_package.in_testing
    } - declared
    depends = {kind: list(names) for kind, names in addition.depends.items()}
    for kind, wider in (("exec", "depend"), ("test", "build")):
        moved = [name for name in depends.get(kind, ()) if name in required]
        if moved:
            depends[kind] = [name for name in depends[kind] if name not in required]
            depends[wider] = [*depends.get(wider, ()), *moved]
    return addition._replace(depends=depends)


def _python_editors(package: Package, addition: Addition) -> Iterator[tuple[str, _Editor]]:
    config = package.setup_cfg if package.has(SETUP_CFG) else None
    in_config = config is not None and _declares_scripts(package, config)
    extra = config is None or "extras_require" not in config.source.text
    yield (
        SETUP_PY,
        lambda source: setup_py.add_to_setup(
            source, addition, entry_point=not in_config, extra=extra
        ),
    )
    others = [point for point in package.setup_py.console_scripts if not _is_of(point, addition)]
    has_others = in_config or bool(others)

    def edit_config(source: Source) -> Outcome:
        first = setup_cfg.add_directories(source, addition, has_others=has_others)
        if not in_config:
            return first
        second = setup_cfg.add_to_setup_cfg(first.source, addition)
        return Outcome(second.source, first.by_hand + second.by_hand)

    yield SETUP_CFG, edit_config


def _is_of(point: EntryPoint, addition: Addition) -> bool:
    return addition.program is not None and point.name == addition.program.name


def _declares_scripts(package: Package, config: IniFile) -> bool:
    return setup_cfg.scripts(config) is not None and not package.setup_py.console_scripts


def _documents(package: Package, addition: Addition) -> Iterator[tuple[str, _Editor]]:
    """Yield edits of README and changelog; unreadable files are skipped."""
    editors: dict[str, _Editor] = {
        README: lambda source: readme.add_to_readme(source, addition),
        CHANGELOG: lambda source: changelog.add_to_changelog(source, addition),
    }
    for path, make in editors.items():
        try:
            if package.has(path):
                package.editable(path)
                yield path, make
        except (ParseError, ViewError):
            continue
