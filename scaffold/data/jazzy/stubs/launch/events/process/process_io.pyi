from launch.actions.execute_process import ExecuteProcess
from launch.events.process.running_process_event import RunningProcessEvent

class ProcessIO(RunningProcessEvent):
    def __init__(
        self,
        *,
        text: bytes,
        fd: int,
        action: ExecuteProcess,
        name: str,
        cmd: list[str],
        cwd: str | None,
        env: dict[str, str] | None,
        pid: int,
    ) -> None: ...
    @property
    def text(self) -> bytes: ...
    @property
    def from_stdin(self) -> bool: ...
    @property
    def from_stdout(self) -> bool: ...
    @property
    def from_stderr(self) -> bool: ...
