"""Checks a workspace in worker processes; the order of the results does not depend on them."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterator, Sequence

from scaffold.check.diagnostic import Diagnostic
from scaffold.check.session import Result
from scaffold.model.discovery import Target

BATCH = 16
"""Packages per batch: large enough to share the start of ruff, small enough for progress."""

Batch = Callable[[Sequence[Target]], list[Result]]
_Found = list[tuple[int, list[Diagnostic]]]

_work: tuple[Batch, Sequence[Target]]
"""Set before the workers are forked and inherited by them: rules are loaded by path and could not
be sent; only numbers go in and diagnostics come out."""


def batches(check: Batch, targets: Sequence[Target]) -> Iterator[Result]:
    """Check targets in batches; yield results in their order."""
    global _work  # noqa: PLW0603  see its docstring
    _work = check, targets
    starts = range(0, len(targets), BATCH)
    workers = min(len(os.sched_getaffinity(0)), len(starts))
    if workers == 1:
        for start in starts:
            yield from check(targets[start : start + BATCH])
        return
    with multiprocessing.get_context("fork").Pool(workers) as pool:
        for start, found in zip(starts, pool.imap(_run, starts), strict=True):
            for target, (files, diagnostics) in zip(
                targets[start : start + BATCH], found, strict=True
            ):
                yield Result(target.package, files, diagnostics)


def _run(start: int) -> _Found:
    check, targets = _work
    return [(one.files, one.diagnostics) for one in check(targets[start : start + BATCH])]
