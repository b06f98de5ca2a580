from collections.abc import Callable
from typing import Any
from launch.event import Event as Event
from ...actions import ExecuteProcess as ExecuteProcess

class ProcessTargetedEvent(Event):
    def __init__(self, *, process_matcher: Callable[[Any], bool]) -> None: ...
    @property
    def process_matcher(self) -> Callable[[Any], bool]: ...
