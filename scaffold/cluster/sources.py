"""The sources of packages as bytes, for workers."""

from __future__ import annotations

import io
import os
import tarfile
from pathlib import Path

from scaffold.model.package import Package

_LEFT_BEHIND = frozenset(
    {".git", ".hg", ".svn", "__pycache__", "build", "install", "log", "COLCON_IGNORE", ".venv"}
)
"""Directories of builds and version control in a package."""


def pack(package: Package) -> bytes:
    """Return the files of a package as a compressed archive.

    Raises:
        OSError: they cannot be read.
    """
    out = io.BytesIO()
    with tarfile.open(fileobj=out, mode="w:gz", compresslevel=1) as archive:
        archive.add(os.path.realpath(package.directory), arcname=".", filter=_archive_filter)
    return out.getvalue()


def unpack(data: bytes, directory: Path) -> Package:
    """Write the files of a package to a new directory; return the package.

    Raises:
        OSError: they cannot be written.
    """
    directory.mkdir(parents=True)
    with tarfile.open(fileobj=io.BytesIO(data), mode="r:gz") as archive:
        # Only this tool packs archives, and their sender may run code here anyway; the filter
        # keeps links and names from leaving the directory by mistake.
        archive.extractall(directory, filter="data")
    return Package.at(str(directory))


def _archive_filter(entry: tarfile.TarInfo) -> tarfile.TarInfo | None:
    name = os.path.basename(entry.name)
    is_special = not (entry.isreg() or entry.isdir() or entry.issym() or entry.islnk())
    if is_special or (name in _LEFT_BEHIND and entry.name != "."):
        return None
    entry.uid = entry.gid = 0
    entry.uname = entry.gname = ""
    return entry
