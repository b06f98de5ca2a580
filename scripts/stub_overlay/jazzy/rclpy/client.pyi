from typing import Any, Generic, Optional
from _ros_interfaces import RequestT, ResponseT, Service
from rclpy.callback_groups import CallbackGroup
from rclpy.qos import QoSProfile as QoSProfile
from rclpy.task import Future as Future

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
    srv_type: type[Service[RequestT, ResponseT]]
    callback_group: CallbackGroup
    def call(self, request: RequestT, timeout_sec: Optional[float] = None) -> ResponseT: ...
    def call_async(self, request: RequestT) -> Future[ResponseT]: ...
    def get_pending_request(self, sequence_number: int) -> Future[ResponseT]: ...
    def remove_pending_request(self, future: Future[Any]) -> None: ...
    @property
    def handle(self) -> Any: ...
