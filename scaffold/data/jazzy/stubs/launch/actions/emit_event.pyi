from launch.action import Action as Action
from launch.condition import Condition
from launch.event import Event as Event

class EmitEvent(Action):
    def __init__(
        self,
        *,
        event: Event,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def event(self) -> Event: ...
