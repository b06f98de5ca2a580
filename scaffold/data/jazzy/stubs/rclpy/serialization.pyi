# Made by scripts/make_stubs.py from rclpy 7.1.6 of ROS 2 Jazzy; do not edit.
from rclpy.type_support import check_for_type_support as check_for_type_support
from typing import TypeVar
from _ros_interfaces import AnyMessage

def serialize_message(message: AnyMessage) -> bytes: ...
def deserialize_message(serialized_message: bytes, message_type: type[_MsgT]) -> _MsgT: ...

_MsgT = TypeVar("_MsgT", bound=AnyMessage)
