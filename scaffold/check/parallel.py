"""Distributes a check over worker processes by size; results keep their order."""

from __future__ import annotations

import gc
import os
import signal
import sys
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Protocol

from scaffold.check.cache import worker_reads
from scaffold.diagnostic import Diagnostic
from scaffold.files.disk import size
from scaffold.model.package import Package
from scaffold.programs.termination import SIGNALS, leave_to_default
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from multiprocessing.pool import Pool

    from scaffold.ament import StyleCheck
    from scaffold.check.result import Earlier, Result, Ruled
    from scaffold.model.discovery.targets import Target

WORTH_WORKERS = 150_000
"""The size of Python code from which worker processes pay."""
TASK = 250_000
"""The size of Python code per task, large enough to share the start of ruff."""
STYLE = 500_000
"""The size of Python code whose style is one task next to those of rules: ruff is started for each,
and what it leaves in memory grows."""
MOST_OF_RULES = 2_000_000
"""Bytes of Python whose rules are one task, unless they are one package: what is parsed for them
stays in memory until its end."""
MOST_PACKAGES = 16
"""The maximum number of packages per task, for progress."""
MAX_GARBAGE = 300_000
"""Blocks of memory, some 20 MB, from which on it pays to look for garbage: what the rules and the
style of 500 kB of Python leave."""
MAX_FACTS = 10_000
"""The maximum number of facts that a worker keeps between tasks; 2,000 take 1 MB."""

Style = dict[str, list[Diagnostic]]


class Checker(Protocol):
    """A checker of packages: a ``Session``, the same in all processes."""

    def run_batch(
        self,
        targets: Sequence[Target],
        style: StyleCheck | None = None,
        earlier: Mapping[str, Earlier] | None = None,
    ) -> list[Result]:
        """Check packages in this process."""

    def start_style(
        self,
        packages: Sequence[Package],
        earlier: Mapping[str, Earlier] | None = None,
        paths: Collection[str] | None = None,
    ) -> StyleCheck | None:
        """Start the style backend."""

    def check_rules(self, package: Package, earlier: Earlier | None = None) -> Ruled:
        """Run the rules over a package."""

    def result(
        self,
        target: Target,
        rules: Ruled,
        style: Mapping[str, Sequence[Diagnostic]],
        earlier: Earlier | None = None,
    ) -> Result:
        """Combine the findings in a package."""


class _Task(NamedTuple):
    """The rules of some packages, their style, or both."""

    start: int
    stop: int
    has_rules: bool
    paths: frozenset[str] | None = None
    """The files whose style is checked; ``None`` for all."""


class _Done(NamedTuple):
    """The results of a task, by index of the package."""

    rules: dict[int, Ruled]
    style: dict[int, Style]
    learnt: list[worker_reads.WorkerReads]


class _Work(NamedTuple):
    session: Checker
    targets: Sequence[Target]
    earlier: Mapping[str, Earlier]
    packages: Sequence[Package]
    tasks: Sequence[_Task]


_work: _Work
"""Set before the workers are forked and inherited by them: rules are loaded by path and could not
be sent; only numbers go in, and what was found and learnt comes out."""


def run(
    session: Checker, targets: Sequence[Target], earlier: Mapping[str, Earlier]
) -> Iterator[Result]:
    """Check packages; yield their results in the order given.

    Args:
        session: The checker.
        targets: The packages.
        earlier: Earlier results of some packages, by directory.
    """
    global _work  # noqa: PLW0603  see its docstring
    sizes = [_sizes(target.package, earlier) for target in targets]
    processors = len(os.sched_getaffinity(0))
    tasks = list(_tasks(sizes, processors))
    workers = min(processors, len(tasks))
    if workers < 2 or sum(sum(item.values()) for item in sizes) < WORTH_WORKERS:  # noqa: PLR2004
        for start in range(0, len(targets), MOST_PACKAGES):
            yield from session.run_batch(targets[start : start + MOST_PACKAGES], None, earlier)
        return
    packages = _all_packages(targets)
    _work = _Work(session, targets, earlier, packages, tasks)
    with _start_pool(workers) as pool:
        rules: dict[int, Ruled] = {}
        style: dict[int, Style] = {}
        for number, done in enumerate(pool.imap(_run, range(len(tasks))), 1):
            for note in done.learnt:
                note.add_to(packages)
            rules.update(done.rules)
            for at, styles in done.style.items():
                style.setdefault(at, {}).update(styles)
            is_complete = number == len(tasks) or tasks[number].has_rules
            for at in sorted(rules) if is_complete else ():
                package = targets[at].package
                previous = earlier.get(package.directory)
                result = session.result(targets[at], rules.pop(at), style.pop(at, {}), previous)
                package.forget()
                yield result


