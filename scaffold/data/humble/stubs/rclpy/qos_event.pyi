from rclpy.event_handler import *
from typing import Any
from enum import IntEnum
from typing import Callable
from typing import List
from typing import Optional
from rclpy.callback_groups import CallbackGroup as CallbackGroup
from rclpy.logging import get_logger as get_logger
from rclpy.qos import qos_policy_name_from_kind as qos_policy_name_from_kind
from rclpy.waitable import NumberOfEntities as NumberOfEntities
from rclpy.waitable import Waitable as Waitable

QoSPublisherEventType: Any
QoSSubscriptionEventType: Any
QoSRequestedDeadlineMissedInfo: Any
QoSLivelinessChangedInfo: Any
QoSMessageLostInfo: Any
QoSRequestedIncompatibleQoSInfo: Any
QoSOfferedDeadlineMissedInfo: Any
QoSLivelinessLostInfo: Any
QoSOfferedIncompatibleQoSInfo = QoSRequestedIncompatibleQoSInfo
UnsupportedEventTypeError: Any

class QoSEventHandler(Waitable):
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
        deadline: Optional[Callable[[QoSRequestedDeadlineMissedInfo], None]] = None,
        incompatible_qos: Optional[Callable[[QoSRequestedIncompatibleQoSInfo], None]] = None,
        liveliness: Optional[Callable[[QoSLivelinessChangedInfo], None]] = None,
        message_lost: Optional[Callable[[QoSMessageLostInfo], None]] = None,
        use_default_callbacks: bool = True,
    ) -> None: ...
    def create_event_handlers(
        self, callback_group: CallbackGroup, subscription: Any, topic_name: str
    ) -> List[QoSEventHandler]: ...
    deadline: Optional[Callable[[QoSRequestedDeadlineMissedInfo], None]]
    incompatible_qos: Optional[Callable[[QoSRequestedIncompatibleQoSInfo], None]]
    liveliness: Optional[Callable[[QoSLivelinessChangedInfo], None]]
    message_lost: Optional[Callable[[QoSMessageLostInfo], None]]
    use_default_callbacks: bool

class PublisherEventCallbacks:
    def __init__(
        self,
        *,
        deadline: Optional[Callable[[QoSOfferedDeadlineMissedInfo], None]] = None,
        liveliness: Optional[Callable[[QoSLivelinessLostInfo], None]] = None,
        incompatible_qos: Optional[Callable[[QoSRequestedIncompatibleQoSInfo], None]] = None,
        use_default_callbacks: bool = True,
    ) -> None: ...
    def create_event_handlers(
        self, callback_group: CallbackGroup, publisher: Any, topic_name: str
    ) -> List[QoSEventHandler]: ...
    deadline: Optional[Callable[[QoSOfferedDeadlineMissedInfo], None]]
    liveliness: Optional[Callable[[QoSLivelinessLostInfo], None]]
    incompatible_qos: Optional[Callable[[QoSRequestedIncompatibleQoSInfo], None]]
    use_default_callbacks: bool
