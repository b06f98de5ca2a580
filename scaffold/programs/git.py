"""Runs git such that the configuration of a repository cannot execute programs.

A ``.git/config`` may name programs: a file system monitor, hooks, pagers. Git itself checks only
the owner of a repository, and an unpacked archive belongs to the user who unpacked it.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping, Sequence

from scaffold.programs import search

_PROTECTION = (
    "--no-pager",
    *("-c", "core.fsmonitor=false"),
    *("-c", "core.hooksPath=/dev/null"),
)
_NO_TRANSPORT = {"GIT_ALLOW_PROTOCOL": "none"}
"""Disables lazy fetching in partial clones, which would run programs from their configuration."""
_NETWORK = {"GIT_ALLOW_PROTOCOL": "https:ssh:file", "GIT_TERMINAL_PROMPT": "0"}
SECONDS = 10
"""The time limit of git; a file included by the configuration may be a pipe."""
SECONDS_TO_FETCH = 120


def run(*words: str, directory: str, data: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    """Run a command of git and return its output.

    Args:
        words: The command and its arguments.
        directory: The working directory.
        data: The standard input.

    Raises:
        OSError: git cannot be started.
        subprocess.TimeoutExpired: it timed out.
    """
    return _run(words, directory, _NO_TRANSPORT, SECONDS, data)


def fetch(url: str, directory: str) -> subprocess.CompletedProcess[bytes]:
    """Fetch the tags and branches of a repository that the user trusts.

    Args:
        url: The address.
        directory: Our own bare repository to fetch into.

    Raises:
        OSError: git cannot be started.
        subprocess.TimeoutExpired: it timed out.
    """
    refs = [f"+refs/{kind}/*:refs/{kind}/*" for kind in ("heads", "tags")]
    words = ("--git-dir=.", "fetch", "--quiet", "--prune", "--no-tags", "--", url, *refs)
    return _run(words, directory, _NETWORK, SECONDS_TO_FETCH)


def _run(
    words: Sequence[str], directory: str, more: Mapping[str, str], seconds: int, data: bytes = b""
) -> subprocess.CompletedProcess[bytes]:
    program = search.find("git")
    if program is None:
        raise FileNotFoundError("git")
    return subprocess.run(
        [program, *_PROTECTION, "-C", directory, *words],
        input=data,
        capture_output=True,
        env={**os.environ, **more},
        timeout=seconds,
        check=False,
    )
