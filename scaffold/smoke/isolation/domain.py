"""A ROS domain for every executable under test, so that none sees the messages of another."""

from __future__ import annotations

import os
import random
import socket
from collections.abc import Iterator
from contextlib import contextmanager

from scaffold.errors import EnvironmentMissingError

FIRST = 1
LAST = 101
"""The domains whose ports are below those that Linux gives to outgoing connections."""

_FIRST_PORT = 7400
_PORTS = 250
"""DDS: domain ``d`` uses the UDP ports from 7400 + 250 d to before those of the next."""


@contextmanager
def reserved() -> Iterator[int]:
    """Hold a domain that is not in use on this machine.

    It is held by a name in the abstract socket namespace: that is as large as the loopback
    network itself, is shared by all users, and is given back by the kernel when the process ends
    in any way. A lock file would be none of these.

    Raises:
        EnvironmentMissingError: all domains are in use.
    """
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as lock:
        yield _take(lock)


def _take(lock: socket.socket) -> int:
    busy = domains_in_use()
    numbers = [number for number in range(FIRST, LAST + 1) if number not in busy]
    # In any order: someone else's idea of a free domain is often the first one.
    random.shuffle(numbers)
    for number in numbers:
        try:
            lock.bind(f"\0ros2-scaffold-domain-{number}")
        except OSError:
            continue
        return number
    raise EnvironmentMissingError(
        f"all ROS domains from {FIRST} to {LAST} are in use on this machine"
    )


def domains_in_use() -> set[int]:
    """Return the domains in whose range of ports somebody listens."""
    result: set[int] = set()
    for table in ("/proc/net/udp", "/proc/net/udp6"):
        if not os.path.exists(table):
            continue
        with open(table, encoding="ascii") as lines:
            next(lines, None)
            for line in lines:
                port = int(line.split()[1].rpartition(":")[2], 16)
                result.add((port - _FIRST_PORT) // _PORTS)
    return result
