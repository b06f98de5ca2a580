from typing import Any
import asyncio
from typing import Callable, Optional
from rclpy.clock import (
    ClockChange as ClockChange,
    JumpHandle as JumpHandle,
    JumpThreshold as JumpThreshold,
    TimeJump as TimeJump,
)
from rclpy.context import Context as Context
from rclpy.duration import Duration as Duration
from rclpy.exceptions import TimeSourceChangedError as TimeSourceChangedError
from rclpy.executors import await_or_execute as await_or_execute
from rclpy.timer import (
    BaseTimer as BaseTimer,
    TimerCallbackUnion as TimerCallbackUnion,
    TimerInfo as TimerInfo,
)
from .async_clock import AsyncClock as AsyncClock

class AsyncTimer(BaseTimer):
    def __init__(
        self,
        timer_period_ns: int,
        clock: AsyncClock,
        context: Context,
        callback: TimerCallbackUnion,
        autostart: bool,
        on_destroy: Callable[["AsyncTimer"], None],
        tg: Optional[asyncio.TaskGroup] = None,
    ) -> None: ...
    @property
    def callback(self) -> TimerCallbackUnion: ...
    @callback.setter
    def callback(self, cb: TimerCallbackUnion) -> None: ...
    _detect_wants_info: Any
    _destroy: Any

    def cancel(self) -> None: ...
    _on_reset: Any
    _resolve: Any
    _reject: Any
    _on_jump: Any
    _wait: Any
    _call: Any
    _run: Any
    _task: Optional[asyncio.Task]
    _reset_event: Any
    _sleep_waiter: Optional[asyncio.Future]
    _jump_handle: Optional[JumpHandle]
    _callback: Any
    _pass_info: Any
