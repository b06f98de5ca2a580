"""Python files that nothing reaches: not installed, or not imported by anything that is run."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.formats.hash_comments import code_with
from scaffold.model.contents.ament_cmake import programs
from scaffold.model.discovery.texts_above import names_above
from scaffold.model.facts import fact
from scaffold.model.install.console_scripts import has_program_files
from scaffold.model.install.package_data import installed_data
from scaffold.model.install.unused import (
    INIT,
    RUN_AS_THEY_ARE,
    TEXTS,
    files_naming,
    is_apart,
    is_copy_of_old_code,
    is_in_python_package,
    is_named_in_text,
    is_unused_setup_py,
    names_file,
)
from scaffold.model.python.module import is_in_tests
from scaffold.model.remembered import remembered
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_IMPORTS_RELATIVELY = lazy_re.compile(rb"(?m)^[ \t]*from[ \t]+\.")
_LOADS = lazy_re.compile(
    rb"\b(?:import_module|__import__)\(\s{0,99}(?![\"'][\w.]{1,99}[\"']\s{0,99}[,)])"
    rb"|\b(?:iter_modules|walk_packages|exec_module)\("
)
"""Matches code that imports modules whose names are computed."""
_OF_NAMES = (".yaml", ".yml", ".json")
_CPP = (".cpp", ".hpp")
_NAMING = (".py", ".cfg", ".toml", *_CPP)
"""The endings of files of other packages that may import a module, or tell who does."""


def is_never_run(package: Package, path: str) -> bool:
    """Return whether a Python file is a copy of old code, or is not reached where it is installed.

    Scripts started from the sources need no dependency of the package.
    """
    return is_copy_of_old_code(package, path) or is_unreached(package, path, from_sources=False)


@remembered
def is_unreached(package: Package, path: str, *, from_sources: bool = True) -> bool:
    """Return whether no program, launch file, test or library runs or imports a Python file.

    Follows the names of files in texts, without parsing them: what names a file that is not
    reached must itself be reached. Files that others may use or start without naming them are
    reached: tests, launch files, programs, and modules of packages without programs.

    Args:
        package: The package.
        path: The file; it need not exist.
        from_sources: Whether a file is reached if a text tells people to start it from the
            sources.
    """
    try:
        return _is_unreached(package, path, from_sources=from_sources)
    except ViewError:  # of setup.py, for example
        return False


def _is_unreached(package: Package, path: str, *, from_sources: bool) -> bool:
    if path == "setup.py":
        return is_unused_setup_py(package)
    pending = [(package, path)]
    for owner, item in pending:  # which grows
        texts = _texts_about(owner, item, from_sources=from_sources)
        if texts is None:
            return False
        for user, naming in _users(owner, item, texts):
            if not naming.endswith(".py"):
                if item.endswith(INIT):
                    continue  # which may mean the ROS package
                return False
            if (user, naming) not in pending:
                pending.append((user, naming))
    return True


def _texts_about(package: Package, path: str, *, from_sources: bool) -> tuple[str, ...] | None:
    """Return the endings of texts that may tell people to start a file; ``None`` if it is reached.

    A module with ``main()`` or a main guard may be started as a file, unless it is installed in a
    Python package without an entry point, where ``ros2 run`` does not find it.
    """
    if from_sources and _is_told(package, path):
        return None
    if is_apart(package, path):
        return TEXTS if from_sources else ()
    if _is_root(path) or not has_programs(package):
        return None
    if not package.has(path) or not _may_be_started(package, path):
        return ()
    return TEXTS if is_only_importable(package, path) else None


@fact
def _may_be_started(package: Package, path: str) -> bool:
    """Return whether a module has ``main()``, or a main guard; raises ViewError."""
    text = package.data(path)
    has_guard = b"__main__" in text and not _IMPORTS_RELATIVELY.search(text)
    return has_guard or b"def main(" in text


def _is_told(package: Package, path: str) -> bool:
    """Return whether a text of the package, or a text or script above it, names a file."""
    name = path.rpartition("/")[2]
    if name in RUN_AS_THEY_ARE:
        return False
    return names_above(package, name) or is_named_in_text(package, path, name)


def _is_root(path: str) -> bool:
    """Return whether a file is used without being named: tests, launch files, setup.py."""
    name = path.rpartition("/")[2]
    is_subpackage = name == INIT and path.count("/") > 1
    is_launch_file = ".launch." in name or name.endswith("launch.py")
    return is_in_tests(path) or is_launch_file or (name in RUN_AS_THEY_ARE and not is_subpackage)


def _users(package: Package, path: str, texts: tuple[str, ...]) -> Iterator[tuple[Package, str]]:
    """Yield the files that may import or start a file, with their packages."""
    if is_in_tests(path):
        return  # its own tests are apart too
    stem = path.removesuffix(f"/{INIT}").rpartition("/")[2].removesuffix(".py")
    for naming in (*files_naming(package, path, stem, texts), *loaders(package, path)):
        yield package, naming
    for user in package.workspace:
        yield from ((user, naming) for naming in _code_naming(user, package, path, stem))


def _code_naming(user: Package, package: Package, module: str, stem: str) -> Iterator[str]:
    """Yield the code of a package that names a module; other packages name its package as well."""
    word = stem.encode("utf-8", "surrogateescape")
    directory = module.rpartition("/")[0].rpartition("/")[2]
    files: Sequence[str]
    if user is package:
        files = [path for path in user.files if path.endswith(_CPP)]
    else:
        files = code_about(user, package.name, module.partition("/")[0])
    for path in files:
        data = _data(user, path)
        is_python = path.endswith(".py")
        code = code_with(data, word)
        if code and names_file(code, stem, is_python=is_python, directory=directory):
            yield path


def code_about(user: Package, *names: str) -> Sequence[str]:
    """Return the code of a package that may import or start that of another one.

    Args:
        user: The package.
        names: The names of the other one, and of the directory with its code.
    """
    words = [name.encode() for name in names]

    def find() -> list[str]:
        files = ((path, _data(user, path)) for path in user.files if path.endswith(_NAMING))
        return [path for path, data in files if any(word in data for word in words)]

    return user.remember(("code about", *names), find)


def loaders(package: Package, path: str) -> Iterator[str]:
    """Yield the files of a package that import computed names, which may result in a module.

    They are next to the module, or about its directory, or a file with data has its name.
    """
    directory, _, name = path.rpartition("/")
    above, stem = (
        text.encode("utf-8", "surrogateescape")
        for text in (directory.rpartition("/")[2], name.removesuffix(".py"))
    )
    loading = [item for item in _loading(package) if item != path]
    is_in_data = bool(loading) and any(
        stem in _data(package, item) for item in package.files if item.endswith(_OF_NAMES)
    )
    for item in loading:
        is_beside = item.rpartition("/")[0] == directory
        if is_beside or is_in_data or (above and above in _data(package, item)):
            yield item


def _data(package: Package, path: str) -> bytes:
    """Return the content of a file; empty if it cannot be read."""
    try:
        return package.data(path)
    except ViewError:
        return b""


@fact
def _loading(package: Package) -> tuple[str, ...]:
    """Return the Python files that import computed names."""
    return tuple(path for path in package.python_files if _loads(package, path))


@fact
def _loads(package: Package, path: str) -> bool:
    return _LOADS.search(_data(package, path)) is not None


def is_only_importable(package: Package, path: str) -> bool:
    """Return whether setup.py installs a module in a Python package alone, not as a program."""
    if package.build_type != "ament_python" or not is_in_python_package(package, path):
        return False
    data = installed_data(package)
    return data is not None and path not in data and package.setup_py.entry_points_complete


@fact
def has_programs(package: Package) -> bool:
    """Return whether a package installs programs, for which its modules are."""
    try:
        if package.build_type == "ament_cmake":
            return bool(programs(package))
        return bool(package.setup_py.console_scripts) or has_program_files(package)
    except ViewError:
        return False
