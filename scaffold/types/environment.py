"""A Python environment that contains only the stubs, for the type checker.

It is written to the user's cache once for each version of the stubs.
"""

from __future__ import annotations

import contextlib
import marshal
import os
import shutil
import time
from collections.abc import Callable, Iterator
from functools import lru_cache

from scaffold.distributions import NAMES, Distribution
from scaffold.files import cache, temporary
from scaffold.files.disk import digest
from scaffold.types.stubs import libraries as stubs
from scaffold.types.stubs.marks import mark

KIND = "stubs"
KEPT = 6
"""The number of environments to keep, including those of other versions of the tool."""
_IN_USE = 600.0
"""Seconds after its last use until an environment may be removed; ty runs for at most a minute."""
_INDEX = "index"
_MAGIC = b"scaffold-stubs-1\n"
_SETTINGS = "home = /nonexistent\nversion = {}\n"


def packages(distribution: Distribution) -> str:
    """Return the directory of the stubs in an environment."""
    return os.path.join("lib", f"python{distribution.python_version}", "site-packages")


@lru_cache(maxsize=len(NAMES))
def identity(distribution: Distribution) -> str:
    """Return a hash of the stubs of a distribution and of the code that writes them."""
    parts = [distribution.name]
    own = os.path.dirname(os.path.abspath(__file__))
    for top in (own, os.path.join(os.path.dirname(own), "data")):
        parts += sorted(stamp.removeprefix(top) for stamp in _stamps(top))
    return digest("\n".join(parts).encode("utf-8", "surrogateescape"))


def _stamps(top: str) -> Iterator[str]:
    with os.scandir(top) as entries:
        for entry in entries:
            if not entry.is_dir():
                status = entry.stat()
                yield f"{entry.path} {status.st_size} {status.st_mtime_ns}"
            elif entry.name != "__pycache__":
                yield from _stamps(entry.path)


def directory(distribution: Distribution, scratch: Callable[[str], str]) -> str:
    """Return the environment of a distribution; it is written if it does not exist yet.

    Args:
        distribution: The distribution.
        scratch: Returns a temporary directory, used if there is no cache.

    Raises:
        OSError: it cannot be written.
    """
    kept = cache.directory(KIND)
    if kept is not None:
        place = os.path.join(kept, identity(distribution))
        if _is_whole(place):
            with contextlib.suppress(OSError):
                os.utime(place)  # marks it as in use
            return place
        try:
            _write_aside(distribution, place)
        except OSError:
            if _is_whole(place):  # another process was faster
                return place
        else:
            return place
    place = scratch("environment")
    _write(distribution, place)
    return place


def _is_whole(place: str) -> bool:
    """Return whether an environment has all of its files, unchanged and owned by this user."""
    index = cache.read_sealed(os.path.join(place, _INDEX), _MAGIC)
    if index is None:
        return False
    return all(
        _stamp(os.path.join(place, path)) == tuple(stamp)
        for path, *stamp in marshal.loads(index)  # noqa: S302  own files
    )


def _stamp(path: str) -> tuple[int, int] | None:
    try:
        status = os.lstat(path)
    except OSError:
        return None
    return status.st_size, status.st_mtime_ns


def _write_aside(distribution: Distribution, place: str) -> None:
    kept = os.path.dirname(place)
    aside = os.path.join(kept, temporary.name())
    os.makedirs(kept, exist_ok=True)
    try:
        paths = _write(distribution, aside)
        index = [(path, *(_stamp(os.path.join(aside, path)) or ())) for path in paths]
        cache.write_sealed(os.path.join(aside, _INDEX), _MAGIC, marshal.dumps(index))
        try:
            os.rename(aside, place)
        except OSError:
            if _is_whole(place):
                return  # another process was faster, and its type checker reads these files
            shutil.rmtree(place, ignore_errors=True)
            os.rename(aside, place)
    finally:
        shutil.rmtree(aside, ignore_errors=True)
    trim(kept)


_ARRAY = ("ndarray[Any, Any]", "ndarray")
"""The partial stub of numpy has a class without type arguments."""


def _write(distribution: Distribution, place: str) -> list[str]:
    """Write an environment; return the paths of its files."""
    files = {
        os.path.join(packages(distribution), path): marked(path, text.replace(*_ARRAY))
        for path, text in (stubs.partial_stubs() | stubs.stub_files(distribution)).items()
    }
    files["pyvenv.cfg"] = _SETTINGS.format(distribution.python_version)
    write_files(place, files)
    return list(files)


def marked(path: str, text: str) -> str:
    """Return a stub with marked names; its path determines its module."""
    parts = path.removesuffix(".pyi").split("/")
    return mark(text, ".".join(parts[:-1] if parts[-1] == "__init__" else parts))


def write_files(top: str, files: dict[str, str]) -> None:
    """Write files below a directory, which is created; raises OSError."""
    for folder in {os.path.dirname(path) for path in files}:
        os.makedirs(os.path.join(top, folder), exist_ok=True)
    for path, text in files.items():
        with open(os.path.join(top, path), "wb") as file:
            file.write(text.encode())


def trim(kept: str) -> None:
    """Remove the oldest environments, except those that a running type checker may read."""
    recent = time.time() - _IN_USE
    try:
        places = [entry.path for entry in os.scandir(kept)]
        for path in sorted(places, key=os.path.getmtime)[:-KEPT]:
            if os.path.getmtime(path) < recent:
                shutil.rmtree(path, ignore_errors=True)
    except OSError:
        return  # another process is cleaning up
