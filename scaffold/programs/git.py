"""Runs git so that the repository around cannot make it run anything else.

A ``.git/config`` may name programs: a file system monitor, hooks, pagers. Git itself looks at the
owner of a repository only, and an unpacked archive has the owner who unpacked it.
"""

from __future__ import annotations

import subprocess

from scaffold.programs import search

_PROTECTION = (
    "--no-pager",
    *("-c", "core.fsmonitor=false"),
    *("-c", "core.hooksPath=/dev/null"),
)
SECONDS = 10
"""After which git is given up; a file that the configuration includes may be a pipe."""


def run(*words: str, directory: str) -> subprocess.CompletedProcess[bytes]:
    """Run a command of git and return its output.

    Args:
        words: The command and its arguments.
        directory: Where it runs.

    Raises:
        OSError: git cannot be started.
        subprocess.TimeoutExpired: it did not end.
    """
    program = search.find("git")
    if program is None:
        raise FileNotFoundError("git")
    return subprocess.run(
        [program, *_PROTECTION, "-C", directory, *words],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=SECONDS,
        check=False,
    )
