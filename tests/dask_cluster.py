"""A real scheduler and real workers, as processes of this machine."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path

from tests.smoke.smoke_runs import ROOT, variables, wait_until


@dataclass
class Member:
    """A scheduler or worker; its directory for temporary files identifies its processes."""

    process: subprocess.Popen[str]
    tmp: Path
    log: Path


@dataclass
class Running:
    """A cluster."""

    address: str
    scheduler: Member
    workers: list[Member]

    @contextmanager
    def worker(
        self, address: str, given: Mapping[str, str], flags: Sequence[str] = ()
    ) -> Iterator[Member]:
        """Run one more worker for the length of the block.

        Args:
            address: Where it finds the scheduler.
            given: Variables of its environment.
            flags: Of its program.
        """
        directory, number = self.scheduler.tmp.parent, len(self.workers)
        words = ["dask_worker", address, "--nthreads", "1", "--no-nanny", *flags]
        scratch = str(directory / f"dask-{number}")
        command = [*words, "--local-directory", scratch]
        with _member(directory / f"worker-{number}", command, given) as member:
            self.workers.append(member)
            yield member


@contextmanager
def cluster(
    directory: Path,
    workers: int,
    *,
    of_all: Mapping[str, str] | None = None,
    of_workers: Mapping[str, str] | None = None,
    flags: Sequence[str] = (),
) -> Iterator[Running]:
    """Run a scheduler and workers with one thread each for the length of the block.

    Args:
        directory: For their logs and temporary files.
        workers: How many.
        of_all: Variables of the environment.
        of_workers: More of them, for workers.
        flags: Of both programs.
    """
    given = dict(of_all or {})
    with ExitStack() as stack:
        scheduler = stack.enter_context(
            _member(
                directory / "scheduler",
                ["dask_scheduler", "--host", "127.0.0.1", "--port", "0", *flags],
                given,
            )
        )
        wait_until(lambda: "Scheduler at" in scheduler.log.read_text())
        address = re.search(r"(?:tcp|tls)://[\d.]+:\d+", scheduler.log.read_text())
        assert address is not None
        of_one = {**given, **(of_workers or {})}
        running = Running(address[0], scheduler, [])
        for _ in range(workers):
            stack.enter_context(running.worker(address[0], of_one, flags))
        for member in running.workers:
            wait_until(lambda log=member.log: "Registered to" in log.read_text())  # type: ignore[misc]
        yield running


@contextmanager
def _member(tmp: Path, words: Sequence[str], given: Mapping[str, str]) -> Iterator[Member]:
    tmp.mkdir()
    log = tmp.with_suffix(".log")
    command = [sys.executable, "-m", f"distributed.cli.{words[0]}", *words[1:], "--no-dashboard"]
    with (
        log.open("w") as out,
        subprocess.Popen(
            command,
            env={**variables(tmp, XDG_STATE_HOME=f"{tmp}-state"), **given},
            stdout=out,
            stderr=out,
            cwd=ROOT,
            text=True,
        ) as process,
    ):
        try:
            yield Member(process, tmp, log)
        finally:
            process.kill()
