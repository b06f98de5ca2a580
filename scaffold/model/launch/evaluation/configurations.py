"""The launch configurations that have a value when a launch file runs."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold import lazy_re
from scaffold.model.launch.calls import LaunchCall
from scaffold.model.launch.evaluation.evaluator import share_path
from scaffold.model.launch.python_file import LaunchFile
from scaffold.model.launch.unused.written_commands import gives_argument
from scaffold.model.remembered import remembered
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package

_SETTERS = ("DeclareLaunchArgument", "SetLaunchConfiguration", "SetLaunchConfigurationFrom")
BY_LAUNCH = frozenset({"ros_namespace", "global_params", "ros_remaps", "launch_file_directory"})
"""Configurations that launch itself sets."""
_ENDINGS = (".py", ".xml", ".yaml", ".yml")
_MARKUP = lazy_re.compile(r"(?m)^(?:launch:|<launch>)")
"""The start of a launch file, also in a directory such as `config`."""
_COMPUTED = lazy_re.compile(r"(?:[}%]|\+ ?['\"])([\w.-]*launch\.(?:py|xml|ya?ml))")
"""Matches the known end of a computed name, ``f'{world}.launch.py'``."""


def set_names(
    package: Package, launch: LaunchFile, seen: frozenset[str] = frozenset()
) -> set[str] | None:
    """Return the configurations set by a file and its included files.

    Returns:
        ``None`` if unknown: names are computed, or unknown files are included.
    """
    names = set(BY_LAUNCH)
    for call in launch.calls:
        if call.kind.startswith(_SETTERS):
            name = launch.text(call, "name")
            if not isinstance(name, str):
                return None
            names.add(name)
    if _has_own_actions(launch):
        return None
    for call in launch.find("IncludeLaunchDescription"):
        given, inner = _given(launch, call), _included(package, launch, call, seen)
        if given is None or inner is None:
            return None
        names |= given | inner
    return names


def may_be_set_elsewhere(package: Package, path: str, name: str) -> bool:
    """Return whether another launch file of the workspace includes the file and sets the name.

    Or a file that is included before it does, perhaps through others; or a command line gives it.
    """
    basename = path.rpartition("/")[2]
    if gives_argument(package, basename, name):
        return True
    is_included = any(
        basename in text or (package.name in text and _may_compute(text, basename))
        for text in _other_launch_files(package, path)
    )
    return is_included and is_named_elsewhere(package, path, name)


def is_named_elsewhere(package: Package, path: str, name: str) -> bool:
    """Return whether another launch file of the workspace contains the name of a configuration."""
    return any(name in text for text in _other_launch_files(package, path))


def _may_compute(text: str, basename: str) -> bool:
    """Return whether a launch file computes file names that may be this one."""
    return any(basename.endswith(match[1]) for match in _COMPUTED.finditer(text))


def _other_launch_files(package: Package, but: str) -> Iterator[str]:
    """Yield the texts of the other launch files of the workspace."""
    for other in package.workspace:
        for path in _launch_files(other):
            if other is not package or path != but:
                with suppress(ViewError):
                    yield other.source(path).text


@remembered
def _launch_files(package: Package) -> list[str]:
    """Return what is named like a launch file, or starts like one in XML or YAML."""
    paths = [path for path in package.files if path.endswith(_ENDINGS)]
    return [path for path in paths if "launch" in path or _is_markup(package, path)]


def _is_markup(package: Package, path: str) -> bool:
    with suppress(ViewError):
        return not path.endswith(".py") and bool(_MARKUP.search(package.source(path).text))
    return False


def _has_own_actions(launch: LaunchFile) -> bool:
    """Return whether functions or classes of other packages may declare arguments.

    Such as those of nav2_common, moveit_configs_utils and simple_launch.
    """
    for call in launch.module.walk(ast.Call):
        name = launch.module.qualified_name(call.func) or ""
        root, _, last = name.partition(".")[0], "", name.rpartition(".")[2].lower()
        if root in {"", "launch", "launch_ros"} or "." not in name:
            continue
        if "arg" in last or "declare" in last or "launch" in last or "generate" in last:
            return root not in {"os", "sys", "argparse", "ament_index_python"}
    # ``context.launch_configurations['x'] = ...``
    return any(node.attr == "launch_configurations" for node in launch.module.walk(ast.Attribute))


def _given(launch: LaunchFile, call: LaunchCall) -> set[str] | None:
    """Return the names that an include sets, also for later actions."""
    node = call.given.get("launch_arguments")
    if node is None:
        return None if call.is_open else set()
    match node:
        case ast.Call(func=ast.Attribute(value=ast.Dict() as literal, attr="items")):
            keys = [launch.evaluator.joined_text(key) for key in literal.keys]
        case ast.Dict():
            keys = [launch.evaluator.joined_text(key) for key in node.keys]
        case ast.List() | ast.Tuple():
            keys = [
                launch.evaluator.joined_text(pair.elts[0])
                for pair in node.elts
                if isinstance(pair, ast.Tuple | ast.List) and pair.elts
            ]
        case _:
            return None
    names = {key for key in keys if isinstance(key, str)}
    return names if len(names) == len(set(keys)) else None


def _included(
    package: Package, launch: LaunchFile, call: LaunchCall, seen: frozenset[str]
) -> set[str] | None:
    """Return the names that an included file of the same package sets."""
    source = call.given.get("launch_description_source")
    inner = launch.call_of(source)
    argument = next(iter(inner.call.args), None) if inner is not None else source
    path = share_path(launch.evaluator.joined_text(argument))
    if path is None or path[0] != package.name or not path[1].endswith(".py"):
        return None
    if path[1] in seen:
        return set()
    try:
        other = LaunchFile.of(package, path[1])
    except ViewError:
        return None
    return set_names(package, other, seen | {path[1]})
