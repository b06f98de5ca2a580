from typing import TypeVar
from _ros_interfaces import AnyMessage

_MsgT = TypeVar("_MsgT", bound=AnyMessage)

def serialize_message(message: AnyMessage) -> bytes: ...
def deserialize_message(serialized_message: bytes, message_type: type[_MsgT]) -> _MsgT: ...
