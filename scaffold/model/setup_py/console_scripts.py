"""The executables of an ament_python package."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.setup_py.setup_py import EntryPoint


def node_scripts(package: Package) -> list[EntryPoint]:
    """Return the console scripts that start nodes: their module imports rclpy.

    Others may be tools that rightly go to ``bin/``, such as the ament linters themselves, and
    what extends the command ``ros2``, or is it.
    """
    if any(entry.group.startswith("ros2cli.") for entry in package.setup_py.entry_points):
        return []
    return [entry for entry in package.setup_py.console_scripts if _is_node(package, entry)]


def _is_node(package: Package, entry: EntryPoint) -> bool:
    base = entry.module.replace(".", "/")
    for path in (f"{base}.py", f"{base}/__init__.py"):
        try:
            return "rclpy" in package.imports(path)
        except ViewError:
            continue
    return False
