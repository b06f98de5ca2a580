from typing import Any
from _ros_launch import Environment, Listed, Reaction
from launch.actions.execute_local import ExecuteLocal as ExecuteLocal
from launch.condition import Condition
from launch.events.process.process_exited import ProcessExited
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from .shutdown_action import Shutdown as Shutdown
from ..descriptions import Executable as Executable
from ..frontend import Entity as Entity
from ..frontend import expose_action as expose_action
from ..frontend import Parser as Parser
from ..substitutions import TextSubstitution as TextSubstitution

class ExecuteProcess(ExecuteLocal):
    def __init__(
        self,
        *,
        cmd: Listed[SomeSubstitutionsType],
        prefix: SomeSubstitutionsType | None = None,
        name: SomeSubstitutionsType | None = None,
        cwd: SomeSubstitutionsType | None = None,
        env: Environment | None = None,
        additional_env: Environment | None = None,
        arguments: Listed[SomeSubstitutionsType] | None = None,
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
    def name(self) -> Any: ...
    @property
    def cmd(self) -> Any: ...
    @property
    def cwd(self) -> Any: ...
    @property
    def env(self) -> Any: ...
    @property
    def additional_env(self) -> Any: ...

_global_process_counter_lock: Any
_global_process_counter: int
