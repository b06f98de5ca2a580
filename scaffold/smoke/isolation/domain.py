"""A separate ROS domain for each executable under test."""

from __future__ import annotations

import os
import random
import socket
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress

from scaffold.errors import EnvironmentMissingError

FIRST = 1
LAST = 101
"""The last domain with ports below those that Linux uses for outgoing connections."""

_FIRST_PORT = 7400
_PORTS = 250
"""DDS: domain ``d`` uses the UDP ports from 7400 + 250 d to before those of the next."""

_FIRST_OF_PARTICIPANTS = 10

_FIRST_LOCK = 32768
"""``domain_coordinator/impl.py``: the TCP port 32768 + d reserves domain ``d``."""


@contextmanager
def reserved() -> Iterator[int]:
    """Reserve a domain that is not in use on this machine.

    It is reserved with a TCP port, like ``domain_coordinator`` of ROS 2, so that tests that use
    that and executables under test are separate. The kernel releases the port when the process
    ends.

    Raises:
        EnvironmentMissingError: all domains are in use.
    """
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as lock:
        yield _claim(lock)


def _claim(lock: socket.socket) -> int:
    busy = domains_in_use()
    numbers = [number for number in range(FIRST, LAST + 1) if number not in busy]
    # In random order, as other programs often choose the first free domain.
    random.shuffle(numbers)
    for number in numbers:
        try:
            lock.bind(("127.0.0.1", _FIRST_LOCK + number))
        except OSError:
            continue
        return number
    raise EnvironmentMissingError(
        f"all ROS domains from {FIRST} to {LAST} are in use on this machine"
    )


def domains_in_use() -> set[int]:
    """Return the domains with a port in use."""
    return {(port - _FIRST_PORT) // _PORTS for port, _ in _udp_sockets()}


def domains_of(pids: Iterable[int]) -> set[int]:
    """Return the domains of processes, as far as visible to this user."""
    own = {socket for pid in pids for socket in _sockets_of(pid)}
    ports = {port for port, inode in _udp_sockets() if inode in own and port >= _FIRST_PORT}
    result: set[int] = set()
    for port in ports:
        number, place = divmod(port - _FIRST_PORT, _PORTS)
        # A participant has two consecutive ports, which hardly happens by chance.
        if place >= _FIRST_OF_PARTICIPANTS and not place % 2 and port + 1 in ports:
            result.add(number)
    return result


def _udp_sockets() -> Iterator[tuple[int, str]]:
    """Yield the local port and the inode of each UDP socket."""
    for table in ("/proc/net/udp", "/proc/net/udp6"):
        if not os.path.exists(table):
            continue
        with open(table, encoding="ascii") as lines:
            next(lines, None)
            for line in lines:
                values = line.split()
                yield int(values[1].rpartition(":")[2], 16), values[9]


def _sockets_of(pid: int) -> Iterator[str]:
    """Yield the inodes of the sockets of a process."""
    directory = f"/proc/{pid}/fd"
    try:
        names = os.listdir(directory)
    except OSError:
        return
    for name in names:
        with suppress(OSError):
            kind, _, inode = os.readlink(f"{directory}/{name}").partition(":")
            if kind == "socket":
                yield inode.strip("[]")