def _sizes(package: Package, earlier: Mapping[str, Earlier]) -> dict[str, int]:
    """Return the sizes of the Python files to read, ignoring changes in memory."""
    previous = earlier.get(package.directory)
    place = package.place
    if place is None:
        return {}
    return {
        path: size(os.path.join(place, path))
        for path in (*package.tree.files, *getattr(package.tree, "broken_links", ()))
        if path.endswith(".py") and (previous is None or package.full_path(path) in previous.edited)
    }


def _tasks(sizes: Sequence[Mapping[str, int]], processors: int) -> Iterator[_Task]:
    """Yield the tasks; the rules of a package come before the rest of its style.

    A large package is one task for its rules and others for its style. Next to one, the rules of
    other packages join its task, as they ask about it, and each process would read it again: half
    of the processors, one at least, share the rules.
    """
    totals = [sum(files.values()) for files in sizes]
    share = TASK
    if max(totals, default=0) > 2 * TASK:
        share = min(max(sum(totals) // max(processors // 2, 1), TASK), MOST_OF_RULES)
    start = 0
    while start < len(totals):
        stop, total = start + 1, totals[start]
        while stop < min(start + MOST_PACKAGES, len(totals)) and total + totals[stop] <= share:
            total += totals[stop]
            stop += 1
        if total <= 2 * TASK:
            yield _Task(start, stop, has_rules=True)
        else:
            yield _Task(start, stop, has_rules=True, paths=frozenset())
            yield from _style_tasks(sizes, start, stop)
        start = stop


def _style_tasks(sizes: Sequence[Mapping[str, int]], start: int, stop: int) -> Iterator[_Task]:
    """Yield the tasks for the style of packages: parts of large ones, and small ones together."""
    while start < stop:
        end, total = start + 1, sum(sizes[start].values())
        while end < stop and total + sum(sizes[end].values()) <= STYLE:
            total += sum(sizes[end].values())
            end += 1
        if total <= STYLE:
            yield _Task(start, end, has_rules=False)
        else:
            for paths in _split(sizes[start]):
                yield _Task(start, end, has_rules=False, paths=paths)
        start = end


def _split(files: Mapping[str, int]) -> Iterator[frozenset[str]]:
    paths: list[str] = []
    total = 0
    for path, bytes_ in files.items():
        paths.append(path)
        total += bytes_
        if total > STYLE:
            yield frozenset(paths)
            paths, total = [], 0
    if paths:
        yield frozenset(paths)


@contextmanager
def _start_pool(workers: int) -> Iterator[Pool]:
    """Run worker processes that ignore Ctrl-C: the first process ends them.

    A killed worker could hold the lock of the queue, for which the first process waits.
    Processes and threads inherit blocked signals when they are started.
    """
    import multiprocessing  # slow to import, and not needed for small checks

    gc.freeze()  # so that workers only collect their own objects
    with _no_interruption():
        pool = multiprocessing.get_context("fork").Pool(workers, leave_to_default)
    try:
        yield pool
    finally:
        gc.unfreeze()
        with _no_interruption():
            pool.terminate()


@contextmanager
def _no_interruption() -> Iterator[None]:
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT, *SIGNALS})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _run(number: int) -> _Done:
    session, targets, earlier, packages, tasks = _work
    _drop_old_data(packages)
    task = tasks[number]
    places = range(task.start, task.stop)
    backend = session.start_style([targets[at].package for at in places], earlier, task.paths)
    rules: dict[int, Ruled] = {}
    style: dict[int, Style] = {}
    for at in places:
        _garbage.collect()
        package = targets[at].package
        if task.has_rules:
            rules[at] = session.check_rules(package, earlier.get(package.directory))
        style[at] = backend.by_file(package) if backend else {}
        package.forget_views()
    return _Done(rules, style, list(worker_reads.take(packages)))


class _Garbage:
    """Controls garbage collection in a worker.

    Parsed files are in reference cycles: Python would collect them after most of a task, or very
    late. Collecting after each package takes a tenth of the time of a check.
    """

    def __init__(self) -> None:
        self._blocks = 0

    def start(self) -> None:
        """Take over from Python."""
        gc.disable()
        self._blocks = sys.getallocatedblocks()

    def collect(self) -> None:
        """Collect garbage if there are many new objects."""
        if sys.getallocatedblocks() - self._blocks > MAX_GARBAGE:
            gc.collect()
            self._blocks = sys.getallocatedblocks()


_garbage = _Garbage()


def _drop_old_data(packages: Sequence[Package]) -> None:
    """Drop the data of earlier tasks of this process."""
    if gc.isenabled():  # the first task
        _garbage.start()
    elif sum(len(package.facts) for package in packages) > MAX_FACTS:
        for package in packages:
            package.forget_facts()


def _all_packages(targets: Sequence[Target]) -> list[Package]:
    """Return the packages to check and those around them."""
    packages = {id(target.package): target.package for target in targets}
    for around in {id(item.package.known_workspace): item for item in targets}.values():
        packages.update((id(package), package) for package in around.package.known_workspace or ())
    return list(packages.values())
