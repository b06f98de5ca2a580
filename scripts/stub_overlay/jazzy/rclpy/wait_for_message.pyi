from typing import TypeVar, Union
from _ros_interfaces import AnyMessage

_MsgT = TypeVar("_MsgT", bound=AnyMessage)

def wait_for_message(
    msg_type: type[_MsgT],
    node: Node,
    topic: str,
    *,
    qos_profile: Union[QoSProfile, int] = 1,
    time_to_wait: float = -1,
) -> tuple[bool, _MsgT | None]: ...
