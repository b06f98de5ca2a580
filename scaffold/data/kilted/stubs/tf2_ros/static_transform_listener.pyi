from typing import Any
from threading import Thread
from typing import Optional
from typing import Union
from rclpy.callback_groups import ReentrantCallbackGroup as ReentrantCallbackGroup
from rclpy.executors import SingleThreadedExecutor as SingleThreadedExecutor
from rclpy.node import Node as Node
from rclpy.qos import DurabilityPolicy as DurabilityPolicy
from rclpy.qos import HistoryPolicy as HistoryPolicy
from rclpy.qos import QoSProfile as QoSProfile
from tf2_msgs.msg import TFMessage as TFMessage
from tf2_ros.buffer import Buffer as Buffer

DEFAULT_TF_TOPIC: str
DEFAULT_STATIC_TF_TOPIC: str

class StaticTransformListener:
    def __init__(
        self,
        buffer: Buffer,
        node: Node,
        *,
        spin_thread: bool = False,
        static_qos: Optional[Union[QoSProfile, int]] = None,
        tf_static_topic: str = DEFAULT_STATIC_TF_TOPIC,
    ) -> None: ...
    def unregister(self) -> None: ...
    def static_callback(self, data: TFMessage) -> None: ...
    buffer: Buffer
    node: Node
    group: ReentrantCallbackGroup
    tf_static_sub: Any
    executor: SingleThreadedExecutor
    dedicated_listener_thread: Thread
