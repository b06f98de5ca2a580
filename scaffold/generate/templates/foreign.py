"""Renders templates that are not built in, in a subprocess with limits.

Jinja's sandbox restricts access, but neither memory nor time. The subprocess has limits on both,
and nothing has been written when it is killed.
"""

from __future__ import annotations

import json
import os
import pickle
import select
import signal
import subprocess
import sys
import time
import weakref
from collections.abc import Mapping, Sequence
from typing import IO, Any

from scaffold.errors import ContentError

MAX_MEMORY = 512 * 2**20
"""The memory limit of the process in bytes."""
MAX_CPU = 5
"""The limit of CPU time for one file in seconds."""
MAX_WALL = 60.0
"""The limit of wall time for one file in seconds, for a process that waits."""
MAX_CHARACTERS = 5_000_000
"""The maximum length of a rendered file."""

_START = (
    "import json, sys; sys.path[:] = json.loads(sys.argv.pop()); "
    "from scaffold.generate.templates.foreign_worker import serve; serve()"
)
_SIZE = 8
"""The size of the length prefix of a message."""
_MAX_SHOWN = 80
"""The number of characters of a short text shown in a message."""


class ForeignEngine:
    """Renders in another process; see `scaffold.generate.templates.engine.LocalEngine`."""

    def __init__(
        self, roots: Sequence[str], directories: Mapping[str, Sequence[str]], *, is_tutorial: bool
    ) -> None:
        self._directories = directories
        self._setup = [os.path.abspath(root) for root in roots], directories, is_tutorial
        self._process: subprocess.Popen[bytes] | None = None

    def has(self, name: str) -> bool:
        """Return whether there is a file, such as ``launch/_readme.md.jinja``."""
        return bool(self._request("has", name))

    def text(self, source: str, context: Mapping[str, Any]) -> str:
        """Render a short text; raises ContentError."""
        return str(self._request("text", source, context))

    def file(self, name: str, context: Mapping[str, Any]) -> str:
        """Render a file by its name; raises ContentError."""
        return str(self._request("file", name, context))

    def _request(self, *request: object) -> object:
        """Send a request to the process, and return its answer.

        Raises:
            ContentError: the template is wrong, or the process died while rendering it.
        """
        process = self._process or self._started()
        answer = _exchange(process, request)
        if answer is None:
            self._process = None
            raise ContentError(f"{self._place(str(request[1]))}: {_cause_of_death(process)}")
        entry = json.loads(answer)
        if "error" in entry:
            task, name = map(str, request[:2])
            own = f"template {name!r}"  # a short text has no file name
            message = entry["error"]
            if task == "text" and message.startswith(own):
                message = self._place(name) + message.removeprefix(own)
            raise ContentError(message)
        return entry["value"]

    def _started(self) -> subprocess.Popen[bytes]:
        """Start the process, which is ended with this engine."""
        paths = [os.path.abspath(path) for path in sys.path if path]
        process = subprocess.Popen(
            [sys.executable, "-I", "-c", _START, json.dumps(paths)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        weakref.finalize(self, _end, process)
        self._process = process
        if _exchange(process, (*self._setup, (MAX_MEMORY, MAX_CPU, MAX_CHARACTERS))) is None:
            raise ContentError(f"no process for templates: {_cause_of_death(process)}")
        return process

    def _place(self, name: str) -> str:
        """Return the file of a template, or the manifest of a short text."""
        first, _, rest = name.partition("/")
        if first in self._directories and rest:
            places = [os.path.join(place, rest) for place in self._directories[first]]
            return next(filter(os.path.exists, places), places[-1])
        inner = name.removeprefix("{% if ").removesuffix(" %}true{% endif %}")
        short = inner if len(inner) <= _MAX_SHOWN else f"{inner[:_MAX_SHOWN]}..."
        for directories in self._directories.values():
            manifest = os.path.join(directories[-1], "template.yaml")
            with open(manifest, encoding="utf-8", errors="replace") as file:
                if inner in file.read():
                    return f"{manifest}: {short!r}"
        return f"template {short!r}"


def send(message: bytes, out: IO[bytes]) -> None:
    """Write a message to a pipe."""
    out.write(len(message).to_bytes(_SIZE, "big") + message)
    out.flush()


def receive(source: IO[bytes]) -> bytes | None:
    """Return the next message of a pipe, ``None`` at its end."""
    size = source.read(_SIZE)
    return source.read(int.from_bytes(size, "big")) if len(size) == _SIZE else None


def _exchange(process: subprocess.Popen[bytes], request: object) -> bytes | None:
    """Send a request and return the answer; ``None`` if the process died or was killed."""
    if process.stdin is None or process.stdout is None:
        return None
    try:
        send(pickle.dumps(request), process.stdin)
    except BrokenPipeError:
        return None
    end = time.monotonic() + MAX_WALL
    data = b""
    while len(data) < _SIZE or len(data) < _SIZE + int.from_bytes(data[:_SIZE], "big"):
        left = end - time.monotonic()
        if left <= 0 or not select.select([process.stdout], [], [], left)[0]:
            process.kill()
            return None
        part = os.read(process.stdout.fileno(), 1 << 20)
        if not part:
            return None
        data += part
    return data[_SIZE:]


def _cause_of_death(process: subprocess.Popen[bytes]) -> str:
    code = process.wait()
    if code == -signal.SIGXCPU:
        return f"takes more than {MAX_CPU} s of CPU time to render"
    if code == -signal.SIGKILL:
        return f"takes more than {MAX_WALL:g} s, or more memory than there is, to render"
    return f"crashes the process that renders it ({_name_of(code)})"


def _name_of(code: int) -> str:
    return signal.Signals(-code).name if code < 0 else f"exit code {code}"


def _end(process: subprocess.Popen[bytes]) -> None:
    process.kill()
    process.wait()
    for pipe in (process.stdin, process.stdout):
        if pipe is not None:
            try:
                pipe.close()
            except BrokenPipeError:
                continue  # the request that killed it
