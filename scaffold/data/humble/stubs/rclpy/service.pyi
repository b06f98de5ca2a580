from typing import Callable
from typing import TypeVar
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.qos import QoSProfile as QoSProfile
from collections.abc import Awaitable
from typing import Any, Generic
from _ros_interfaces import RequestT, ResponseT
from _ros_interfaces import Service as _ServiceType

SrvType = TypeVar("SrvType")
SrvTypeRequest = TypeVar("SrvTypeRequest")
SrvTypeResponse = TypeVar("SrvTypeResponse")

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
    def send_response(self, response: ResponseT, header: Any) -> None: ...
    @property
    def handle(self) -> Any: ...
    @property
    def logger_name(self) -> str: ...
    def destroy(self) -> None: ...
    __service: Any
    srv_type: type[_ServiceType[RequestT, ResponseT]]
    srv_name: str
    callback: Callable[[RequestT, ResponseT], ResponseT | Awaitable[ResponseT]]
    callback_group: CallbackGroup
    _executor_event: Any
    qos_profile: QoSProfile
