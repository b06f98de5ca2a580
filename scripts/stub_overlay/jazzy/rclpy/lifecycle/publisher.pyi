from typing import Any, Generic
from rclpy.lifecycle.managed_entity import SimpleManagedEntity as SimpleManagedEntity
from rclpy.publisher import MsgType as MsgType
from rclpy.publisher import Publisher as Publisher

class LifecyclePublisher(SimpleManagedEntity, Publisher[MsgType], Generic[MsgType]):
    def __init__(self, *args: Any, **kwargs: Any) -> None: ...
    def publish(self, msg: MsgType | bytes) -> None: ...
