from rclpy.publisher import Publisher as Publisher
from .managed_entity import SimpleManagedEntity as SimpleManagedEntity
from typing import Any, Generic
from collections.abc import Callable
from typing import Optional, Tuple, Type, TypedDict
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.event_handler import PublisherEventCallbacks as PublisherEventCallbacks
from rclpy.publisher import BasePublisher as BasePublisher
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.type_support import MsgT as MsgT
from typing_extensions import TypeAlias as TypeAlias
from typing_extensions import Unpack as Unpack

class LifecyclePublisher(SimpleManagedEntity, Publisher[MsgType], Generic[MsgType]):
    def __init__(self, *args: Any, **kwargs: Any) -> None: ...
    def publish(self, msg: MsgType | bytes) -> None: ...

LifecyclePublisherArgs: TypeAlias = Tuple[_rclpy.Publisher[MsgT], Type[MsgT], str, QoSProfile]

class LifecyclePublisherKWArgs(TypedDict, Generic[MsgT]):
    publisher_impl: _rclpy.Publisher[MsgT]
    msg_type: Type[MsgT]
    topic: str
    qos_profile: QoSProfile
    on_destroy: Optional[Callable[["Publisher[MsgT]"], None]]
    event_callbacks: PublisherEventCallbacks
    callback_group: CallbackGroup
