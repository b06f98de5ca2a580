from typing_extensions import Self
from typing import Any
from types import TracebackType
from typing import Callable, Optional, Type
from .duration import Duration as Duration
from .exceptions import NotInitializedException as NotInitializedException
from .time import Time as Time
from .utilities import get_default_context as get_default_context

ClockChange: Any

class JumpThreshold:
    def __init__(
        self,
        *,
        min_forward: Optional[Duration],
        min_backward: Optional[Duration],
        on_clock_change: bool = True,
    ) -> None: ...
    min_forward: Optional[Duration]
    min_backward: Optional[Duration]
    on_clock_change: bool

class TimeJump:
    def __init__(self, clock_change: ClockChange, delta: Duration) -> None: ...
    @property
    def clock_change(self) -> ClockChange: ...
    @property
    def delta(self) -> Duration: ...
    _clock_change: Any
    _delta: Any

class JumpHandle:
    def __init__(
        self,
        *,
        clock: Clock,
        threshold: JumpThreshold,
        pre_callback: Optional[JumpHandlePreCallbackType],
        post_callback: Optional[Callable[[TimeJumpDictionary], None]],
    ) -> None: ...
    def unregister(self) -> None: ...
    def __enter__(self) -> Self: ...
    def __exit__(
        self,
        t: Optional[Type[BaseException]],
        v: Optional[BaseException],
        tb: Optional[TracebackType],
    ) -> None: ...
    _clock: Optional[Clock]
    _pre_callback: Any
    _post_callback: Any

class Clock:
    def __new__(cls, *, clock_type: ClockType = ClockType.SYSTEM_TIME) -> Clock: ...
    @property
    def clock_type(self) -> ClockType: ...
    @property
    def handle(self) -> ClockHandle: ...
    def __repr__(self) -> str: ...
    def now(self) -> Time: ...
    def create_jump_callback(
        self,
        threshold: JumpThreshold,
        *,
        pre_callback: Optional[JumpHandlePreCallbackType] = None,
        post_callback: Optional[Callable[[TimeJump], None]] = None,
    ) -> JumpHandle: ...
    def sleep_until(self, until: Time, context: Optional[Context] = None) -> bool: ...
    def sleep_for(self, rel_time: Duration, context: Optional[Context] = None) -> bool: ...
    __clock: Any
    _clock_type: Any

class ROSClock(Clock):
    def __new__(cls) -> ROSClock: ...
    @property
    def ros_time_is_active(self) -> bool: ...
    _set_ros_time_is_active: Any

    def set_ros_time_override(self, time: Time) -> None: ...

ClockType: Any
