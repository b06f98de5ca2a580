"""Launch arguments that nothing reads."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.model.launch.evaluation.configurations import BY_LAUNCH, is_named_elsewhere
from scaffold.model.launch.includes import included
from scaffold.model.launch.python_file import LaunchFile, launch_paths
from scaffold.model.launch.unused.unlaunched import covers, is_never_used
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.launch.calls import LaunchCall
    from scaffold.model.package import Package
    from scaffold.source import Location


def unread_arguments(package: Package, launch: LaunchFile) -> Iterator[tuple[LaunchCall, str]]:
    """Yield the declarations of arguments that nothing reads, with the names."""
    if launch.function is None or _is_open(package, launch):
        return
    for call in launch.find("DeclareLaunchArgument"):
        name = launch.text(call, "name")
        if not isinstance(name, str) or name in BY_LAUNCH or _is_mentioned(launch, call, name):
            continue
        if not (is_named_elsewhere(package, launch.path, name) or _is_in_yaml(package, name)):
            yield call, name


def is_of_unread_argument(package: Package, at: Location) -> bool:
    """Return whether a path in a launch file is only the default of arguments that nothing reads.

    Raises:
        ViewError: the file cannot be read.
    """
    if at.path not in launch_paths(package) or not at.path.endswith(".py"):
        return False
    launch = LaunchFile.of(package, at.path)
    unread: frozenset[ast.AST] = frozenset(
        call.call for call, _ in unread_arguments(package, launch)
    )
    paths = (path.node for path in launch.share_paths) if unread else ()
    return any(
        is_never_used(launch, node, ignored=unread)
        for node in paths
        if covers(node, at.line, at.column)
    )


def _is_open(package: Package, launch: LaunchFile) -> bool:
    """Return whether a file may read arguments by computed names, or unknown files may."""
    if launch.module.mentions("launch_configurations"):
        return True
    names = [launch.text(call, "variable_name") for call in launch.find("LaunchConfiguration")]
    includes = launch.find("IncludeLaunchDescription")
    others = [included(package, launch, call) for call in includes]
    return not all(isinstance(name, str) for name in names) or any(
        other is None or other.package != package.name for other in others
    )


def _is_mentioned(launch: LaunchFile, declaration: LaunchCall, name: str) -> bool:
    """Return whether a string outside of a declaration contains the name of the argument."""
    whole = re.compile(rf"(?<!\w){re.escape(name)}(?!\w)")
    return any(
        isinstance(node.value, str)
        and whole.search(node.value)
        and not launch.module.is_inside(node, declaration.call)
        for node in launch.module.walk(ast.Constant)
    )


def _is_in_yaml(package: Package, name: str) -> bool:
    """Return whether a file with substitutions, such as a parameter file, has the argument."""
    for path in package.files:
        if path.endswith((".yaml", ".yml")):
            try:
                if f"$(var {name})" in package.source(path).text:
                    return True
            except ViewError:
                continue
    return False
