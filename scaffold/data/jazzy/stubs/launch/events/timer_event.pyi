from launch.actions.timer_action import TimerAction
from launch.event import Event as Event

class TimerEvent(Event):
    def __init__(self, *, timer_action: TimerAction) -> None: ...
    @property
    def timer_action(self) -> TimerAction: ...
