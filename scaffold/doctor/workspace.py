"""A colcon workspace: its sources, and its build and install spaces."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from functools import cached_property
from pathlib import Path

from scaffold import lazy_re
from scaffold.files.disk import Disk
from scaffold.files.tree import MANIFEST
from scaffold.model.discovery.colcon import package_directories

_MARKER = ".colcon_install_layout"
_NAME = lazy_re.compile(r"<name>\s*([^<>\s]+)\s*</name>")
_CHAINED = lazy_re.compile(r"""^_?COLCON_CURRENT_PREFIX=["']?([^"'\n$]+)["']?\s*$""", re.MULTILINE)
_MANIFEST_BYTES = 2**16
_INSTALLED_ONCE = ("setup.py", "setup.cfg", "pyproject.toml", "CMakeLists.txt", MANIFEST)
"""Files that take effect only by a build, also with ``--symlink-install``."""
_GENERATED = (".msg", ".srv", ".action", ".idl", ".c", ".cc", ".cpp", ".h", ".hpp")


class Workspace:
    """A directory with ``src`` and ``install``.

    Args:
        top: The directory.
    """

    def __init__(self, top: str) -> None:
        self.top = top

    @classmethod
    def around(cls, directory: str) -> Workspace | None:
        """Return the workspace of a directory."""
        path = os.path.realpath(directory)
        while True:
            if os.path.isdir(os.path.join(path, "src")) and (
                os.path.isfile(os.path.join(path, "install", _MARKER))
                or package_directories(Disk(), os.path.join(path, "src"), most=1000)
            ):
                return cls(path)
            parent = os.path.dirname(path)
            if parent == path:
                return None
            path = parent

    @classmethod
    def of_prefix(cls, prefix: str) -> Workspace | None:
        """Return the workspace of a prefix, which is its ``install`` or a package in it."""
        for install in (prefix, os.path.dirname(prefix)):
            top = os.path.dirname(install)
            is_made = os.path.isfile(os.path.join(install, _MARKER))
            if is_made and os.path.isdir(os.path.join(top, "src")):
                return cls(top)
        return None

    @property
    def install(self) -> str:
        """The install space."""
        return os.path.join(self.top, "install")

    @cached_property
    def sources(self) -> dict[str, list[str]]:
        """The directories of the packages in ``src``, by name; more than one is an error."""
        result: dict[str, list[str]] = {}
        for directory in package_directories(Disk(), os.path.join(self.top, "src")):
            result.setdefault(_name(directory), []).append(directory)
        return result

    @cached_property
    def installed(self) -> dict[str, str]:
        """The prefixes of the packages in ``install``, by name."""
        result: dict[str, str] = {}
        try:
            entries = sorted(os.listdir(self.install))
        except OSError:
            return result
        for prefix in [self.install, *(os.path.join(self.install, name) for name in entries)]:
            for manifest in Path(prefix).glob(f"share/*/{MANIFEST}"):
                result.setdefault(manifest.parent.name, prefix)
        return result

    def built(self, name: str) -> float | None:
        """Return when a package was last built; ``None`` if unknown."""
        candidates = (
            os.path.join(self.top, "build", name, "colcon_build.rc"),
            os.path.join(self.installed.get(name, self.install), "share", name, "package.sh"),
            os.path.join(self.installed.get(name, self.install), "share", name, MANIFEST),
        )
        times = [os.stat(path).st_mtime for path in candidates if os.path.exists(path)]
        return max(times, default=None)

    def changed_since(self, directory: str, name: str, moment: float) -> str | None:
        """Return a file of a package that has changed since and needs a build."""
        is_linked = self._is_linked(name)
        for path in _files(directory):
            takes_effect = path.endswith((*_INSTALLED_ONCE, *_GENERATED)) or not is_linked
            if takes_effect and os.path.getmtime(path) > moment:
                return os.path.relpath(path, self.top)
        return None

    def chained(self) -> list[str]:
        """Return the underlays: the prefixes that its ``setup.sh`` sources first."""
        try:
            with open(os.path.join(self.install, "setup.sh"), encoding="utf-8") as file:
                text = file.read(_MANIFEST_BYTES)
        except (OSError, UnicodeDecodeError):
            return []
        return [path for path in _CHAINED.findall(text) if path != self.install]

    def _is_linked(self, name: str) -> bool:
        """Return whether a package was installed with symlinks to its sources."""
        prefix = self.installed.get(name, self.install)
        roots = (os.path.join(prefix, "share", name), os.path.join(prefix, "lib", name))
        return any(
            os.path.islink(path) for root in roots if os.path.isdir(root) for path in _files(root)
        ) or any(Path(prefix).glob("lib/python*/site-packages/*.egg-link"))


def _files(directory: str) -> Iterator[str]:
    for parent, directories, names in os.walk(directory):
        directories[:] = [
            name for name in directories if not name.startswith(".") and name != "__pycache__"
        ]
        for name in names:
            path = os.path.join(parent, name)
            if not name.startswith(".") and os.path.exists(path):
                yield path


def _name(directory: str) -> str:
    try:
        with open(os.path.join(directory, MANIFEST), encoding="utf-8", errors="replace") as file:
            match = _NAME.search(file.read(_MANIFEST_BYTES))
    except OSError:
        match = None
    return match[1] if match else os.path.basename(directory)
