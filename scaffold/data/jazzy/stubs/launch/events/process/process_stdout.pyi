from launch.actions.execute_process import ExecuteProcess
from launch.events.process.process_io import ProcessIO

class ProcessStdout(ProcessIO):
    def __init__(
        self,
        *,
        text: bytes,
        action: ExecuteProcess,
        name: str,
        cmd: list[str],
        cwd: str | None,
        env: dict[str, str] | None,
        pid: int,
    ) -> None: ...
