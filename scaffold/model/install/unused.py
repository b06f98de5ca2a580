"""Files that nothing uses: not installed, unrun tests, or backup copies; and who names a file."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.formats.hash_comments import code_with, without_comments
from scaffold.model.contents.words import files_with
from scaffold.model.facts import fact
from scaffold.model.python.module import is_collected, is_in_tests
from scaffold.model.remembered import remembered
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_COPY = lazy_re.compile(
    r"^(?:old|backup|bak|deprecated|obsolete|unused)[_ -]|^copy[_ -]of|^untitled\d{0,4}$"
    r"|[_ .-](?:old|backup|bak|orig|original|deprecated|obsol[eu]te|unused|copy)(?:[_ -]?\d{1,8})?$"
    r"|[ ](?:copy[ ])?\(?\d{1,4}\)?$|[ ]copy[ ]\d{1,4}$"
    r"|[ ](?:-[ ]|\((?:another[ ]|\d{1,2}\w\w[ ])?)(?:copy|kopie|kopia|copia|copie)\b[^/]{0,5}$",
    re.IGNORECASE,
)
"""Matches the name of a backup copy next to the file that is used.

The last ones are written by file managers: ``talk (copy).py``, ``talk (3rd copy).py``,
``talk - Copy.py``.
"""
_UNUSED_DIRECTORY = lazy_re.compile(
    r"(?:^|[\W_])(?:unused|deprecated|backups?|bak|archived?|old)(?:$|[\W_])|^te?mp$",
    re.IGNORECASE,
)
"""Matches the name of a directory with unused code."""
_KEPT = (".py", ".xacro", ".urdf", ".launch", ".xml", ".yaml", ".yml")
"""The extensions of files whose copies are recognized by name."""
_RUNS_PYTHON = lazy_re.compile(rb"pytest|launch_test|nose|python|PYTHON|ament_lint_auto|\.py\b")
"""Matches commands of CMakeLists.txt that run or check Python."""
_ADDS_DIRECTORY = lazy_re.compile(rb"\badd_subdirectory\s*\([^)]{0,200}\)")
_INSTALLS_PYTHON = lazy_re.compile(rb"ament_python_install|python_setup|setup\.py")
"""Matches commands that may install a whole Python package."""
_RUNS_SETUP = lazy_re.compile(rb"python_setup|setup\.py|\bpip3?\b")
_OF_TARGETS = lazy_re.compile(
    rb"\b(?:add_(?:executable|library)|ament_export_[a-z]{1,20}|ament_target_dependencies"
    rb"|target_[a-z_]{1,20}|ament_(?:auto_)?add_(?:executable|gmock|gtest|library))"
    rb"\s*\([^)]{0,500}\)|\binstall\s*\(\s*TARGETS\b[^)]{0,500}\)"
)
"""Matches commands about C++."""
_OF_PROJECT = lazy_re.compile(rb"(?<![/\w])\$\{PROJECT_NAME\}/?(?=[\s\")])")
"""Matches what may be the directory with the name of the package."""
_PROJECT = lazy_re.compile(rb"\bproject\s*\([^)]{0,200}\)")
_IN_WORD = lazy_re.compile(rb"[\w-]")
_BEFORE_FILE = (b'"', b"'", b"/")
_AFTER_FILE = lazy_re.compile(rb"\.py\b|[\"'/:]")
"""What is before and after the name of a file in Python."""
_LIST_OF_NAMES = lazy_re.compile(rb"[\s\w,()]{0,400}")
"""Matches a line that may belong to an import of several lines."""
_TAKES_ALL = (
    rb"GLOB_RECURSE[^)]{0,500}\*(?:\.py|(?!\.))|\bDIRECTORY\s+\./?\s|\brglob"
    rb"|os\.walk\(\s*(?:[\"']\.?/?[\"']|os\.)|[\"']\*\*/"
)
"""Matches code that uses all files of a directory."""
_BUILDING = ("CMakeLists.txt", "setup.py", "setup.cfg", "pyproject.toml")
_NAMING = (*_KEPT, ".txt", ".cfg", ".toml", ".cmake", ".sh", ".bash")
TEXTS = (".md", ".rst")
"""The endings of texts that tell people what to start."""
_OF_CMAKE = ("CMakeLists.txt", ".cmake")
INIT = "__init__.py"
RUN_AS_THEY_ARE = frozenset({"setup.py", INIT, "__main__.py"})
_FOR_TESTS = "conftest.py"
"""The file that pytest loads for the tests in and below a directory."""


def is_copy_of_old_code(package: Package, path: str) -> bool:
    """Return whether a file or its directory is named like a copy, and is never mentioned."""
    *directories, name = path.split("/")
    stem, dot, _ = name.rpartition(".")
    if not dot or not name.endswith(_KEPT):
        return False
    is_kept = _COPY.search(stem) or any(map(_UNUSED_DIRECTORY.search, directories))
    return bool(is_kept) and not is_named(package, path, stem)


def is_unused_setup_py(package: Package) -> bool:
    """Return whether CMake builds a package without its setup.py."""
    return _is_built_by_cmake(package) and not _uses_setup_py(package)


def is_apart(package: Package, path: str) -> bool:
    """Return whether a Python file is in no directory that is installed, or no test that is run."""
    directory, _, name = path.rpartition("/")
    stem = name.removesuffix(".py")
    if stem == name or ".launch." in name or stem.endswith("launch"):
        return False
    if name in RUN_AS_THEY_ARE and not (name == INIT and _is_built_by_cmake(package)):
        return False
    if is_in_tests(path):
        return is_unrun_test(package, path)
    if not any(package.has(item) for item in _BUILDING[:2]):
        return False
    parts = directory.split("/") if directory else []
    installing = package.remember("what is installed", lambda: [*_installing(package)])
    if is_in_python_package(package, path):
        whole = [_INSTALLS_PYTHON, *([_OF_PROJECT] if package.name in parts else [])]
        is_whole = any(pattern.search(data) for pattern in whole for data in installing)
        if is_whole or not _is_built_by_cmake(package):
            return False
        installing = [_PROJECT.sub(b"", data) for data in installing]
    is_mentioned = any(_mentions_directory(data, part) for part in parts for data in installing)
    takes_all = re.compile(rb"\*\.py" if not parts else _TAKES_ALL)
    return not is_mentioned and not any(map(takes_all.search, installing))


def is_in_python_package(package: Package, path: str) -> bool:
    """Return whether a directory around a file has ``__init__.py``."""
    directories = path.split("/")[:-1]
    return any(
        package.has("/".join([*directories[:at], "__init__.py"]))
        for at in range(1, len(directories) + 1)
    )


def _installing(package: Package) -> Iterator[bytes]:
    """Yield what is said about the installation of files other than targets; raises ViewError."""
    for path in _building(package):
        yield _OF_TARGETS.sub(b"", without_comments(package.data(path)))


def _building(package: Package) -> list[str]:
    """Return the files that say what is installed; colcon uses no setup.py next to CMake."""
    files = _BUILDING[:1] if _is_built_by_cmake(package) else _BUILDING
    return [path for path in files if package.has(path)]


def _uses_setup_py(package: Package) -> bool:
    """Return whether CMake may run setup.py."""
    return any(_RUNS_SETUP.search(without_comments(package.data(path))) for path in _lists(package))


def _is_built_by_cmake(package: Package) -> bool:
    return package.build_type in {"ament_cmake", "cmake"} and package.has("CMakeLists.txt")


def is_unrun_test(package: Package, path: str) -> bool:
    """Return whether a test file is neither run as a test nor used by one."""
    *directories, name = path.split("/")
    stem = name.removesuffix(".py")
    if not is_in_tests(path) or stem == name or name in RUN_AS_THEY_ARE:
        return False
    if name == _FOR_TESTS:
        return not any(
            other.startswith(path.removesuffix(_FOR_TESTS))
            and is_collected(other.rpartition("/")[2])
            and not is_unrun_test(package, other)
            for other in package.python_files
        )
    if package.build_type == "ament_python":
        is_run = is_collected(name) or {"test", "tests"}.isdisjoint(directories)
    elif package.has("CMakeLists.txt"):
        is_run = _runs_in_cmake(package, [x for x in directories if x in {"test", "tests"}])
    else:
        return False
    return not is_run and not is_named(package, path, stem)


def _runs_in_cmake(package: Package, directories: Sequence[str]) -> bool:
    """Return whether CMake runs Python, and names one of some directories as a whole, if any."""
    lists = [without_comments(package.data(item)) for item in _lists(package)]
    calls = [_ADDS_DIRECTORY.sub(b"", text) for text in lists]
    return any(
        _RUNS_PYTHON.search(text)
        and (not directories or any(_mentions_directory(text, part) for part in directories))
        for text in calls
    )


def _lists(package: Package) -> frozenset[str]:
    """Return the files of CMake, except those of directories that none of them adds."""
    return package.remember("files of CMake", lambda: frozenset(_added_lists(package)))


def _added_lists(package: Package) -> Iterator[str]:
    names = [item for item in package.files if item.endswith(_OF_CMAKE)]
    texts = {item: _commands_in(package, item) for item in names}
    for item in names:
        directory = item.removesuffix("/CMakeLists.txt")
        added = directory.rpartition("/")[2].encode("utf-8", "surrogateescape")
        if directory == item or any(
            b"$" in call or added in call
            for other, text in texts.items()
            if other != item
            for call in _ADDS_DIRECTORY.findall(text)
        ):
            yield item


def _commands_in(package: Package, path: str) -> bytes:
    try:
        return without_comments(package.data(path))
    except ViewError:  # it may add any directory
        return b"add_subdirectory(${all})"


def is_named(package: Package, path: str, stem: str, texts: tuple[str, ...] = ()) -> bool:
    """Return whether any other file of the package mentions a name, such as that of a module.

    Parameter files mention a node whether it is started or not.

    Args:
        package: The package.
        path: The file to skip.
        stem: The name.
        texts: The extensions of further files to search.
    """
    return any(files_naming(package, path, stem, texts))


def files_naming(package: Package, path: str, stem: str, texts: tuple[str, ...]) -> Iterator[str]:
    """Yield the files that mention a name; see `is_named`."""
    directory = path.rpartition("/")[0].rpartition("/")[2]
    name = stem.encode("utf-8", "surrogateescape")
    for item in files_with(package, texts, lambda: _naming_files(package, texts), name):
        if item != path and _is_in_code(package, item, stem, directory):
            yield item


def is_named_in_text(package: Package, path: str, name: str) -> bool:
    """Return whether a text of the package mentions the name of a file."""
    directory = path.rpartition("/")[0].rpartition("/")[2]
    return any(
        item != path and item.endswith(TEXTS) and _is_in_code(package, item, name, directory)
        for item in _naming_files(package, TEXTS)
    )


@remembered
def _naming_files(package: Package, texts: tuple[str, ...]) -> Sequence[str]:
    """Return the files that may mention what is used."""
    unused = ("package.xml", *(_BUILDING[1:] if _is_built_by_cmake(package) else ()))
    endings = (*_NAMING, *texts)
    return [
        item
        for item in package.files
        if item not in unused
        and (item.endswith(endings) or item.startswith("scripts/"))
        and not item.startswith(("config/", "params/"))
        and (not item.endswith(_OF_CMAKE) or item in _lists(package))
    ]


@fact
def _is_in_code(package: Package, path: str, name: str, directory: str) -> bool:
    """Return whether a file may mention a name outside of comments; too large code may.

    Large XML and YAML is data, such as the weights of a classifier.
    """
    try:
        data = package.data(path)
    except ViewError:
        return not path.endswith((".xml", ".yaml", ".yml", ".urdf"))
    code = code_with(data, name.encode("utf-8", "surrogateescape"))
    is_python = path.endswith(".py")
    if path == "setup.py" and name == directory and not _is_started(package, name):
        return b"%b.py" % name.encode("utf-8", "surrogateescape") in code
    is_named = names_file(code, name, is_python=is_python, directory=directory)
    return is_named and _mentions(code, name, directory)


def _is_started(package: Package, module: str) -> bool:
    """Return whether setup.py may start a module, and not only install the package around it."""
    try:
        setup = package.setup_py
    except ViewError:
        return True
    started = {script.module.rpartition(".")[2] for script in setup.console_scripts}
    return module in started or not setup.entry_points_complete


def names_file(code: bytes, stem: str, *, is_python: bool, directory: str = "") -> bool:
    """Return whether code may import or start a file; Python may use its name for a variable.

    Args:
        code: The code.
        stem: The name of the file.
        is_python: Whether it is Python.
        directory: The name of the directory of the file: ``plot.axes`` is not ``plot/plot.py``.
    """
    word = stem.encode("utf-8", "surrogateescape")
    if is_python and stem == directory:
        code = re.sub(rb"\b%b\.(?!py\b|%b\b)(?=\w)" % (re.escape(word), re.escape(word)), b"", code)
    places = [*_places(code, word)]
    if not is_python or not places:
        return bool(places)
    if any(
        code[at - 1 : at] in _BEFORE_FILE or _AFTER_FILE.match(code, at + len(word))
        for at in places
    ):
        return True
    return any(
        b"import" in line or _LIST_OF_NAMES.fullmatch(line)
        for line in code.splitlines()
        if [*_places(line, word)]
    )


def _places(data: bytes, word: bytes) -> Iterator[int]:
    """Yield where a word is that is not part of a longer one."""
    at = data.find(word)
    while at >= 0:
        end = at + len(word)
        if not (_IN_WORD.match(data, max(at - 1, 0), at) or _IN_WORD.match(data, end)):
            yield at
        at = data.find(word, at + 1)


def _mentions_directory(data: bytes, name: str) -> bool:
    """Return whether a build file mentions a directory itself, or all files of a kind."""
    word = re.escape(name.encode("utf-8", "surrogateescape"))
    pattern = rb"(?<![\w-])%b(?![\w-])(?!/[\w/-]+\.\w+)(?!/[\w/-]*\*\.(?!py\b)\w+)" % word
    return re.search(pattern, data) is not None


def _mentions(code: bytes, name: str, directory: str) -> bool:
    """Return whether code with a name mentions it not only as a file in another directory."""
    word = name.encode("utf-8", "surrogateescape")
    if b"/" + word not in code:
        return True
    around = directory.encode("utf-8", "surrogateescape")
    pattern = rb"(?:(?<![\w-])([\w-]+)/)?(?<![\w-])%b(?![\w-])" % re.escape(word)
    return any(match[1] in {None, around} for match in re.finditer(pattern, code))
