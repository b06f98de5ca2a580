"""Files that run in the Python of another program, which does not see packages of the system."""

from __future__ import annotations

from scaffold.api import Package
from scaffold.api.python import imports_by_path, paths_importing

_EMBEDDED = frozenset({"bpy", "carb", "isaacsim", "omni", "unreal"})
"""Modules of programs with a Python of their own: Blender, Isaac Sim, Unreal Engine."""


def is_for_embedded_python(package: Package, module: str) -> bool:
    """Return whether only scripts of other programs, and modules of such scripts, import a module.

    Dependencies of the package do not help them.
    """
    users = {*paths_importing(package, module)}
    scripts = {*paths_importing(package, *_EMBEDDED)} if users else set[str]()
    return bool(scripts) and all(
        path in scripts or _is_module_of(package, path, scripts) for path in users
    )


def _is_module_of(package: Package, path: str, scripts: set[str]) -> bool:
    """Return whether only scripts of other programs import a file, which is no program itself."""
    name = path.rpartition("/")[2].removesuffix(".py")
    importing = {
        other
        for other, imports in imports_by_path(package)
        for item in imports
        if name in {*item.module.split("."), *(taken.name for taken in item.names)}
    }
    is_program = b"__main__" in package.data(path)
    return bool(importing) and importing <= scripts and not is_program
