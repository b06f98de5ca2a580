"""The importable Python modules of a package."""

from __future__ import annotations

import os
import posixpath
import re
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.model.catalog import ROS_PACKAGES, keys_of_module
from scaffold.model.cmake.ament import has_unknown_commands, programs
from scaffold.model.facts import fact
from scaffold.model.install.share import installed_files
from scaffold.model.package import mentions
from scaffold.model.python.facts import imports_by_path, imports_of
from scaffold.model.python.module import is_in_tests
from scaffold.model.workspace.gitignore import directories_above, is_untracked
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.cmake.lists import Install
    from scaffold.model.package import Package
    from scaffold.model.python.imports import Import

_ELSEWHERE = ("ament_environment_hooks", "ament_python_install_module", "configure_file")
"""Commands that put modules on the Python path in another way."""

_PROJECT = re.compile(r"(?i)\bproject\s*\(\s*([\w-]+)")
"""Matches the name of a project in a CMakeLists.txt."""

_ON_PATH = re.compile(r"(?:.*(?:-packages/|\}/))([\w/]+)$")
"""Matches a destination on the Python path, with the path below it."""


def absolute_name(path: str, node: Import) -> str:
    """Return the absolute name of a relative import."""
    if not node.level:
        return node.module
    directory = path.split("/")[: -node.level]
    return ".".join([*directory, *([node.module] if node.module else [])])


def names_imported(package: Package) -> set[str]:
    """Return the full names imported by modules of the package: modules and names in them."""
    result: set[str] = set()
    for path, imports in imports_by_path(package):
        for item in imports:
            base = absolute_name(path, item)
            result |= {base, *(f"{base}.{name.name}" for name in item.names)}
    return result


def paths_imported_by(package: Package, files: set[str]) -> list[str]:
    """Return the paths of modules imported by some files, relative to the Python path."""
    paths = sorted(files & set(package.python_files))
    names = {item.module for path in paths for item in imports_of(package, path)}
    return [f"{name.replace('.', '/')}.py" for name in sorted(names) if name]


def own_roots(package: Package) -> set[str]:
    """Return the names of importable Python packages in the root of a package."""
    roots = {path.partition("/")[0] for path in package.glob("*/__init__.py")}
    others = {"test", "tests", "launch"} | (ROS_PACKAGES - {package.name})
    return {root for root in roots - others if root.isidentifier()}


def file_of(package: Package, name: str) -> str:
    """Return the file of a module; empty if there is none."""
    base = name.replace(".", "/")
    return next((item for item in (f"{base}.py", f"{base}/__init__.py") if package.has(item)), "")


def moved_to(package: Package, name: str) -> str:
    """Return the subdirectory to which a module was moved; empty if it was not."""
    parent, _, leaf = name.replace(".", "/").rpartition("/")
    for path in package.python_files:
        directory, _, file = path.rpartition("/")
        if file == f"{leaf}.py" and parent and directory.rpartition("/")[0] == parent:
            return directory
    return ""


def is_elsewhere(package: Package, name: str) -> bool:
    """Tell whether a directory of the checkout above a package has a module.

    Then the package is assembled elsewhere, such as in a container.
    """
    path = f"{name.replace('.', '/')}.py"
    disk = package.outside
    own = f"{disk.real(package.root)}/" if package.root else ""
    places = (os.path.join(directory, path) for directory in directories_above(package))
    return any(not place.startswith(own) and disk.is_file(place) for place in places)


def may_be_made(package: Package, name: str) -> bool:
    """Tell whether a module may come from elsewhere: compiled, generated, a namespace."""
    base = name.replace(".", "/")
    if package.has_directory(base) or package.glob(f"{base}.*") or is_untracked(package, base):
        return True
    if _is_put_into_package(package, name):
        return True
    cmake = package.source("CMakeLists.txt").text if package.has("CMakeLists.txt") else ""
    project = _PROJECT.search(cmake)
    cmake = cmake.replace("${PROJECT_NAME}", project[1] if project else package.name)
    last = name.rpartition(".")[2]
    proto = re.sub(r"_pb2(_grpc)?$", ".proto", last)  # what protoc makes of a file
    if last in cmake or proto in cmake or "pybind11" in cmake:
        return True
    return any(
        last in package.source(path).text
        for path in ("setup.py", ".gitignore")
        if package.has(path)
    )


def _is_put_into_package(package: Package, name: str) -> bool:
    """Tell whether CMake installs the file of a module from elsewhere into a Python package."""
    return package.has("CMakeLists.txt") and name in _modules_installed_by_path(package)


def is_installed_by_path(user: Package, name: str) -> bool:
    """Tell whether a package of the workspace installs a module with ``install(DESTINATION)``."""
    root = name.partition(".")[0]
    package = user if user.name == root else user.workspace.get(root)
    if package is None or not package.has("CMakeLists.txt"):
        return False
    try:
        return name in _modules_installed_by_path(package)
    except ViewError:
        return False


@fact
def _modules_installed_by_path(package: Package) -> frozenset[str]:
    """Return the modules that ``install(DESTINATION ${PYTHON_INSTALL_DIR}/...)`` installs.

    These are full names, also of the directories that modules lie in; raises ViewError.
    """
    result: set[str] = set()
    for install in package.cmake.installs:
        directory = _python_directory(package, install)
        if directory is None or install.kind not in {"DIRECTORY", "FILES", "PROGRAMS"}:
            continue
        for item in install.items:
            for path, _ in installed_files(package, install, item):
                result |= {*_names_of(posixpath.join(directory, path))}
    return frozenset(result)


