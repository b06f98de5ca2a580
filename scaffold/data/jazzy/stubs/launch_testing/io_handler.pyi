from collections.abc import Iterator
from typing import Any

class IoHandler:
    def __init__(self) -> None: ...
    def track(self, process_name: str) -> None: ...
    def append(self, process_io: Any) -> None: ...
    def __iter__(self) -> Iterator[Any]: ...
    def processes(self) -> Any: ...
    def process_names(self) -> Any: ...
    def __getitem__(self, key: Any) -> Any: ...

class ActiveIoHandler(IoHandler):
    @property
    def io_event(self) -> Any: ...
    def assertWaitFor(
        self,
        expected_output: Any,
        process: Any = None,
        cmd_args: Any = None,
        *,
        strict_proc_matching: bool = True,
        output_filter: Any = None,
        timeout: float = 10,
        strip_ansi_escape_sequences: bool = True,
        stream: str = "stderr",
    ) -> None: ...
    def waitFor(
        self,
        expected_output: Any,
        process: Any = None,
        cmd_args: Any = None,
        *,
        strict_proc_matching: bool = True,
        output_filter: Any = None,
        timeout: float = 10,
        strip_ansi_escape_sequences: bool = True,
        stream: str = "stderr",
    ) -> bool: ...
