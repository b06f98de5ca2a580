"""Names that are certainly no keys of rosdep."""

from __future__ import annotations

import re
import sys
from typing import TYPE_CHECKING

from scaffold.api import ViewError
from scaffold.api.catalog import LIBRARY_KEYS, is_released, module_keys, module_of_key
from scaffold.api.python import paths_importing

from ._debian import key_of_debian

if TYPE_CHECKING:
    from scaffold.api import Package

_MODULES = (".msg", ".srv", ".action")
_OF_PYTHON_2 = frozenset(
    {"lxml", "matplotlib", "numpy", "opencv", "pandas", "pil", "psutil", "pyqt5", "requests"}
    | {"scipy", "serial", "setuptools", "tk", "yaml", "zmq"}
)
_WITHOUT_PYTHON_2 = frozenset(
    {"argparse", "cpplint", "docx", "fysom", "is-python3", "kdtree", "lttngust", "multicast"}
    | {"path.py", "percol", "slacker-cli", "telegram-bot", "trep"}
)
"""The last parts of keys ``python-...`` that are still resolved, most of them with pip."""
_NO_KEYS = frozenset({"ament_python"})
_KEYS_LIKE_MODULES = frozenset({"sqlite3", "time", "uuid", "zlib"})
"""Rosdep keys with names of modules of the standard library."""


def why_no_key(package: Package, name: str) -> str:
    """Return why rosdep cannot have a key of this name; nothing if it may."""
    return _problem(name) or _why_unknown(package, name)


def _problem(name: str) -> str:
    key = key_of_debian(name)
    problem = ""
    if key:
        problem = f"{name!r} is a Debian package; its rosdep key is {key!r}"
    elif stray := re.search(r"[<>=~!](?!.*\d)", name):
        problem = f"{name!r} contains {stray[0]!r}: rosdep stops; remove it"
    elif re.search(r"[<>=~!]", name):
        problem = (
            f"{name!r} contains a version, which rosdep treats as part of the name; use "
            "version_gte='...'"
        )
    elif len(name.split()) > 1:
        problem = f"{name!r} contains several names: rosdep stops; write an element for each"
    elif name.endswith(_MODULES):
        problem = f"{name!r} is a module: rosdep stops; the package is {name.rpartition('.')[0]!r}"
    elif name.startswith("python3_"):
        problem = f"rosdep keys contain dashes, not underscores; use {name.replace('_', '-')!r}"
    elif name.startswith("python-") and not name.endswith("-pip"):
        problem = _problem_of_python_2(name)
    elif name in _NO_KEYS:
        problem = f"{name!r} is a build type, not a package: rosdep cannot resolve it; remove it"
    return problem


def _why_unknown(package: Package, name: str) -> str:
    """Return why a name is certainly no key, unless the local rosdep cache has it."""
    rosdep = package.workspace.rosdep
    if rosdep is not None and rosdep.resolves(name):
        return ""
    if name in LIBRARY_KEYS and (not module_of_key(name) or is_found_by_cmake(package, name)):
        return f"{name!r} is not a rosdep key: rosdep stops; the key is {LIBRARY_KEYS[name]!r}"
    if _is_of_python(package, name):
        return f"{name!r} is a module of Python itself: rosdep stops; remove it"
    if _is_own_module(package, name):
        return f"{name!r} is a Python package in this package: rosdep stops; remove it"
    return ""


def _problem_of_python_2(name: str) -> str:
    rest = name.removeprefix("python-")
    if rest in _WITHOUT_PYTHON_2:
        return ""
    key = f"python3-{rest}"
    is_known = rest in _OF_PYTHON_2 or key in module_keys()
    advice = f"use {key!r}" if is_known else "use the key for Python 3"
    return f"{name!r} is a Python 2 package: rosdep stops; {advice}"


def _is_of_python(package: Package, name: str) -> bool:
    """Return whether a name is that of a module of the standard library, which is not a key."""
    is_module = name in sys.stdlib_module_names and name not in _KEYS_LIKE_MODULES
    # ``argparse`` and others are also C++ libraries.
    return is_module and not is_found_by_cmake(package, name) and not is_of_cpp(package, name)


def _is_own_module(package: Package, name: str) -> bool:
    """Return whether setup.py installs a Python package of a name that no other package has."""
    if name == package.name or is_released(name) or package.build_type != "ament_python":
        return False
    try:
        packages = package.setup_py.packages
    except ViewError:
        return False
    is_packed = isinstance(packages, list) and name in packages
    return is_packed and package.has(f"{name}/__init__.py")


def is_found_by_cmake(package: Package, name: str) -> bool:
    """Return whether a name is also a C++ library, such as serial."""
    try:
        return bool(package.cmake.finds(name))
    except ViewError:
        return False


def is_of_cpp(package: Package, module: str) -> bool:
    """Return whether a package with C++ imports no such module, and may mean a C++ library."""
    return package.has("CMakeLists.txt") and not any(paths_importing(package, module))
