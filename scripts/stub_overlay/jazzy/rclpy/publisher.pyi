from typing import Any, Generic
from typing_extensions import TypeVar
from rclpy.callback_groups import CallbackGroup
from rclpy.qos import QoSProfile as QoSProfile

MsgType = TypeVar("MsgType", default=Any)

class Publisher(Generic[MsgType]):
    def __init__(
        self,
        publisher_impl: Any,
        msg_type: type[MsgType],
        topic: str,
        qos_profile: QoSProfile,
        event_callbacks: PublisherEventCallbacks,
        callback_group: CallbackGroup,
    ) -> None: ...
    msg_type: type[MsgType]
    topic: str
    event_handlers: list[EventHandler]
    def publish(self, msg: MsgType | bytes) -> None: ...
    def wait_for_all_acked(self, timeout: Duration = ...) -> bool: ...
    @property
    def handle(self) -> Any: ...
