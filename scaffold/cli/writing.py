"""Common code of verbs that write: locks the package, reports interrupted runs."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager

from scaffold.cli import terminal
from scaffold.errors import ScaffoldError
from scaffold.record import NamedTuple

_OTHER_FILES = 256
"""The number of open files besides the directories of packages."""


@contextmanager
def held(directory: str, *, is_dry: bool) -> Iterator[None]:
    """Lock a package from the first read to the last write; a dry run does not lock.

    Args:
        directory: The root of the package.
        is_dry: Whether nothing will be written.

    Raises:
        LockedError: another process has locked the package for too long.
    """
    from scaffold.writing import transaction

    if is_dry:
        note_unfinished(directory)
        yield
        return
    with transaction.exclusive(directory, terminal.note):
        yield


class Held(NamedTuple):
    """The packages that this run has locked."""

    roots: frozenset[str]
    has_waited: bool
    """Whether files may have changed while waiting."""
    has_failed: bool
    """Whether another process has locked some of the packages for too long."""


def hold_all(stack: ExitStack, roots: Sequence[str], *, is_dry: bool) -> Held:
    """Lock packages until a stack is closed, like `held`; report those that stay locked.

    Args:
        stack: Releases the locks.
        roots: The directories of the packages.
        is_dry: Whether nothing will be written.
    """
    from scaffold.writing import transaction

    if is_dry:
        for root in roots:
            note_unfinished(root)
        return Held(frozenset(roots), has_waited=False, has_failed=False)
    _allow_open_files(len(roots))
    notes: list[str] = []

    def note(line: str) -> None:
        terminal.note(line)
        notes.append(line)

    got: set[str] = set()
    # In the same order in every process, to avoid deadlocks.
    for root in sorted(roots, key=os.path.realpath):
        try:
            stack.enter_context(transaction.exclusive(root, note))
        except ScaffoldError as error:
            terminal.error(str(error))
        else:
            got.add(root)
    return Held(frozenset(got), has_waited=bool(notes), has_failed=len(got) < len({*roots}))


def _allow_open_files(count: int) -> None:
    """Raise the limit of open files by a number, as far as the system allows."""
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    if soft != resource.RLIM_INFINITY and soft < count + _OTHER_FILES:
        wanted = count + _OTHER_FILES
        wanted = wanted if hard == resource.RLIM_INFINITY else min(wanted, hard)
        resource.setrlimit(resource.RLIMIT_NOFILE, (wanted, hard))


def note_unfinished(directory: str) -> bool:
    """Note if a run was interrupted while it changed a package; return whether that is so."""
    from scaffold.files import temporary

    try:
        names = os.listdir(directory)
    except OSError:
        return False
    if not any(map(temporary.is_temporary, names)):
        return False  # the usual case, without the imports of the next line
    from scaffold.writing import transaction

    is_unfinished = transaction.is_unfinished(directory)
    if is_unfinished:
        terminal.note(
            f"{directory}: a run was interrupted while it changed this package; "
            "the next add, update or check --fix completes or undoes it"
        )
    return is_unfinished
