from launch.action import Action as Action
from launch.condition import Condition
from launch.event_handler import BaseEventHandler

class RegisterEventHandler(Action):
    def __init__(
        self,
        event_handler: BaseEventHandler,
        *,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def event_handler(self) -> BaseEventHandler: ...
