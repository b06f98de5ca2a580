from typing import Any
from typing import Optional, Set
import weakref
from rcl_interfaces.msg import SetParametersResult as SetParametersResult
from rclpy.clock import ROSClock as ROSClock
from rclpy.clock_type import ClockType as ClockType
from rclpy.parameter import Parameter as Parameter
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.qos import ReliabilityPolicy as ReliabilityPolicy
from rclpy.time import Time as Time
import rosgraph_msgs.msg

CLOCK_TOPIC: str
USE_SIM_TIME_NAME: str

class TimeSource:
    def __init__(self, *, node: Optional["Node"] = None) -> None: ...
    @property
    def ros_time_is_active(self) -> bool: ...
    @ros_time_is_active.setter
    def ros_time_is_active(self, enabled: bool) -> None: ...
    _subscribe_to_clock_topic: Any

    def attach_node(self, node: Node) -> None: ...
    def detach_node(self) -> None: ...
    def attach_clock(self, clock: ROSClock) -> None: ...
    def clock_callback(self, msg: rosgraph_msgs.msg.Clock) -> None: ...
    _on_parameter_event: Any
    _get_node: Any
    _clock_sub: Optional["Subscription"]
    _node_weak_ref: Optional[weakref.ReferenceType["Node"]]
    _associated_clocks: Set[ROSClock]
    _last_time_set: Any
    _ros_time_is_active: Any
