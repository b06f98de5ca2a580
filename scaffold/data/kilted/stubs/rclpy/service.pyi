from typing_extensions import Self
from typing import Callable
from typing import TypeVar
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.clock import Clock as Clock
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.service_introspection import ServiceIntrospectionState as ServiceIntrospectionState
from collections.abc import Awaitable
from typing import Any, Generic
from _ros_interfaces import RequestT, ResponseT
from _ros_interfaces import Service as _ServiceType
from types import TracebackType
from typing import Optional
from typing import Type
from rclpy.type_support import Srv as Srv, SrvRequestT as SrvRequestT, SrvResponseT as SrvResponseT

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
    def configure_introspection(
        self,
        clock: Clock,
        service_event_qos_profile: QoSProfile,
        introspection_state: ServiceIntrospectionState,
    ) -> None: ...
    @property
    def handle(self) -> Any: ...
    @property
    def service_name(self) -> str: ...
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

    def __enter__(self) -> Self: ...
    def __exit__(
        self,
        exc_type: Optional[Type[BaseException]],
        exc_val: Optional[BaseException],
        exc_tb: Optional[TracebackType],
    ) -> None: ...
