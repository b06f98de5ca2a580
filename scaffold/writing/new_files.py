"""Creates files and directories with the expected owner, mode and attributes.

A file that replaces another one gets its owner, mode and extended attributes, including access
control lists. Hard links are not preserved: other links keep the old content. Files that root
creates in a directory of another user belong to that user.
"""

from __future__ import annotations

import os
import stat
from contextlib import suppress

from scaffold.files import temporary

_EXECUTABLE = stat.S_IXUSR | stat.S_IXGRP | stat.S_IXOTH


def write(path: str, content: bytes, *, executable: bool, like: str, is_durable: bool) -> None:
    """Create a file.

    Args:
        path: The path, which does not exist.
        content: The content.
        executable: Whether to set executable bits.
        like: The file that it will replace, if any, to copy the attributes from.
        is_durable: Whether to wait until it is on disk.

    Raises:
        OSError: the system refuses.
    """
    try:
        old = os.stat(like)
    except (FileNotFoundError, NotADirectoryError):
        old = None
    with open(temporary.create(path), "wb") as file:
        file.write(content)
        file.flush()
        descriptor = file.fileno()
        if old is None:
            adopt(descriptor, os.path.dirname(like))
            mode = 0o666 & ~_umask()
        else:
            mode = _take_owner(descriptor, old)
            _copy_attributes(like, descriptor)
        os.fchmod(descriptor, mode | (_EXECUTABLE & ~_umask() if executable else 0))
        if is_durable:
            os.fsync(descriptor)


def make_directory(path: str) -> None:
    """Create a directory.

    Raises:
        OSError: the system refuses.
    """
    os.mkdir(path)
    adopt(path, os.path.dirname(path))


def adopt(new: str | int, directory: str) -> None:
    """Change the owner of a path created by root to the owner of its destination."""
    while not os.path.isdir(directory):
        directory = os.path.dirname(directory)
    owner = os.stat(directory)
    with suppress(OSError):
        if os.geteuid() == 0 and owner.st_uid != 0:
            os.chown(new, owner.st_uid, owner.st_gid)
        elif owner.st_mode & stat.S_ISGID:
            os.chown(new, -1, owner.st_gid)


def _take_owner(descriptor: int, old: os.stat_result) -> int:
    """Copy the owner of another file, as far as allowed; return the mode to set."""
    new = os.fstat(descriptor)
    if (new.st_uid, new.st_gid) != (old.st_uid, old.st_gid):
        try:
            os.fchown(descriptor, old.st_uid, old.st_gid)
        except OSError:
            with suppress(OSError):
                os.fchown(descriptor, -1, old.st_gid)
    mode = stat.S_IMODE(old.st_mode)
    if os.fstat(descriptor).st_uid != old.st_uid:
        mode &= ~(stat.S_ISUID | stat.S_ISGID)  # setuid bits are not copied to another owner
    return mode


def _copy_attributes(source: str, descriptor: int) -> None:
    if not hasattr(os, "listxattr"):
        return
    with suppress(OSError):
        for name in os.listxattr(source):
            with suppress(OSError):  # some are reserved for the system
                os.setxattr(descriptor, name, os.getxattr(source, name))


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
