from launch.actions.execute_process import ExecuteProcess
from launch.events.process.running_process_event import RunningProcessEvent

class ProcessExited(RunningProcessEvent):
    def __init__(
        self,
        *,
        returncode: int,
        action: ExecuteProcess,
        name: str,
        cmd: list[str],
        cwd: str | None,
        env: dict[str, str] | None,
        pid: int,
    ) -> None: ...
    @property
    def returncode(self) -> int: ...
