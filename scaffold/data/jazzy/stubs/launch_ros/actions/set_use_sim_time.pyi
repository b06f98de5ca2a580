from rclpy.parameter import Parameter as Parameter
from launch.action import Action as Action
from launch.condition import Condition

class SetUseSimTime(Action):
    def __init__(self, value: bool, *, condition: Condition | None = None) -> None: ...
    @property
    def value(self) -> bool: ...
