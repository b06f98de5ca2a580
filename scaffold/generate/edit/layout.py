"""Where a package keeps its Python programs and tests, for new ones."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from typing import NamedTuple

from scaffold.errors import InputError
from scaffold.generate.edit.cmake_editor import INSTALL_PYTHON
from scaffold.generate.update.provenance import NAME as PROVENANCE
from scaffold.model.contents.ament_cmake import programs
from scaffold.model.contents.interface_files import is_interface_package
from scaffold.model.package import Package
from scaffold.model.setup_py.keywords import FindPackages
from scaffold.model.setup_py.setup_py import SetupPy

SCRIPTS = "scripts"
"""The directory for programs of a package that has no Python yet."""
_USUAL = (SCRIPTS, "script", "nodes", "bin", "src")
_TESTS = ("test", "tests")
BUILD_TYPES = ("ament_cmake", "ament_python")


class Layout(NamedTuple):
    """The directories of a package; all are relative to its root, without ``/`` at the end."""

    programs: str
    module: str
    """The dotted name of the directory with the programs; empty if it is no Python package."""
    tests: str
    new_files: tuple[str, ...] = ()
    """Empty files that the directories need."""
    installs_python: bool = False
    """Whether CMakeLists.txt has to install the Python package explicitly."""


def layout_of(package: Package) -> Layout:
    """Return the directories of a package.

    Raises:
        InputError: its build type is not supported.
        ViewError: one of its files is missing or cannot be parsed.
    """
    if package.build_type == "ament_cmake":
        return _of_cmake(package)
    if package.build_type == "ament_python":
        return _of_setup(package)
    raise InputError(
        f"{package.directory or package.name}: the build type {package.build_type} is not "
        f"supported, only {' and '.join(BUILD_TYPES)} are"
    )


def _of_cmake(package: Package) -> Layout:
    name, tests = package.name, _tests(package)
    destinations = Counter(
        program.path.rpartition("/")[0]
        for program in programs(package)
        if (program.destination or "").rstrip("/") == f"lib/{name}"
        and program.path in package.python_files
    )
    usual = _choose(destinations, (name, *_USUAL))
    if usual is not None:
        return Layout(usual, name if usual == name else "", tests)
    installed = _installed_python(package)
    if installed is not None and package.has(f"{installed}/__init__.py"):
        return Layout(installed, name, tests)
    init = f"{name}/__init__.py"
    if (package.has(init) or package.has(PROVENANCE)) and not is_interface_package(package):
        missing = () if package.has(init) else (init,)
        return Layout(name, name, tests, missing, installs_python=True)
    return Layout(SCRIPTS, "", tests)


def _of_setup(package: Package) -> Layout:
    setup = package.setup_py
    modules = Counter(entry.module.rpartition(".")[0] for entry in setup.console_scripts)
    module = _choose(modules, (package.name,)) or package.name
    directory = _directory(setup, module)
    init = f"{directory}/__init__.py"
    missing = () if package.has(init) else (init,)
    return Layout(directory, module, _tests(package), missing)


def _choose(counts: Mapping[str, int], usual: Iterable[str]) -> str | None:
    """Return the default directory if it is in use, else the only one in use."""
    places = [place for place in counts if place and not place.startswith(_TESTS)]
    for place in usual:
        if place in places:
            return place
    return places[0] if len(places) == 1 else None


def _installed_python(package: Package) -> str | None:
    """Return the directory of the Python package that CMake installs under the project's name."""
    cmake = package.cmake
    for command in cmake.find(INSTALL_PYTHON):
        if cmake.expand_list(command.arguments[:1], command) != [package.name]:
            continue
        keywords = {"VERSION", "SETUP_CFG", "DESTINATION", "SCRIPTS_DESTINATION"}
        given = command.keyword("PACKAGE_DIR", keywords)
        directory = cmake.expand(given[0], command) if given else package.name
        return None if directory is None else cmake.path_of(directory)
    return None


def _directory(setup: SetupPy, module: str) -> str:
    """Return the directory of an import package: ``package_dir`` may move it."""
    word = setup.keyword("package_dir")
    moved = word.value if word is not None and isinstance(word.value, dict) else {}
    head, _, rest = module.partition(".")
    if isinstance(moved.get(head), str):
        return "/".join(filter(None, [moved[head].strip("./"), *rest.split(".")]))
    root = moved.get("", "")
    if not moved and isinstance(setup.packages, FindPackages):
        root = setup.packages.where if isinstance(setup.packages.where, str) else ""
    return "/".join([*filter(None, [str(root).strip("./")]), *module.split(".")])


def _tests(package: Package) -> str:
    return next((name for name in _TESTS if package.has_directory(name)), _TESTS[0])
