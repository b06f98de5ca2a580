"""A slot for running one executable: a ROS domain with an observer."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Mapping
from contextlib import AsyncExitStack, asynccontextmanager
from dataclasses import dataclass
from pathlib import Path

from scaffold.smoke import observe
from scaffold.smoke.isolation import domain
from scaffold.smoke.observe import Observer
from scaffold.smoke.processes.process import Origin

FAST_DISCOVERY = """\
<?xml version="1.0" encoding="UTF-8"?>
<profiles xmlns="http://www.eprosima.com">
  <participant profile_name="smoke" is_default_profile="true">
    <rtps>
      <builtin>
        <discovery_config>
          <initialAnnouncements>
            <count>20</count>
            <period><sec>0</sec><nanosec>100000000</nanosec></period>
          </initialAnnouncements>
          <leaseAnnouncement><sec>0</sec><nanosec>250000000</nanosec></leaseAnnouncement>
        </discovery_config>
      </builtin>
    </rtps>
  </participant>
</profiles>
"""
"""Frequent initial announcements: a missed one costs 0.1 s instead of 3 s."""


@dataclass(frozen=True)
class Isolation:
    """A domain and the observer in it."""

    number: int
    observer: Observer
    scratch: Path

    def variables(self, of_user: Mapping[str, str]) -> dict[str, str]:
        """Return variables for a process that is only visible in this domain."""
        return isolated(of_user, self.number, self.scratch)


def isolated(variables: Mapping[str, str], number: int, scratch: Path) -> dict[str, str]:
    """Return variables that keep a process in a domain, on the loopback network."""
    profile = scratch / "fastdds.xml"
    if not profile.exists():
        profile.write_text(FAST_DISCOVERY, encoding="utf-8")
    temporary = scratch / "tmp"
    temporary.mkdir(exist_ok=True)
    return {
        **variables,
        "ROS_DOMAIN_ID": str(number),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "TMPDIR": str(temporary),  # files left there are removed with the run
        "ROS_LOG_DIR": str(scratch / "ros_log"),
        "FASTRTPS_DEFAULT_PROFILES_FILE": str(profile),
        "FASTDDS_DEFAULT_PROFILES_FILE": str(profile),
        "PYTHONUNBUFFERED": "1",
    }


class Stations:
    """A pool of stations, which can be opened in advance.

    Args:
        python: The interpreter that has rclpy.
        scratch: The directory of the run.
        origin: The run that the observers belong to.
    """

    def __init__(self, python: str, scratch: Path, origin: Origin) -> None:
        self._python = python
        self._scratch = scratch
        self._origin = origin
        self._opened = 0
        self._waiting: list[asyncio.Task[tuple[AsyncExitStack, Isolation]]] = []

    def open_early(self, variables: Mapping[str, str], count: int) -> None:
        """Start to open some stations; ``close`` must be called afterwards."""
        for _ in range(count):
            self._waiting.append(asyncio.create_task(self._open(variables)))

    @asynccontextmanager
    async def one(self, variables: Mapping[str, str]) -> AsyncIterator[Isolation]:
        """Provide a station for the duration of the block.

        Raises:
            ObserverError: its observer does not start.
        """
        stack, station = await self._next_station(variables)
        async with stack:
            yield station

    async def close(self) -> None:
        """Close the stations that were never requested."""
        while self._waiting:
            task = self._waiting.pop()
            task.cancel()
            for outcome in await asyncio.gather(task, return_exceptions=True):
                if not isinstance(outcome, BaseException):
                    await outcome[0].aclose()

    async def _next_station(self, variables: Mapping[str, str]) -> tuple[AsyncExitStack, Isolation]:
        if not self._waiting:
            return await self._open(variables)
        task = self._waiting.pop(0)
        try:
            return await asyncio.shield(task)
        except BaseException:
            self._waiting.append(task)  # the station is not used: ``close`` closes it
            raise

    async def _open(self, variables: Mapping[str, str]) -> tuple[AsyncExitStack, Isolation]:
        self._opened += 1
        label = f"probe-{self._opened}"
        async with AsyncExitStack() as stack:
            number = stack.enter_context(domain.reserved())
            observing = observe.observing(
                self._python,
                isolated(variables, number, self._scratch),
                self._scratch / label,
                self._origin.below(label),
            )
            observer = await stack.enter_async_context(observing)
            return stack.pop_all(), Isolation(number, observer, self._scratch)
