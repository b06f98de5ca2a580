from typing import Optional
from rclpy.clock_type import ClockType as ClockType
from rclpy.context import Context as Context
from rclpy.duration import Duration as Duration

class JumpThreshold:
    def __init__(
        self,
        *,
        min_forward: Optional[Duration],
        min_backward: Optional[Duration],
        on_clock_change: bool = True,
    ) -> None: ...
