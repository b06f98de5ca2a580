from rclpy.clock import Clock as Clock
from rclpy.duration import Duration as Duration
from rclpy.node import Node as Node
from rclpy.qos import (
    DurabilityPolicy as DurabilityPolicy,
    HistoryPolicy as HistoryPolicy,
    QoSProfile as QoSProfile,
)
from rclpy.time import Time as Time
from std_msgs.msg import Header as Header
from tf2_msgs.msg import TFMessage as TFMessage
from tf2_py import (
    BufferCore as BufferCore,
    ConnectivityException as ConnectivityException,
    ExtrapolationException as ExtrapolationException,
    InvalidArgumentException as InvalidArgumentException,
    LookupException as LookupException,
    TimeoutException as TimeoutException,
    TransformException as TransformException,
)
from tf2_ros import (
    buffer as buffer,
    buffer_client as buffer_client,
    buffer_interface as buffer_interface,
    static_transform_broadcaster as static_transform_broadcaster,
    transform_broadcaster as transform_broadcaster,
    transform_listener as transform_listener,
    static_transform_listener as static_transform_listener,
)
from tf2_ros.buffer import Buffer as Buffer
from tf2_ros.buffer_client import BufferClient as BufferClient
from tf2_ros.buffer_interface import (
    BufferInterface as BufferInterface,
    ConvertRegistration as ConvertRegistration,
    MsgStamped as MsgStamped,
    NotImplementedException as NotImplementedException,
    PyKDLType as PyKDLType,
    Stamped as Stamped,
    TransformableObject as TransformableObject,
    TransformableObjectType as TransformableObjectType,
    TransformRegistration as TransformRegistration,
    TypeException as TypeException,
    convert as convert,
)
from tf2_ros.static_transform_broadcaster import (
    StaticTransformBroadcaster as StaticTransformBroadcaster,
)
from tf2_ros.transform_broadcaster import TransformBroadcaster as TransformBroadcaster
from tf2_ros.transform_listener import TransformListener as TransformListener
from geometry_msgs.msg import TransformStamped as TransformStamped
