from launch.action import Action as Action
from launch.condition import Condition
from launch.event_handler import BaseEventHandler
from ..launch_context import LaunchContext as LaunchContext
from ..launch_description_entity import LaunchDescriptionEntity as LaunchDescriptionEntity

class RegisterEventHandler(Action):
    def __init__(
        self, event_handler: BaseEventHandler, *, condition: Condition | None = None
    ) -> None: ...
    @property
    def event_handler(self) -> BaseEventHandler: ...
