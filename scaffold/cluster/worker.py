"""The functions that run on workers, which need the same version of this tool."""

from __future__ import annotations

import socket
from collections.abc import Callable
from importlib import import_module
from typing import TypeVar

from scaffold import __version__

Item = TypeVar("Item")
Result = TypeVar("Result")


def version() -> str:
    """Return the version of this tool on a worker."""
    return __version__


def same(item: Item) -> Item:
    """Return its argument, to keep data shared by tasks on a worker."""
    return item


def work(function: Callable[..., Result], expected: str, *arguments: object) -> tuple[str, Result]:
    """Run a task; return the name of the worker and the result.

    Args:
        function: A function of this tool.
        expected: The version of this tool on the client.
        arguments: The arguments of the function.

    Raises:
        RuntimeError: this worker, which may have joined later, has another version.
    """
    worker = import_module("distributed").get_worker()
    name = f"{socket.gethostname()} ({worker.address})"
    if __version__ != expected:
        raise RuntimeError(f"{name} has ros2-scaffold {__version__}, and not {expected}")
    return name, function(*arguments)
