"""Whether the files that launch files refer to are installed."""

from __future__ import annotations

import ast
import posixpath
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from difflib import SequenceMatcher, get_close_matches
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.discovery.gitignore import is_untracked
from scaffold.model.facts import fact
from scaffold.model.install.share import Share, share_of
from scaffold.model.launch.evaluation.evaluator import share_path
from scaffold.model.launch.evaluation.module_paths import NamedPath, paths_of_module
from scaffold.model.launch.files import DATA_DIRECTORIES
from scaffold.model.launch.markup_file import markup_files
from scaffold.model.launch.python_file import LaunchFile, SharePath, launch_paths
from scaffold.model.launch.unused.unlaunched import covers, is_never_used
from scaffold.model.python.evaluation.values import UNKNOWN
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule
    from scaffold.source import Location


_OF_MADE_FILES = frozenset(
    {"os.mknod", "os.remove", "os.unlink", "os.path.exists", "os.path.isfile"}
    | {"xacro.open_output"}
)
"""Functions that create, remove or test for a file that need not exist."""

_DATABASES = (".db", ".sqlite", ".sqlite3")

_PLACEHOLDER = lazy_re.compile(r"(?i:readme[^/]*|\.(?:git)?(?:keep|ignore)|\.placeholder)")
"""Matches files that keep a directory in git."""
_OPTIONS = lazy_re.compile(r"\s-")
"""Matches the start of options after a file."""
_IMAGE = lazy_re.compile(r"""^image:[ \t]*["']?([^\s"'#]+)""", re.MULTILINE)
"""Matches the image that the file of a map names."""

_SIMILAR = 0.8
"""How similar the names of two files are if one is surely meant."""
_HINTED = 0.5
"""How similar they are if one may be meant."""
_PATHS = frozenset({"PathJoinSubstitution", "TextSubstitution"})
"""Substitutions that are paths."""


def named_paths(package: Package) -> Iterator[NamedPath]:
    """Yield the paths below share directories in launch files of a package."""
    for path in launch_paths(package):
        with suppress(ViewError):
            yield from _paths_of_launch_file(package, path)
    yield from _paths_of_nodes(package)
    for file in markup_files(package):
        for named in file.paths:
            if named.path:
                yield NamedPath(named.package, named.path, named.location)
    yield from _images_of_maps(package)


def _images_of_maps(package: Package) -> Iterator[NamedPath]:
    """Yield the images that the installed files of maps name, next to them."""
    for installed, path in share_of(package).files.items():
        if not path.endswith((".yaml", ".yml")) or b"resolution:" not in package.data(path):
            continue
        with suppress(ViewError):
            source = package.source(path)
            match = _IMAGE.search(source.text)
            if match is not None and not match[1].startswith("/"):
                place = posixpath.normpath(posixpath.join(posixpath.dirname(installed), match[1]))
                yield NamedPath(package.name, place, source.location(*match.span(1)))


@fact
def _paths_of_launch_file(package: Package, path: str) -> tuple[NamedPath, ...]:
    launch = LaunchFile.of(package, path)
    made = [*_made_files(launch)]
    return tuple(
        named
        for path_below in launch.share_paths
        if not launch.is_optional(path_below.node)
        and not _is_given_to_unknown(launch, path_below.node)
        and not is_never_used(launch, path_below.node)
        and not _is_written(launch, path_below, made)
        for named in _as_installed(package, launch, path_below)
    )


def _without_options(path: str) -> str:
    """Return the file of ``worlds/empty.sdf -r``, which Gazebo splits."""
    return _OPTIONS.split(path, 1)[0].rstrip()


def _paths_of_nodes(package: Package) -> Iterator[NamedPath]:
    """Yield the paths that the modules of a package only read."""
    of_launch = {*launch_paths(package)}
    for path in package.python_files:
        with suppress(ViewError):
            if path in of_launch or _is_of_tests(path):
                continue
            for item in paths_of_module(package, path):
                yield NamedPath(item.package, item.path.rstrip(), item.location)


def _is_of_tests(path: str) -> bool:
    *directories, name = path.split("/")
    return not {"test", "tests", "launch"}.isdisjoint(directories) or name == "setup.py"


def _as_installed(package: Package, launch: LaunchFile, path: SharePath) -> Iterator[NamedPath]:
    """Yield a path relative to the installed directory of its launch file.

    Nothing for a file next to a launch file that is only started from the sources.
    """
    named = NamedPath(path.package, _without_options(path.path), path.location)
    directory = posixpath.dirname(launch.path)
    is_next_to = named.path.startswith(f"{directory}/") and package.has(named.path)
    if not is_next_to or not launch.module.mentions("ThisLaunchFileDir"):
        yield named
        return
    for installed, source in share_of(package).files.items():
        if source == launch.path:
            place = posixpath.join(posixpath.dirname(installed), named.path[len(directory) + 1 :])
            yield named._replace(path=place)


