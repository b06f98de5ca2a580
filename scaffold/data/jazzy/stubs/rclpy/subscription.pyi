# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from enum import Enum
from typing import Callable
from typing import TypeVar
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.event_handler import EventHandler as EventHandler
from rclpy.event_handler import SubscriptionEventCallbacks as SubscriptionEventCallbacks
from rclpy.qos import QoSProfile as QoSProfile
from typing import Any, Generic, TypedDict

MsgType = TypeVar("MsgType", default=Any)

class Subscription(Generic[MsgType]):
    class CallbackType(Enum):
        MessageOnly = 0
        WithMessageInfo = 1

    def __init__(
        self,
        subscription_impl: Any,
        msg_type: type[MsgType],
        topic: str,
        callback: Callable[[MsgType], object] | Callable[[MsgType, MessageInfo], object],
        callback_group: CallbackGroup,
        qos_profile: QoSProfile,
        raw: bool,
        event_callbacks: SubscriptionEventCallbacks,
    ) -> None: ...
    def get_publisher_count(self) -> int: ...
    @property
    def handle(self) -> Any: ...
    def destroy(self) -> None: ...
    @property
    def topic_name(self) -> str: ...
    @property
    def callback(self) -> Any: ...
    @callback.setter
    def callback(self, value: Any) -> None: ...
    @property
    def logger_name(self) -> str: ...
    __subscription: Any
    msg_type: type[MsgType]
    topic: str
    callback_group: CallbackGroup
    _executor_event: Any
    qos_profile: QoSProfile
    raw: bool
    event_handlers: list[EventHandler]
    _callback: Any
    _callback_type: Any

class MessageInfo(TypedDict):
    source_timestamp: int
    received_timestamp: int
    publication_sequence_number: int | None
    reception_sequence_number: int | None
