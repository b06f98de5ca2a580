"""The executables of an ament_python package."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.values import Glob
from scaffold.model.setup_py.globs import matches
from scaffold.source import ViewError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from scaffold.model.package import Package
    from scaffold.model.setup_py.entry_points import EntryPoint


def node_scripts(package: Package) -> list[EntryPoint]:
    """Return the console scripts that start nodes: their module imports rclpy.

    Others may be tools that belong in ``bin/``, such as the ament linters, and
    extensions of the command ``ros2``. Those that data_files install for ``ros2 run``
    are found there.
    """
    if any(entry.group.startswith("ros2cli.") for entry in package.setup_py.entry_points):
        return []
    scripts = {*_put_into_lib(package)}
    return [
        entry
        for entry in package.setup_py.console_scripts
        if entry.name not in scripts and _is_node(package, entry)
    ]


def has_program_files(package: Package) -> bool:
    """Return whether data_files install files for ``ros2 run``."""
    return any(_put_into_lib(package))


def _put_into_lib(package: Package) -> Iterator[str]:
    """Yield the names of the files that data_files install for ``ros2 run``."""
    for data in package.setup_py.data_files:
        if str(data.destination).rstrip("/") == f"lib/{package.name}":
            for source in data.sources:
                paths = matches(source, package.files) if isinstance(source, Glob) else [source]
                yield from (str(path).rpartition("/")[2] for path in paths)


def _is_node(package: Package, entry: EntryPoint) -> bool:
    base = entry.module.replace(".", "/")
    for path in (f"{base}.py", f"{base}/__init__.py"):
        try:
            return "rclpy" in package.imports(path)
        except ViewError:
            continue
    return False
