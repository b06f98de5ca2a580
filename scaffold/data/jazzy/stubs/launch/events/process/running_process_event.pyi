from launch.actions.execute_process import ExecuteProcess
from launch.event import Event as Event

class RunningProcessEvent(Event):
    def __init__(
        self,
        *,
        action: ExecuteProcess,
        name: str,
        cmd: list[str],
        cwd: str | None,
        env: dict[str, str] | None,
        pid: int,
    ) -> None: ...
    @property
    def action(self) -> ExecuteProcess: ...
    @property
    def execute_process_action(self) -> ExecuteProcess: ...
    @property
    def process_name(self) -> str: ...
    @property
    def cmd(self) -> list[str]: ...
    @property
    def cwd(self) -> str | None: ...
    @property
    def env(self) -> dict[str, str] | None: ...
    @property
    def pid(self) -> int: ...
