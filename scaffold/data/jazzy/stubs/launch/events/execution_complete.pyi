from launch.action import Action
from launch.event import Event as Event

class ExecutionComplete(Event):
    def __init__(self, *, action: Action) -> None: ...
    @property
    def action(self) -> Action: ...
