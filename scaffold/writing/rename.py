"""Renames that never overwrite: to a free path, or by exchanging two files.

Linux can do both in one step. On other systems, and on file systems without support, several steps
are needed, which are almost as safe.
"""

from __future__ import annotations

import errno
import os
import shutil
from contextlib import suppress

_NO_REPLACE = 1
_EXCHANGE = 2
_CURRENT_DIRECTORY = -100

_UNSUPPORTED = {errno.ENOSYS, errno.EINVAL, errno.EOPNOTSUPP, errno.EPERM}
"""Errors of unsupported calls; some containers return EPERM for them."""


def move(source: str, target: str) -> None:
    """Rename a file to a free name.

    Raises:
        FileExistsError: the name is taken.
        OSError: the system refuses.
    """
    try:
        if not try_rename(source, target, _NO_REPLACE):
            _link_and_unlink(source, target)
    except FileExistsError:
        if not os.path.samefile(source, target):
            raise
        os.unlink(source)  # an earlier attempt was interrupted between its two steps


def _link_and_unlink(source: str, target: str) -> None:
    try:
        os.link(source, target, follow_symlinks=False)
    except (FileExistsError, FileNotFoundError):
        raise
    except OSError:  # no hard links on this file system
        if os.path.lexists(target):
            raise FileExistsError(errno.EEXIST, os.strerror(errno.EEXIST), target) from None
        os.rename(source, target)
    else:
        os.unlink(source)


def exchange(first: str, second: str, spare: str) -> None:
    """Exchange two files.

    Args:
        first: A file.
        second: Another one, which exists at every moment.
        spare: A free name, for file systems that need it. If the process is killed there,
            the old ``second`` has it when ``first`` is missing.

    Raises:
        FileNotFoundError: one of them is missing.
        OSError: the system refuses.
    """
    if try_rename(first, second, _EXCHANGE):
        return
    with suppress(FileNotFoundError):
        os.unlink(spare)
    try:
        os.link(second, spare, follow_symlinks=False)
    except FileNotFoundError:
        raise
    except OSError:
        shutil.copy2(second, spare, follow_symlinks=False)
    os.replace(first, second)
    os.rename(spare, first)


def try_rename(source: str, target: str, flags: int) -> bool:
    """Rename with the Linux system call; return whether it is supported."""
    import ctypes  # only needed to write into an existing directory

    call = getattr(ctypes.CDLL(None, use_errno=True), "renameat2", None)
    if call is None:
        return False
    current = ctypes.c_int(_CURRENT_DIRECTORY)
    old, new = ctypes.c_char_p(os.fsencode(source)), ctypes.c_char_p(os.fsencode(target))
    if call(current, old, current, new, ctypes.c_uint(flags)) == 0:
        return True
    number = ctypes.get_errno()
    if number in _UNSUPPORTED:
        return False
    raise OSError(number, os.strerror(number), source, None, target)
