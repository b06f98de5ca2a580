"""The stubs (``.pyi``) of a distribution: libraries and interfaces."""

from __future__ import annotations

import os
from functools import lru_cache
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.types.stubs.interface_stubs import package_stubs

if TYPE_CHECKING:
    from scaffold.distributions import Distribution
    from scaffold.model.interfaces.definitions import Definitions
    from scaffold.model.package import Package

_STUBS = "stubs"
_REMOVED = "removed_stubs.txt"
_PARTIAL = "python_libraries"
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
        "rosbag2_py",
        "tf2_kdl",
    }
)
"""The libraries whose stubs omit modules or names."""


def library_stubs(distribution: Distribution, library: str = "") -> dict[str, str]:
    """Return the stubs of the libraries of a distribution, by relative path.

    Those of Jazzy are complete; other distributions have the differing ones, and a list of those
    that are gone.

    Args:
        distribution: The distribution.
        library: The importable package to return the stubs of.
    """
    files = _stubs_below(distributions.JAZZY.path(_STUBS), library)
    if distribution.place != distributions.JAZZY.place:
        with open(distribution.path(_REMOVED), encoding="utf-8") as file:
            for line in file:
                files.pop(line.strip(), None)
        files.update(_stubs_below(distribution.path(_STUBS), library))
    return dict(sorted(files.items()))


@lru_cache(maxsize=1)
def partial_libraries() -> frozenset[str]:
    """Return the importable names of the libraries of `partial_stubs`."""
    return frozenset(os.listdir(os.path.join(distributions.DATA, _PARTIAL)))


def partial_stubs(library: str = "") -> dict[str, str]:
    """Return the stubs of Python libraries that programs use besides ROS, by relative path.

    They declare the few names of a library that all of its versions share, and accept all
    others. They are for our own type checker: an editor has those of the library itself.

    Args:
        library: The importable package to return the stubs of.
    """
    return _stubs_below(os.path.join(distributions.DATA, _PARTIAL), library)


def _stubs_below(top: str, library: str) -> dict[str, str]:
    files: dict[str, str] = {}
    for directory, _, names in os.walk(os.path.join(top, library)):
        for name in names:
            if not name.endswith(".pyi"):
                continue
            path = os.path.join(directory, name)
            with open(path, encoding="utf-8") as file:
                files[os.path.relpath(path, top)] = file.read()
    return files


def stub_files(
    distribution: Distribution, definitions: Definitions | None = None
) -> dict[str, str]:
    """Return the stubs of the libraries and of all interfaces, by relative path.

    Args:
        distribution: The distribution of the libraries.
        definitions: The interfaces: those of the workspace, of installed packages, of the bundle;
            ``None`` for the bundle alone.
    """
    from scaffold.model.workspace.definitions import definitions_for

    files = library_stubs(distribution)
    if definitions is None:
        with distributions.targeting(distribution):
            definitions = definitions_for(prefixes=())
    for package in definitions.packages():
        for path, text in package_stubs(definitions, package).items():
            files.setdefault(path, text)
    return files


def stubs_of(distribution: Distribution, name: str) -> dict[str, str]:
    """Return the `stub_files` of one importable package."""
    from scaffold.model.workspace.definitions import definitions_for

    with distributions.targeting(distribution):
        definitions = definitions_for(prefixes=())
    is_known = name in definitions.packages()
    made = package_stubs(definitions, name) if is_known else {}
    own = {path: text for path, text in made.items() if path.startswith(f"{name}/")}
    return own | library_stubs(distribution, name)


def interface_stub_files(package: Package) -> dict[str, str]:
    """Return the stubs of the interfaces that a package defines, by relative path.

    They depend on the files of this package alone: message types of other packages are
    imported from the stubs of those.
    """
    from scaffold.model.interfaces.definitions import Definitions
    from scaffold.model.workspace.definitions import WorkspaceSource
    from scaffold.model.workspace.workspace import Workspace

    definitions = Definitions([WorkspaceSource(Workspace([package]))])
    if package.name not in definitions.packages():
        return {}
    return package_stubs(definitions, package.name, others=True)
