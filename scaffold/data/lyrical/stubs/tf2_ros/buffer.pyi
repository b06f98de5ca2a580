from typing import Any, Literal, overload
from rclpy.clock import Clock, JumpHandle, JumpThreshold as JumpThreshold, TimeJump as TimeJump
from rclpy.duration import Duration as Duration
from rclpy.node import Node as Node
from rclpy.service import Service
from rclpy.task import Future as Future
from rclpy.time import Time as Time
from tf2_msgs.srv import FrameGraph as FrameGraph
from tf2_py import BufferCore
from tf2_ros.buffer_interface import BufferInterface
from builtin_interfaces.msg import Time as _TimeMsg
from geometry_msgs.msg import TransformStamped as TransformStamped
import tf2_py as tf2

class Buffer(BufferInterface, BufferCore, BufferInterface):
    srv: Service
    clock: Clock
    jump_handle: JumpHandle

    def __init__(self, cache_time: Duration | None = None, node: Node | None = None) -> None: ...
    def time_jump_callback(self, time_jump: TimeJump) -> None: ...
    def set_transform(self, transform: TransformStamped, authority: str) -> None: ...
    def set_transform_static(self, transform: TransformStamped, authority: str) -> None: ...
    async def lookup_transform_async(
        self, target_frame: str, source_frame: str, time: Time | _TimeMsg
    ) -> TransformStamped: ...
    async def lookup_transform_full_async(
        self,
        target_frame: str,
        target_time: Time | _TimeMsg,
        source_frame: str,
        source_time: Time | _TimeMsg,
        fixed_frame: str,
    ) -> TransformStamped: ...
    @overload
    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | _TimeMsg,
        timeout: Duration = ...,
        return_debug_tuple: Literal[False] = False,
    ) -> bool: ...
    @overload
    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Time | _TimeMsg,
        timeout: Duration = ...,
        return_debug_tuple: bool = ...,
    ) -> Any: ...
    @overload
    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time | _TimeMsg,
        source_frame: str,
        source_time: Time | _TimeMsg,
        fixed_frame: str,
        timeout: Duration = ...,
        return_debug_tuple: Literal[False] = False,
    ) -> bool: ...
    @overload
    def can_transform_full(
        self,
        target_frame: str,
        target_time: Time | _TimeMsg,
        source_frame: str,
        source_time: Time | _TimeMsg,
        fixed_frame: str,
        timeout: Duration = ...,
        return_debug_tuple: bool = ...,
    ) -> Any: ...
    def wait_for_transform_async(
        self, target_frame: str, source_frame: str, time: Time | _TimeMsg
    ) -> Future[TransformStamped]: ...
    def wait_for_transform_full_async(
        self,
        target_frame: str,
        target_time: Time | _TimeMsg,
        source_frame: str,
        source_time: Time | _TimeMsg,
        fixed_frame: str,
    ) -> Future[TransformStamped]: ...
