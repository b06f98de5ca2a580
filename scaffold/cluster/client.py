"""The connection to a Dask cluster: submits tasks, returns each result once."""

from __future__ import annotations

import asyncio
import logging
import time
import uuid
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from importlib import import_module
from typing import Any, Generic, TypeVar

from scaffold import __version__
from scaffold.cluster import worker
from scaffold.cluster.silence import PATIENCE, Silence
from scaffold.errors import EnvironmentMissingError
from scaffold.programs import installation

TIMEOUT = 10.0
"""Seconds for a scheduler to respond and to have a worker."""

_PERIOD = 0.05

Task = TypeVar("Task")
Result = TypeVar("Result")
Dask = Any
"""Objects of Dask, which need not be installed."""


@dataclass(frozen=True)
class Done(Generic[Result]):
    """The outcome of a task."""

    name: str
    worker: str = ""
    """The worker that ran it; empty if it did not finish."""
    result: Result | None = None
    error: str = ""
    """The error, if there is no result."""


class Cluster:
    """A connection to a cluster.

    Args:
        client: Dask's.
        tell: Called with messages for the user.
    """

    def __init__(self, client: Dask, tell: Callable[[str], None]) -> None:
        self._client = client
        self._tell = tell

    @property
    def threads(self) -> int:
        """The number of tasks that its workers run at a time."""
        return sum(self._client.nthreads().values()) or 1

    def map(
        self, function: Callable[..., Result], tasks: Mapping[str, Task], *shared: object
    ) -> Iterator[Done[Result]]:
        """Submit tasks; yield each outcome once, in the order of completion.

        A task whose worker dies is run again on another one; Dask gives up when that happens
        repeatedly.

        Args:
            function: A function of this tool, which the workers have.
            tasks: Its first arguments, by name.
            shared: Its other arguments, the same for all: sent once to each worker, however
                large they are.
        """
        run = uuid.uuid4().hex
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # a warning about large arguments
            given = [
                # As results of tasks they survive the death of a worker.
                self._client.submit(worker.same, item, key=f"ros2-scaffold-{run}-shared-{number}")
                for number, item in enumerate(shared)
            ]
        waiting: dict[str, str] = {}
        futures = []
        for name, task in tasks.items():
            key = f"ros2-scaffold-{run}-{name}"
            waiting[key] = name
            futures.append(
                self._client.submit(
                    worker.work, function, __version__, task, *given, key=key, pure=False
                )
            )
        try:
            for future in self._ended_tasks(futures):
                if future.key in waiting:
                    yield _outcome(waiting.pop(future.key), future)
                future.release()
            for name in waiting.values():
                yield Done(name, error=f"the scheduler has not responded for {PATIENCE:g} s")
        finally:
            with suppress(Exception):  # the scheduler may be gone
                self._client.cancel([*futures, *given], force=True)

    def _ended_tasks(self, futures: Sequence[Dask]) -> Iterator[Dask]:
        """Yield ended tasks, until the scheduler does not respond any more."""
        ended = _dask().as_completed(futures, loop=self._client.loop)
        silence = Silence(self._client, self._tell)
        while not ended.is_empty():
            batch = ended.next_batch(block=False)
            yield from batch
            if not batch:
                if silence.has_come():
                    return
                time.sleep(_PERIOD)


def _dask() -> Dask:
    return import_module("distributed")


def _outcome(name: str, future: Dask) -> Done[Any]:
    try:
        where, result = future.result(timeout=TIMEOUT)
    except (Exception, asyncio.CancelledError) as error:  # noqa: BLE001  whatever a worker raises
        return Done(name, error=_reason(error))
    return Done(name, where, result)


def _reason(error: BaseException) -> str:
    if isinstance(error, _dask().KilledWorker):
        return "its worker died, and so did every other worker that was tried"
    if isinstance(error, asyncio.CancelledError) or "Cancelled" in type(error).__name__:
        return "the connection to the scheduler was lost"
    return f"{type(error).__name__}: {error}".splitlines()[0]


@contextmanager
def connected(address: str, tell: Callable[[str], None]) -> Iterator[Cluster]:
    """Connect to a scheduler for the duration of the block.

    Args:
        address: Such as ``tcp://host:8786``; TLS is set in the configuration of Dask.
        tell: Called with messages for the user.

    Raises:
        EnvironmentMissingError: Dask is not installed, there is no scheduler, it has no workers,
            or the versions differ.
    """
    try:
        dask = _dask()
    except ImportError as error:
        raise EnvironmentMissingError(
            f"--cluster needs Dask; run: {installation.command('cluster')}"
        ) from error
    _silence_logging()
    try:
        client = dask.Client(address, timeout=TIMEOUT, set_as_default=False)
    except Exception as error:  # any error of a wrong address, a wrong port or TLS
        raise EnvironmentMissingError(_connection_error(address, error)) from error
    try:
        _validate(client, address)
        yield Cluster(client, tell)
    finally:
        with suppress(Exception):
            client.close(timeout=TIMEOUT)


def _silence_logging() -> None:
    """Keep Dask from logging, as this tool reports errors itself."""
    names = [*logging.root.manager.loggerDict, "distributed"]  # it sets the levels of many loggers
    for name in names:
        if name.partition(".")[0] in {"distributed", "tornado", "asyncio"}:
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)


def _connection_error(address: str, error: Exception) -> str:
    reason = f"{type(error).__name__}: {error}".splitlines()[0]
    if address.startswith("tls://") and "ssl" in reason.lower():
        return (
            f"--cluster {address}: TLS is not configured; name the certificates in "
            f"distributed.comm.tls of Dask's configuration ({reason})"
        )
    return (
        f"--cluster {address}: no scheduler answers within {TIMEOUT:g} s ({reason}); "
        "is it running, and does its address begin with tcp:// or tls:// as its log shows?"
    )


def _validate(client: Dask, address: str) -> None:
    try:
        client.wait_for_workers(1, timeout=TIMEOUT)
        versions = client.get_versions()
        tools = client.run(worker.version, on_error="return")
    except Exception as error:
        if not client.scheduler_info()["workers"]:
            raise EnvironmentMissingError(
                f"--cluster {address}: the scheduler has no workers; "
                f"start some with: dask worker {address}"
            ) from error
        raise EnvironmentMissingError(_connection_error(address, error)) from error
    own = versions["client"]["packages"]
    others = {"the scheduler": versions["scheduler"], **versions["workers"]}
    for name, other in others.items():
        for program in ("distributed", "python"):
            theirs = _release(program, other["packages"][program])
            ours = _release(program, own[program])
            if theirs != ours:
                raise EnvironmentMissingError(
                    f"--cluster {address}: {name} has {program} {theirs}, and this machine {ours}; "
                    "install the same on all"
                )
    for name, tool in tools.items():
        if tool != __version__:
            raise EnvironmentMissingError(
                f"--cluster {address}: {name} has {_tool(tool)}, and this machine "
                f"ros2-scaffold {__version__}; install the same on all"
            )


def _tool(version: object) -> str:
    if isinstance(version, str):
        return f"ros2-scaffold {version}"
    return f"no ros2-scaffold ({type(version).__name__})"


def _release(program: str, version: str) -> str:
    """Return the part of a version that has to be equal."""
    return ".".join(version.split(".")[:2]) if program == "python" else version
