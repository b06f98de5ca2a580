"""Runs git so that the repository around cannot make it run anything else.

A ``.git/config`` may name programs: a file system monitor, hooks, pagers. Git itself looks at the
owner of a repository only, and an unpacked archive has the owner who unpacked it.
"""

from __future__ import annotations

import os
import subprocess

from scaffold.programs import search

_PROTECTION = (
    "--no-pager",
    *("-c", "core.fsmonitor=false"),
    *("-c", "core.hooksPath=/dev/null"),
)
_NO_TRANSPORT = {"GIT_ALLOW_PROTOCOL": "none"}
"""A clone without all objects would fetch them, by programs that its configuration names."""
SECONDS = 10
"""After which git is given up; a file that the configuration includes may be a pipe."""


def run(*words: str, directory: str, data: bytes = b"") -> subprocess.CompletedProcess[bytes]:
    """Run a command of git and return its output.

    Args:
        words: The command and its arguments.
        directory: Where it runs.
        data: What it reads.

    Raises:
        OSError: git cannot be started.
        subprocess.TimeoutExpired: it did not end.
    """
    program = search.find("git")
    if program is None:
        raise FileNotFoundError("git")
    return subprocess.run(
        [program, *_PROTECTION, "-C", directory, *words],
        input=data,
        capture_output=True,
        env={**os.environ, **_NO_TRANSPORT},
        timeout=SECONDS,
        check=False,
    )
