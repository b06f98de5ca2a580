from launch.actions.emit_event import EmitEvent
from launch.condition import Condition

class Shutdown(EmitEvent):
    def __init__(
        self,
        *,
        reason: str = "reason not given",
        condition: Condition | None = None,
    ) -> None: ...
