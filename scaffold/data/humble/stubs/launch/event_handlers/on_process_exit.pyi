from collections.abc import Callable
from _ros_launch import Reaction
from launch.actions.execute_local import ExecuteLocal
from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.process.process_exited import ProcessExited as ProcessExited
from ..event import Event as Event
from ..launch_context import LaunchContext as LaunchContext
from ..some_actions_type import SomeActionsType as SomeActionsType
from ..actions import Action as Action

class OnProcessExit(OnActionEventBase):
    def __init__(
        self,
        *,
        target_action: ExecuteLocal | Callable[[ExecuteLocal], bool] | None = None,
        on_exit: Reaction[ProcessExited],
        handle_once: bool = False,
    ) -> None: ...
