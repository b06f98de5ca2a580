from contextlib import AbstractContextManager
from typing import Any

EXIT_OK: int
EXIT_SIGINT: int
EXIT_SIGQUIT: int
EXIT_SIGKILL: int
EXIT_SIGSEGV: int
EXIT_FORCED: int
NO_CMD_ARGS: Any

def assertExitCodes(
    proc_info: Any,
    allowable_exit_codes: Any = ...,
    process: Any = None,
    cmd_args: Any = None,
    *,
    strict_proc_matching: bool = True,
) -> None: ...
def assertInStream(
    proc_output: Any,
    expected_output: Any,
    process: Any,
    cmd_args: Any = None,
    *,
    output_filter: Any = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
    stream: str = "stderr",
) -> None: ...
def assertInStdout(
    proc_output: Any,
    expected_output: Any,
    process: Any,
    cmd_args: Any = None,
    *,
    output_filter: Any = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
) -> None: ...
def assertInStderr(
    proc_output: Any,
    expected_output: Any,
    process: Any,
    cmd_args: Any = None,
    *,
    output_filter: Any = None,
    strict_proc_matching: bool = True,
    strip_ansi_escape_sequences: bool = True,
) -> None: ...
def assertDefaultStream() -> Any: ...

class SequentialTextChecker:
    def __init__(self, output: Any) -> None: ...
    def assertInText(self, msg: str) -> Any: ...
    def assertInStdout(self, msg: str) -> None: ...
    def get_nearby_lines(self) -> Any: ...

def assertSequentialStdout(
    proc_output: Any, process: Any, cmd_args: Any = None
) -> AbstractContextManager[SequentialTextChecker]: ...
def __getattr__(name: str) -> Any: ...
