from enum import IntEnum
from typing import Callable
from typing import List
from typing import Optional
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.logging import get_logger as get_logger
from rclpy.qos import qos_policy_name_from_kind as qos_policy_name_from_kind
from rclpy.waitable import NumberOfEntities as NumberOfEntities
from rclpy.waitable import Waitable as Waitable
from enum import Enum
from typing import Any
from typing import Union
from typing_extensions import TypeAlias as TypeAlias

class QoSPublisherEventType(Enum):
    RCL_PUBLISHER_OFFERED_DEADLINE_MISSED = ...
    RCL_PUBLISHER_LIVELINESS_LOST = ...
    RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS = ...
    RCL_PUBLISHER_INCOMPATIBLE_TYPE = ...
    RCL_PUBLISHER_MATCHED = ...

class QoSSubscriptionEventType(Enum):
    RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED = ...
    RCL_SUBSCRIPTION_LIVELINESS_CHANGED = ...
    RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS = ...
    RCL_SUBSCRIPTION_MESSAGE_LOST = ...
    RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE = ...
    RCL_SUBSCRIPTION_MATCHED = ...

class QoSRequestedDeadlineMissedInfo:
    total_count: int
    total_count_change: int

class QoSLivelinessChangedInfo:
    alive_count: int
    not_alive_count: int
    alive_count_change: int
    not_alive_count_change: int

class QoSMessageLostInfo:
    total_count: int
    total_count_change: int

class QoSRequestedIncompatibleQoSInfo:
    total_count: int
    total_count_change: int
    last_policy_kind: Any

class QoSSubscriptionMatchedInfo:
    total_count: int
    total_count_change: int
    current_count: int
    current_count_change: int

class QoSOfferedDeadlineMissedInfo:
    total_count: int
    total_count_change: int

class QoSLivelinessLostInfo:
    total_count: int
    total_count_change: int

QoSPublisherMatchedInfo = QoSSubscriptionMatchedInfo
QoSOfferedIncompatibleQoSInfo: TypeAlias = QoSRequestedIncompatibleQoSInfo

class IncompatibleTypeInfo:
    total_count_change: int

class UnsupportedEventTypeError(RuntimeError): ...

class EventHandler(Waitable):
    def __init__(
        self,
        *,
        callback_group: CallbackGroup,
        callback: Callable[..., Any],
        event_type: IntEnum,
        parent_impl: Any,
    ) -> None: ...
    def is_ready(self, wait_set: Any) -> Any: ...
    def take_data(self) -> Any: ...
    async def execute(self, taken_data: Any) -> None: ...
    def get_num_entities(self) -> Any: ...
    def add_to_wait_set(self, wait_set: Any) -> None: ...
    def __enter__(self) -> None: ...
    def __exit__(self, t: Any, v: Any, tb: Any) -> None: ...
    def destroy(self) -> None: ...
    event_type: IntEnum
    callback: Callable[..., Any]
    _ready_to_take_data: Any
    _event_index: Any
    __event: Any

class SubscriptionEventCallbacks:
    def __init__(
        self,
        *,
        deadline: Optional[Callable[[QoSRequestedDeadlineMissedInfo], object]] = None,
        incompatible_qos: Optional[Callable[[QoSRequestedIncompatibleQoSInfo], object]] = None,
        liveliness: Optional[Callable[[QoSLivelinessChangedInfo], object]] = None,
        message_lost: Optional[Callable[[QoSMessageLostInfo], object]] = None,
        incompatible_type: Optional[Callable[[IncompatibleTypeInfo], object]] = None,
        matched: Optional[Callable[[QoSSubscriptionMatchedInfo], object]] = None,
        use_default_callbacks: bool = True,
    ) -> None: ...
    def create_event_handlers(
        self, callback_group: CallbackGroup, subscription: Any, topic_name: str
    ) -> List[EventHandler]: ...
    deadline: Optional[Callable[[QoSRequestedDeadlineMissedInfo], None]]
    incompatible_qos: Optional[Callable[[QoSRequestedIncompatibleQoSInfo], None]]
    liveliness: Optional[Callable[[QoSLivelinessChangedInfo], None]]
    message_lost: Optional[Callable[[QoSMessageLostInfo], None]]
    incompatible_type: Optional[Callable[[IncompatibleTypeInfo], None]]
    matched: Optional[Callable[[QoSSubscriptionMatchedInfo], None]]
    use_default_callbacks: bool

class PublisherEventCallbacks:
    def __init__(
        self,
        *,
        deadline: Optional[Callable[[QoSOfferedDeadlineMissedInfo], object]] = None,
        liveliness: Optional[Callable[[QoSLivelinessLostInfo], object]] = None,
        incompatible_qos: Optional[Callable[[QoSRequestedIncompatibleQoSInfo], object]] = None,
        incompatible_type: Optional[Callable[[IncompatibleTypeInfo], object]] = None,
        matched: Optional[Callable[[QoSPublisherMatchedInfo], object]] = None,
        use_default_callbacks: bool = True,
    ) -> None: ...
    def create_event_handlers(
        self, callback_group: CallbackGroup, publisher: Any, topic_name: str
    ) -> List[EventHandler]: ...
    deadline: Optional[Callable[[QoSOfferedDeadlineMissedInfo], None]]
    liveliness: Optional[Callable[[QoSLivelinessLostInfo], None]]
    incompatible_qos: Optional[Callable[[QoSRequestedIncompatibleQoSInfo], None]]
    incompatible_type: Optional[Callable[[IncompatibleTypeInfo], None]]
    matched: Optional[Callable[[QoSPublisherMatchedInfo], None]]
    use_default_callbacks: bool

EventHandlerData: TypeAlias = Optional[
    Union[
        QoSRequestedDeadlineMissedInfo,
        QoSLivelinessChangedInfo,
        QoSMessageLostInfo,
        QoSRequestedIncompatibleQoSInfo,
        IncompatibleTypeInfo,
        QoSSubscriptionMatchedInfo,
        QoSOfferedDeadlineMissedInfo,
        QoSLivelinessLostInfo,
        "_rclpy._rmw_offered_qos_incompatible_event_status_t",
        IncompatibleTypeInfo,
        QoSPublisherMatchedInfo,
    ]
]