def _python_directory(package: Package, install: Install) -> str | None:
    """Return the destination relative to a directory on the Python path; ``None`` if elsewhere.

    A variable that is not set in the package may be such a directory.
    """
    written = install.destination_argument
    if written is None:
        return None
    name = package.cmake.project_name or package.name
    destination = install.destination or written.text.replace("${PROJECT_NAME}", name)
    matched = _ON_PATH.match(destination)
    return matched[1] if matched else None


def _names_of(path: str) -> Iterator[str]:
    """Yield the name of a module, and those of its packages except the outermost."""
    if path.endswith(".py"):
        parts = path.removesuffix(".py").removesuffix("/__init__").split("/")
        yield from (".".join(parts[:depth]) for depth in range(2, len(parts)))
        yield ".".join(parts)


def modules_of(package: Package, root: str) -> list[str]:
    """Return the names of the modules in a directory and below it."""
    return [
        path.removesuffix(".py").replace("/", ".")
        for path in package.python_files
        if path.startswith(f"{root}/") and path.endswith(".py")
    ]


def intended_module(package: Package, path: str, name: str) -> str:
    """Return the module that a name in a file refers to and that is not on the path."""
    own = path.partition("/")[0]
    if path.count("/") != 1 or not package.has(f"{own}/__init__.py") or is_in_tests(path):
        return ""
    root, _, rest = name.partition(".")
    if root in ROS_PACKAGES or root in sys.stdlib_module_names:
        return ""
    if rest.startswith(f"{own}.") and not package.has_directory(root) and file_of(package, rest):
        return rest if root == "src" else ""
    if package.build_type == "ament_python":
        return f"{own}.{name}" if _lacks_package(package, path, own, name) else ""
    installed = {program.path: program.destination for program in programs(package)}
    intended = file_of(package, f"{own}.{name}")
    if path in installed and intended and intended not in installed:
        others = [install for install in package.cmake.installs if install.kind == "FILES"]
        changes_path = mentions(package, path, "sys.path") or bool(others)
        return "" if changes_path else f"{own}.{name}"
    return ""


def uninstalled_import(package: Package, where: str, name: str) -> str:
    """Return the file that a program of a CMake package imports and that is not installed.

    It is next to the program, or relative to the root of the package. Empty if the module may be
    installed in another way, or come from elsewhere.
    """
    if package.build_type != "ament_cmake" or mentions(package, where, "sys.path"):
        return ""
    paths = package.remember(
        "program_paths", lambda: frozenset(program.path for program in programs(package))
    )
    if where not in paths:
        return ""
    directory = where.rpartition("/")[0]
    root = name.partition(".")[0]
    path = file_of(package, f"{directory}/{name}".strip("/")) or file_of(package, name)
    own_names = {root, path.partition("/")[0]} & _python_packages(package)
    if not path or own_names or root in sys.stdlib_module_names or keys_of_module(root):
        return ""
    return "" if _may_be_installed(package, path) else path


def _may_be_installed(package: Package, path: str) -> bool:
    if has_unknown_commands(package) or package.cmake.find(*_ELSEWHERE):
        return True
    others = [install for install in package.cmake.installs if install.kind != "TARGETS"]
    items = [item.path for install in others for item in install.items]
    return any(install.destination is None for install in others) or any(
        item is None or item == "." or f"{path}/".startswith(f"{item}/") for item in items
    )


def _python_packages(package: Package) -> set[str]:
    """Return the names of the Python packages installed by CMake, and of the package itself."""
    cmake = package.cmake
    calls = cmake.find("ament_python_install_package")
    names = {str(value) for call in calls for value in cmake.expand_list(call.arguments) or ()}
    return names | {package.name, cmake.project_name or ""}


def _lacks_package(package: Package, path: str, own: str, name: str) -> bool:
    """Tell whether the module of an entry point has imports without the name of its package."""
    root = name.partition(".")[0]
    setup = package.setup_py
    started = {script.module for script in setup.console_scripts}
    if path.removesuffix(".py").replace("/", ".") not in started:
        return False
    if package.has_directory(root) or package.has(f"{root}.py"):
        return False
    changes_path = mentions(package, path, "sys.path")
    changes_path |= "-packages" in setup.module.source.text
    return not changes_path and bool(file_of(package, f"{own}.{name}"))


@fact
def is_started(package: Package, path: str) -> bool:
    """Tell whether a file is a program: a shebang, a main guard, rclpy.

    A module in a Python package of a CMake package, without a ``main`` and without a node
    that is spun, is only a demo when started: others import it.
    """
    if is_in_tests(path) or path.startswith(("examples/", "doc/", "docs/", "tools/")):
        return False
    try:
        if "rclpy" not in package.imports(path):
            return False
        module = package.module(path)
    except ViewError:
        return False
    directory = path.rpartition("/")[0]
    shows_itself = (
        bool(package.cmake.find("ament_python_install_package"))
        and package.has(f"{directory}/__init__.py")
        and "main" not in module.functions
        and "spin" not in module.source.text
    )
    return module.is_script and module.has_main_guard and not shows_itself
