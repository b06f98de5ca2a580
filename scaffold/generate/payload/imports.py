"""The imports of generated code."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Sequence

from scaffold.generate.payload.lookup import Types
from scaffold.generate.templates.filters import MAX_COLUMNS

MODULES = ("math", "struct", "uuid", "zlib")
"""Modules of the standard library that statements may use."""

FUNCTIONS = {"create_cloud_xyz32": "sensor_msgs_py.point_cloud2"}
"""Functions of other packages that statements may use, with their modules."""

LIBRARIES = frozenset(module.partition(".")[0] for module in FUNCTIONS.values())
"""The packages of these functions."""


def imports(
    types: Types, code: Sequence[str], used: Iterable[str] = ()
) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Return the ROS packages that code needs, and its imports, both sorted.

    Args:
        types: Maps names in the code to messages.
        code: Lines of Python.
        used: The full names of messages that are always imported.
    """
    names = _names("\n".join(code))
    messages = set(used)
    aliases = {name: types.class_name(name) for name in messages}
    aliases = {name: alias for name, alias in aliases.items() if not name.endswith(f"/{alias}")}
    for name in sorted(names):
        full_name = types.full_name(name)
        if full_name is not None and "/msg/" in full_name:
            messages.add(full_name)
            if not full_name.endswith(f"/{name}"):
                aliases[full_name] = name
    modules = [item for item in MODULES if item in names]
    packages = sorted({name.partition("/")[0] for name in messages})
    lines = [f"import {module}" for module in modules]
    functions = {name: module for name, module in FUNCTIONS.items() if name in names}
    lines.extend(f"from {module} import {name}" for name, module in functions.items())
    for package in packages:
        classes = sorted(
            f"{name.rpartition('/')[2]} as {aliases[name]}"
            if name in aliases
            else name.rpartition("/")[2]
            for name in messages
            if name.startswith(f"{package}/")
        )
        lines.extend(_import_lines(f"{package}.msg", classes))
    libraries = {module.partition(".")[0] for module in functions.values()}
    return tuple(sorted({*packages, *libraries})), tuple(lines)


def _names(code: str) -> set[str]:
    """Return the names that code uses."""
    return {node.id for node in ast.walk(ast.parse(code)) if isinstance(node, ast.Name)}


def _import_lines(module: str, classes: Sequence[str]) -> Iterator[str]:
    """Yield an import statement, or several if one would be too long."""
    line = f"from {module} import {classes[0]}"
    for name in classes[1:]:
        if len(line) + len(name) + 2 > MAX_COLUMNS:
            yield line
            line = f"from {module} import {name}"
        else:
            line += f", {name}"
    yield line
