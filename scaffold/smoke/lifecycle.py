"""Drives lifecycle nodes through their states and records the transitions."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence

from scaffold.smoke.observe import Observer, Watched
from scaffold.smoke.result import Problem, Transition
from scaffold.smoke.scenario.model import Call

_NUMBERS = {"configure": 1, "cleanup": 2, "activate": 3, "deactivate": 4}
_SHUTDOWN = {"unconfigured": 5, "inactive": 6, "active": 7}
"""Numbers of ``lifecycle_msgs/msg/Transition``; those of a shutdown depend on the state."""
_STARTS = {
    "configure": ("unconfigured",),
    "activate": ("inactive",),
    "deactivate": ("active",),
    "cleanup": ("inactive",),
    "shutdown": tuple(_SHUTDOWN),
}
"""The states in which a transition is possible."""
_GOALS = {
    "configure": "inactive",
    "activate": "active",
    "deactivate": "inactive",
    "cleanup": "unconfigured",
    "shutdown": "finalized",
}
_CHANGE = "/change_state"
_CHANGE_TYPE = "lifecycle_msgs/srv/ChangeState"
_GET = "/get_state"
_GET_TYPE = "lifecycle_msgs/srv/GetState"


class Lifecycles:
    """The lifecycle nodes of an executable.

    Args:
        observer: The observer, which has discovered them.
        running: The executable.
        timeout: Seconds to wait for a response.
    """

    def __init__(self, observer: Observer, running: Watched, timeout: float) -> None:
        self._observer = observer
        self._running = running
        self._timeout = timeout
        self.transitions: list[Transition] = []

    async def pause(self, seconds: float, names: Sequence[str]) -> None:
        """Continue to observe for a while after the nodes have been brought up.

        Args:
            seconds: How long.
            names: The transitions to do first.

        Raises:
            ObserverError: the probe has ended.
        """
        if await self._observer.wait_for(self._are_there, seconds, self._running):
            await self.lead(names)
            await self._observer.pause(seconds, self._running)

    def _are_there(self) -> bool:
        return bool(self._nodes())

    async def lead(self, names: Sequence[str]) -> None:
        """Take all nodes through transitions one after the other, until one fails.

        Raises:
            ObserverError: the probe has ended.
        """
        for name in names:
            for node in self._nodes():
                if self._running.exit_code is None and not self._has_failed(node):
                    await self._transition(node, name)

    def _nodes(self) -> list[str]:
        return self._observer.offering(_CHANGE, _CHANGE_TYPE)

    def _has_failed(self, node: str) -> bool:
        return any(item.node == node and not item.ok for item in self.transitions)

    async def _transition(self, node: str, name: str) -> None:
        before, error = await self._state(node)
        if error or before not in _STARTS[name]:
            if error:
                self.transitions.append(Transition(node, name, before, "", 0.0, error))
            return  # a node that activates itself is active already
        begun = time.monotonic()
        number = _SHUTDOWN[before] if name == "shutdown" else _NUMBERS[name]
        request = {"transition": {"id": number}}
        call = Call("service", f"{node}{_CHANGE}", _CHANGE_TYPE, request)
        answer = await self._observer.call(call, self._timeout, self._running)
        seconds = time.monotonic() - begun
        after, error = await self._state(node)
        if not answer.error and not (answer.value or {}).get("success"):
            error = error or f"rejected, or its callback failed or raised an exception: {after}"
        if not error and after != _GOALS[name]:
            error = f"it is {after} and not {_GOALS[name]}"
        error = answer.error or error
        self.transitions.append(Transition(node, name, before, after, seconds, error))

    async def _state(self, node: str) -> tuple[str, str]:
        """Return the state of a node, and why it is unknown."""
        call = Call("service", f"{node}{_GET}", _GET_TYPE)
        answer = await self._observer.call(call, self._timeout, self._running)
        state = (answer.value or {}).get("current_state") or {}
        return str(state.get("label", "unknown")), answer.error


def problems(transitions: Sequence[Transition]) -> Iterator[Problem]:
    """Yield the transitions that failed."""
    for item in transitions:
        if not item.ok:
            yield Problem(
                f"{item.node} does not {_verb(item.name)} from {item.before}: {item.error}"
            )


def _verb(name: str) -> str:
    return {"cleanup": "clean up", "shutdown": "shut down"}.get(name, name)
