"""Runs batches in separate processes on a worker of a cluster.

A worker has threads, but the current directory, the environment and the target distribution belong
to a process.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys

from scaffold.check.cluster import batch
from scaffold.cluster.mirror import Mirror


def check(work: batch.Batch, files: Mirror) -> batch.Answer:
    """Check a batch in a separate process.

    Raises:
        RuntimeError: the process fails.
    """
    done = subprocess.run(
        [sys.executable, "-m", __name__],
        input=pickle.dumps((work, files)),
        capture_output=True,
        cwd=os.sep,  # not on the import path
        check=False,
    )
    if done.returncode:
        lines = done.stderr.decode(errors="replace").strip().splitlines()
        raise RuntimeError(lines[-1] if lines else f"its process ended with {done.returncode}")
    answer: batch.Answer = pickle.loads(done.stdout)  # noqa: S301  what this tool wrote just now
    return answer


if __name__ == "__main__":
    # The sender of work may run code on the cluster anyway.
    sent = pickle.load(sys.stdin.buffer)  # noqa: S301
    sys.stdout.buffer.write(pickle.dumps(batch.check(*sent)))
