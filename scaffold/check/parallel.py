"""Checks a workspace in worker processes; the order of the results does not depend on them."""

from __future__ import annotations

import multiprocessing
import os
import signal
from collections.abc import Callable, Iterator, Sequence

from scaffold.check.cache import worker_reads
from scaffold.check.session import Result
from scaffold.diagnostic import Diagnostic
from scaffold.model.discovery.targets import Target
from scaffold.model.package import Package

BATCH = 16
"""Packages per batch: large enough to share the start of ruff, small enough for progress."""

Batch = Callable[[Sequence[Target]], list[Result]]
_Found = tuple[list[tuple[int, list[Diagnostic]]], list[worker_reads.Note]]

_work: tuple[Batch, Sequence[Target], Sequence[Package]]
"""Set before the workers are forked and inherited by them: rules are loaded by path and could not
be sent; only numbers go in, and diagnostics and notes come out."""


def batches(check: Batch, targets: Sequence[Target]) -> Iterator[Result]:
    """Check targets in batches; yield results in their order."""
    global _work  # noqa: PLW0603  see its docstring
    packages = _all_packages(targets)
    _work = check, targets, packages
    starts = range(0, len(targets), BATCH)
    workers = min(len(os.sched_getaffinity(0)), len(starts))
    if workers == 1:
        for start in starts:
            yield from check(targets[start : start + BATCH])
        return
    with multiprocessing.get_context("fork").Pool(workers, _end_with_the_terminal) as pool:
        for start, (found, learnt) in zip(starts, pool.imap(_run, starts), strict=True):
            for note in learnt:
                note.add_to(packages)
            for target, (files, diagnostics) in zip(
                targets[start : start + BATCH], found, strict=True
            ):
                yield Result(target.package, files, diagnostics)


def _end_with_the_terminal() -> None:
    """Let Ctrl-C, which every process gets, end this one without a word: the first one reports."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def _run(start: int) -> _Found:
    check, targets, packages = _work
    found = [(one.files, one.diagnostics) for one in check(targets[start : start + BATCH])]
    return found, list(worker_reads.take(packages))


def _all_packages(targets: Sequence[Target]) -> list[Package]:
    """Return the packages to check and those around them."""
    found = {id(target.package): target.package for target in targets}
    for around in {id(one.package.known_workspace): one for one in targets}.values():
        found.update((id(package), package) for package in around.package.known_workspace or ())
    return list(found.values())
