"""The Python files of a package that use interfaces."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import suppress

from scaffold.model.facts import fact
from scaffold.model.interfaces.definitions import KINDS
from scaffold.model.package import Package
from scaffold.model.remembered import remembered_list
from scaffold.source import ViewError

_CONVERTING = frozenset({"cv_bridge", "sensor_msgs_py", "tf2_geometry_msgs"})
"""Libraries that create and read messages."""


@remembered_list
def message_paths(package: Package) -> Iterator[str]:
    """Return the Python files that import interfaces, except those of ROS 1."""
    for path in package.python_files:
        with suppress(ViewError):
            if _uses_interfaces(package, path):
                yield path


@fact
def _uses_interfaces(package: Package, path: str) -> bool:
    """Return whether a file imports interfaces and is not of ROS 1; raises ViewError."""
    module = package.module(path)
    if "rospy" in module.imports_by_root:
        return False
    if not _CONVERTING.isdisjoint(module.imports_by_root):
        return True
    if module.mentions("get_parameter_value(", "radians(") or (
        module.mentions(".transform(") and "tf2_ros" in module.imports_by_root
    ):
        return True
    return any(
        not import_.level and _names_kind(import_.module, [n.name for n in import_.names])
        for import_ in module.imports
    )


def _names_kind(module: str, names: Sequence[str]) -> bool:
    _, dot, rest = module.partition(".")
    return rest.partition(".")[0] in KINDS if dot else not set(KINDS).isdisjoint(names)
