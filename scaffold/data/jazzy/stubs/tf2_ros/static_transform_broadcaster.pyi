from rclpy.qos import DurabilityPolicy as DurabilityPolicy, HistoryPolicy as HistoryPolicy
from collections.abc import Iterable

from rclpy.node import Node as Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile as QoSProfile
from tf2_msgs.msg import TFMessage as TFMessage

from geometry_msgs.msg import TransformStamped as TransformStamped

class StaticTransformBroadcaster:
    pub_tf: Publisher[TFMessage]
    net_message: TFMessage
    def __init__(self, node: Node, qos: QoSProfile | int | None = None) -> None: ...
    def sendTransform(self, transform: TransformStamped | Iterable[TransformStamped]) -> None: ...
