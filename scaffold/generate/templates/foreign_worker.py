"""The subprocess of `foreign`, which renders templates that are not built in."""

from __future__ import annotations

import json
import pickle
import resource
import sys
from typing import Any

from scaffold.errors import ContentError
from scaffold.generate.templates.engine import TOO_MUCH_MEMORY, LocalEngine
from scaffold.generate.templates.foreign import receive, send


def serve() -> None:
    """Answer requests on standard input until it ends."""
    source, out = sys.stdin.buffer, sys.stdout.buffer
    setup = receive(source)
    if setup is None:
        return
    # Requests come from the parent process, never from a template, so pickle is safe.
    roots, directories, is_tutorial, bounds = pickle.loads(setup)  # noqa: S301  see above
    memory, seconds, characters = bounds
    engine = LocalEngine(roots, directories, is_tutorial=is_tutorial)
    _limit(resource.RLIMIT_CORE, 0)
    _limit(resource.RLIMIT_AS, memory)
    send(_response(value=True), out)
    while (request := receive(source)) is not None:
        used = resource.getrusage(resource.RUSAGE_SELF)
        _limit(resource.RLIMIT_CPU, int(used.ru_utime + used.ru_stime) + seconds)
        send(_rendered(engine, request, characters), out)


def _limit(which: int, most: int) -> None:
    _, hard = resource.getrlimit(which)
    if hard != resource.RLIM_INFINITY:
        most = min(most, hard)
    resource.setrlimit(which, (most, hard))


def _rendered(engine: LocalEngine, request: bytes, characters: int) -> bytes:
    """Return the answer to a request: a value, or the error in the template."""
    task, name, *context = pickle.loads(request)  # noqa: S301  made by the parent
    try:
        value = getattr(engine, task)(name, *context)
    except ContentError as error:
        return _response(error=str(error)[:characters])
    except MemoryError:
        return _response(error=f"template {name!r}: {TOO_MUCH_MEMORY}")
    if isinstance(value, str) and len(value) > characters:
        return _response(error=f"template {name!r}: renders more than {characters} characters")
    return _response(value=value)


def _response(**entry: Any) -> bytes:  # noqa: ANN401  whatever JSON has
    return json.dumps(entry).encode()
