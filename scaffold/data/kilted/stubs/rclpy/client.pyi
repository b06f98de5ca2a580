from typing_extensions import Self
from typing import Dict
from typing import Optional
from typing import TypeVar
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.clock import Clock as Clock
from rclpy.context import Context as Context
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.service_introspection import ServiceIntrospectionState as ServiceIntrospectionState
from rclpy.task import Future as Future
from typing import Any, Generic
from _ros_interfaces import RequestT, ResponseT, Service
from types import TracebackType
from typing import Type
from rclpy.type_support import Srv as Srv, SrvRequestT as SrvRequestT, SrvResponseT as SrvResponseT

SrvType = TypeVar("SrvType")
SrvTypeRequest = TypeVar("SrvTypeRequest")
SrvTypeResponse = TypeVar("SrvTypeResponse")

class Client(Generic[RequestT, ResponseT]):
    def __init__(
        self,
        context: Context,
        client_impl: Any,
        srv_type: type[Service[RequestT, ResponseT]],
        srv_name: str,
        qos_profile: QoSProfile,
        callback_group: CallbackGroup,
    ) -> None: ...
    def call(self, request: RequestT, timeout_sec: Optional[float] = None) -> ResponseT: ...
    def call_async(self, request: RequestT) -> Future[ResponseT]: ...
    def get_pending_request(self, sequence_number: int) -> Future[ResponseT]: ...
    def remove_pending_request(self, future: Future[Any]) -> None: ...
    def service_is_ready(self) -> bool: ...
    def wait_for_service(self, timeout_sec: Optional[float] = None) -> bool: ...
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
    context: Context
    __client: Any
    srv_type: type[Service[RequestT, ResponseT]]
    srv_name: str
    qos_profile: QoSProfile
    _pending_requests: Dict[int, Future]
    callback_group: CallbackGroup
    _executor_event: Any
    _lock: Any

    def __enter__(self) -> Self: ...
    def __exit__(
        self,
        exc_type: Optional[Type[BaseException]],
        exc_val: Optional[BaseException],
        exc_tb: Optional[TracebackType],
    ) -> None: ...