def _is_given_to_unknown(launch: LaunchFile, node: ast.expr) -> bool:
    """Return whether a path is passed to an unknown function, which may test whether it exists."""
    call = launch.module.parent(node)
    if not (isinstance(call, ast.Call) and isinstance(call.func, ast.Name)):
        return False
    lookup = launch.module.index.lookup(call.func.id, call.func)
    made = (
        [item.value.func for item in lookup[1] if isinstance(item.value, ast.Call)]
        if lookup
        else []
    )
    return any(isinstance(item, ast.Name) and item.id == "getattr" for item in made)


def _is_written(
    launch: LaunchFile, path: SharePath, made: Sequence[tuple[object, set[str]]]
) -> bool:
    """Return whether a launch file writes the file itself, ``open(path, 'w')``, or tests for it."""
    node = path.node
    holder = launch.module.parent(node)
    if isinstance(holder, ast.Dict) and _is_for_output(holder, node):
        return True
    if isinstance(holder, ast.List) and _is_redirected_to(holder, node):
        return True
    return any(
        _name(path.path) in names
        if written is UNKNOWN
        else share_path(written) == (path.package, path.path)
        for written, names in made
    )


def _made_files(launch: LaunchFile) -> Iterator[tuple[object, set[str]]]:
    """Yield the files that a launch file writes, removes or tests for.

    Each with the texts that its path is made of, by which it is known if the whole is unknown.
    """
    module = launch.module
    for call in module.walk(ast.Call):
        path = _made_path(module, call)
        if path is not None:
            values = [item.value for item in module.index.bindings_of(path) if item.value]
            parts = (part for value in values or [path] for part in ast.walk(value))
            texts = (part.value for part in parts if isinstance(part, ast.Constant))
            yield launch.evaluator.joined_text(path), {_name(str(text)) for text in texts}


def _made_path(module: PythonModule, call: ast.Call) -> ast.expr | None:
    """Return the path of a file that a call writes, removes or tests for."""
    match call:
        case ast.Call(func=ast.Name(id="open"), args=[path, ast.Constant(value=mode), *_]):
            return path if str(mode)[:1] in {*"wax"} else None
        case ast.Call(func=ast.Attribute(value=path, attr="write_text" | "write_bytes")):
            return path
        case ast.Call(args=[path, *_]):
            return path if module.qualified_name(call.func) in _OF_MADE_FILES else None
    return None


def _is_redirected_to(command: ast.List, path: ast.expr) -> bool:
    """Return whether the shell writes to a path: it follows ``'date > '``."""
    at = command.elts.index(path)
    before = command.elts[at - 1] if at else None
    return isinstance(before, ast.Constant) and str(before.value).rstrip().endswith(">")


def _is_for_output(parameters: ast.Dict, path: ast.expr) -> bool:
    """Return whether a parameter has a name such as ``output_file``: its node writes the file."""
    return any(
        isinstance(key, ast.Constant) and re.search(r"output|save|record|export", str(key.value))
        for key, value in zip(parameters.keys, parameters.values, strict=True)
        if value is path
    )


def missing_in(package: Package, named: NamedPath) -> str:
    """Return the common cause of missing files in one directory, or of a missing directory."""
    owner = package if named.package == package.name else package.workspace.get(named.package)
    installed = share_of(owner).files if owner is not None else {}
    *directories, _ = named.path.split("/")
    above = ["/".join(directories[:depth]) for depth in range(1, len(directories) + 1)]
    missing = (item for item in above if not any(x.startswith(f"{item}/") for x in installed))
    return f"files of {named.package}/{next(missing, '/'.join(directories))}"


def why_missing(package: Package, named: NamedPath) -> str | None:
    """Return why a path certainly does not exist; ``None`` if it may exist."""
    owner = package if named.package == package.name else package.workspace.get(named.package)
    if owner is None:
        return None
    share = share_of(owner)
    if not _is_file_name(named.path):
        return _why_directory_missing(owner, named.path.rstrip("/"), share)
    if share.has(named.path) or not share.complete:
        return None
    if any(named.path.startswith(f"{nested}/") for nested in owner.tree.nested):
        return None  # the files of a nested package are its own
    if named.path.startswith(tuple(share.unread)):
        return None
    is_format = "{" in named.path and any(map(_before_field(named.path), share.files))
    return None if is_format else _reason(owner, named.path, share.files)


def _why_directory_missing(owner: Package, path: str, share: Share) -> str | None:
    """Return why a directory of the sources is not installed; ``None`` if it may be."""
    start = f"{path}/"
    sources = [file for file in owner.files if file.startswith(start)]
    is_installed = any(file.startswith(start) for file in share.files)
    if not path or not sources or is_installed or not share.complete:
        return None
    if start.startswith(tuple(share.unread)) or _nothing_of(sources[0], share.files):
        return None
    if all(_PLACEHOLDER.fullmatch(_name(file)) for file in sources):
        return None
    return f"{_build_file(owner)} of {owner.name} does not install {start}"


def _build_file(owner: Package) -> str:
    return "setup.py" if owner.build_type == "ament_python" else "CMakeLists.txt"


