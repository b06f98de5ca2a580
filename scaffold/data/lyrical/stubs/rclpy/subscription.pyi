from enum import Enum
from typing import Callable
from typing import TypeVar
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.event_handler import SubscriptionEventCallbacks as SubscriptionEventCallbacks
from rclpy.qos import QoSProfile as QoSProfile
from typing import Any, Generic, TypedDict
from types import TracebackType
from typing import Awaitable
from typing import Literal
from typing import Optional
from typing import overload
from typing import Type
from typing import Union
from rclpy.subscription_content_filter_options import ContentFilterOptions as ContentFilterOptions
from rclpy.type_support import MsgT as MsgT
from typing_extensions import Self as Self
from typing_extensions import TypeAlias as TypeAlias

MsgType = TypeVar("MsgType", default=Any)

class Subscription(BaseSubscription, Generic[MsgType]):
    class CallbackType(Enum):
        MessageOnly = 0
        WithMessageInfo = 1

    def __init__(
        self,
        subscription_impl: Any,
        msg_type: type[MsgType],
        topic: str,
        callback: Callable[[MsgType], object] | Callable[[MsgType, MessageInfo], object],
        qos_profile: QoSProfile,
        raw: bool,
        *,
        on_destroy: Optional[Callable[["Subscription[MsgT]"], None]] = None,
        callback_group: CallbackGroup,
        event_callbacks: SubscriptionEventCallbacks,
    ) -> None: ...
    def get_publisher_count(self) -> int: ...
    @property
    def handle(self) -> Any: ...
    def destroy(self) -> None: ...
    @property
    def topic_name(self) -> str: ...
    @property
    def callback(self) -> Any: ...
    @callback.setter
    def callback(self, value: Any) -> None: ...
    @property
    def logger_name(self) -> str: ...
    msg_type: type[MsgType]
    topic: str
    callback_group: CallbackGroup
    _executor_event: Any
    qos_profile: QoSProfile
    raw: bool
    event_handlers: list[EventHandler]
    _callback: Any
    _callback_type: Any
    _destroy: Any
    _on_destroy: Any

class MessageInfo(TypedDict):
    source_timestamp: int
    received_timestamp: int
    publication_sequence_number: int | None
    reception_sequence_number: int | None

class PublisherGID(TypedDict):
    implementation_identifier: str
    data: bytes

T = TypeVar("T")
GenericSubscriptionCallback: TypeAlias = Union[
    Callable[[T], None], Callable[[T, MessageInfo], None]
]
AsyncGenericSubscriptionCallback: TypeAlias = Union[
    Callable[[T], Awaitable[None]], Callable[[T, MessageInfo], Awaitable[None]]
]
GenericSubscriptionCallbackUnion: TypeAlias = Union[
    GenericSubscriptionCallback[T], AsyncGenericSubscriptionCallback[T]
]
SubscriptionCallbackUnion: TypeAlias = Union[
    GenericSubscriptionCallbackUnion[MsgT], GenericSubscriptionCallbackUnion[bytes]
]

class BaseSubscription(Generic[MsgT]):
    class CallbackType(Enum):
        MessageOnly = 0
        WithMessageInfo = 1

    @overload
    def __init__(
        self,
        subscription_impl: _rclpy.Subscription[MsgT],
        msg_type: Type[MsgT],
        topic: str,
        callback: GenericSubscriptionCallbackUnion[bytes],
        qos_profile: QoSProfile,
        raw: Literal[True],
        *,
        on_destroy: Optional[Callable[["BaseSubscription[MsgT]"], None]] = None,
    ) -> None: ...
    @overload
    def __init__(
        self,
        subscription_impl: _rclpy.Subscription[MsgT],
        msg_type: Type[MsgT],
        topic: str,
        callback: GenericSubscriptionCallbackUnion[MsgT],
        qos_profile: QoSProfile,
        raw: Literal[False],
        *,
        on_destroy: Optional[Callable[["BaseSubscription[MsgT]"], None]] = None,
    ) -> None: ...
    @overload
    def __init__(
        self,
        subscription_impl: _rclpy.Subscription[MsgT],
        msg_type: Type[MsgT],
        topic: str,
        callback: SubscriptionCallbackUnion[MsgT],
        qos_profile: QoSProfile,
        raw: bool,
        *,
        on_destroy: Optional[Callable[["BaseSubscription[MsgT]"], None]] = None,
    ) -> None: ...
    def __init__(
        self,
        subscription_impl: _rclpy.Subscription[MsgT],
        msg_type: Type[MsgT],
        topic: str,
        callback: SubscriptionCallbackUnion[MsgT],
        qos_profile: QoSProfile,
        raw: bool,
        *,
        on_destroy: Optional[Callable[["BaseSubscription[MsgT]"], None]] = None,
    ) -> None: ...
    def get_publisher_count(self) -> int: ...
    @property
    def handle(self) -> _rclpy.Subscription[MsgT]: ...
    def destroy(self) -> None: ...
    _destroy: Any

    @property
    def topic_name(self) -> str: ...
    @property
    def callback(self) -> SubscriptionCallbackUnion[MsgT]: ...
    @callback.setter
    def callback(self, value: SubscriptionCallbackUnion[MsgT]) -> None: ...
    _set_callback_type: Any

    @property
    def logger_name(self) -> str: ...
    @property
    def is_cft_supported(self) -> bool: ...
    @property
    def is_cft_enabled(self) -> bool: ...
    def set_content_filter(
        self, filter_expression: str, expression_parameters: list[str]
    ) -> None: ...
    def get_content_filter(self) -> ContentFilterOptions: ...
    def __enter__(self) -> Self: ...
    def __exit__(
        self,
        exc_type: Optional[Type[BaseException]],
        exc_val: Optional[BaseException],
        exc_tb: Optional[TracebackType],
    ) -> None: ...
    __subscription: Any
    msg_type: Type[MsgT]
    topic: str
    qos_profile: QoSProfile
    raw: bool
    _on_destroy: Any
    _destroyed: Any
    _callback: Any
    _callback_type: Any
