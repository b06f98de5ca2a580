"""Calls of launch, launch_ros and ament_index_python in Python code."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from typing import TYPE_CHECKING

from scaffold.model.launch.signatures import signature
from scaffold.record import NamedTuple
from scaffold.source import Location

if TYPE_CHECKING:
    from scaffold.model.python.module import PythonModule

_MODULES = ("launch.", "launch_ros.", "launch_xml.", "launch_yaml.", "ament_index_python.")
_POSITIONAL: Mapping[str, tuple[str, ...]] = {
    "ParameterFile": ("param_file",),
    "ParameterValue": ("value",),
    "get_package_share_directory": ("package_name",),
    "get_package_share_path": ("package_name",),
}


class LaunchCall(NamedTuple):
    """A call of a name from launch, launch_ros or ament_index_python."""

    kind: str
    """The last part of its name: ``Node``, ``DeclareLaunchArgument`` ..."""
    call: ast.Call
    module: PythonModule
    given: Mapping[str, ast.expr]
    """The arguments by name, if known."""
    words: Mapping[str, ast.keyword]
    """The keyword arguments by name."""
    is_open: bool
    """Whether more arguments may be given with ``*`` or ``**``."""

    @property
    def location(self) -> Location:
        """The location of the called name."""
        return self.module.location(self.call.func)


def launch_call(module: PythonModule, node: ast.Call) -> LaunchCall | None:
    """Return the view of a call of launch, else ``None``."""
    called = module.qualified_names(node.func)
    kinds = {name.rpartition(".")[2] for name in called if name.startswith(_MODULES)}
    if len(kinds) != 1 or any(".events." in name for name in called):
        return None
    kind = kinds.pop()
    words = {word.arg: word for word in node.keywords if word.arg}
    parameters = signature(kind)
    names = parameters.positional if parameters is not None else _POSITIONAL.get(kind, ())
    given: dict[str, ast.expr] = dict(zip(names, node.args, strict=False))
    given.update({name: word.value for name, word in words.items()})
    is_open = len(words) < len(node.keywords)
    is_open = is_open or any(isinstance(arg, ast.Starred) for arg in node.args)
    return LaunchCall(kind, node, module, given, words, is_open)
