from rclpy.type_support import check_for_type_support as check_for_type_support
from typing import TypeVar
from _ros_interfaces import AnyMessage
from rclpy.type_support import Msg as Msg
from rclpy.type_support import MsgT as MsgT

def serialize_message(message: AnyMessage) -> bytes: ...
def deserialize_message(serialized_message: bytes, message_type: type[_MsgT]) -> _MsgT: ...

_MsgT = TypeVar("_MsgT", bound=AnyMessage)
