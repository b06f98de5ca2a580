"""The dependencies that the Python imports of a package require."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.formats.hash_comments import without_comments
from scaffold.model.catalog import ROS1_PACKAGES, keys_of_module, library_keys
from scaffold.model.contents.ament_cmake import programs
from scaffold.model.contents.interface_files import generations
from scaffold.model.contents.python_facts import imports_by_path
from scaffold.model.python.module import is_collected, is_in_tests
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.imports import Import
    from scaffold.source import Location

INTERFACE_MODULES = frozenset({"msg", "srv", "action"})
_OF_INTERFACES = [[], *([name] for name in sorted(INTERFACE_MODULES))]
"""The submodules of interface packages."""
_NOT_SHIPPED = ("doc/", "docker/", "docs/", "setup.py", "conf.py")
_ROS1 = frozenset({"rospy", "roslib"})
_NOT_INSTALLING = lazy_re.compile(
    r"\b(?:add_subdirectory|aux_source_directory|(?:target_)?include_directories)\s*\([^()]*\)"
    r"|\bPYTHONPATH=[^\s)]*"
)
"""Matches CMake calls with C++ directories, and the search path of tests."""
_OLD_STANDARD_LIBRARY = frozenset({"distutils", "imp", "asynchat", "asyncore", "smtpd"})


class Requirement(NamedTuple):
    """An import provided by another package."""

    keys: tuple[str, ...]
    """The suitable manifest keys, the usual one first."""
    module: str
    """The top-level name that is imported."""
    location: Location
    """The first import of it."""
    for_tests: bool
    """Whether only tests import it."""
    for_launch: bool
    """Whether only launch files import it."""
    in_data: bool
    """Whether only files in the share directory import it, which no command starts."""

    def is_stronger_than(self, other: Requirement) -> bool:
        """Return whether it is more important: programs before tests, tests before data."""
        return (self.in_data, self.for_tests) < (other.in_data, other.for_tests)


def required_packages(package: Package) -> list[Requirement]:
    """Return the imports from other packages, once each; unknown modules are skipped."""
    result: dict[str, Requirement] = {}
    local = _local_names(package).union(package.workspace.policy.implicit)
    for path, imports in shipped_imports(package):
        for item in imports:
            keys = _keys(package, item, local)
            if not keys:
                continue
            earlier = result.get(item.root)
            for_tests = _is_for_tests(package, path)
            for_launch = path.endswith("launch.py") or "launch" in path.split("/")[:-1]
            need = Requirement(
                keys, item.root, item.location, for_tests, for_launch, _is_data(package, path)
            )
            if earlier is None or need.is_stronger_than(earlier):
                result[item.root] = need
            elif not for_launch and not earlier.is_stronger_than(need):
                result[item.root] = earlier._replace(for_launch=False)
    return sorted(result.values(), key=lambda need: need.location)


def shipped_imports(package: Package) -> Iterator[tuple[str, Sequence[Import]]]:
    """Yield the imports of the files that are installed or are tests; not those of ROS 1."""
    for path, imports in imports_by_path(package):
        if is_shipped(package, path) and not _is_of_ros1(imports):
            yield path, imports


def is_shipped(package: Package, path: str) -> bool:
    """Return whether a file is installed or is a test; helper scripts and documentation are not.

    A module of a Python package, a launch file, a test, or a script in a build file.
    """
    if path.startswith(_NOT_SHIPPED) or path.endswith(("/setup.py", "/conf.py")):
        return False
    if path.endswith("launch.py") or not path.endswith(".py"):
        return True
    directory, _, name = path.rpartition("/")
    if is_in_tests(path) and (_is_collected(name) or _is_imported_by_tests(package, name)):
        return True
    if directory and package.has(f"{directory}/requirements.txt"):
        return False  # a separate tool
    if directory and package.has(f"{directory}/__init__.py"):
        # "talker copy" cannot be imported.
        return directory.replace("/", "").replace("-", "").isidentifier()
    whole = _mentions(directory)
    return any(
        name in text or (directory and whole.search(_NOT_INSTALLING.sub("", text)) is not None)
        for text in _builds(package, directory)
    )


def _mentions(*paths: str) -> re.Pattern[str]:
    """Match a mention of files or directories, not of ``console_scripts`` or a file in them."""
    names = "|".join(map(re.escape, paths))
    return re.compile(rf"(?<!\w)(?:{names})/?(?![\w/.-])")


def _is_of_ros1(imports: Iterable[Import]) -> bool:
    """Return whether a file is a node of ROS 1, which does not start in ROS 2 anyway."""
    roots = {item.root for item in imports if not item.guarded and not item.conditional}
    return "rclpy" not in roots and not roots.isdisjoint(_ROS1)


def _is_data(package: Package, path: str) -> bool:
    """Return whether a script is installed with a data directory."""
    directory, _, name = path.rpartition("/")
    if path.endswith("launch.py") or is_in_tests(path) or package.has(f"{directory}/__init__.py"):
        return False
    try:
        installs = package.cmake.installs
    except ViewError:
        return False
    return not any(name in text for text in _builds(package)) and any(
        install.kind == "DIRECTORY"
        and "share" in (install.destination or "")
        and any(item.path and path.startswith(f"{item.path}/") for item in install.items)
        for install in installs
    )


def _is_collected(name: str) -> bool:
    """Return whether pytest or launch_testing collects a file."""
    return is_collected(name) or name.endswith(".test.py") or "conftest" in name


def _is_imported_by_tests(package: Package, name: str) -> bool:
    def find() -> set[str]:
        imports = [
            item
            for path, imports in imports_by_path(package)
            if is_in_tests(path)
            for item in imports
        ]
        words = {part for item in imports for part in item.module.split(".")}
        return words | {name.name for item in imports for name in item.names}

    stem = name.removesuffix(".py")
    return stem in package.remember("imported_by_tests", find)


def _is_for_tests(package: Package, path: str) -> bool:
    """Return whether only tests run a file; ``tf_test.py`` may be a program."""
    directory, _, name = path.rpartition("/")
    may_be_started = name.endswith(".launch.py") and not is_in_tests(f"{directory}/")
    if is_in_tests(path) and not may_be_started:  # such as launch/test_arm.launch.py
        return path not in package.remember("programs named like tests", lambda: _programs(package))
    return _is_named_for_tests(package, path)


def _programs(package: Package) -> frozenset[str]:
    """Return the Python files that are installed as programs."""
    try:
        if package.build_type == "ament_python":
            started = {script.module for script in package.setup_py.console_scripts}
            return frozenset(f"{module.replace('.', '/')}.py" for module in started)
        return frozenset(program.path for program in programs(package))
    except ViewError:
        return frozenset()


def _is_named_for_tests(package: Package, path: str) -> bool:
    """Return whether CMake uses a file, or a directory around it, only for tests."""
    try:
        cmake = package.cmake
    except ViewError:
        return False
    *directories, name = path.split("/")
    around = ["/".join(directories[: at + 1]) for at in range(len(directories))]
    own = ["${PROJECT_NAME}"] if package.name in around else []
    names = _mentions(name, *around, *own)
    using = [command for command in cmake.commands if any(map(names.search, command.values))]
    return bool(using) and all(cmake.guarded_by_testing(item) for item in using)


def _builds(package: Package, directory: str = "") -> Iterator[str]:
    """Yield the texts of the build files, including those of subdirectories."""
    own = [f"{directory}/CMakeLists.txt"] if directory else []
    for path in ("CMakeLists.txt", "setup.py", *own):
        try:
            yield without_comments(package.source(path).text)
        except ViewError:
            continue


def _keys(package: Package, node: Import, local: frozenset[str]) -> tuple[str, ...]:
    root = node.root
    if not root or node.guarded or root in local or root == package.name:
        return ()
    keys = keys_of_module(root)
    if keys:  # also of tkinter, which Debian has separately from Python
        return _with_keys_for_pip(keys)
    if root in sys.stdlib_module_names or root in _OLD_STANDARD_LIBRARY:
        return ()
    names = node.module.split(".")
    if root in ROS1_PACKAGES:
        return ()
    is_interface = len(names) > 1 and names[1] in INTERFACE_MODULES
    # ``from pygazebo.msg import pose_pb2`` takes a module; interfaces are classes.
    is_interface = is_interface and not any(item.name[:1].islower() for item in node.names)
    is_interface = is_interface and root not in _libraries(package)
    if is_interface or package.workspace.get(root) is not None:
        return (root,)
    return _with_keys_for_pip(library_keys(root))


def _libraries(package: Package) -> frozenset[str]:
    """Return the top-level packages with imported modules other than interfaces."""
    return package.remember(
        "libraries that are imported",
        lambda: frozenset(
            node.root
            for _, imports in imports_by_path(package)
            for node in imports
            if node.module.split(".")[1:2] not in _OF_INTERFACES
        ),
    )


def _with_keys_for_pip(keys: tuple[str, ...]) -> tuple[str, ...]:
    """Append the rosdep keys of the same modules installed with pip."""
    names = [key.removeprefix("python3-").removesuffix("-pip") for key in keys]
    return keys + tuple(
        other
        for key, name in zip(keys, names, strict=True)
        if key != name
        for other in (f"python3-{name}-pip", f"python-{name}-pip")
        if other not in keys
    )


def _local_names(package: Package) -> frozenset[str]:
    """Return the names of own modules, including those next to scripts.

    A directory counts if it is a Python package, or if no ROS package has its name: nearly
    every package has a ``launch/``, which is not what ``import launch`` means.
    """
    files = {path.rpartition("/")[2][:-3] for path in package.python_files if path.endswith(".py")}
    directories = {
        path.rpartition("/")[2]
        for path in package.tree.directories
        if package.has(f"{path}/__init__.py") or not keys_of_module(path.rpartition("/")[2])
    }
    return frozenset(files | directories | _generated_names(package))


def _generated_names(package: Package) -> set[str]:
    """Return the modules that CMake generates from interfaces; tests may have their own."""
    try:
        return {generation.target for generation in generations(package) if generation.target}
    except ViewError:
        return set()
