"""Stubs (``.pyi``) of a distribution: its libraries, and all interfaces that are known."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from scaffold.errors import InputError
from scaffold.types.interface_stubs import package_stubs

if TYPE_CHECKING:
    from scaffold.model.interfaces.definitions import Definitions
    from scaffold.model.package import Package

_DATA = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "data")
_STUBS = "stubs"
INCOMPLETE = frozenset(
    {
        "ament_copyright",
        "ament_flake8",
        "ament_mypy",
        "ament_pep257",
        "ament_pycodestyle",
        "ament_xmllint",
        "cv_bridge",
        "image_geometry",
        "launch_testing",
        "launch_testing_ros",
        "launch_xml",
        "launch_yaml",
        "tf2_kdl",
    }
)
"""The libraries whose stubs leave modules or names out."""


def distributions() -> list[str]:
    """Return the names of the distributions that have stubs, sorted."""
    return sorted(
        name for name in os.listdir(_DATA) if os.path.isdir(os.path.join(_DATA, name, _STUBS))
    )


def library_stubs(distribution: str) -> dict[str, str]:
    """Return the stubs of the libraries of a distribution, by relative path.

    Raises:
        InputError: there are no stubs for this distribution.
    """
    if distribution not in distributions():
        supported = ", ".join(distributions())
        raise InputError(
            f"no stubs for distribution {distribution!r}; there are some for {supported}"
        )
    top = os.path.join(_DATA, distribution, _STUBS)
    files: dict[str, str] = {}
    for directory, _, names in os.walk(top):
        for name in names:
            if not name.endswith(".pyi"):
                continue
            path = os.path.join(directory, name)
            with open(path, encoding="utf-8") as file:
                files[os.path.relpath(path, top)] = file.read()
    return dict(sorted(files.items()))


def stub_files(distribution: str, definitions: Definitions | None = None) -> dict[str, str]:
    """Return the stubs of the libraries and of all interfaces, by relative path.

    Args:
        distribution: The one whose libraries are wanted, such as ``jazzy``.
        definitions: The interfaces: those of the workspace, of installed packages, of the bundle;
            ``None``: of the bundle alone.

    Raises:
        InputError: there are no stubs for this distribution.
    """
    from scaffold.model.interfaces.definitions import Definitions

    files = library_stubs(distribution)
    if definitions is None:
        definitions = Definitions.around(prefixes=())
    for package in definitions.packages():
        for path, text in package_stubs(definitions, package).items():
            files.setdefault(path, text)
    return files


def interface_stub_files(package: Package) -> dict[str, str]:
    """Return the stubs of the interfaces that a package defines, by relative path.

    They depend on the files of this package alone: what its messages hold of other packages is
    imported from the stubs of those.
    """
    from scaffold.model.interfaces.definitions import Definitions
    from scaffold.model.interfaces.sources import WorkspaceSource
    from scaffold.model.workspace.workspace import Workspace

    definitions = Definitions([WorkspaceSource(Workspace([package]))])
    if package.name not in definitions.packages():
        return {}
    return package_stubs(definitions, package.name, others=True)


def write_stubs(directory: str, files: dict[str, str]) -> None:
    """Write stubs below a directory, which is made if it is not there."""
    for path, text in files.items():
        target = os.path.join(directory, path)
        os.makedirs(os.path.dirname(target), exist_ok=True)
        with open(target, "w", encoding="utf-8") as file:
            file.write(text)
