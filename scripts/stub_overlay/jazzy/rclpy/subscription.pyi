from collections.abc import Callable
from typing import Any, Generic, TypedDict
from typing_extensions import TypeAlias, TypeVar
from rclpy.callback_groups import CallbackGroup
from rclpy.qos import QoSProfile as QoSProfile

MsgType = TypeVar("MsgType", default=Any)

class MessageInfo(TypedDict):
    source_timestamp: int
    received_timestamp: int
    publication_sequence_number: int | None
    reception_sequence_number: int | None

class Subscription(Generic[MsgType]):
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
    msg_type: type[MsgType]
    topic: str
    event_handlers: list[EventHandler]
    raw: bool
    callback_group: CallbackGroup
    def get_publisher_count(self) -> int: ...
    @property
    def handle(self) -> Any: ...
    @property
    def topic_name(self) -> str: ...
    @property
    def callback(self) -> Any: ...
    @callback.setter
    def callback(self, value: Any) -> None: ...
