from typing import Any

from _ros_launch import Reaction
from launch.action import Action as Action
from launch.condition import Condition
from launch.descriptions.executable import Executable as Executable
from launch.events.process.process_exited import ProcessExited as ProcessExited
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)

class ExecuteLocal(Action):
    def __init__(
        self,
        *,
        process_description: Executable,
        shell: bool = False,
        sigterm_timeout: SomeSubstitutionsType = ...,
        sigkill_timeout: SomeSubstitutionsType = ...,
        emulate_tty: bool = False,
        output: SomeSubstitutionsType | dict[str, Any] = "log",
        output_format: str = ...,
        cached_output: bool = False,
        log_cmd: bool = False,
        on_exit: Reaction[ProcessExited] | None = None,
        respawn: bool | SomeSubstitutionsType = False,
        respawn_delay: float | None = None,
        respawn_max_retries: int = -1,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def process_description(self) -> Executable: ...
    @property
    def shell(self) -> bool: ...
    @property
    def emulate_tty(self) -> bool: ...
    @property
    def sigkill_timeout(self) -> Any: ...
    @property
    def sigterm_timeout(self) -> Any: ...
    @property
    def output(self) -> Any: ...
    @property
    def process_details(self) -> dict[str, Any] | None: ...
    @property
    def return_code(self) -> int | None: ...
    def prepare(self, context: Any) -> None: ...
    def get_stdout(self) -> bytes: ...
    def get_stderr(self) -> bytes: ...
