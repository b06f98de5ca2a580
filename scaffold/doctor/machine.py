"""A snapshot of variables and files for ``doctor``; nothing is run or sourced."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from scaffold import lazy_re
from scaffold.distributions import DEFAULT
from scaffold.doctor.workspace import Workspace

INSTALLED = "/opt/ros"
NETWORK = "/sys/class/net"

_PYTHON = lazy_re.compile(r"python(3\.\d+)")


@dataclass(frozen=True)
class Machine:
    """The paths and variables that are read; tests replace them."""

    variables: Mapping[str, str] = field(default_factory=lambda: dict(os.environ))
    installed: str = INSTALLED
    """The directory of installations, with one directory per distribution."""
    own_prefix: str = sys.prefix
    """The Python environment of this tool, which may hold the wheels of ROS."""
    directory: str = field(default_factory=os.getcwd)
    network: str = NETWORK

    def paths(self, variable: str) -> list[str]:
        """Return the directories in a variable."""
        parts = self.variables.get(variable, "").split(os.pathsep)
        return [os.path.normpath(part) for part in parts if part]

    @cached_property
    def prefixes(self) -> list[str]:
        """The sourced prefixes, in order of precedence."""
        return self.paths("AMENT_PREFIX_PATH")

    @cached_property
    def installations(self) -> list[str]:
        """The distributions that are installed, the default one first."""
        names = [path.parent.name for path in Path(self.installed).glob("*/setup.bash")]
        return sorted(names, key=lambda name: (name != DEFAULT, name))

    def distribution_of(self, path: str) -> str | None:
        """Return the distribution of the installation that contains a path."""
        top = os.path.join(os.path.normpath(self.installed), "")
        return path[len(top) :].partition("/")[0] or None if path.startswith(top) else None

    @cached_property
    def distribution(self) -> str:
        """The distribution that is sourced or installed, else the default one."""
        named = self.variables.get("ROS_DISTRO") if self.prefixes else None
        return named or next(iter(self.installations), DEFAULT)

    @cached_property
    def python(self) -> str | None:
        """The ``python3`` of the search path."""
        return self.program("python3")

    @cached_property
    def python_version(self) -> str | None:
        """The version of ``python3``, such as ``3.12``, from its file name or environment."""
        if self.python is None:
            return None
        settings = Path(self.python).parent.parent / "pyvenv.cfg"
        if settings.is_file():
            lines = settings.read_text(encoding="utf-8", errors="replace").splitlines()
            pairs = [line.partition("=") for line in lines]
            stated = {name.strip(): value.strip() for name, _, value in pairs}
            version = stated.get("version") or stated.get("version_info")
            if version:
                return ".".join(version.split(".")[:2])
        match = _PYTHON.search(os.path.basename(os.path.realpath(self.python)))
        return match[1] if match else None

    def program(self, name: str) -> str | None:
        """Return the path of a program on the search path."""
        return shutil.which(name, path=self.variables.get("PATH") or os.defpath)

    @cached_property
    def workspace(self) -> Workspace | None:
        """The workspace of the current directory, else the one that is sourced."""
        around = Workspace.around(self.directory)
        if around is not None:
            return around
        for prefix in [*self.paths("COLCON_PREFIX_PATH"), *self.prefixes]:
            workspace = Workspace.of_prefix(prefix)
            if workspace is not None:
                return workspace
        return None


def python_in(path: str) -> str | None:
    """Return the Python version of a directory, such as ``3.12``."""
    match = _PYTHON.search(path)
    return match[1] if match else None


def has_package(prefix: str, name: str) -> bool:
    """Return whether a prefix has a package of ament."""
    return os.path.exists(os.path.join(prefix, "share/ament_index/resource_index/packages", name))


def packages_in(prefix: str) -> list[str]:
    """Return the packages of ament in a prefix."""
    try:
        return sorted(os.listdir(os.path.join(prefix, "share/ament_index/resource_index/packages")))
    except OSError:
        return []


def middlewares(prefixes: list[str]) -> list[str]:
    """Return the middlewares that are installed in prefixes."""
    names: set[str] = set()
    for prefix in prefixes:
        index = os.path.join(prefix, "share/ament_index/resource_index/rmw_typesupport")
        if os.path.isdir(index):
            names.update(os.listdir(index))
    return sorted(names - {"rmw_implementation"})
