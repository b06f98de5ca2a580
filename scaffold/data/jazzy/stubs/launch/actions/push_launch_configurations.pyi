from launch.action import Action as Action
from launch.condition import Condition

class PushLaunchConfigurations(Action):
    def __init__(self, *, condition: Condition | None = None) -> None: ...
