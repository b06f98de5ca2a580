from collections.abc import Callable
from _ros_launch import Reaction
from launch.action import Action
from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.execution_complete import ExecutionComplete as ExecutionComplete
from ..event import Event as Event
from ..launch_context import LaunchContext as LaunchContext
from ..some_actions_type import SomeActionsType as SomeActionsType

class OnExecutionComplete(OnActionEventBase):
    def __init__(
        self,
        *,
        target_action: Action | Callable[[Action], bool] | None = None,
        on_completion: Reaction[ExecutionComplete],
        handle_once: bool = False,
    ) -> None: ...
