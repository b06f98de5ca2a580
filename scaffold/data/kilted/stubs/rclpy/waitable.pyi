from typing import Any
from types import TracebackType
from typing import Optional, Type, TypeVar
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.task import Future as Future

class NumberOfEntities:
    def __init__(
        self,
        num_subs: int = 0,
        num_gcs: int = 0,
        num_timers: int = 0,
        num_clients: int = 0,
        num_services: int = 0,
        num_events: int = 0,
    ) -> None: ...
    def __add__(self, other: NumberOfEntities) -> NumberOfEntities: ...
    def __repr__(self) -> str: ...
    num_subscriptions: int
    num_guard_conditions: int
    num_timers: int
    num_clients: int
    num_services: int
    num_events: int

    def __iadd__(self, other: NumberOfEntities) -> NumberOfEntities: ...

class Waitable:
    def __init__(self, callback_group: Any) -> None: ...
    def __enter__(self) -> None: ...
    def __exit__(
        self,
        exc_type: Optional[Type[BaseException]],
        exc_val: Optional[BaseException],
        exc_tb: Optional[TracebackType],
    ) -> None: ...
    def add_future(self, future: Any) -> None: ...
    def remove_future(self, future: Any) -> None: ...
    def is_ready(self, wait_set: Any) -> bool: ...
    def take_data(self) -> Any: ...
    async def execute(self, taken_data: Any) -> None: ...
    def get_num_entities(self) -> NumberOfEntities: ...
    def add_to_wait_set(self, wait_set: Any) -> None: ...
    callback_group: Any
    _executor_event: Any
    _futures: Any

T = TypeVar("T")
