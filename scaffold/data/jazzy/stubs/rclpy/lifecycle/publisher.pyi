# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from rclpy.publisher import MsgType as MsgType
from rclpy.publisher import Publisher as Publisher
from .managed_entity import SimpleManagedEntity as SimpleManagedEntity
from typing import Any, Generic

class LifecyclePublisher(SimpleManagedEntity, Publisher[MsgType], Generic[MsgType]):
    def __init__(self, *args: Any, **kwargs: Any) -> None: ...
    def publish(self, msg: MsgType | bytes) -> None: ...
