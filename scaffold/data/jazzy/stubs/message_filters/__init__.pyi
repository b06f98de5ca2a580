from collections.abc import Callable, Iterable
from typing import Any, TypeVar

from _ros_interfaces import AnyMessage
from rclpy.callback_groups import CallbackGroup
from rclpy.event_handler import SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.qos_overriding_options import QoSOverridingOptions
from rclpy.subscription import Subscription
from rclpy.time import Time

_MsgT = TypeVar("_MsgT", bound=AnyMessage)

class SimpleFilter:
    callbacks: dict[int, Any]
    def __init__(self) -> None: ...
    def registerCallback(self, cb: Callable[..., object], *args: Any) -> int: ...
    def signalMessage(self, *msg: Any) -> None: ...

class Subscriber(SimpleFilter):
    node: Node
    topic: str
    sub: Subscription
    def __init__(
        self,
        node: Node,
        msg_type: type[_MsgT],
        topic: str,
        /,
        *,
        qos_profile: QoSProfile | int = 10,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> None: ...
    def callback(self, msg: Any) -> None: ...
    def getTopic(self) -> str: ...
    # What it lacks it asks its subscription for.
    @property
    def topic_name(self) -> str: ...
    @property
    def handle(self) -> Any: ...
    @property
    def logger_name(self) -> str: ...
    msg_type: Any
    raw: bool
    qos_profile: QoSProfile
    callback_group: CallbackGroup
    event_handlers: Any
    def destroy(self) -> None: ...
    def get_publisher_count(self) -> int: ...

class Cache(SimpleFilter):
    cache_msgs: list[Any]
    cache_times: list[Time]
    cache_size: int
    allow_headerless: bool
    def __init__(
        self, f: SimpleFilter, cache_size: int = 1, allow_headerless: bool = False
    ) -> None: ...
    def connectInput(self, f: SimpleFilter) -> None: ...
    def add(self, msg: Any) -> None: ...
    def getInterval(self, from_stamp: Time, to_stamp: Time) -> list[Any]: ...
    def getElemAfterTime(self, stamp: Time) -> Any: ...
    def getElemBeforeTime(self, stamp: Time) -> Any: ...
    def getLastestTime(self) -> Time | None: ...
    def getOldestTime(self) -> Time | None: ...
    def getLast(self) -> Any: ...

class TimeSynchronizer(SimpleFilter):
    queues: list[dict[int, Any]]
    queue_size: int
    input_connections: list[int]
    lock: Any
    def __init__(self, fs: Iterable[SimpleFilter], queue_size: int) -> None: ...
    def connectInput(self, fs: Iterable[SimpleFilter]) -> None: ...
    def add(self, msg: Any, my_queue: Any, my_queue_index: int | None = None) -> None: ...

class ApproximateTimeSynchronizer(TimeSynchronizer):
    slop: Any
    allow_headerless: bool
    def __init__(
        self,
        fs: Iterable[SimpleFilter],
        queue_size: int,
        slop: float,
        allow_headerless: bool = False,
    ) -> None: ...
