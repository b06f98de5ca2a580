from typing import Any
from _ros_launch import Reaction
from launch.action import Action as Action
from launch.descriptions.executable import Executable as Executable
from launch.events.process.process_exited import ProcessExited as ProcessExited
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from osrf_pycommon.process_utils import async_execute_process as async_execute_process
from osrf_pycommon.process_utils import AsyncSubprocessProtocol as AsyncSubprocessProtocol
from .emit_event import EmitEvent as EmitEvent
from .opaque_function import OpaqueFunction as OpaqueFunction
from .timer_action import TimerAction as TimerAction
from ..conditions import evaluate_condition_expression as evaluate_condition_expression
from ..event import Event as Event
from ..event_handler import EventHandler as EventHandler
from ..event_handlers import OnProcessExit as OnProcessExit
from ..event_handlers import OnProcessIO as OnProcessIO
from ..event_handlers import OnProcessStart as OnProcessStart
from ..event_handlers import OnShutdown as OnShutdown
from ..events import matches_action as matches_action
from ..events import Shutdown as Shutdown
from ..events.process import ProcessIO as ProcessIO
from ..events.process import ProcessStarted as ProcessStarted
from ..events.process import ProcessStderr as ProcessStderr
from ..events.process import ProcessStdin as ProcessStdin
from ..events.process import ProcessStdout as ProcessStdout
from ..events.process import ShutdownProcess as ShutdownProcess
from ..events.process import SignalProcess as SignalProcess
from ..launch_context import LaunchContext as LaunchContext
from ..launch_description import LaunchDescription as LaunchDescription
from ..launch_description_entity import LaunchDescriptionEntity as LaunchDescriptionEntity
from ..some_actions_type import SomeActionsType as SomeActionsType
from ..substitution import Substitution as Substitution
from ..substitutions import LaunchConfiguration as LaunchConfiguration
from ..substitutions import PythonExpression as PythonExpression
from ..utilities import create_future as create_future
from ..utilities import is_a_subclass as is_a_subclass
from ..utilities import normalize_to_list_of_substitutions as normalize_to_list_of_substitutions
from ..utilities import perform_substitutions as perform_substitutions
from ..utilities.type_utils import normalize_typed_substitution as normalize_typed_substitution
from ..utilities.type_utils import perform_typed_substitution as perform_typed_substitution

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
        output_format: str = "[{this.process_description.final_name}] {line}",
        cached_output: bool = False,
        log_cmd: bool = False,
        on_exit: Reaction[ProcessExited] | None = None,
        respawn: bool | SomeSubstitutionsType = False,
        respawn_delay: float | None = None,
        **kwargs: Any,
    ) -> None: ...
    @property
    def process_description(self) -> Executable: ...
    @property
    def shell(self) -> bool: ...
    @property
    def emulate_tty(self) -> bool: ...
    @property
    def output(self) -> Any: ...
    @property
    def process_details(self) -> dict[str, Any] | None: ...
    @property
    def return_code(self) -> int | None: ...
    def prepare(self, context: Any) -> None: ...
    def get_stdout(self) -> bytes: ...
    def get_stderr(self) -> bytes: ...

_global_process_counter_lock: Any
_global_process_counter: int
