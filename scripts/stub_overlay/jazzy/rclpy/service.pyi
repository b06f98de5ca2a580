from collections.abc import Awaitable, Callable
from typing import Any, Generic
from _ros_interfaces import RequestT, ResponseT
from _ros_interfaces import Service as _ServiceType
from rclpy.callback_groups import CallbackGroup
from rclpy.qos import QoSProfile as QoSProfile

class Service(Generic[RequestT, ResponseT]):
    def __init__(
        self,
        service_impl: Any,
        srv_type: type[_ServiceType[RequestT, ResponseT]],
        srv_name: str,
        callback: Callable[[RequestT, ResponseT], ResponseT | Awaitable[ResponseT]],
        callback_group: CallbackGroup,
        qos_profile: QoSProfile,
    ) -> None: ...
    srv_type: type[_ServiceType[RequestT, ResponseT]]
    callback: Callable[[RequestT, ResponseT], ResponseT | Awaitable[ResponseT]]
    callback_group: CallbackGroup
    def send_response(self, response: ResponseT, header: Any) -> None: ...
    @property
    def handle(self) -> Any: ...
