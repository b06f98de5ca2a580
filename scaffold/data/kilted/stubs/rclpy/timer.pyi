from typing_extensions import Self
from typing import Callable
from typing import Optional
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.clock import Clock as Clock
from rclpy.context import Context as Context
from rclpy.exceptions import (
    InvalidHandle as InvalidHandle,
    ROSInterruptException as ROSInterruptException,
)
from rclpy.utilities import get_default_context as get_default_context
from typing import Any
from types import TracebackType
from typing import Type
from rclpy.clock_type import ClockType as ClockType
from rclpy.time import Time as Time

class Timer:
    def __init__(
        self,
        callback: Callable[[], object],
        callback_group: CallbackGroup,
        timer_period_ns: int,
        clock: Clock,
        *,
        context: Optional[Context] = None,
        autostart: bool = True,
    ) -> None: ...
    @property
    def handle(self) -> Any: ...
    def destroy(self) -> None: ...
    @property
    def clock(self) -> Clock: ...
    @property
    def timer_period_ns(self) -> int: ...
    @timer_period_ns.setter
    def timer_period_ns(self, value: int) -> None: ...
    def is_ready(self) -> bool: ...
    def is_canceled(self) -> bool: ...
    def cancel(self) -> None: ...
    def reset(self) -> None: ...
    def time_since_last_call(self) -> int: ...
    def time_until_next_call(self) -> int: ...
    _context: Any
    _clock: Any
    callback: Callable[[], object]
    callback_group: CallbackGroup
    _executor_event: Any
    __timer: Any
    __timer_period_ns: Any

    def __enter__(self) -> Self: ...
    def __exit__(
        self,
        exc_type: Optional[Type[BaseException]],
        exc_val: Optional[BaseException],
        exc_tb: Optional[TracebackType],
    ) -> None: ...

class Rate:
    def __init__(self, timer: Timer, *, context: Context) -> None: ...
    _on_shutdown: Any

    def destroy(self) -> None: ...
    _presleep: Any
    _postsleep: Any

    def sleep(self) -> None: ...
    _timer: Any
    _is_shutdown: Any
    _is_destroyed: Any
    _event: Any
    _lock: Any
    _num_sleepers: Any

class TimerInfo:
    def __init__(
        self,
        *,
        expected_call_time: int = 0,
        actual_call_time: int = 0,
        clock_type: ClockType = ClockType.SYSTEM_TIME,
    ) -> None: ...
    @property
    def expected_call_time(self) -> Time: ...
    @property
    def actual_call_time(self) -> Time: ...
    _expected_call_time: Time
    _actual_call_time: Time
