"""Cleanup that a cancellation does not cut short."""

from __future__ import annotations

import asyncio
from collections.abc import Coroutine
from typing import Any


async def uninterrupted(cleanup: Coroutine[Any, Any, object]) -> None:
    """Run a cleanup to its end; a cancellation in the meantime is raised afterwards.

    The signal that ends a run may arrive while a part of the run is ending anyway.

    Raises:
        asyncio.CancelledError: the waiting task was cancelled.
    """
    task = asyncio.create_task(cleanup)
    cancellation: asyncio.CancelledError | None = None
    while not task.done():
        try:
            await asyncio.wait([task])
        except asyncio.CancelledError as error:
            cancellation = error
    task.result()
    if cancellation is not None:
        raise cancellation
