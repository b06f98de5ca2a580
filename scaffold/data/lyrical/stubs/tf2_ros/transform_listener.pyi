from rclpy.callback_groups import ReentrantCallbackGroup as ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor as SingleThreadedExecutor
from rclpy.node import Node as Node
from rclpy.qos import (
    DurabilityPolicy as DurabilityPolicy,
    HistoryPolicy as HistoryPolicy,
    QoSProfile as QoSProfile,
)
from rclpy.subscription import Subscription
from tf2_msgs.msg import TFMessage as TFMessage
from tf2_ros.buffer import Buffer as Buffer

DEFAULT_TF_TOPIC: str
DEFAULT_STATIC_TF_TOPIC: str

class TransformListener:
    buffer: Buffer
    node: Node
    group: ReentrantCallbackGroup
    tf_sub: Subscription[TFMessage]
    tf_static_sub: Subscription[TFMessage]
    executor: SingleThreadedExecutor

    def __init__(
        self,
        buffer: Buffer,
        node: Node,
        *,
        spin_thread: bool = False,
        qos: QoSProfile | int | None = None,
        static_qos: QoSProfile | int | None = None,
        tf_topic: str = DEFAULT_TF_TOPIC,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
        static_only: bool = False,
    ) -> None: ...
    def unregister(self) -> None: ...
    def callback(self, data: TFMessage) -> None: ...
    def static_callback(self, data: TFMessage) -> None: ...
