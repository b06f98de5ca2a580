from collections.abc import Callable
from launch.actions.execute_local import ExecuteLocal
from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.process.process_io import ProcessIO as ProcessIO
from launch.some_entities_type import SomeEntitiesType
from ..event import Event as Event
from ..launch_context import LaunchContext as LaunchContext
from ..some_actions_type import SomeActionsType as SomeActionsType
from ..actions import Action as Action

class OnProcessIO(OnActionEventBase):
    def __init__(
        self,
        *,
        target_action: ExecuteLocal | Callable[[ExecuteLocal], bool] | None = None,
        on_stdin: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        on_stdout: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        on_stderr: Callable[[ProcessIO], SomeEntitiesType | None] | None = None,
        handle_once: bool = False,
    ) -> None: ...
