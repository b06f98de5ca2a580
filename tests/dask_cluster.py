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
    """A scheduler or worker, with a directory for temporary files: it tells whose a process is."""

    process: subprocess.Popen[str]
    tmp: Path
    log: Path


@dataclass
class Running:
    """A cluster."""

    address: str
    scheduler: Member
    workers: Sequence[Member]


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
        directory: Gets their logs and temporary files.
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
        members = []
        for number in range(workers):
            scratch = str(directory / f"dask-{number}")
            words = ["dask_worker", address[0], "--nthreads", "1", "--no-nanny", *flags]
            members.append(
                stack.enter_context(
                    _member(
                        directory / f"worker-{number}",
                        [*words, "--local-directory", scratch],
                        {**given, **(of_workers or {})},
                    )
                )
            )
        for member in members:
            wait_until(lambda log=member.log: "Registered to" in log.read_text())  # type: ignore[misc]
        yield Running(address[0], scheduler, members)


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
