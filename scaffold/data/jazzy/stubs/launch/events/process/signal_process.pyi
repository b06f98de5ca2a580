from collections.abc import Callable
from signal import Signals
from typing import Any

from launch.events.process.process_targeted_event import ProcessTargetedEvent

class SignalProcess(ProcessTargetedEvent):
    def __init__(
        self, *, signal_number: str | Signals, process_matcher: Callable[[Any], bool]
    ) -> None: ...
    @property
    def signal(self) -> str | Signals: ...
    @property
    def signal_name(self) -> str: ...
