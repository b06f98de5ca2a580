"""Which of two different names of a package is the correct one."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold.model.remembered import remembered
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package


@remembered
def name_used_elsewhere(package: Package) -> str | None:
    """Return the name that all files except package.xml use, if there is one.

    The build file has another name, and more of the directory, the Python package,
    the marker and setup.cfg agree with it than with package.xml: then package.xml is wrong.
    """
    try:
        declared = package.manifest.name
    except ViewError:
        return None
    other = _built_name(package)
    if not other or not declared or _normalized(other) == _normalized(declared):
        return None
    if _other_uses(package, other) > _other_uses(package, declared):
        return other
    return None


def _built_name(package: Package) -> str | None:
    """Return the name in CMakeLists.txt or setup.py."""
    try:
        if package.has("CMakeLists.txt"):
            return package.cmake.project_name
        name = package.setup_py.name
    except ViewError:
        return None
    return name if isinstance(name, str) else None


def _other_uses(package: Package, name: str) -> int:
    """Count the other uses of a name in the package."""
    return sum(
        (
            package.directory.rstrip("/").rpartition("/")[2] == name,
            package.has(f"{name}/__init__.py"),
            package.has(f"resource/{name}"),
            f"lib/{name}" in _script_directory(package),
        )
    )


def _script_directory(package: Package) -> str:
    try:
        return package.setup_cfg.get("install", "install_scripts") or ""
    except ViewError:
        return ""


def _normalized(name: str) -> str:
    return name.replace("-", "_")
