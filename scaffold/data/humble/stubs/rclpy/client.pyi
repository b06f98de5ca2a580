from typing import Dict
from typing import Optional
from typing import TypeVar
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.context import Context as Context
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.task import Future as Future
from typing import Any, Generic
from _ros_interfaces import RequestT, ResponseT, Service

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
    def call(self, request: RequestT) -> ResponseT: ...
    def call_async(self, request: RequestT) -> Future[ResponseT]: ...
    def get_pending_request(self, sequence_number: int) -> Future[ResponseT]: ...
    def remove_pending_request(self, future: Future[Any]) -> None: ...
    def service_is_ready(self) -> bool: ...
    def wait_for_service(self, timeout_sec: Optional[float] = None) -> bool: ...
    @property
    def handle(self) -> Any: ...
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
