from rclpy.action.client import ActionClient as ActionClient
from rclpy.clock import Clock as Clock
from rclpy.duration import Duration as Duration
from rclpy.node import Node as Node
from rclpy.time import Time as Time
from tf2_msgs.action import LookupTransform as LookupTransform
from tf2_ros.buffer_interface import BufferInterface
from geometry_msgs.msg import TransformStamped as TransformStamped

class BufferClient(BufferInterface, BufferInterface):
    node: Node
    action_client: ActionClient
    check_frequency: float
    timeout_padding: Duration

    def __init__(
        self, node: Node, ns: str, check_frequency: float = 10.0, timeout_padding: Duration = ...
    ) -> None: ...
    def destroy(self) -> None: ...
