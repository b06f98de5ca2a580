from collections.abc import Callable
from typing import Any

from launch.event import Event

class ChangeState(Event):
    valid_transitions: dict[int, str]
    valid_states: Any
    def __init__(
        self, *, lifecycle_node_matcher: Callable[[Any], bool], transition_id: int
    ) -> None: ...
    @property
    def lifecycle_node_matcher(self) -> Callable[[Any], bool]: ...
    @property
    def transition_id(self) -> int: ...
