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
    """The keyword arguments by name, also those of a dictionary after ``**``."""
    is_open: bool
    """Whether unknown arguments may be given with ``*`` or ``**``."""

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
    keywords, is_open = _keywords(module, node)
    words = {str(word.arg): word for word in keywords}
    parameters = signature(kind)
    names = parameters.positional if parameters is not None else _POSITIONAL.get(kind, ())
    given: dict[str, ast.expr] = dict(zip(names, node.args, strict=False))
    given.update({name: word.value for name, word in words.items()})
    is_open = is_open or any(isinstance(arg, ast.Starred) for arg in node.args)
    return LaunchCall(kind, node, module, given, words, is_open)


def _keywords(module: PythonModule, call: ast.Call) -> tuple[list[ast.keyword], bool]:
    """Return the keyword arguments, with those of dictionaries; and whether there may be more."""
    keywords: list[ast.keyword] = []
    is_open = False
    for word in call.keywords:
        unpacked = [word] if word.arg else _unpacked(module, word.value)
        is_open |= unpacked is None
        keywords += unpacked or ()
    return keywords, is_open


def _unpacked(module: PythonModule, node: ast.expr) -> list[ast.keyword] | None:
    """Return the items of a dictionary as keyword arguments; ``None`` if they are not known."""
    if isinstance(node, ast.Name):
        uses = [use for use in module.index.uses_of(node) if isinstance(use.ctx, ast.Load)]
        if not all(_is_unpacked(module.parent(use)) for use in uses):
            return None  # it may be changed
        value = module.index.only_value(node)
    else:
        value = node
    if not isinstance(value, ast.Dict):
        return None
    result: list[ast.keyword] = []
    for key, item in zip(value.keys, value.values, strict=True):
        if not isinstance(key, ast.Constant) or not isinstance(key.value, str):
            return None
        word = ast.keyword(key.value, item)
        word.lineno, word.col_offset = key.lineno, key.col_offset + 1  # after the quote
        word.end_lineno, word.end_col_offset = item.end_lineno, item.end_col_offset
        result.append(word)
    return result


def _is_unpacked(parent: ast.AST | None) -> bool:
    """Return whether an expression is an argument after ``**``."""
    return isinstance(parent, ast.keyword) and parent.arg is None
