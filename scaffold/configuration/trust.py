"""The trusted directories and repositories, whose rules and templates may be loaded.

The user trusts directories by path, and git repositories by address. Trust applies to exactly that
directory, like git's ``safe.directory``, not to those below it. The list is a file in the user's
configuration, with the real path of each directory and its owner at that time: if another user
replaces the directory, it is no longer trusted.
"""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator

from scaffold.errors import ConfigError, InputError
from scaffold.files import home
from scaffold.files.disk import Disk

FILE = "trusted"
"""The file in the user's configuration directory."""

_OF_URLS = "git"
"""The prefix of repository addresses, instead of an owner."""
_ABOUT = "# Trusted by `ros2-scaffold trust`: owner and path of directories; git and URL.\n"


def is_trusted(disk: Disk, directory: str) -> bool:
    """Return whether the user trusts a directory.

    Args:
        disk: Records what the answer depends on.
        directory: Its real path.
    """
    owner = trusted(disk).get(directory)
    return owner is not None and owner == disk.owner(directory)


def trusted(disk: Disk) -> dict[str, str]:
    """Return the owners of the trusted directories by their real paths."""
    return {place: owner for place, owner in _entries(disk).items() if owner != _OF_URLS}


def is_trusted_url(url: str) -> bool:
    """Return whether the user trusts a repository by its address."""
    return _entries(Disk()).get(url) == _OF_URLS


def trusted_urls() -> list[str]:
    """Return the addresses of the repositories that the user trusts."""
    return [url for url, owner in _entries(Disk()).items() if owner == _OF_URLS]


def add_url(url: str) -> None:
    """Trust a repository by its address, whatever it will contain.

    Raises:
        InputError: it is not a valid address.
        ConfigError: the list cannot be written.
    """
    if url.startswith("-") or url.split() != [url]:
        raise InputError(f"{url!r}: not the address of a repository")
    with _locked() as path:
        _write(path, {**_entries(Disk()), url: _OF_URLS})


def _entries(disk: Disk) -> dict[str, str]:
    """Return the owners of directories by their real paths, and addresses of repositories."""
    path = _path()
    if path is None or not disk.is_file(path):
        return {}
    try:
        text = os.fsdecode(disk.read(path))
    except OSError as error:
        raise ConfigError(f"{path}: {error.strerror}") from error
    entries: dict[str, str] = {}
    for line in text.splitlines(keepends=False):
        owner, _, directory = line.partition(" ")
        if owner == _OF_URLS or (owner.isdecimal() and os.path.isabs(directory)):
            entries[directory] = owner
    return entries


def add(directory: str) -> str:
    """Trust a directory and return its real path.

    Raises:
        InputError: it does not exist, or is world-writable.
        ConfigError: the list cannot be written.
    """
    if not os.path.isdir(directory):
        raise InputError(f"{directory}: no such directory")
    disk = Disk()
    real = disk.real(directory)
    if real.splitlines() != [real]:
        raise InputError(f"{directory}: names with line breaks cannot be trusted")
    if disk.is_shared(real):
        raise InputError(f"{directory}: world-writable, so it cannot be trusted")
    with _locked() as path:
        _write(path, {**_entries(Disk()), real: disk.owner(real)})
    return real


def remove(directory: str) -> str:
    """Stop trusting a directory, which may no longer exist, or an address; return its entry.

    Raises:
        InputError: it is not trusted.
        ConfigError: the list cannot be written.
    """
    with _locked() as path:
        entries = _entries(Disk())
        names = (directory, os.path.realpath(directory), os.path.abspath(directory))
        name = next((name for name in names if name in entries), None)
        if name is None:
            raise InputError(f"{directory}: not trusted; see `ros2-scaffold trust --list`")
        del entries[name]
        _write(path, entries)
    return name


def _path() -> str | None:
    directory = home.configuration()
    return None if directory is None else os.path.join(directory, FILE)


@contextlib.contextmanager
def _locked() -> Iterator[str]:
    """Lock the list and yield its path."""
    import fcntl

    path = _path()
    if path is None:
        raise ConfigError("no home directory for the list of trusted directories; set HOME")
    try:
        os.makedirs(os.path.dirname(path), mode=0o700, exist_ok=True)
        descriptor = os.open(os.path.dirname(path), os.O_RDONLY)
    except OSError as error:
        raise ConfigError(f"{path}: {error.strerror}; nothing was changed") from error
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX)
        yield path
    finally:
        os.close(descriptor)


def _write(path: str, entries: dict[str, str]) -> None:
    """Write the list atomically; a symlink to it, as for dotfiles, is kept."""
    from tempfile import NamedTemporaryFile

    target = os.path.realpath(path)
    lines = [f"{owner} {directory}\n" for directory, owner in sorted(entries.items())]
    try:
        with NamedTemporaryFile(
            prefix=f".{FILE}-", dir=os.path.dirname(target), delete=False
        ) as file:
            try:
                file.write(os.fsencode(_ABOUT + "".join(lines)))
                file.flush()
                os.fsync(file.fileno())
                os.replace(file.name, target)
            except BaseException:
                os.unlink(file.name)
                raise
    except OSError as error:
        raise ConfigError(f"{path}: {error.strerror}; nothing was changed") from error
