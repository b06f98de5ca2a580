"""The dependencies that the Python imports of a package require."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from scaffold.formats.hash_comments import without_comments
from scaffold.model.catalog import (
    LIBRARY_KEYS,
    OTHER_NAMES,
    ROS1_PACKAGES,
    ROS_PACKAGES,
    keys_brought,
    keys_of_module,
    module_of_key,
    similar_key,
    similar_package,
)
from scaffold.model.contents.ament_cmake import programs
from scaffold.model.contents.interface_files import generations
from scaffold.model.contents.python_facts import imports_by_path
from scaffold.model.python.module import is_collected, is_in_tests
from scaffold.model.released import dependencies, is_released, transitive_dependencies
from scaffold.record import NamedTuple
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.imports import Import
    from scaffold.source import Location

INTERFACE_MODULES = frozenset({"msg", "srv", "action"})
_OF_INTERFACES = [[], *([name] for name in sorted(INTERFACE_MODULES))]
"""The submodules of interface packages."""
_NOT_SHIPPED = ("doc/", "docs/", "setup.py", "conf.py")
_ROS1 = frozenset({"rospy", "roslib"})
_NOT_INSTALLING = re.compile(
    r"\b(?:add_subdirectory|aux_source_directory|(?:target_)?include_directories)\s*\([^()]*\)"
    r"|\bPYTHONPATH=[^\s)]*"
)
"""Matches CMake calls with C++ directories, and the search path of tests."""
_OF_MESSAGES = ("_msgs", "_interfaces", "_msg")
"""The last parts of names of interface packages, which often use those of ROS."""
_INTERFACES = frozenset(
    {"action", "interface", "interfaces", "messages", "msg", "msgs", "srv", "srvs"}
)
"""Words in names of packages that only contain interfaces."""
_TOOLS = ("ament_", "launch", "rclcpp", "rclpy", "rosbag2", "rosidl_")
"""The first parts of names of client libraries, and of tools for builds and tests."""
_STARTING = frozenset(
    {"bringup", "config", "demo", "demos", "description", "launch", "robot", "robots", "sim"}
    | {"simulation", "simulator"}
)
"""Words in names of packages with launch files, which start nodes of other packages."""
_DIGITS = "0123456789"
_COMMON_WORDS = frozenset({"ament", "my", "python", "python3", "ros", "ros2"})
"""First parts of names that do not make packages related."""
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


class Declared(NamedTuple):
    """The packages that the manifest declares, directly and through dependencies."""

    direct: set[str]
    along: set[str]
    unknown: frozenset[str]
    """Packages that are neither released nor in the workspace; what they bring is not known."""

    def may_bring(self, package: Package, name: str) -> bool:
        """Return whether an unknown dependency may bring a package from outside of the workspace.

        Their names are related: ``arm_bringup`` may bring ``arm_msgs``, and ``arm_msgs`` may bring
        ``sensor_msgs``.
        """
        return package.workspace.get(name) is None and any(
            _are_related(dependency, name) for dependency in self.unknown
        )

    def may_use(self, package: Package, name: str) -> bool:
        """Return whether an unknown dependency may bring a library or node that it uses itself.

        ``arm_driver`` may use messages, which ``arm_msgs`` does not, and ``arm_bringup`` any node.
        Several unknown ones are part of a larger system that is installed in another way.
        """
        if self.may_bring(package, name):
            return True
        if package.workspace.get(name) is not None or name.startswith(_TOOLS):
            return False
        using = [*filter(_may_use_others, self.unknown)]
        return (
            len(using) > 1
            or (bool(using) and _has_messages(name))
            or any(not _STARTING.isdisjoint(dependency.split("_")) for dependency in using)
        )


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


def declared(package: Package, *, for_tests: bool) -> Declared:
    """Return the packages available to the package, or to its tests."""
    return package.remember(("declared", for_tests), lambda: _declared(package, for_tests))


def _declared(package: Package, for_tests: bool) -> Declared:  # noqa: FBT001  as declared() says
    manifest = package.manifest
    direct = set(manifest.run_names)
    # Code generators are build dependencies with modules as well.
    direct |= {
        dependency.name
        for dependency in manifest.dependencies
        if dependency.kind.startswith("buildtool")
    }
    direct |= {dependency.name for dependency in manifest.dependencies if dependency.is_optional}
    direct |= {*package.workspace.policy.implicit}
    if for_tests:
        direct |= manifest.test_names | manifest.build_names
    along = transitive_dependencies(direct)
    seen = {package.name}
    pending = sorted(direct)
    while pending:
        name = pending.pop()
        if name in seen:
            continue
        seen.add(name)
        neighbor = package.workspace.get(name)
        if neighbor is not None:
            brought = _run_names(neighbor)
            along |= brought
            pending += sorted(brought)
    along |= transitive_dependencies(along)
    unknown = frozenset(name for name in direct | along if _is_unknown(package, name))
    return Declared(direct, along | keys_brought(direct | along), unknown)


def _is_unknown(package: Package, name: str) -> bool:
    """Return whether a dependency is a package that is neither released nor in the workspace."""
    if name in LIBRARY_KEYS or name in OTHER_NAMES:
        return False
    is_known = is_released(name) or name in ROS_PACKAGES or name in ROS1_PACKAGES
    is_module = name in sys.stdlib_module_names or keys_of_module(name) or module_of_key(name)
    return not (is_known or is_module) and package.workspace.get(name) is None


def _are_related(dependency: str, name: str) -> bool:
    """Return whether two packages are of one family, or both contain interfaces."""
    first, rest = dependency.partition("_")[::2]
    if first == name.partition("_")[0] and first not in _COMMON_WORDS:
        return bool(rest) or not is_released(name)  # no distribution has ``nav2``
    return dependency.endswith(_OF_MESSAGES) and _has_messages(name)


def _may_use_others(dependency: str) -> bool:
    """Return whether an unknown package may use libraries and nodes: its name is of no other kind.

    Programs themselves declare their client library, and the tools of builds and tests.
    """
    if similar_package(dependency) or similar_key(dependency) or not dependency.islower():
        return False
    words = [word.rstrip(_DIGITS) for word in dependency.split("_")]
    is_name = len(words) > 1 and not dependency.startswith(_TOOLS)
    return is_name and _INTERFACES.isdisjoint(words)


def _has_messages(name: str) -> bool:
    """Return whether a package has only interfaces; ``tf2_geometry_msgs`` converts those of ROS."""
    needed = dependencies(name)
    is_generated = not needed or any(item.startswith("rosidl_") for item in needed)
    return name.endswith(_OF_MESSAGES) and is_generated


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
    if name.endswith(".launch.py") and not is_in_tests(f"{directory}/"):
        return False  # such as launch/test_arm.launch.py, started by users
    if is_in_tests(path):
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
    if root in sys.stdlib_module_names or root in _OLD_STANDARD_LIBRARY:
        return ()
    keys = keys_of_module(root)
    if keys:
        return keys + _keys_for_pip(keys)
    names = node.module.split(".")
    if root in ROS1_PACKAGES:
        return ()
    is_interface = len(names) > 1 and names[1] in INTERFACE_MODULES
    # ``from pygazebo.msg import pose_pb2`` takes a module; interfaces are classes.
    is_interface = is_interface and not any(item.name[:1].islower() for item in node.names)
    is_interface = is_interface and root not in _libraries(package)
    if is_interface or package.workspace.get(root) is not None:
        return (root,)
    return ()


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


def _keys_for_pip(keys: Sequence[str]) -> tuple[str, ...]:
    """Return the rosdep keys of the same modules installed with pip."""
    names = [key.removeprefix("python3-").removesuffix("-pip") for key in keys]
    return tuple(
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


def _run_names(package: Package) -> set[str]:
    try:
        return package.manifest.run_names
    except ViewError:
        return set()
