from typing import TypeVar
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.duration import Duration as Duration
from rclpy.event_handler import EventHandler as EventHandler
from rclpy.event_handler import PublisherEventCallbacks as PublisherEventCallbacks
from rclpy.qos import QoSProfile as QoSProfile
from typing import Any, Generic
from collections.abc import Callable
from types import TracebackType
from typing import Optional, Type, Union
from rclpy.type_support import MsgT as MsgT
from typing_extensions import Self as Self

MsgType = TypeVar("MsgType", default=Any)

class Publisher(BasePublisher, Generic[MsgType]):
    def __init__(
        self,
        publisher_impl: Any,
        msg_type: type[MsgType],
        topic: str,
        qos_profile: QoSProfile,
        *,
        on_destroy: Optional[Callable[["Publisher[MsgT]"], None]] = None,
        event_callbacks: PublisherEventCallbacks,
        callback_group: CallbackGroup,
    ) -> None: ...
    def publish(self, msg: MsgType | bytes) -> None: ...
    def get_subscription_count(self) -> int: ...
    @property
    def topic_name(self) -> str: ...
    @property
    def handle(self) -> Any: ...
    @property
    def logger_name(self) -> str: ...
    def destroy(self) -> None: ...
    def assert_liveliness(self) -> None: ...
    def wait_for_all_acked(self, timeout: Duration = ...) -> bool: ...
    msg_type: type[MsgType]
    topic: str
    qos_profile: QoSProfile
    event_handlers: list[EventHandler]
    _destroy: Any
    _on_destroy: Any

class BasePublisher(Generic[MsgT]):
    def __init__(
        self,
        publisher_impl: _rclpy.Publisher[MsgT],
        msg_type: Type[MsgT],
        topic: str,
        qos_profile: QoSProfile,
        *,
        on_destroy: Optional[Callable[["BasePublisher[MsgT]"], None]] = None,
    ) -> None: ...
    def publish(self, msg: Union[MsgT, bytes]) -> None: ...
    def get_subscription_count(self) -> int: ...
    @property
    def topic_name(self) -> str: ...
    @property
    def handle(self) -> _rclpy.Publisher[MsgT]: ...
    @property
    def logger_name(self) -> str: ...
    def destroy(self) -> None: ...
    _destroy: Any

    def assert_liveliness(self) -> None: ...
    def __enter__(self) -> Self: ...
    def __exit__(
        self,
        exc_type: Optional[Type[BaseException]],
        exc_val: Optional[BaseException],
        exc_tb: Optional[TracebackType],
    ) -> None: ...
    __publisher: Any
    msg_type: Type[MsgT]
    topic: str
    qos_profile: QoSProfile
    _on_destroy: Any
    _destroyed: Any
