from typing import Any

from launch.actions.execute_process import ExecuteProcess
from launch.event_handlers.on_process_io import OnProcessIO

class StdoutReadyListener(OnProcessIO):
    def __init__(
        self,
        *,
        target_action: ExecuteProcess | None = None,
        ready_txt: str,
        actions: list[Any],
    ) -> None: ...
