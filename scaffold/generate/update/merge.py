"""Three-way merges of single files with git."""

from __future__ import annotations

import os
import subprocess
import tempfile
from typing import NamedTuple

from scaffold.errors import InputError
from scaffold.programs import git

LABELS = ("yours", "template before", "template now")
"""The labels after the markers of a conflict."""
MARKS = (f"<<<<<<< {LABELS[0]}", f">>>>>>> {LABELS[2]}")
"""The lines around a conflict."""
_FAILED = 128
"""The lowest exit code of ``git merge-file`` that is not a number of conflicts."""


class Merged(NamedTuple):
    """A merged file."""

    content: bytes
    conflicts: int


def merge(yours: bytes, before: bytes, now: bytes) -> Merged:
    """Apply the change from one text to another to a third one.

    Args:
        yours: The user's file; its line endings are kept.
        before: The rendered file when it was generated.
        now: The file rendered by the current template.

    Raises:
        InputError: git is missing or fails, as for binary files.
    """
    if b"\r\n" in yours and b"\r\n" not in before:
        before, now = (text.replace(b"\n", b"\r\n") for text in (before, now))
    with tempfile.TemporaryDirectory(prefix="ros2-scaffold-") as directory:
        names: list[str] = []
        for name, content in zip(("yours", "before", "now"), (yours, before, now), strict=True):
            names.append(os.path.join(directory, name))
            with open(names[-1], "wb") as file:
                file.write(content)
        labels = [word for label in LABELS for word in ("-L", label)]
        try:
            # Outside of the user's repository, so that its configuration does not matter.
            words = ("merge-file", "--stdout", "--diff3", *labels, *names)
            done = git.run(*words, directory=directory)
        except FileNotFoundError:
            raise InputError("git is required to merge files; install it") from None
        except subprocess.TimeoutExpired:
            raise InputError(f"the merge with git took more than {git.SECONDS} s") from None
    if done.returncode >= _FAILED or done.returncode < 0:
        reason = " ".join(done.stderr.decode(errors="replace").split())
        raise InputError(f"git cannot merge: {reason}")
    return Merged(done.stdout, done.returncode)
