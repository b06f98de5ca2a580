from collections.abc import Callable

from _ros_launch import Reaction
from launch.actions.execute_local import ExecuteLocal
from launch.event_handlers.on_action_event_base import OnActionEventBase
from launch.events.process.process_exited import ProcessExited as ProcessExited

class OnProcessExit(OnActionEventBase):
    def __init__(
        self,
        *,
        target_action: ExecuteLocal | Callable[[ExecuteLocal], bool] | None = None,
        on_exit: Reaction[ProcessExited],
        handle_once: bool = False,
    ) -> None: ...
