from typing import Any
import asyncio
from typing import Dict, Optional
from rclpy.clock import (
    BaseClock as BaseClock,
    ClockChange as ClockChange,
    JumpHandle as JumpHandle,
    JumpThreshold as JumpThreshold,
    TimeJump as TimeJump,
)
from rclpy.clock_type import ClockType as ClockType
from rclpy.duration import Duration as Duration
from rclpy.exceptions import TimeSourceChangedError as TimeSourceChangedError
from rclpy.time import Time as Time

class AsyncClock(BaseClock):
    def __init__(self, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> None: ...
    _resolve_future: Any
    _on_jump: Any
    _destroy: Any

    async def sleep(self, duration_sec: float) -> None: ...
    _pending_sleeps: Dict[asyncio.Future, Optional[Time]]
    _destroyed: Any
    _jump_handle: JumpHandle