def has_similar_file(package: Package, named: NamedPath) -> bool:
    """Return whether the package of a missing file has one with this name or a similar one."""
    owner = package if named.package == package.name else package.workspace.get(named.package)
    return owner is None or any(_ratio(file, named.path) >= _SIMILAR for file in owner.files)


def _ratio(path: str, other: str) -> float:
    """Return how similar the names of two files are, without their endings."""
    first, second = (posixpath.splitext(_name(item)) for item in (path, other))
    if first[1] != second[1]:
        return 0.0
    matcher = SequenceMatcher(None, first[0], second[0])
    return matcher.ratio() if matcher.quick_ratio() >= _HINTED else 0.0


def is_given_as_parameters(launch: LaunchFile, at: Location) -> bool:
    """Return whether a path is only in ``Node(parameters=[...])``, as it is.

    Then launch_ros warns if the file does not exist, and starts the node.
    """
    return any(
        _is_given(launch, path.node)
        for path in launch.share_paths
        if covers(path.node, at.line, at.column)
    )


def _is_given(launch: LaunchFile, node: ast.AST, seen: frozenset[ast.AST] = frozenset()) -> bool:
    for parent in launch.module.parents(node):
        match parent:
            case ast.keyword(arg="parameters"):
                return True
            case ast.Assign(targets=[ast.Name() as variable]):
                index = launch.module.index
                uses = [use for use in index.uses_of(variable) if isinstance(use.ctx, ast.Load)]
                following = seen | {variable}
                return variable in seen or (
                    bool(uses) and all(_is_given(launch, use, following) for use in uses)
                )
            case ast.Call():
                call = launch.call_of(parent)
                if call is None or call.kind not in _PATHS:
                    return False
            case ast.List() | ast.Tuple() | ast.Starred() | ast.BinOp():
                pass
            case _:
                return False
    return False


def _before_field(path: str) -> Callable[[str], bool]:
    """Return a function that tells whether a file matches a path before ``{}``."""
    start = path.partition("{")[0]
    return lambda file: file.startswith(start)


def is_left_to_the_user(package: Package, named: NamedPath) -> bool:
    """Return whether the directory of a missing file is a placeholder for files of the user.

    It only has a README or ``.gitkeep`` in the sources: weights of a model, for example.
    """
    owner = package if named.package == package.name else package.workspace.get(named.package)
    directory, _, _ = named.path.rpartition("/")
    if owner is None or not directory:
        return False
    names = [
        path.removeprefix(f"{directory}/")
        for path in owner.files
        if path.startswith(f"{directory}/")
    ]
    return bool(names) and all(map(_PLACEHOLDER.fullmatch, names))


def _reason(owner: Package, path: str, files: dict[str, str]) -> str | None:
    """Return why a path is not installed by its package."""
    where = [file for file in owner.files if _name(file) == _name(path)]
    installed = sorted(name for name, source in files.items() if source in where)
    if installed:
        return _installed_alternative(owner, path, installed)
    if where:
        first = path if path in where else where[0]
        if _nothing_of(first, files):
            return None  # another rule reports that the whole directory is not installed
        return f"{_build_file(owner)} of {owner.name} does not install {first}"
    made_of = [file for file in owner.files if _name(file).startswith(f"{_name(path)}.")]
    if any(not file.endswith(".xacro") or _is_converted(owner, file) for file in made_of):
        return None  # generated from a template
    if is_untracked(owner, path) or path.endswith(_DATABASES):
        return None  # created on each machine, a database when opened
    closest = [
        file for file in get_close_matches(path, files, 1, 0.6) if _ratio(file, path) >= _HINTED
    ]
    hint = f"; did you mean {closest[0]}?" if closest else ""
    return f"{owner.name} has no such file{hint}"


def _is_converted(owner: Package, path: str) -> bool:
    """Return whether the build generates a URDF from a xacro file."""
    if owner.build_type != "ament_cmake":
        return False
    converters = owner.cmake.find("xacro_add_files", "xacro_add_xacro_file")
    return any(
        _name(argument.value) == _name(path)
        for command in converters
        for argument in command.arguments
    )


def _installed_alternative(owner: Package, path: str, installed: list[str]) -> str:
    """Return the installed file of the same name: the only one, or the closest."""
    if len(installed) == 1:
        return f"it is installed as share/{owner.name}/{installed[0]}"
    closest = get_close_matches(path, installed, 1, 0)
    return f"{owner.name} has no such file; did you mean {closest[0]}?"


def _nothing_of(path: str, installed: dict[str, str]) -> bool:
    """Return whether no file of a common data directory is installed."""
    directory = path.partition("/")[0]
    return directory in {"launch", *DATA_DIRECTORIES} and not any(
        source.startswith(f"{directory}/") for source in installed.values()
    )


def _name(path: str) -> str:
    return path.rpartition("/")[2]


def _is_file_name(path: str) -> bool:
    """Return whether a path is a file name, not a directory, a prefix or a pattern."""
    stem, ending = posixpath.splitext(_name(path))
    is_pattern = not {"*", "?", "["}.isdisjoint(path)
    return bool(stem) and 2 <= len(ending) <= 8 and not is_pattern  # noqa: PLR2004  .py to .geojson
