"""The process table of this machine."""

from __future__ import annotations

import os

from scaffold.record import NamedTuple

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

_ZOMBIE = "Z"


class Process(NamedTuple):
    """A process; ``started``, in ticks since boot, distinguishes reused ids."""

    pid: int
    state: str
    parent: int
    group: int
    session: int
    started: int

    @property
    def is_alive(self) -> bool:
        """Whether it is running; a zombie is not."""
        return self.state != _ZOMBIE


def snapshot() -> dict[int, Process]:
    """Return all processes by their ids."""
    table = (of_pid(int(name)) for name in os.listdir("/proc") if name.isdigit())
    return {process.pid: process for process in table if process is not None}


def of_pid(pid: int) -> Process | None:
    """Return one process; ``None`` if it is gone."""
    try:
        with open(f"/proc/{pid}/stat", "rb") as file:
            status = file.read()
    except OSError:
        return None
    # The name in parentheses may contain anything, even parentheses.
    values = status[status.rindex(b")") + 2 :].split()
    parent, group, session = map(int, values[1:4])
    return Process(pid, values[0].decode(), parent, group, session, int(values[19]))


def descendants(root: int, table: Mapping[int, Process] | None = None) -> list[Process]:
    """Return the living descendants of a process."""
    children: dict[int, list[Process]] = {}
    for process in (snapshot() if table is None else table).values():
        children.setdefault(process.parent, []).append(process)
    return [process for process in _descendants(root, children) if process.is_alive]


def command_line(pid: int) -> str:
    """Return the command line of a process, or its name if it has none."""
    for source, template in (("cmdline", "{}"), ("comm", "[{}]")):
        try:
            with open(f"/proc/{pid}/{source}", "rb") as file:
                text = file.read().replace(b"\0", b" ").decode("utf-8", "replace").strip()
        except OSError:
            continue
        if text:
            return template.format(text)
    return f"process {pid}"


def _descendants(root: int, children: Mapping[int, list[Process]]) -> Iterator[Process]:
    waiting = [root]
    while waiting:
        for process in children.get(waiting.pop(), ()):
            yield process
            waiting.append(process.pid)
