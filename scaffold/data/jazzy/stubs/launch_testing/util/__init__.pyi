from typing import Any

from launch.actions.execute_process import ExecuteProcess

NO_CMD_ARGS: Any

class NoMatchingProcessException(Exception): ...

def KeepAliveProc() -> ExecuteProcess: ...
def resolveProcesses(
    info_obj: Any, *, process: Any = None, cmd_args: Any = None, strict_proc_matching: bool = True
) -> Any: ...
