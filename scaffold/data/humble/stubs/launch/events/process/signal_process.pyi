from collections.abc import Callable
from signal import Signals
from typing import Any
from launch.events.process.process_targeted_event import ProcessTargetedEvent
import signal as signal_module
from ...utilities import ensure_argument_type as ensure_argument_type
from ...actions import ExecuteProcess as ExecuteProcess

class SignalProcess(ProcessTargetedEvent):
    def __init__(
        self, *, signal_number: str | Signals, process_matcher: Callable[[Any], bool]
    ) -> None: ...
    @property
    def signal(self) -> str | Signals: ...
    @property
    def signal_name(self) -> str: ...
