from typing import Callable, Type
from rclpy.publisher import BasePublisher as BasePublisher
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.type_support import MsgT as MsgT

class AsyncPublisher(BasePublisher[MsgT]):
    def __init__(
        self,
        publisher_impl: object,
        msg_type: Type[MsgT],
        topic: str,
        qos_profile: QoSProfile,
        on_destroy: Callable[["AsyncPublisher"], None],
    ) -> None: ...
