from typing import Union
from rclpy.node import Node as Node
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.signals import SignalHandlerGuardCondition as SignalHandlerGuardCondition
from rclpy.utilities import timeout_sec_to_nsec as timeout_sec_to_nsec
from typing import TypeVar
from _ros_interfaces import AnyMessage
from rclpy.type_support import MsgT as MsgT

def wait_for_message(
    msg_type: type[_MsgT],
    node: Node,
    topic: str,
    *,
    qos_profile: Union[QoSProfile, int] = 1,
    time_to_wait: float = -1,
) -> tuple[bool, _MsgT | None]: ...

_MsgT = TypeVar("_MsgT", bound=AnyMessage)
