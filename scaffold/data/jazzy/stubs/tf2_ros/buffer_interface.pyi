from collections.abc import Callable
from typing import Any, TypeVar, overload

from rclpy.duration import Duration as Duration
from rclpy.time import Time as Time
from std_msgs.msg import Header as Header

from builtin_interfaces.msg import Time as _TimeMsg
from geometry_msgs.msg import (
    PointStamped as PointStamped,
    PoseStamped as PoseStamped,
    PoseWithCovarianceStamped as PoseWithCovarianceStamped,
    TransformStamped as TransformStamped,
    Vector3Stamped as Vector3Stamped,
)
from sensor_msgs.msg import PointCloud2 as PointCloud2

_T = TypeVar("_T")
PyKDLType = TypeVar("PyKDLType")
TransformableObjectType = TypeVar("TransformableObjectType")
MsgStamped = PointStamped | PoseStamped | PoseWithCovarianceStamped | Vector3Stamped | PointCloud2
TransformableObject = (
    PointStamped
    | PoseStamped
    | PoseWithCovarianceStamped
    | Vector3Stamped
    | PointCloud2
    | PyKDLType
)

class BufferInterface:
    registration: TransformRegistration
    def __init__(self) -> None: ...
    @overload
    def transform(
        self, object_stamped: _T, target_frame: str, timeout: Duration = ..., new_type: None = None
    ) -> _T: ...
    @overload
    def transform(
        self, object_stamped: Any, target_frame: str, timeout: Duration = ..., new_type: Any = None
    ) -> Any: ...
    @overload
    def transform_full(
        self,
        object_stamped: _T,
        target_frame: str,
        target_time: Time | _TimeMsg,
        fixed_frame: str,
        timeout: Duration = ...,
        new_type: None = None,
    ) -> _T: ...
    @overload
    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: Time | _TimeMsg,
        fixed_frame: str,
        timeout: Duration = ...,
        new_type: Any = None,
    ) -> Any: ...
    def lookup_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | _TimeMsg,
        timeout: Duration = ...,
    ) -> TransformStamped: ...
    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Time | _TimeMsg,
        source_frame: str,
        source_time: Time | _TimeMsg,
        fixed_frame: str,
        timeout: Duration = ...,
    ) -> TransformStamped: ...
    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | _TimeMsg,
        timeout: Duration = ...,
    ) -> bool: ...
    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time | _TimeMsg,
        source_frame: str,
        source_time: Time | _TimeMsg,
        fixed_frame: str,
        timeout: Duration = ...,
    ) -> bool: ...

def Stamped(obj: _T, stamp: _TimeMsg, frame_id: str) -> _T: ...

class TypeException(Exception):
    errstr: str
    def __init__(self, errstr: str) -> None: ...

class NotImplementedException(Exception):
    errstr: str
    def __init__(self) -> None: ...

class TransformRegistration:
    def print_me(self) -> None: ...
    def add(self, key: Any, callback: Callable[[Any, TransformStamped], Any]) -> None: ...
    def get(self, key: Any) -> Callable[[Any, TransformStamped], Any]: ...

class ConvertRegistration:
    def add_from_msg(self, key: Any, callback: Callable[[Any], Any]) -> None: ...
    def add_to_msg(self, key: Any, callback: Callable[[Any], Any]) -> None: ...
    def add_convert(self, key: tuple[Any, Any], callback: Callable[[Any], Any]) -> None: ...
    def get_from_msg(self, key: Any) -> Callable[[Any], Any]: ...
    def get_to_msg(self, key: Any) -> Callable[[Any], Any]: ...
    def get_convert(self, key: tuple[Any, Any]) -> Callable[[Any], Any]: ...

def convert(a: Any, b_type: Any) -> Any: ...
